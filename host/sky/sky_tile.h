/* Texels of a level that are filtered together: what is far from one is far from all. */
#ifndef TL_SKY_TILE_H
#define TL_SKY_TILE_H

#include "sky_tree.h"

enum { TL_SKY_SIDE = 8, TL_SKY_TILE = TL_SKY_SIDE * TL_SKY_SIDE };

/* A square of a level. Weights are K of sky_prefilter.h times 4 alpha^4, 1 at most, so that no sum leaves the
 * range of float. */
typedef struct tl_sky_tile {
    float toward[3][TL_SKY_TILE]; /* of texels, unit */
    float sum[3][TL_SKY_TILE];    /* of weights times solid angle and radiance */
    float weight[TL_SKY_TILE];    /* of weights times solid angle */
    float middle[3],
        radius; /* a direction, and the chord within which those of all texels are */
    float alpha2;
    float most_share2, steepness2; /* sky_prefilter.c: counts_as_a_whole */
} tl_sky_tile;

/* Adds a piece of the sky to all texels. One text for every instruction set, and the same bits. A weight is
 * off by 22u of itself: the chord, of differences of directions that are off by u each, is at least as
 * large as its texel's alpha where that shows. n pieces are added up, n u more. */
typedef void tl_sky_add_piece(tl_sky_tile *tile, const tl_sky_node *node);
extern tl_sky_add_piece tl_sky_add_piece_portable, tl_sky_add_piece_avx2,
    tl_sky_add_piece_avx512;

#endif
