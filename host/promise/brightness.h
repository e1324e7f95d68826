/* How bright pictures are: the mean of a pixel's channels. */
#ifndef TL_PROMISE_BRIGHTNESS_H
#define TL_PROMISE_BRIGHTNESS_H

#include "tilelight/image.h"

/* Of one pixel. */
double tl_brightness(const tl_image *image, uint32_t x, uint32_t y);

/* The mean of that over the picture, padding left out. */
double tl_mean_brightness(const tl_image *image);

/* most[tile] becomes the brightest pixel of each tile, [tiles_y][tiles_x], squares of `tile` pixels. */
void tl_brightest_of_tiles(const tl_image *image, uint32_t tile, double *most);

#endif
