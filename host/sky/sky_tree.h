/* A sky's light by direction, coarse to fine: what sums over all directions are taken over. */
#ifndef TL_SKY_TREE_H
#define TL_SKY_TREE_H

#include "sky_source.h"

/* A piece of the sky: the texels, or parts of texels, that lie in a cell of an octahedral map. */
typedef struct tl_sky_node {
    float toward[3];   /* unit; where its light comes from on average (right, up, ahead) */
    float radius;      /* chord from there within which the piece lies */
    float radiance[3]; /* mean */
    float solid_angle; /* sr, of what it is made of; 0: it is empty */
} tl_sky_node;

/* Level 0 is the whole; node i of a level has nodes 4 i to 4 i + 3 of the next below it. */
typedef struct tl_sky_tree {
    unsigned depth;      /* levels beside the whole */
    tl_sky_node **nodes; /* [depth + 1][4^level]; owned */
} tl_sky_tree;

/* 2^depth cells along a side of the finest level. Every texel is cut into parts that are smaller than its
 * cells, each with its exact solid angle: what the tree holds is all of the light. Sums are in double, and
 * what comes of them is rounded once for each level. Release with tl_sky_tree_clear. Fails with
 * TL_ERR_MEMORY. */
tl_status tl_sky_tree_make(const tl_sky_source *source,
                           unsigned depth,
                           tl_sky_tree *out,
                           tl_error *err);

/* Accepts one that is all zero. */
void tl_sky_tree_clear(tl_sky_tree *tree);

/* Direction (right, up, ahead), unit, at (x, y) of an octahedral map of `size` texels a side: (0, 0) is the
 * corner of the first texel. */
void tl_sky_cell_direction(double x, double y, double size, double out[3]);

#endif
