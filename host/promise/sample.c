#include "sample.h"

#include "brightness.h"
#include "random.h"
#include "strata.h"
#include "surround.h"
#include "try.h"

#include "tilelight/report.h"

#include <stdlib.h>

enum { TILE_PIXELS = TL_RIM_TILE * TL_RIM_TILE };

tl_sample_options tl_sample_options_default(void)
{
    return (tl_sample_options){.seed = 1, .pairs = 1.5e6, .rim_most = 16384};
}

void tl_sample_destroy(tl_sample *sample)
{
    if (!sample)
        return;
    free(sample->strata);
    free(sample->at);
    free(sample->stratum);
    free(sample->reference);
    free(sample);
}

int tl_sample_is_whole(const tl_sample *sample)
{
    return sample->count == (size_t)sample->width * sample->height;
}

/* What is drawn from. */
typedef struct source {
    uint32_t width, height, tiles_x;
    const uint8_t *at_rim; /* [height][width] */
    uint64_t state;
    uint32_t rims_ahead, rims_to_draw; /* of pixels at rims that were not yet come to */
} source;

static void put(tl_sample *to, uint32_t x, uint32_t y, uint32_t stratum)
{
    to->at[to->count] = (tl_pixel_at){x, y};
    to->stratum[to->count++] = stratum;
}

/* Of those at rims each is taken with the chance that leaves all subsets as likely: D. Knuth, "The Art of
 * Computer Programming", volume 2, section 3.4.2, algorithm S. Returns how many of the tile are not at rims:
 * their places in `plain`. */
static uint32_t part_rims(source *from, tl_sample *to, uint32_t x0, uint32_t y0, uint8_t *plain)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint32_t x = x0 + i % TL_RIM_TILE, y = y0 + i / TL_RIM_TILE;
        if (x >= from->width || y >= from->height)
            continue;
        if (!from->at_rim[(size_t)y * from->width + x]) {
            plain[count++] = (uint8_t)i;
            continue;
        }
        if (tl_random_below(&from->state, from->rims_ahead--) < from->rims_to_draw) {
            from->rims_to_draw--;
            put(to, x, y, to->stratum_count - 1);
        }
    }
    return count;
}

static void draw_tile(source *from, tl_sample *to, uint32_t tile)
{
    const uint32_t x0 = tile % from->tiles_x * TL_RIM_TILE,
                   y0 = tile / from->tiles_x * TL_RIM_TILE;
    uint8_t plain[TILE_PIXELS];
    const uint32_t count = part_rims(from, to, x0, y0, plain);
    for (uint32_t i = 0; i < to->strata[tile].drawn; i++) { /* the first places of a shuffle */
        const uint32_t k = i + tl_random_below(&from->state, count - i);
        const uint8_t place = plain[k];
        plain[k] = plain[i];
        put(to, x0 + place % TL_RIM_TILE, y0 + place / TL_RIM_TILE, tile);
    }
}

/* begins: [tiles + 1] */
static void draw_all(source *from, tl_sample *to, size_t *begins)
{
    const uint32_t tiles = to->stratum_count - 1;
    for (uint32_t tile = 0; tile < tiles; tile++) {
        begins[tile] = to->count;
        draw_tile(from, to, tile);
    }
    begins[tiles] = to->count;
}

/* What is known before anything is drawn; [tiles] each, and [height][width] flags. */
typedef struct facts {
    tl_tile_facts *tiles;
    tl_rim_tile *rims;
    double *brightest;
    uint8_t *at_rim;
    size_t *begins;
    uint32_t rim_count;
} facts;

static void facts_clear(facts *f)
{
    free(f->tiles);
    free(f->rims);
    free(f->brightest);
    free(f->at_rim);
    free(f->begins);
}

static tl_status out_of_memory(const tl_sample *sample, tl_error *err)
{
    return tl_fail(err, TL_ERR_MEMORY, "out of memory for a sample of %u x %u pixels",
                   sample->width, sample->height);
}

static tl_status facts_find(const tl_prepared *prepared,
                            const tl_gbuffer *gbuffer,
                            const tl_image *guide,
                            tl_sample *sample,
                            facts *f,
                            tl_error *err)
{
    const uint32_t tiles = sample->stratum_count - 1;
    const double mean = tl_mean_brightness(guide);
    f->tiles = malloc(tiles * sizeof *f->tiles);
    f->rims = malloc(tiles * sizeof *f->rims);
    f->brightest = malloc(tiles * sizeof *f->brightest);
    f->at_rim = malloc((size_t)sample->width * sample->height);
    f->begins = malloc((tiles + (size_t)1) * sizeof *f->begins);
    if (!f->tiles || !f->rims || !f->brightest || !f->at_rim || !f->begins)
        return out_of_memory(sample, err);
    tl_rims_find(prepared, gbuffer, f->rims, f->at_rim);
    tl_brightest_of_tiles(guide, TL_RIM_TILE, f->brightest);
    for (uint32_t i = 0; i < tiles; i++) {
        const uint32_t x = i % sample->tiles_x * TL_RIM_TILE,
                       y = i / sample->tiles_x * TL_RIM_TILE;
        const uint32_t right = sample->width - x, below = sample->height - y;
        const uint32_t size = (right < TL_RIM_TILE ? right : TL_RIM_TILE) *
                              (below < TL_RIM_TILE ? below : TL_RIM_TILE);
        f->rim_count += f->rims[i].rim_count;
        f->tiles[i] =
            (tl_tile_facts){f->rims[i], size - f->rims[i].rim_count, f->brightest[i] + mean};
    }
    return TL_OK;
}

static tl_status reserve(tl_sample *sample, tl_error *err)
{
    size_t count = 0;
    for (uint32_t i = 0; i < sample->stratum_count; i++)
        count += sample->strata[i].drawn;
    sample->at = malloc((count + 1) * sizeof *sample->at);
    sample->stratum = malloc((count + 1) * sizeof *sample->stratum);
    sample->reference = malloc((count + 1) * sizeof *sample->reference);
    return sample->at && sample->stratum && sample->reference ? TL_OK
                                                              : out_of_memory(sample, err);
}

static tl_status draw(const tl_prepared *prepared,
                      const tl_gbuffer *gbuffer,
                      const tl_image *guide,
                      const tl_sample_options *options,
                      tl_sample *sample,
                      tl_error *err)
{
    tl_status status = TL_OK;
    facts f = {0};
    const uint32_t tiles = sample->stratum_count - 1;
    TRY(facts_find(prepared, gbuffer, guide, sample, &f, err));
    TRY(tl_strata_of_tiles(f.tiles, tiles, options->pairs, sample->strata, err));
    sample->pixel_cost = tl_mean_pixel_cost(f.tiles, tiles);
    const uint32_t rims_drawn =
        f.rim_count < options->rim_most ? f.rim_count : options->rim_most;
    sample->strata[tiles] = (tl_stratum){f.rim_count, rims_drawn};
    TRY(reserve(sample, err));
    source from = {.width = sample->width,
                   .height = sample->height,
                   .tiles_x = sample->tiles_x,
                   .at_rim = f.at_rim,
                   .state = options->seed,
                   .rims_ahead = f.rim_count,
                   .rims_to_draw = rims_drawn};
    draw_all(&from, sample, f.begins);
    const tl_pixel_groups groups = {sample->at, f.begins, tiles};
    tl_reference_some(prepared, gbuffer, &groups, sample->reference);
done:
    facts_clear(&f);
    return status;
}

tl_status tl_sample_draw(const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         const tl_image *guide,
                         const tl_sample_options *options,
                         tl_sample **out,
                         tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    tl_prepared prepared = {0};
    tl_sample *made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a sample"));
    made->width = gbuffer->camera.width;
    made->height = gbuffer->camera.height;
    made->tiles_x = (made->width + TL_RIM_TILE - 1) / TL_RIM_TILE;
    made->tiles_y = (made->height + TL_RIM_TILE - 1) / TL_RIM_TILE;
    made->stratum_count = made->tiles_x * made->tiles_y + 1;
    made->strata = calloc(made->stratum_count, sizeof *made->strata);
    if (!made->strata)
        TRY(out_of_memory(made, err));
    TRY(tl_prepare(gbuffer, lights, &(tl_prepare_options){.tile_size = TL_RIM_TILE}, NULL,
                   &prepared, err));
    tl_reference_surround(&prepared, gbuffer, TL_TWIN_REFERENCE);
    TRY(draw(&prepared, gbuffer, guide, options, made, err));
    made->seconds = tl_seconds() - start;
    *out = made;
    made = NULL;
done:
    tl_prepared_clear(&prepared);
    tl_sample_destroy(made);
    return status;
}
