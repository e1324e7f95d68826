#include "explain.h"

#include "console.h"
#include "explain_costs.h"
#include "explain_map.h"
#include "explain_text.h"
#include "explain_use.h"
#include "output.h"
#include "surface_pixels.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

enum { OPTION_EXPLAIN = 256, OPTION_COSTS, OPTION_MAP, OPTION_COST_MAP };

static error_t parse(int key, char *text, struct argp_state *state)
{
    explain_options *options = state->input;
    switch (key) {
    case OPTION_EXPLAIN: options->text = true; return 0;
    case OPTION_COSTS: options->text = options->costs = true; return 0;
    case OPTION_COST_MAP:
        output_kind(state, "--explain-map-costs", text, OUTPUT_PNG);
        options->cost_map = text;
        return 0;
    case OPTION_MAP:
        output_kind(state, "--explain-map", text, OUTPUT_PNG);
        options->map = text;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"explain", OPTION_EXPLAIN, NULL, 0,
     "Say which effects the frame called for and why, what was left out, what was built and "
     "how much work it was, on standard error or in --json (docs/effects.md)",
     0},
    {"explain-costs", OPTION_COSTS, NULL, 0,
     "--explain, and what each effect costs in time: the frame is shaded with and without it "
     "by turns, 7 times each, and kernels without it are built where the cache has none: a few "
     "seconds",
     0},
    {"explain-map", OPTION_MAP, "FILE.png", 0,
     "A picture of how many lights each tile lists; standard error says what its colours mean",
     0},
    {"explain-map-costs", OPTION_COST_MAP, "FILE.png", 0,
     "A picture of how long a thread shades each tile, measured by a clock in the kernel, the "
     "median of 7 frames (on x86 processors); standard error says what its colours mean",
     0},
    {0},
};

const struct argp explain_argp = {.options = options_table, .parser = parse};

tl_status explain_check(const explain_options *options, const char *input, tl_error *err)
{
    tl_status status = TL_OK;
    if (options->map)
        TRY(output_check(options->map, input, err));
    if (options->cost_map)
        TRY(output_check(options->cost_map, input, err));
done:
    return status;
}

bool explain_wanted(const explain_options *options)
{
    return options->text || options->map || options->cost_map;
}

tl_status explain_take(const job *j,
                       tl_lighting *lighting,
                       const tl_lighting_options *options,
                       const tl_lighting_counts *counts,
                       explained *out,
                       tl_error *err)
{
    const tl_camera *camera = &j->gbuffer->camera;
    const uint32_t tile = options->tile_size;
    out->tile_size = tile;
    out->tiles_x = (camera->width + tile - 1) / tile;
    out->tiles_y = (camera->height + tile - 1) / tile;
    tl_status status = TL_OK;
    out->counts = *counts;
    const size_t size = counts->tile_count * sizeof(uint32_t);
    out->lights = malloc(size);
    out->surfaces = malloc(size);
    if (!out->lights || !out->surfaces)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for an explanation of %u tiles",
                    counts->tile_count));
    memcpy(out->lights, tl_lighting_tile_lights(lighting), size);
    tl_lighting_explain(lighting, &out->of);
    tl_lighting_build_options(lighting, out->build, sizeof out->build);
    tl_surface_pixels(j->gbuffer, tile, out->surfaces);
    TRY(explain_find_use(j, tl_lighting_effect_use(lighting), out, err));
    if (out->asked->costs)
        TRY(explain_measure_costs(j, lighting, out, err));
    if (out->asked->cost_map)
        TRY(explain_time_tiles(j, lighting, out, err));
done:
    return status;
}

void explained_clear(explained *e)
{
    free(e->lights);
    free(e->surfaces);
    free(e->tile_us);
    *e = (explained){0};
}

static tl_status write_map(job *j,
                           const explained *e,
                           const map_scale *scale,
                           const char *key,
                           const char *path,
                           tl_error *err)
{
    const tl_status status = explain_map_write(j, e, scale, path, err);
    if (status == TL_OK && j->report)
        job_report(j, key, explain_map_json(scale, path));
    else if (status == TL_OK)
        explain_map_print(scale, path);
    return status;
}

static tl_status write_maps(job *j,
                            const explain_options *options,
                            const explained *e,
                            tl_error *err)
{
    map_scale scale;
    tl_status status = TL_OK;
    if (options->map) {
        scale = explain_map_scale(e);
        TRY(write_map(j, e, &scale, "explain_map", options->map, err));
    }
    if (options->cost_map) {
        TRY(explain_cost_scale(e, &scale, err));
        TRY(write_map(j, e, &scale, "explain_map_costs", options->cost_map, err));
    }
done:
    return status;
}

tl_status explain_tell(job *j,
                       const explain_options *options,
                       const explained *e,
                       tl_error *err)
{
    tl_status status = TL_OK;
    console_stage(NULL);
    if (options->text && j->report)
        job_report(j, "explain", explain_as_json(j, e));
    else if (options->text)
        explain_print(j, e);
    const double start = tl_seconds();
    TRY(write_maps(j, options, e, err));
    if (options->map || options->cost_map)
        tl_timings_end(&j->timings, "map", start);
done:
    return status;
}
