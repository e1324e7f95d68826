/* The pairs of a pixel and a light that plain tiled shading computes: the yardstick of others. */
#ifndef TL_CLASSIC_PAIRS_H
#define TL_CLASSIC_PAIRS_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* Tiles of 16 x 16 pixels; a light is on a tile where its sphere is neither wholly outside of one of the
 * four planes through the eye and a side of the tile, nor wholly before the nearest or behind the
 * farthest of the tile's surfaces; and then on every pixel of it. gbuffer: in full float, perspective.
 * lights: point lights with a range. On all threads. Cannot fail. */
uint64_t tl_classic_pairs(const tl_gbuffer *gbuffer, const tl_light_set *lights);

#endif
