/* What a shadow map may let through where the place it is looked up at is uncertain. */
#ifndef TL_ALLOWANCE_SHADOW_H
#define TL_ALLOWANCE_SHADOW_H

#include "rough.h"

/* Of a light with this shape; {1, 1} of one without a map. */
interval tl_shadow_allowance(const tl_prepared *prepared,
                             const tl_view_shape *shape,
                             const rough_surface *s,
                             const way *w,
                             const incidence *n_dot_l);

#endif
