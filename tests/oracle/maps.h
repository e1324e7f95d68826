/* Which place of a picture a direction shows, and the colours of a sky, by the words of docs/conventions.md
 * ("Textures of lights, and skies"). Nothing is shared with kernels/texture.h and sky.h. Places count pixels
 * from 0 at the centre of the first. Off by 10v of the picture's size, v = 2^-113. */
#ifndef TL_ORACLE_MAPS_H
#define TL_ORACLE_MAPS_H

#include "oracle/vectors.h"

typedef struct tl_oracle_place {
    wide x, y;
} tl_oracle_place;

/* A slide: ahead is its middle, and its edges are at tan(half) from there, half: radians. right, up, ahead:
 * unit and at right angles to each other. */
tl_oracle_place tl_oracle_slide_place(
    wide3 way, wide3 right, wide3 up, wide3 ahead, wide half, int width, int height);

/* A map of longitude and latitude: ahead in the middle, up at the top. */
tl_oracle_place tl_oracle_globe_place(
    wide3 way, wide3 right, wide3 up, wide3 ahead, int width, int height);

/* Between the centres of pixels, which go on at their ends, or come round: values [height][width]. */
wide tl_oracle_shown(
    const float *values, int width, int height, int is_around, tl_oracle_place at);

/* Of a sky that is a gradient, by the sine of the elevation of a ray. */
wide tl_oracle_gradient(wide3 ray, wide3 up, wide horizon, wide zenith, wide ground);

#endif
