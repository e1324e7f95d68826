#include "explain_costs.h"

#include "sampling.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static tl_status shade(const job *j,
                       tl_lighting *lighting,
                       uint64_t without,
                       tl_image *image,
                       double *ms,
                       tl_error *err)
{
    return tl_lighting_shade_without(lighting, j->gbuffer, without, image, ms, err);
}

/* By turns, after once each, for which kernels are built. ms[0] with the effect, ms[1] without. */
static tl_status take_pairs(const job *j,
                            tl_lighting *lighting,
                            uint64_t without,
                            tl_image *image,
                            tl_samples *all,
                            tl_samples *more,
                            tl_error *err)
{
    const uint64_t lacks[2] = {0, without};
    double ms[2];
    tl_status status = TL_OK;
    for (int i = -1; i < COST_RUNS; i++) {
        const int first = i & 1;
        TRY(shade(j, lighting, lacks[first], image, &ms[first], err));
        TRY(shade(j, lighting, lacks[1 - first], image, &ms[1 - first], err));
        if (i < 0)
            continue;
        TRY(tl_samples_add(all, ms[0], err));
        TRY(tl_samples_add(more, ms[0] - ms[1], err));
    }
done:
    return status;
}

static tl_status measure(const job *j,
                         tl_lighting *lighting,
                         int effect,
                         tl_image *image,
                         explained *e,
                         tl_error *err)
{
    effect_cost *cost = &e->costs[effect];
    tl_samples all = {0}, more = {0};
    tl_status status = TL_OK;
    TRY(take_pairs(j, lighting, TL_ON(effect), image, &all, &more, err));
    const tl_summary with = tl_samples_summarize(&all), by = tl_samples_summarize(&more);
    cost->is_known = true;
    cost->ms = by.median;
    cost->low = by.interval.low;
    cost->high = by.interval.high;
    cost->share = with.median > 0.0 ? by.median / with.median : 0.0;
    if (e->shade_ms == 0.0 || with.median < e->shade_ms)
        e->shade_ms = with.median;
done:
    tl_samples_clear(&all);
    tl_samples_clear(&more);
    return status;
}

tl_status explain_measure_costs(const job *j,
                                tl_lighting *lighting,
                                explained *e,
                                tl_error *err)
{
    const tl_camera *camera = &j->gbuffer->camera;
    tl_image *image = NULL;
    tl_status status = TL_OK;
    e->has_costs = true;
    TRY(tl_image_create(camera->width, camera->height, &image, err));
    for (int i = 0; i < TL_EFFECT_COUNT; i++) {
        const char *bound = tl_effect_bound((tl_effect)i);
        effect_cost *cost = &e->costs[i];
        if (!(e->of.effects >> i & 1u))
            continue;
        if (bound)
            snprintf(cost->why, sizeof cost->why, "not to be taken out alone: %s", bound);
        else
            TRY(measure(j, lighting, i, image, e, err));
    }
done:
    tl_image_destroy(image);
    return status;
}

static double median_of(const double *runs, size_t tiles, size_t tile)
{
    double times[COST_RUNS];
    for (size_t i = 0; i < COST_RUNS; i++)
        times[i] = runs[i * tiles + tile];
    return tl_summarize(times, COST_RUNS).median;
}

tl_status explain_time_tiles(const job *j, tl_lighting *lighting, explained *e, tl_error *err)
{
    const tl_camera *camera = &j->gbuffer->camera;
    const size_t tiles = (size_t)e->tiles_x * e->tiles_y;
    double *runs = malloc((size_t)COST_RUNS * tiles * sizeof *runs);
    tl_image *image = NULL;
    tl_status status = TL_OK;
    e->tile_us = malloc(tiles * sizeof *e->tile_us);
    if (!runs || !e->tile_us)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for times of %zu tiles", tiles));
    TRY(tl_image_create(camera->width, camera->height, &image, err));
    TRY(tl_lighting_time_tiles(lighting, j->gbuffer, image, runs, err)); /* builds, warms up */
    for (size_t i = 0; i < COST_RUNS; i++)
        TRY(tl_lighting_time_tiles(lighting, j->gbuffer, image, runs + i * tiles, err));
    for (size_t tile = 0; tile < tiles; tile++)
        e->tile_us[tile] = median_of(runs, tiles, tile);
done:
    tl_image_destroy(image);
    free(runs);
    return status;
}
