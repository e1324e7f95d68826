/* How far places of a G-buffer's surfaces may be off, for what must not take that for a form of theirs. */
#ifndef TL_PLACE_SLACK_H
#define TL_PLACE_SLACK_H

#include "tilelight/gbuffer.h"

/* A coordinate along a ray, its product with depth, and sums that are made of it: 8u, u = 2^-24. */
#define TL_PLACE_MISREAD (8 * 0x1p-24)

/* A surface at depth d (m) may be off its place by out[0] + d (out[1] + d out[2]), m: by the layout's
 * rounding, and by that of kernels; `beside` is added to out[0]. Cannot fail. */
void tl_place_slack(const tl_gbuffer *gbuffer, double beside, float out[3]);

#endif
