#include "strata.h"

#include <math.h>
#include <stdlib.h>

/* Besides lights a pixel costs about as much as so many. */
static const double pixel_itself = 8.0;

/* One tile in so many is taken whole, for each kind of risk. */
enum { TILES_PER_WHOLE = 512 };

double tl_mean_pixel_cost(const tl_tile_facts *tiles, size_t count)
{
    double cost = 0.0, pixels = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double size = (double)tiles[i].pixel_count;
        pixels += size;
        cost += size * ((double)tiles[i].of.light_count + pixel_itself);
    }
    return pixels > 0.0 ? cost / pixels : pixel_itself;
}

static double list_length(const tl_tile_facts *tile)
{
    return (double)tile->of.light_count;
}

static double brightness(const tl_tile_facts *tile)
{
    return tile->brightest;
}

/* How many times as far the farthest surface is as the nearest. */
static double depth_range(const tl_tile_facts *tile)
{
    return tile->of.nearest > 0.0f ? (double)tile->of.farthest / (double)tile->of.nearest
                                   : (double)(tile->of.farthest - tile->of.nearest);
}

/* What makes a tile one at risk. */
static double (*const risks[])(const tl_tile_facts *) = {list_length, brightness, depth_range};

typedef struct ranked {
    double risk;
    size_t tile;
} ranked;

/* The greatest first; of equal ones the first. */
static int by_risk(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->risk != y->risk)
        return x->risk > y->risk ? -1 : 1;
    return x->tile < y->tile ? -1 : 1;
}

static void take_whole(const tl_tile_facts *tiles,
                       size_t count,
                       ranked *ranks,
                       tl_stratum *strata)
{
    for (size_t k = 0; k < sizeof risks / sizeof risks[0]; k++) {
        for (size_t i = 0; i < count; i++)
            ranks[i] = (ranked){risks[k](&tiles[i]), i};
        qsort(ranks, count, sizeof *ranks, by_risk);
        for (size_t i = 0; i < (count + TILES_PER_WHOLE - 1) / TILES_PER_WHOLE; i++)
            strata[ranks[i].tile].drawn = strata[ranks[i].tile].size;
    }
}

tl_status tl_strata_of_tiles(
    const tl_tile_facts *tiles, size_t count, double pairs, tl_stratum *strata, tl_error *err)
{
    double pixels = 0.0, bright = 0.0;
    ranked *ranks = malloc(count * sizeof *ranks);
    if (!ranks)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a sample of %zu tiles", count);
    for (size_t i = 0; i < count; i++) {
        const double size = (double)tiles[i].pixel_count;
        pixels += size;
        bright += size * tiles[i].brightest;
    }
    const double share = pixels > 0.0 ? pairs / tl_mean_pixel_cost(tiles, count) / pixels : 1.0;
    for (size_t i = 0; i < count; i++) {
        const double size = (double)tiles[i].pixel_count;
        const double by_light =
            bright > 0.0 ? size * tiles[i].brightest / bright * pixels : size;
        const double wanted = ceil(share * 0.5 * (size + by_light));
        strata[i].size = tiles[i].pixel_count;
        strata[i].drawn =
            share < 1.0 && wanted < size ? (uint32_t)wanted : tiles[i].pixel_count;
    }
    take_whole(tiles, count, ranks, strata);
    free(ranks);
    return TL_OK;
}
