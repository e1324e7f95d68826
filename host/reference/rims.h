/* Where the picture hangs on rounding, found by looking at every pixel and every light that may reach it.
 *
 * Float and double may differ by much in a pixel only where they decide otherwise whether a light adds anything
 * and what it would add does not fade to nothing there: at the rim where n.l = 0, under models whose lobe is not
 * multiplied by n.l, and at the end of a falloff that is a table. Everywhere else what a light adds changes by a
 * multiple of rounding. rims.c derives how near to the rim that may be. */
#ifndef TL_RIMS_H
#define TL_RIMS_H

#include "packing.h"
#include "prepared.h"

enum { TL_RIM_TILE = 16 }; /* px; the side of a tile here, whatever that of the kernels is */

/* A square of the picture, cut where the picture ends. */
typedef struct tl_rim_tile {
    uint32_t
        light_count; /* that may reach it: all without a range, of others those that reach its box */
    float nearest, farthest; /* m; of its surfaces; 0 where there is none */
    uint32_t rim_count;      /* pixels at a rim */
} tl_rim_tile;

/* tiles: [tiles_y][tiles_x] of TL_RIM_TILE pixels; at_rim: [height][width], 1 or 0. On all threads. Cannot
 * fail. */
void tl_rims_find(const tl_prepared *prepared,
                  const tl_gbuffer *gbuffer,
                  tl_rim_tile *tiles,
                  uint8_t *at_rim);

/* One row of tiles, compiled once per instruction set. */
typedef void tl_rim_row(const tl_prepared *prepared,
                        const tl_word_planes *planes,
                        uint32_t width,
                        uint32_t height,
                        uint32_t tile_row,
                        tl_rim_tile *tiles,
                        uint8_t *at_rim);

#endif
