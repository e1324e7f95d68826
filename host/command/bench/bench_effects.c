/* What choosing effects is worth: frames with those that they call for against all effects, and with an
 * effect that no tile uses, or a stage that all pixels go through, against the same frame without. */
#include "bench_json.h"
#include "bench_post.h"
#include "bench_session.h"
#include "console.h"
#include "effect_frames.h"
#include "frame_ratio.h"
#include "json_values.h"
#include "stage_frames.h"
#include "try.h"

#include <stdio.h>
#include <string.h>

/* As many pairs as a long row gets; the others get as many as there is time for. */
static const size_t effects_samples = 11;
static const double effects_seconds = 3.0;

/* What is wanted; the printed verdicts say whether it was reached. */
static const double least_gain_of_plainest = 2.0, most_of_unused = 1.03;

typedef struct effects_bench {
    bench_session *session;
    tl_bench_case of; /* its size and how it is lit */
    tl_sampling_rule rule;
    json_t *frames, *unused, *stages, *post;
    int all_same_bits, is_complete;
    double gain_of_plainest, most_of_unused; /* median; upper end of the interval */
} effects_bench;

static void print_ratio(FILE *out, tl_effect_frame_row about, const tl_frame_ratio *r)
{
    char interval[64] = "one sample";
    if (r->ratio.count > 1)
        snprintf(interval, sizeof interval, "%.3f to %.3f", r->ratio.interval.low,
                 r->ratio.interval.high);
    fprintf(out, "%-15s %9.2f %9.2f %8.3f %18s %6zu %9.3f  %-6s %s\n", about.name,
            r->frame_ms[0].median, r->frame_ms[1].median, r->ratio.median, interval,
            r->ratio.count, r->processor_ratio.median, r->same_bits ? "same" : "DIFFER",
            about.meaning);
    fflush(out);
}

static void print_heading(FILE *out, const char *title, const char *first, const char *second)
{
    fprintf(out, "%s\n%-15s %9s %9s %8s %18s %6s %9s  %-6s\n", title, "", first, second,
            "ratio", "95 % interval", "pairs", "processor", "bits");
}

static json_t *ratio_json(tl_effect_frame_row about,
                          const tl_frame_ratio *r,
                          const char *first,
                          const char *second)
{
    json_t *object =
        json_pack("{ss ss so so sb sI sI}", "name", about.name, "meaning", about.meaning,
                  "ratio", tl_bench_json_summary(&r->ratio), "processor_ratio",
                  tl_bench_json_summary(&r->processor_ratio), "same_bits", r->same_bits,
                  "tiles", (json_int_t)r->counts[0].tile_count, "list_entries",
                  (json_int_t)r->counts[0].list_length);
    const char *const sides[2] = {first, second};
    for (int i = 0; i < 2; i++)
        json_object_set_new(object, sides[i],
                            json_pack("{so so so}", "frame_ms",
                                      tl_bench_json_summary(&r->frame_ms[i]), "kernel_shade_ms",
                                      tl_bench_json_summary(&r->shade_ms[i]), "processor_ms",
                                      tl_bench_json_summary(&r->processor_ms[i])));
    return object;
}

/* What there is, so that nothing is lost where the rest is not waited for. */
static tl_status write_json(effects_bench *b, tl_error *err)
{
    const bench_session *s = b->session;
    if (!s->options->json)
        return TL_OK;
    const tl_device_info device = tl_device_describe(s->device);
    json_t *report = tl_bench_json_begin(&s->machine);
    json_object_set_new(report, "device", tl_bench_json_device(&device));
    json_object_set_new(report, "effects",
                        json_pack("{so sO sO sO sO so so sb sb}", "case",
                                  tl_bench_json_case(&b->of), "frames", b->frames, "unused",
                                  b->unused, "stages", b->stages, "post", b->post,
                                  "gain_of_plainest", tl_json_number(b->gain_of_plainest),
                                  "most_of_unused", tl_json_number(b->most_of_unused),
                                  "same_bits", b->all_same_bits, "complete", b->is_complete));
    return tl_json_write(s->options->json, report, err);
}

/* After each row; standard output gets the whole alone. */
static tl_status keep_rows(void *context, tl_error *err)
{
    effects_bench *b = context;
    const char *path = b->session->options->json;
    return path && strcmp(path, "-") != 0 ? write_json(b, err) : TL_OK;
}

static tl_frame_side side_of(const effects_bench *b, const tl_effect_frame *frame)
{
    return (tl_frame_side){frame->gbuffer, &frame->lights, b->of.lighting, 0};
}

static tl_status measure(effects_bench *b,
                         const tl_effect_frame *first,
                         tl_frame_side second,
                         tl_frame_ratio *out,
                         tl_error *err)
{
    const tl_frame_side sides[2] = {side_of(b, first), second};
    const tl_status status =
        tl_frame_ratio_measure(b->session->device, sides, &b->rule, out, err);
    if (status == TL_OK && !out->same_bits)
        b->all_same_bits = 0;
    return status;
}

/* A frame with what it calls for, and with all effects. */
static tl_status measure_frame(effects_bench *b, int index, tl_error *err)
{
    const tl_effect_frame_row about = tl_effect_frame_about(index);
    const tl_bench_scene_options *size = &b->of.scene_options;
    tl_effect_frame frame = {0};
    tl_frame_ratio ratio;
    tl_status status = TL_OK;
    console_stage("lighting frames with what they call for, and with all effects");
    TRY(tl_effect_frame_make(index, size->width, size->height, &frame, err));
    tl_frame_side all = side_of(b, &frame);
    all.options.effects = TL_EFFECTS_ALL;
    TRY(measure(b, &frame, all, &ratio, err));
    console_stage(NULL);
    if (index == 0)
        b->gain_of_plainest = ratio.ratio.median;
    if (b->session->table)
        print_ratio(b->session->table, about, &ratio);
    json_array_append_new(b->frames, ratio_json(about, &ratio, "chosen", "all"));
    TRY(keep_rows(b, err));
done:
    tl_effect_frame_clear(&frame);
    return status;
}

static tl_status measure_unused(effects_bench *b, int index, tl_error *err)
{
    const tl_effect_frame_row about = tl_unused_effect_about(index);
    const tl_bench_scene_options *size = &b->of.scene_options;
    tl_effect_frame without = {0}, with = {0};
    tl_frame_ratio ratio;
    tl_status status = TL_OK;
    console_stage("lighting frames without effects, and with them, unused");
    TRY(tl_unused_effect_make(index, size->width, size->height, &without, &with, err));
    TRY(measure(b, &without, side_of(b, &with), &ratio, err));
    console_stage(NULL);
    if (ratio.ratio.interval.high > b->most_of_unused)
        b->most_of_unused = ratio.ratio.interval.high;
    if (b->session->table)
        print_ratio(b->session->table, about, &ratio);
    json_array_append_new(b->unused, ratio_json(about, &ratio, "without", "with"));
    TRY(keep_rows(b, err));
done:
    tl_effect_frame_clear(&with);
    tl_effect_frame_clear(&without);
    return status;
}

/* A frame without a stage, and with it. */
static tl_status measure_stage(effects_bench *b, int index, tl_error *err)
{
    const tl_effect_frame_row about = tl_stage_about(index);
    const tl_bench_scene_options *size = &b->of.scene_options;
    const int had_same_bits = b->all_same_bits;
    tl_effect_frame without = {0}, with = {0};
    tl_frame_ratio ratio;
    tl_status status = TL_OK;
    console_stage("lighting frames without stages, and with them");
    TRY(tl_stage_make(index, size->width, size->height, &without, &with, err));
    tl_frame_side stage = side_of(b, &with);
    stage.options.split = tl_stage_split(index);
    stage.group_count = tl_stage_group_count(index);
    TRY(measure(b, &without, stage, &ratio, err));
    console_stage(NULL);
    if (!tl_stage_keeps_bits(index))
        b->all_same_bits = had_same_bits;
    if (b->session->table)
        print_ratio(b->session->table, about, &ratio);
    json_array_append_new(b->stages, ratio_json(about, &ratio, "without", "with"));
    TRY(keep_rows(b, err));
done:
    tl_effect_frame_clear(&with);
    tl_effect_frame_clear(&without);
    return status;
}

static void print_verdicts(FILE *out, const effects_bench *b)
{
    fprintf(out,
            "\nthe plainest frame with all effects: %.2f times its time (%s %g); unused "
            "effects: at most %.3f times, by the upper ends of the intervals (%s %g); "
            "pictures: %s\n",
            b->gain_of_plainest,
            b->gain_of_plainest >= least_gain_of_plainest ? "not below" : "below",
            least_gain_of_plainest, b->most_of_unused,
            b->most_of_unused <= most_of_unused ? "within" : "above", most_of_unused,
            b->all_same_bits ? "the same bits in every pair" : "NOT the same bits");
}

static tl_status measure_all(effects_bench *b, tl_error *err)
{
    FILE *table = b->session->table;
    tl_status status = TL_OK;
    if (table)
        print_heading(table, "effects that frames call for, against all", "chosen ms",
                      "all ms");
    for (int i = 0; i < tl_effect_frame_count; i++)
        TRY(measure_frame(b, i, err));
    if (table)
        print_heading(table, "\neffects that no tile uses", "without", "with ms");
    for (int i = 0; i < tl_unused_effect_count; i++)
        TRY(measure_unused(b, i, err));
    if (table)
        print_heading(table, "\nwhat stages cost", "without", "with ms");
    for (int i = 0; i < tl_stage_count; i++)
        TRY(measure_stage(b, i, err));
    TRY(bench_post_stages(b->session, &b->of, &b->rule, b->post, keep_rows, b, err));
    b->is_complete = 1;
    if (table)
        print_verdicts(table, b);
done:
    return status;
}

tl_status bench_run_effects(bench_session *s, tl_error *err)
{
    effects_bench b = {.session = s,
                       .rule = s->options->rule,
                       .frames = json_array(),
                       .unused = json_array(),
                       .stages = json_array(),
                       .post = json_array(),
                       .all_same_bits = 1};
    tl_status status = TL_OK;
    b.rule.least_samples = s->options->samples_given ? b.rule.least_samples : effects_samples;
    b.rule.seconds = s->options->seconds_given ? b.rule.seconds : effects_seconds;
    TRY(tl_bench_cases_add(&s->cases, &s->options->lists, err));
    if (s->cases.count != 1)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "--effects takes one word of each axis, not lists"));
    b.of = s->cases.cases[0];
    TRY(bench_session_device(s, &b.of, err));
    TRY(measure_all(&b, err));
    TRY(write_json(&b, err));
    if (!b.all_same_bits)
        TRY(tl_fail(err, TL_ERR_DIFFERENT,
                    "pictures that must have the same bits differ: effects are not chosen "
                    "exactly"));
done:
    json_decref(b.frames);
    json_decref(b.unused);
    json_decref(b.stages);
    json_decref(b.post);
    return status;
}
