/* Pixels at which float may be off by far more than elsewhere, found by looking at every pixel and every
 * light that may reach it. There are two kinds.
 *
 * Where the picture hangs on rounding. Float and double may decide otherwise whether a light adds anything,
 * and where what it would add does not fade to nothing there, a pixel is off by that: at the rim where n.l =
 * 0, under models whose lobe is not multiplied by n.l, and at the end of a falloff that is a table. rim_row.c
 * derives how near to a rim that may be.
 *
 * Where a light is near. Positions move by a share of the way to the eye, |p|; that turns the way to a light,
 * l, by as much over its length. Of the pixels around a light a quarter as many are off twice as far, so a
 * sample hardly meets the worst of them: those with |l| < |p| / TL_NEARER are found here.
 *
 * Everywhere else what a light adds changes by a multiple of rounding that many pixels share. */
#ifndef TL_RIMS_H
#define TL_RIMS_H

#include "packing.h"
#include "prepared.h"

enum { TL_NEARER = 128 };

enum { TL_RIM_TILE = 16 }; /* px; the side of a tile here, whatever that of the kernels is */

/* A square of the picture, cut where the picture ends. */
typedef struct tl_rim_tile {
    uint32_t
        light_count; /* that may reach it: all without a range, of others those that reach its box */
    float nearest, farthest; /* m; of its surfaces; 0 where there is none */
    uint32_t rim_count;      /* pixels of either kind */
} tl_rim_tile;

/* tiles: [tiles_y][tiles_x] of TL_RIM_TILE pixels; at_rim: [height][width], 1 for pixels of either kind, else
 * 0. On all threads. Cannot fail. */
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
