/* How long a sky takes to be prepared as what lights surfaces: maps of several sizes, a gradient, one that is
 * found on disk, and the table of shares that all of them need, once in a process. */
#define _GNU_SOURCE /* setenv */
#include "bench_child.h"
#include "bench_json.h"
#include "bench_session.h"
#include "console.h"
#include "json_values.h"
#include "sky_map.h"
#include "split_sum.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

/* width 0: a gradient. */
static const struct {
    const char *name;
    uint32_t width, height; /* px */
    int is_kept;            /* 1: it is found on disk */
} skies[] = {{"gradient", 0, 0, 0},
             {"256 x 128", 256, 128, 0},
             {"1024 x 512", 1024, 512, 0},
             {"4096 x 2048", 4096, 2048, 0},
             {"1024 x 512, kept on disk", 1024, 512, 1}};
enum { SKY_COUNT = sizeof skies / sizeof skies[0] };

typedef struct times {
    tl_samples wall_ms, processor_ms;
} times;

/* Daylight with a sun. */
static void paint(float *pixels, uint32_t width, uint32_t height)
{
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const float up = 1.0f - 2.0f * ((float)y + 0.5f) / (float)height;
            const float cloud = sinf(23.0f * (float)x / (float)width) * sinf(31.0f * up);
            const int is_sun = y == height / 4 && x == width / 3;
            float *to = pixels + 3 * ((size_t)y * width + x);
            to[0] = is_sun ? 5000.0f : up > 0.0f ? 0.4f + 0.2f * cloud : 0.2f;
            to[1] = to[0];
            to[2] = to[0] + (up > 0.0f ? 0.4f : 0.0f);
        }
}

static tl_status sky_of(int row, tl_light_set *set, tl_error *err)
{
    const uint32_t width = skies[row].width, height = skies[row].height;
    set->sky_intensity = set->sky_light = 1.0f;
    set->sky_type = width == 0 ? TL_SKY_GRADIENT : TL_SKY_IMAGE;
    if (width == 0)
        return TL_OK;
    float *pixels = malloc(3 * sizeof *pixels * width * height);
    if (!pixels)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a sky");
    paint(pixels, width, height);
    return tl_light_set_add_image(set, "sky", width, height, pixels, &set->sky_image, err);
}

/* Another sky each time, so that none is found again. */
static void change(tl_light_set *set, size_t turn)
{
    if (set->sky_type == TL_SKY_GRADIENT)
        set->sky[0] = 0.5f + (float)turn * 0x1p-12f;
    else
        set->images[set->sky_image - 1].pixels[0] = 0.5f + (float)turn * 0x1p-12f;
}

static tl_status prepare(const tl_light_set *set, times *to, tl_error *err)
{
    tl_status status = TL_OK;
    tl_sky_map *map = NULL;
    const double start = tl_seconds(), busy = tl_processor_seconds();
    TRY(tl_sky_map_of(set, true, &map, err));
    TRY(tl_samples_add(&to->wall_ms, 1e3 * (tl_seconds() - start), err));
    TRY(tl_samples_add(&to->processor_ms, 1e3 * (tl_processor_seconds() - busy), err));
done:
    tl_sky_map_release(map);
    return status;
}

static void tell(bench_session *s, const char *name, const times *of, json_t *to)
{
    const tl_summary wall = tl_samples_summarize(&of->wall_ms),
                     processor = tl_samples_summarize(&of->processor_ms);
    if (s->table)
        fprintf(s->table, "%-24s %9.1f %9.1f %13.1f %6zu\n", name, wall.median, wall.least,
                processor.median, wall.count);
    json_array_append_new(to, json_pack("{ss so so}", "name", name, "ms",
                                        tl_bench_json_summary(&wall), "processor_ms",
                                        tl_bench_json_summary(&processor)));
}

/* Two by turns are found on disk, for a process keeps the last one alone. */
enum { KEPT = 2 };

static tl_status measure(bench_session *s, int row, json_t *to, tl_error *err)
{
    const size_t turns = skies[row].is_kept ? KEPT : SIZE_MAX;
    tl_light_set set = {0};
    times of = {.wall_ms = {0}};
    tl_status status = TL_OK;
    console_stage("preparing skies");
    TRY(sky_of(row, &set, err));
    for (size_t turn = 0; skies[row].is_kept && turn < KEPT; turn++) {
        change(&set, turn);
        TRY(prepare(&set, &of, err));
    }
    tl_samples_clear(&of.wall_ms);
    tl_samples_clear(&of.processor_ms);
    const double start = tl_seconds();
    do {
        change(&set, of.wall_ms.count % turns);
        TRY(prepare(&set, &of, err));
    } while (!tl_sampling_done(&s->options->rule, &of.wall_ms, start));
    console_stage(NULL);
    tell(s, skies[row].name, &of, to);
done:
    tl_samples_clear(&of.wall_ms);
    tl_samples_clear(&of.processor_ms);
    tl_light_set_clear(&set);
    return status;
}

/* Once: it is kept as long as the process runs. */
static tl_status measure_table(bench_session *s, json_t *to, tl_error *err)
{
    times of = {.wall_ms = {0}};
    tl_status status = TL_OK;
    const double start = tl_seconds(), busy = tl_processor_seconds();
    tl_split_sum_table();
    TRY(tl_samples_add(&of.wall_ms, 1e3 * (tl_seconds() - start), err));
    TRY(tl_samples_add(&of.processor_ms, 1e3 * (tl_processor_seconds() - busy), err));
    tell(s, "shares", &of, to);
done:
    tl_samples_clear(&of.wall_ms);
    tl_samples_clear(&of.processor_ms);
    return status;
}

tl_status bench_run_sky(bench_session *s, tl_error *err)
{
    char folder[BENCH_PATH_SIZE] = "";
    json_t *rows = json_array();
    tl_status status = TL_OK;
    TRY(bench_folder_make("--sky", folder, err));
    if (s->table)
        fprintf(s->table, "%-24s %9s %9s %13s %6s\n", "sky", "ms", "least", "processor ms",
                "runs");
    TRY(measure_table(s, rows, err));
    for (int row = 0; row < SKY_COUNT; row++) {
        setenv("TILELIGHT_CACHE", skies[row].is_kept ? folder : "", 1);
        TRY(measure(s, row, rows, err));
    }
    if (s->options->json) {
        json_t *report = tl_bench_json_begin(&s->machine);
        json_object_set(report, "skies", rows);
        TRY(tl_json_write(s->options->json, report, err));
    }
done:
    bench_folder_remove(folder);
    json_decref(rows);
    return status;
}
