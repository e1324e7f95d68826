/* The sky of a light set as a map of the whole of space, as light comes from it: texels of equal steps of
 * longitude and latitude, each of one radiance all over. Its axes are right, up and ahead, as
 * kernels/texture.h has them: longitude 0 is ahead, in the middle of a row, and grows to the right; the first
 * row is at the top. */
#ifndef TL_SKY_SOURCE_H
#define TL_SKY_SOURCE_H

#include "tilelight/lights.h"

typedef struct tl_sky_source {
    uint32_t width, height; /* texels */
    const float *pixels;    /* [height][width][3], radiance; the light set's, or `own` */
    float *own;             /* or NULL */
} tl_sky_source;

/* Rows of the map of a gradient. It is linear in the sine of the elevation, as solid angle is, and an even
 * number of rows has none across the horizon: the middle of a row is its mean. */
#define TL_GRADIENT_ROWS 512

/* Of an image without the set's intensity and rotation; of a gradient or one colour with all there is. The
 * image must outlive it. Release with tl_sky_source_clear. Fails with TL_ERR_MEMORY. */
tl_status tl_sky_source_of(const tl_light_set *set, tl_sky_source *out, tl_error *err);

/* Accepts one that is all zero. */
void tl_sky_source_clear(tl_sky_source *source);

#endif
