#include "layouts_measured.h"

#include "bench_json.h"
#include "bench_record.h"
#include "console.h"
#include "event_counter.h"
#include "json_values.h"
#include "layouts.h"
#include "pass_bytes.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FRAMES_OF_MISSES = 5 };

/* Of each layout, by turns with full float: all of them in half a minute. */
static const double seconds_per_layout = 1.0;

/* One layout, lit by a light that reaches nothing: what is left is to read every pixel and to write the
 * picture. */
typedef struct measured_layout {
    tl_bench_record record;
    tl_pass_bytes cull, shade; /* counted */
    double missed_bytes; /* a frame, of lines that missed the last cache; NAN: not counted */
} measured_layout;

typedef struct measured {
    const measured_options *options;
    tl_device *device;
    tl_event_counter *misses; /* NULL: not counted */
    char no_misses[512];      /* why */
    tl_peaks peaks;
    tl_bench_frame frame;
    measured_layout *of; /* [TL_LAYOUT_COUNT] */
} measured;

/* What the bytes are told for, as the bench calls it. */
static const char *material_of(enum tl_layout_name layout)
{
    const uint32_t present = layout_content(layout, 0);
    return present & TL_GROUP_METAL_ROUGH ? "metal-rough"
           : present & TL_GROUP_PHONG     ? "phong"
                                          : "diffuse";
}

static tl_status case_of(const measured_options *options,
                         enum tl_layout_name layout,
                         tl_bench_case *out,
                         tl_error *err)
{
    char size[32];
    tl_status status = TL_OK;
    tl_bench_cases cases = {0};
    snprintf(size, sizeof size, "%ux%u", options->width, options->height);
    const tl_bench_lists lists = {.of = {[TL_AXIS_SIZE] = size,
                                         [TL_AXIS_MATERIAL] = material_of(layout),
                                         [TL_AXIS_LAYOUT] = tl_layout_word(layout),
                                         [TL_AXIS_LIGHTS] = "1",
                                         [TL_AXIS_RANGE] = "0.001"}};
    TRY(tl_bench_cases_add(&cases, &lists, err));
    *out = cases.cases[0];
done:
    tl_bench_cases_clear(&cases);
    return status;
}

static tl_frame_extent extent_of(const measured *m, const tl_bench_record *r)
{
    const double tile = r->of.lighting.tile_size;
    const uint32_t present = m->frame.gbuffer->present & tl_layout_planes(r->of.layout);
    return (tl_frame_extent){
        .layout = r->of.layout,
        .present = present,
        .specular = (present & (TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH)) != 0,
        .pixels = r->counts.tile_count * tile * tile,
        .tiles = r->counts.tile_count,
        .lights = (double)r->counts.ranged_light_count,
        .list_entries = (double)r->counts.list_length,
    };
}

/* Of frames of this layout alone. */
static tl_status count_misses(measured *m,
                              const tl_bench_case *of,
                              double *bytes,
                              tl_error *err)
{
    tl_status status = TL_OK;
    tl_lighting *lighting = NULL;
    const tl_gbuffer *gbuffer = NULL;
    double before = 0.0, after = 0.0;
    *bytes = (double)NAN;
    if (!m->misses)
        return TL_OK;
    TRY(tl_bench_frame_in(&m->frame, of->layout, &gbuffer, err));
    TRY(tl_lighting_create(m->device, &of->lighting, &lighting, err));
    for (int i = 0; i <= FRAMES_OF_MISSES; i++) {
        if (i == 1) /* the first frame warms up */
            TRY(tl_event_counter_read(m->misses, &before, err));
        TRY(tl_lighting_run(lighting, gbuffer, &m->frame.lights, m->frame.image, NULL, NULL,
                            NULL, err));
    }
    TRY(tl_event_counter_read(m->misses, &after, err));
    *bytes = TL_LINE_SIZE * (after - before) / FRAMES_OF_MISSES;
done:
    tl_lighting_destroy(lighting);
    return status;
}

static tl_status measure(measured *m, enum tl_layout_name layout, tl_error *err)
{
    tl_status status = TL_OK;
    char stage[128];
    tl_bench_case of;
    measured_layout *made = &m->of[layout];
    tl_sampling_rule rule = tl_sampling_rule_default();
    rule.seconds = seconds_per_layout;
    snprintf(stage, sizeof stage, "measuring layout %s", tl_layout_word(layout));
    console_stage(stage);
    TRY(case_of(m->options, layout, &of, err));
    TRY(tl_bench_measure(m->device, &m->peaks, &of, &m->frame, &rule, &made->record, err));
    TRY(count_misses(m, &of, &made->missed_bytes, err));
    const tl_frame_extent extent = extent_of(m, &made->record);
    made->cull = tl_culling_bytes(&extent);
    made->shade = tl_shading_bytes(&extent);
done:
    return status;
}

/* GB/s of what is counted. */
static double rate(const tl_pass_bytes *bytes, const tl_summary *ms)
{
    return 1e-6 * tl_pass_bytes_sum(bytes) / ms->median;
}

static void print_layout(const measured *m, enum tl_layout_name layout)
{
    const measured_layout *of = &m->of[layout];
    const tl_bench_record *r = &of->record;
    const double shading = rate(&of->shade, &r->kernel_shade_ms);
    printf("%-18s %-11s %7.1f %7.2f %6.1f %7.1f %7.2f %6.1f %6.0f %% %8.2f",
           tl_layout_word(layout), material_of(layout), 1e-6 * tl_pass_bytes_sum(&of->cull),
           r->kernel_cull_ms.median, rate(&of->cull, &r->kernel_cull_ms),
           1e-6 * tl_pass_bytes_sum(&of->shade), r->kernel_shade_ms.median, shading,
           1e11 * shading / m->peaks.copy_bytes, r->frame_ms.median);
    if (r->turns.frame.count)
        printf(" %8.3f", r->turns.frame.median);
    else
        printf(" %8s", "");
    if (m->misses)
        printf(" %8.1f", 1e-6 * of->missed_bytes);
    putchar('\n');
}

static void print_all(const measured *m)
{
    const tl_device_info device = tl_device_describe(m->device);
    printf(
        "\nMeasured on %s: %u x %u pixels and one light, which reaches nothing, so that every "
        "pixel is read and\nwritten and little else is done. This device's memory: %.1f GB/s "
        "read, %.1f GB/s copied.\n\n%-18s %-11s %22s %31s %8s %8s%s\n%-18s %-11s %7s %7s %6s "
        "%7s %7s %6s %8s %8s %8s%s\n",
        device.name, m->options->width, m->options->height, 1e-9 * m->peaks.read_bytes,
        1e-9 * m->peaks.copy_bytes, "", "", "culling", "shading", "frame", "frame",
        m->misses ? "  missed" : "", "layout", "material", "MB", "ms", "GB/s", "MB", "ms",
        "GB/s", "of copy", "ms", "x float", m->misses ? "       MB" : "");
    for (int i = (int)m->options->first; i < (int)m->options->end; i++)
        print_layout(m, (enum tl_layout_name)i);
    puts(
        "\nMB as counted, ms as medians, GB/s of both; \"x float\": the frame's time over that "
        "of "
        "full float with the\nsame content, by turns. With lights, and what the picture loses: "
        "`tilelight bench --case layouts'.");
    if (!m->misses)
        printf("What memory itself moved: %s.\n", m->no_misses);
}

static json_t *pass_json(const tl_pass_bytes *bytes, const tl_summary *ms)
{
    return json_pack("{s{sf sf sf sf sf} so so}", "counted_bytes", "words", bytes->words,
                     "lights", bytes->lights, "tiles", bytes->tiles, "lists", bytes->lists,
                     "picture", bytes->radiance, "ms", tl_bench_json_summary(ms), "gbyte_per_s",
                     tl_json_number(rate(bytes, ms)));
}

static json_t *layout_measured_json(const measured_layout *of)
{
    const tl_bench_record *r = &of->record;
    return json_pack("{so so so so so so}", "case", tl_bench_json_case(&r->of), "culling",
                     pass_json(&of->cull, &r->kernel_cull_ms), "shading",
                     pass_json(&of->shade, &r->kernel_shade_ms), "frame_ms",
                     tl_bench_json_summary(&r->frame_ms), "frame_over_float",
                     r->turns.frame.count ? tl_bench_json_summary(&r->turns.frame)
                                          : json_null(),
                     "missed_bytes", tl_json_number(of->missed_bytes));
}

static void add_all(const measured *m, json_t *report, json_t *layouts)
{
    const tl_device_info device = tl_device_describe(m->device);
    for (int i = (int)m->options->first; i < (int)m->options->end; i++)
        json_object_set_new(json_array_get(layouts, (size_t)(i - (int)m->options->first)),
                            "measured", layout_measured_json(&m->of[i]));
    json_object_set_new(report, "measured_on",
                        json_pack("{so so s[ii] so}", "device", tl_bench_json_device(&device),
                                  "peaks", tl_bench_json_peaks(&m->peaks), "size",
                                  (int)m->options->width, (int)m->options->height,
                                  "why_no_misses",
                                  m->misses ? json_null() : json_string(m->no_misses)));
}

/* A counter counts threads that begin after it: it is opened before the device. */
static void open_counter(measured *m)
{
    tl_error err;
    if (tl_event_counter_open(&tl_cache_misses, &m->misses, &err) != TL_OK)
        snprintf(m->no_misses, sizeof m->no_misses, "%.500s", err.message);
}

/* *found is 0 where none was asked for and there is none. */
static tl_status open_device(measured *m, int *found, tl_error *err)
{
    const tl_status status = tl_device_open(m->options->device, &m->device, err);
    *found = status == TL_OK;
    if (status != TL_ERR_NO_DEVICE || m->options->device)
        return status;
    tl_notice(&console_notices, "nothing is measured: %s", err->message);
    return TL_OK;
}

tl_status measured_layouts(const measured_options *options,
                           json_t *report,
                           json_t *layouts,
                           tl_error *err)
{
    measured m = {.options = options};
    tl_status status = TL_OK;
    int found = 0;
    open_counter(&m);
    TRY(open_device(&m, &found, err));
    if (!found)
        goto done;
    m.of = calloc(TL_LAYOUT_COUNT, sizeof *m.of);
    if (!m.of)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for measurements"));
    console_stage("measuring what the device can do at most");
    TRY(tl_peaks_measure(m.device, &m.peaks, err));
    for (int i = (int)options->first; i < (int)options->end; i++)
        TRY(measure(&m, (enum tl_layout_name)i, err));
    console_stage(NULL);
    if (report)
        add_all(&m, report, layouts);
    else
        print_all(&m);
done:
    console_stage(NULL);
    free(m.of);
    tl_bench_frame_clear(&m.frame);
    tl_device_close(m.device);
    tl_event_counter_close(m.misses);
    return status;
}
