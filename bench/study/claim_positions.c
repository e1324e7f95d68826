#include "claims.h"

#include "bench_scene.h"
#include "frame_ratio.h"
#include "tilelight/layouts.h"
#include "try.h"
#include "values.h"

#include <math.h>

/* What both layouts light. */
static const struct {
    const char *what;
    uint32_t light_count;
    double range; /* m; 0: 27 lights a tile */
} loads[] = {
    {"one light, which reaches nothing", 1, 0.001},
    {"8 lights, which reach everything", 8, 1e4},
    {"1024 lights, 27 a tile", 1024, 0.0},
};
enum { LOADS = sizeof loads / sizeof loads[0] };

/* Percent that a frame takes more with positions. */
static tl_status compare(const tl_claim_options *options,
                         const tl_gbuffer *without,
                         const tl_gbuffer *with,
                         const tl_light_set *lights,
                         tl_claim_figure *out,
                         tl_error *err)
{
    const tl_lighting_options how = tl_lighting_options_default();
    const tl_frame_side sides[2] = {{without, lights, how, 0}, {with, lights, how, 0}};
    const tl_sampling_rule rule = {.least_samples = 2,
                                   .seconds = options->seconds / TL_STUDY_BLOCK_COUNT};
    double blocks[TL_STUDY_BLOCK_COUNT];
    tl_frame_ratio took;
    tl_status status = TL_OK;
    for (int i = 0; i < TL_STUDY_BLOCK_COUNT; i++) {
        TRY(tl_frame_ratio_measure(options->device, sides, &rule, &took, err));
        blocks[i] = 100.0 * (took.ratio.median - 1.0);
    }
    const tl_study_time time =
        tl_study_time_of(blocks, TL_STUDY_BLOCK_COUNT, TL_STUDY_BLOCK_COUNT);
    out->ours = time.median;
    out->low = time.low;
    out->high = time.high;
done:
    return status;
}

static tl_status measure(const tl_claim_options *options,
                         int load,
                         tl_claim_figures *figures,
                         tl_error *err)
{
    tl_bench_scene_options scene = tl_bench_scene_options_default();
    tl_gbuffer *plain = NULL, *without = NULL, *with = NULL;
    tl_light_set lights = {0};
    tl_status status = TL_OK;
    scene.width = options->width;
    scene.height = options->height;
    scene.light_count = loads[load].light_count;
    scene.range = loads[load].range;
    TRY(tl_bench_scene_make(tl_bench_scene_find("spheres"), &scene, &plain, &lights, err));
    TRY(tl_gbuffer_pack(plain, TL_LAYOUT_MERLIN, &without, NULL, err));
    TRY(tl_gbuffer_pack(plain, TL_LAYOUT_MERLIN_POSITION, &with, NULL, err));
    TRY(compare(options, without, with, &lights,
                tl_claim_add(figures, "% more time", 10.0, 20.0, (double)NAN, "%u x %u, %s",
                             options->width, options->height, loads[load].what),
                err));
done:
    tl_gbuffer_destroy(plain);
    tl_gbuffer_destroy(without);
    tl_gbuffer_destroy(with);
    tl_light_set_clear(&lights);
    return status;
}

tl_status tl_claim_position_buffer(const tl_claim_options *options,
                                   tl_claim_figures *out,
                                   tl_error *err)
{
    tl_claim_figures made = {.count = 0};
    tl_status status = TL_OK;
    for (int load = 0; load < LOADS; load++)
        TRY(measure(options, load, &made, err));
    *out = made;
done:
    return status;
}
