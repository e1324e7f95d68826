/* Which tiles and lights of a frame use which effects. */
#ifndef TL_EXPLAIN_USE_H
#define TL_EXPLAIN_USE_H

#include "explain.h"

/* Fills e->use, once e->surfaces is there. Fails with TL_ERR_MEMORY. */
tl_status explain_find_use(const job *j,
                           const tl_effect_use *of_lights,
                           explained *e,
                           tl_error *err);

#endif
