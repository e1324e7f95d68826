/* What a shading kernel in float may give for a pixel: the value in double, and an interval that
 * every correct kernel stays in. allowance.c derives it. */
#ifndef TL_ALLOWANCE_H
#define TL_ALLOWANCE_H

#include "prepared.h"

#include "tilelight/check.h"

/* Linear Rec. 709; low <= expected <= high. */
typedef struct tl_allowance {
    double expected[3], low[3], high[3];
    int certain; /* 0: rounding may decide on a light, and the interval holds both decisions */
} tl_allowance;

/* What one light does to a pixel. */
typedef struct tl_light_share {
    double distance; /* m; 1 of a directional light */
    double n_dot_l;
    int certain; /* 0: rounding may decide whether it reaches the pixel or is above its surface */
    double low[3], high[3]; /* what it adds to the radiance, sums left out of account */
} tl_light_share;

/* The pixel at (column, row) of the frame. planes: [TL_PLANE_COUNT], NULL where absent. */
tl_allowance tl_allowance_of(const tl_prepared *prepared,
                             float *const planes[TL_PLANE_COUNT],
                             uint32_t column,
                             uint32_t row,
                             tl_cosine cosine);

/* The share of light `index` there; 0 where it has none whatever rounding does. */
int tl_allowance_share(const tl_prepared *prepared,
                       float *const planes[TL_PLANE_COUNT],
                       uint32_t column,
                       uint32_t row,
                       uint32_t index,
                       tl_cosine cosine,
                       tl_light_share *out);

#endif
