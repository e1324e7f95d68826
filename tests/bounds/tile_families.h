/* Lights that reach a pixel by one ulp, of rays and distances of every kind: are its tile and the rectangle
 * of the light, kernels/tile_rect.h, of one opinion? */
#ifndef TL_TEST_TILE_FAMILIES_H
#define TL_TEST_TILE_FAMILIES_H

#include "bounds/draws.h"
#include "bounds/tally.h"

typedef struct tl_tile_family {
    const char *name;
    void (*attempt)(tl_draws *draws, tl_tally *tally);
} tl_tile_family;

enum { TL_TILE_FAMILIES = 4 };
extern const tl_tile_family tl_tile_families[TL_TILE_FAMILIES];

#endif
