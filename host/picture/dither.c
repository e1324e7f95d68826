#include "dither.h"

#include <string.h>

#include "blue_noise.h"

#include <stdint.h>

enum { ORDERED_SIDE = 8 };

/* B. Bayer, "An optimum method for two-level rendition of continuous-tone pictures", 1973: the rank of a
 * pixel has the bits of x ^ y and y by turns, those of the finest step first. */
static uint32_t bayer_rank(uint32_t x, uint32_t y)
{
    uint32_t rank = 0;
    for (uint32_t bit = 1; bit < ORDERED_SIDE; bit *= 2)
        rank = rank << 2 | ((x ^ y) & bit ? 2u : 0u) | (y & bit ? 1u : 0u);
    return rank;
}

static double ordered(uint32_t x, uint32_t y)
{
    return (bayer_rank(x % ORDERED_SIDE, y % ORDERED_SIDE) + 0.5) /
           (ORDERED_SIDE * ORDERED_SIDE);
}

static double noise(uint32_t x, uint32_t y)
{
    return (blue_noise[y * TL_DITHER_SIDE + x] + 0.5) / (TL_DITHER_SIDE * TL_DITHER_SIDE);
}

static double (*const added[TL_DITHER_COUNT])(uint32_t x, uint32_t y) = {
    [TL_DITHER_ORDERED] = ordered,
    [TL_DITHER_BLUE_NOISE] = noise,
};

void tl_dither_fill(enum tl_dither_name dither, double rounding, float *tile)
{
    for (uint32_t y = 0; y < TL_DITHER_SIDE; y++)
        for (uint32_t x = 0; x < TL_DITHER_SIDE; x++)
            tile[y * TL_DITHER_SIDE + x] =
                (float)(added[dither] ? added[dither](x, y) : rounding);
}

void tl_dither_shift(uint32_t x, uint32_t y, float *tile)
{
    float from[TL_DITHER_SIDE * TL_DITHER_SIDE];
    memcpy(from, tile, sizeof from);
    for (uint32_t row = 0; row < TL_DITHER_SIDE; row++)
        for (uint32_t column = 0; column < TL_DITHER_SIDE; column++)
            tile[row * TL_DITHER_SIDE + column] =
                from[(y + row) % TL_DITHER_SIDE * TL_DITHER_SIDE +
                     (x + column) % TL_DITHER_SIDE];
}
