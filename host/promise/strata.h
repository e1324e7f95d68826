/* How many pixels of each tile are drawn. */
#ifndef TL_PROMISE_STRATA_H
#define TL_PROMISE_STRATA_H

#include "sample.h"

/* What is known of a tile before a pixel of it is drawn. */
typedef struct tl_tile_facts {
    tl_rim_tile of;
    uint32_t pixel_count; /* without those at rims */
    double brightest; /* the brightest of its pixels, and the mean of the picture beside that */
} tl_tile_facts;

/* Lights that a pixel is looked at with, in the mean, and as many as the rest of it costs. */
double tl_mean_pixel_cost(const tl_tile_facts *tiles, size_t count);

/* strata: [count], of each its size and how many are drawn: about as many in all as `pairs` of pixel and
 * light pay for, at least one a tile, half of them evenly over the picture, half in proportion to the
 * brightest pixel; of tiles at most risk all. Fails with TL_ERR_MEMORY. */
tl_status tl_strata_of_tiles(
    const tl_tile_facts *tiles, size_t count, double pairs, tl_stratum *strata, tl_error *err);

#endif
