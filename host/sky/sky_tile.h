/* Texels of a level that are filtered together: what is far from one is far from all. */
#ifndef TL_SKY_TILE_H
#define TL_SKY_TILE_H

#include "sky_tree.h"

enum { TL_SKY_SIDE = 8, TL_SKY_TILE = TL_SKY_SIDE * TL_SKY_SIDE };

/* A square of a level. */
typedef struct tl_sky_tile {
    double middle[3],
        radius; /* a direction, and the chord within which those of all texels are */
    double toward[3][TL_SKY_TILE]; /* of texels, unit */
    double sum[3][TL_SKY_TILE];    /* of weights times radiance */
    double weight[TL_SKY_TILE];    /* of weights */
    double alpha2, near;           /* tl_sky_level_near */
} tl_sky_tile;

/* Adds a piece of the sky to all texels. One text for every instruction set, and the same bits. */
typedef void tl_sky_add_piece(tl_sky_tile *tile, const tl_sky_node *node);
extern tl_sky_add_piece tl_sky_add_piece_portable, tl_sky_add_piece_avx2;

#endif
