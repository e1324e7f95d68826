/* What is added to values before they are cut to codes (kernels/tones.h). */
#ifndef TL_DITHER_H
#define TL_DITHER_H

#include "tones.h"

#include <stdint.h>

/* tile: [TL_DITHER_SIDE][TL_DITHER_SIDE], above 0 and below 1; of TL_DITHER_NONE all are `rounding`. The
 * others have as many below any t as t says, to half a rank: their mean is 1/2. */
void tl_dither_fill(enum tl_dither_name dither, double rounding, float *tile);

/* Makes the tile that of a part of a picture, whose upper left pixel is at (x, y) there. */
void tl_dither_shift(uint32_t x, uint32_t y, float *tile);

#endif
