/* Our time over that of every other way to light one frame. */
#include "bench_capture.h"
#include "bench_json.h"
#include "bench_session.h"
#include "bench_table.h"
#include "classic_pairs.h"
#include "console.h"
#include "json_values.h"
#include "ratios.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Longer than for a case: a ratio is what the project is held to. */
static const double seconds_per_baseline = 8.0, quick_seconds = 1.5, quick_once_above = 1.0;

static tl_ratio_rule rule_of(const bench_options *options)
{
    tl_ratio_rule rule = {.sampling = options->rule, .once_above = (double)INFINITY};
    if (!options->seconds_given)
        rule.sampling.seconds = options->quick ? quick_seconds : seconds_per_baseline;
    if (options->quick)
        rule.once_above = quick_once_above;
    return rule;
}

static tl_status choose_case(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(tl_bench_cases_add(&s->cases, &s->options->lists, err));
    if (s->cases.count != 1)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "--baselines lights one frame: give each axis one word at most"));
done:
    return status;
}

/* What times are told per: pairs that our culling lists, or, of a capture, those of plain tiles, which
 * programs that lit it before are told by. */
static uint64_t counted_pairs(const bench_session *s, const tl_lighting_counts *counts)
{
    if (!s->options->capture)
        return counts->pair_count;
    return tl_classic_pairs(s->frame.gbuffer, &s->frame.lights);
}

static void print_heading(const bench_session *s,
                          const tl_lighting_counts *counts,
                          uint64_t pair_count)
{
    FILE *out = s->table;
    const tl_bench_case *of = &s->cases.cases[0];
    const tl_camera *camera = &s->frame.gbuffer->camera;
    char title[512];
    tl_bench_case_title(of, title, sizeof title);
    fprintf(out, "%s: %u x %u pixels, %.1f lights per tile, %.1f M pairs; hand is %s\n",
            s->options->capture ? s->options->capture : title, camera->width, camera->height,
            (double)counts->list_length / counts->tile_count, 1e-6 * (double)counts->pair_count,
            tl_hand_instruction_set());
    if (s->options->capture)
        fprintf(out,
                "pairs below are those of plain tiles of 16 px, culled by frustum and depth: "
                "%.1f M, %.1f lights per pixel\n",
                1e-6 * (double)pair_count,
                (double)pair_count / ((double)camera->width * camera->height));
    fprintf(out, "%-13s %9s %19s %8s %10s %10s %8s %8s %9s\n", "", "ratio", "95 % interval",
            "samples", "ours ms", "theirs ms", "ns/pair", "ours", "RMS diff");
}

static void print_ratio(FILE *out, const tl_ratio *r, uint64_t pair_count)
{
    char interval[64] = "one sample";
    if (r->ratio.count == 0) {
        fprintf(out, "%-13s not measured: %s\n", r->baseline->name, r->refusal);
        return;
    }
    if (r->ratio.count > 1)
        snprintf(interval, sizeof interval, "%.4f to %.4f", r->ratio.interval.low,
                 r->ratio.interval.high);
    fprintf(out, "%-13s %9.4f %19s %8zu %10.2f %10.2f %8.3f %8.3f %9.1e\n", r->baseline->name,
            r->ratio.median, interval, r->ratio.count, r->ours_ms.median, r->theirs_ms.median,
            1e6 * r->theirs_ms.median / (double)pair_count,
            1e6 * r->ours_ms.median / (double)pair_count, r->rms_difference);
    if (!tl_ratio_is_of_same_picture(r))
        fprintf(out,
                "    its picture is not ours: RMS %.1e, at most %.1e; it promises %.1e, %.1e\n",
                r->rms_difference, r->max_difference, r->baseline->rms_tolerance,
                r->baseline->max_tolerance);
    fflush(out);
}

/* Lights once, to know the counts and to have everything built. */
static tl_status prepare(bench_session *s,
                         tl_lighting **lighting,
                         tl_lighting_counts *counts,
                         tl_error *err)
{
    const tl_bench_case *of = &s->cases.cases[0];
    tl_status status = TL_OK;
    TRY(bench_session_device(s, of, err));
    console_stage("making the frame");
    if (s->options->capture)
        TRY(bench_capture_frame(s->options->capture, &s->frame, err));
    else
        TRY(tl_bench_frame_make(&s->frame, of, err));
    TRY(tl_lighting_create(s->device, &of->lighting, lighting, err));
    TRY(tl_lighting_run(*lighting, s->frame.ours, &s->frame.lights, s->frame.image, NULL, NULL,
                        counts, err));
done:
    return status;
}

/* A capture by the name of its file: where that lies is no part of a result. */
static json_t *capture_json(const bench_session *s, const tl_lighting_counts *counts)
{
    const char *const slash = strrchr(s->options->capture, '/');
    const tl_camera *const camera = &s->frame.gbuffer->camera;
    char size[32];
    snprintf(size, sizeof size, "%ux%u", camera->width, camera->height);
    return json_pack("{ss ss sI sI}", "file", slash ? slash + 1 : s->options->capture, "size",
                     size, "lights", (json_int_t)s->frame.lights.count, "pairs_listed",
                     (json_int_t)counts->pair_count);
}

static tl_status write_json(const bench_session *s,
                            const tl_ratio *ratios,
                            const tl_lighting_counts *counts,
                            uint64_t pair_count,
                            tl_error *err)
{
    if (!s->options->json)
        return TL_OK;
    const tl_device_info device = tl_device_describe(s->device);
    json_t *report = tl_bench_json_begin(&s->machine);
    json_object_set_new(report, "device", tl_bench_json_device(&device));
    if (s->options->capture)
        json_object_set_new(report, "capture", capture_json(s, counts));
    else
        json_object_set_new(report, "case", tl_bench_json_case(&s->cases.cases[0]));
    json_object_set_new(report, "hand_instruction_set", json_string(tl_hand_instruction_set()));
    json_object_set_new(report, "pairs", json_integer((json_int_t)pair_count));
    json_t *table = tl_ratios_json(ratios, (size_t)tl_baseline_count, pair_count);
    json_object_set(report, "hand_relaxed_ns_per_pair",
                    json_object_get(table, "hand_relaxed_ns_per_pair"));
    json_object_set_new(report, "ratios", table);
    return tl_json_write(s->options->json, report, err);
}

tl_status bench_run_baselines(bench_session *s, tl_error *err)
{
    const tl_ratio_rule rule = rule_of(s->options);
    tl_lighting *lighting = NULL;
    tl_lighting_counts counts = {0};
    uint64_t pair_count = 0;
    tl_status status = TL_OK;
    tl_ratio *ratios = calloc((size_t)tl_baseline_count, sizeof *ratios);
    if (!ratios)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for ratios"));
    TRY(choose_case(s, err));
    TRY(prepare(s, &lighting, &counts, err));
    pair_count = counted_pairs(s, &counts);
    console_stage(NULL);
    if (s->table)
        print_heading(s, &counts, pair_count);
    for (int i = 0; i < tl_baseline_count; i++) {
        console_stage(tl_baselines[i]->name);
        TRY(tl_ratio_measure(tl_baselines[i], s->device, lighting, &s->frame, &rule, &ratios[i],
                             err));
        console_stage(NULL);
        if (s->table)
            print_ratio(s->table, &ratios[i], pair_count);
    }
    const tl_ratio *multipass = tl_ratio_multipass(ratios, (size_t)tl_baseline_count);
    if (s->table && multipass)
        fprintf(s->table, "multipass is %s, the faster of the two\n",
                multipass->baseline->name);
    TRY(write_json(s, ratios, &counts, pair_count, err));
done:
    tl_lighting_destroy(lighting);
    free(ratios);
    return status;
}
