/* What is added to values before they are cut to codes (kernels/tones.h). */
#ifndef TL_DITHER_H
#define TL_DITHER_H

#include "tones.h"

/* tile: [TL_DITHER_SIDE][TL_DITHER_SIDE], above 0 and below 1; of TL_DITHER_NONE all are `rounding`. The others
 * have as many below any t as t says, to half a rank: their mean is 1/2. */
void tl_dither_fill(enum tl_dither_name dither, double rounding, float *tile);

#endif
