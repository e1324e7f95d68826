/* A user's shading kernel beside ours, case by case. */
#include "bench_json.h"
#include "bench_session.h"
#include "bench_table.h"
#include "console.h"
#include "json_values.h"
#include "kernel_ratio.h"
#include "try.h"

#include <stdlib.h>

static void print_heading(FILE *out, const kernel_choice *kernel)
{
    fprintf(out, "yours: %s of %s; times of the shading kernels\n", kernel->entry,
            kernel->file);
    fprintf(out, "%-34s %10s %20s %8s %9s %9s %9s\n", "case", "yours/ours", "95 % interval",
            "samples", "yours ms", "ours ms", "RMS diff");
}

static void print_line(FILE *out, const tl_bench_case *of, const tl_kernel_ratio *r)
{
    char title[512], interval[64] = "one sample";
    tl_bench_case_title(of, title, sizeof title);
    if (r->ratio.count > 1)
        snprintf(interval, sizeof interval, "%.3f to %.3f", r->ratio.interval.low,
                 r->ratio.interval.high);
    fprintf(out, "%-34s %10.3f %20s %8zu %9.2f %9.2f %9.1e\n", title, r->ratio.median, interval,
            r->ratio.count, r->theirs_ms.median, r->ours_ms.median, r->rms_difference);
    fflush(out);
}

static json_t *ratio_json(const tl_bench_case *of, const tl_kernel_ratio *r)
{
    return json_pack(
        "{so so so so so so sI sI so so so}", "case", tl_bench_json_case(of), "yours_over_ours",
        tl_bench_json_summary(&r->ratio), "yours_ms", tl_bench_json_summary(&r->theirs_ms),
        "ours_ms", tl_bench_json_summary(&r->ours_ms), "yours_frame_ms",
        tl_bench_json_summary(&r->theirs_frame_ms), "ours_frame_ms",
        tl_bench_json_summary(&r->ours_frame_ms), "list_entries",
        (json_int_t)r->counts.list_length, "pairs", (json_int_t)r->counts.pair_count,
        "build_ms", tl_json_number(r->build_ms), "rms_difference",
        tl_json_number(r->rms_difference), "max_difference", tl_json_number(r->max_difference));
}

static tl_status write_json(const bench_session *s,
                            const tl_kernel_ratio *ratios,
                            tl_error *err)
{
    const kernel_choice *kernel = &s->options->kernel;
    if (!s->options->json)
        return TL_OK;
    const tl_device_info device = tl_device_describe(s->device);
    json_t *report = tl_bench_json_begin(&s->machine), *array = json_array();
    for (size_t i = 0; i < s->cases.count; i++)
        json_array_append_new(array, ratio_json(&s->cases.cases[i], &ratios[i]));
    json_object_set_new(report, "device", tl_bench_json_device(&device));
    json_object_set_new(report, "kernel", json_string(kernel->file));
    json_object_set_new(report, "entry", json_string(kernel->entry));
    json_object_set_new(report, "kernel_ratios", array);
    return tl_json_write(s->options->json, report, err);
}

tl_status bench_run_kernel(bench_session *s, tl_error *err)
{
    kernel_choice choice = s->options->kernel;
    tl_user_kernel kernel = {0};
    tl_kernel_ratio *ratios = NULL;
    tl_status status = TL_OK;
    TRY(kernel_choice_read(&choice, &kernel, err));
    TRY(tl_bench_cases_add(&s->cases, &s->options->lists, err));
    ratios = calloc(s->cases.count, sizeof *ratios);
    if (!ratios)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for ratios"));
    for (size_t i = 0; i < s->cases.count; i++) {
        const tl_bench_case *of = &s->cases.cases[i];
        TRY(bench_session_device(s, of, err));
        console_stage("measuring both kernels");
        TRY(tl_kernel_ratio_measure(s->device, of, &kernel, &s->frame, &s->options->rule,
                                    &ratios[i], err));
        console_stage(NULL);
        if (s->table && i == 0)
            print_heading(s->table, &choice);
        if (s->table)
            print_line(s->table, of, &ratios[i]);
    }
    TRY(write_json(s, ratios, err));
done:
    free(ratios);
    kernel_choice_release(&choice);
    return status;
}
