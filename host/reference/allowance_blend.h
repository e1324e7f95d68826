/* What blending a layer over what is behind it makes of what both may be. */
#ifndef TL_ALLOWANCE_BLEND_H
#define TL_ALLOWANCE_BLEND_H

#include "allowance.h"

/* opacity: of the layer, above 0 to 1. */
tl_allowance tl_allowance_blended(float opacity,
                                  const tl_allowance *lit,
                                  const tl_allowance *behind);

#endif
