#include "explain.h"

#include "console.h"
#include "explain_map.h"
#include "explain_text.h"
#include "surface_pixels.h"
#include "try.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OPTION_EXPLAIN = 256, OPTION_MAP };

static error_t parse(int key, char *text, struct argp_state *state)
{
    explain_options *options = state->input;
    switch (key) {
    case OPTION_EXPLAIN: options->text = true; return 0;
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
    {"explain-map", OPTION_MAP, "FILE.png", 0,
     "A picture of how many lights each tile lists; standard error says what its colours mean",
     0},
    {0},
};

const struct argp explain_argp = {.options = options_table, .parser = parse};

tl_status explain_check(const explain_options *options, const char *input, tl_error *err)
{
    return options->map ? output_check(options->map, input, err) : TL_OK;
}

bool explain_wanted(const explain_options *options)
{
    return options->text || options->map;
}

tl_status explain_take(const job *j,
                       const tl_lighting *lighting,
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
    out->counts = *counts;
    const size_t size = counts->tile_count * sizeof(uint32_t);
    out->lights = malloc(size);
    out->surfaces = malloc(size);
    if (!out->lights || !out->surfaces)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for an explanation of %u tiles",
                       counts->tile_count);
    memcpy(out->lights, tl_lighting_tile_lights(lighting), size);
    tl_lighting_explain(lighting, &out->of);
    tl_lighting_build_options(lighting, out->build, sizeof out->build);
    tl_surface_pixels(j->gbuffer, tile, out->surfaces);
    return TL_OK;
}

void explained_clear(explained *e)
{
    free(e->lights);
    free(e->surfaces);
    *e = (explained){0};
}

static void color_text(const uint8_t color[3], char text[8])
{
    snprintf(text, 8, "#%02x%02x%02x", color[0], color[1], color[2]);
}

static void print_map(const map_scale *scale, const char *path)
{
    char color[8];
    color_text(scale->sky, color);
    fprintf(stderr, "%s\n  %s  sky alone%16s %10" PRIu32 " tiles\n", path, color, "",
            scale->sky_tiles);
    for (int i = 0; i < scale->count; i++) {
        const map_class *of = &scale->of[i];
        color_text(of->color, color);
        fprintf(stderr, "  %s  %7" PRIu32 " to %7" PRIu32 " lights %10" PRIu32 " tiles\n",
                color, of->from, of->to, of->tiles);
    }
}

static json_t *map_as_json(const map_scale *scale, const char *path)
{
    json_t *classes = json_array();
    char color[8];
    for (int i = 0; i < scale->count; i++) {
        const map_class *of = &scale->of[i];
        color_text(of->color, color);
        json_array_append_new(classes, json_pack("{ss sI sI sI}", "color", color, "from",
                                                 (json_int_t)of->from, "to", (json_int_t)of->to,
                                                 "tiles", (json_int_t)of->tiles));
    }
    color_text(scale->sky, color);
    return json_pack("{ss s{ss sI} so}", "file", path, "sky", "color", color, "tiles",
                     (json_int_t)scale->sky_tiles, "classes", classes);
}

tl_status explain_tell(job *j,
                       const explain_options *options,
                       const explained *e,
                       tl_error *err)
{
    tl_status status = TL_OK;
    map_scale scale;
    console_stage(NULL);
    if (options->text && j->report)
        job_report(j, "explain", explain_as_json(j, e));
    else if (options->text)
        explain_print(j, e);
    if (!options->map)
        goto done;
    const double start = tl_seconds();
    scale = explain_map_scale(e);
    TRY(explain_map_write(j, e, &scale, options->map, err));
    tl_timings_end(&j->timings, "map", start);
    if (j->report)
        job_report(j, "explain_map", map_as_json(&scale, options->map));
    else
        print_map(&scale, options->map);
done:
    return status;
}
