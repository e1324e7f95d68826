#define _POSIX_C_SOURCE 200809L
#include "bench_csv.h"

#include "csv_values.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void print_names(FILE *out)
{
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++)
        fprintf(out, "%s,", tl_bench_axes[axis].name);
    fputs("device_name,samples", out);
    for (int i = 0; i < tl_bench_time_count; i++) {
        const char *name = tl_bench_times[i].name;
        fprintf(out, ",%s_median,%s_low,%s_high,%s_least,%s_p90", name, name, name, name, name);
    }
    fputs(",shade_processors,first_frame,build,pairs_culled,pairs_in_range,pairs_lit,device_"
          "bytes,pixel_bytes,against_pixel_bytes",
          out);
    for (int i = 0; i < tl_bench_ratio_count; i++)
        fprintf(out, ",%s_ratio,%s_ratio_low,%s_ratio_high", tl_bench_ratios[i].name,
                tl_bench_ratios[i].name, tl_bench_ratios[i].name);
    fputs(",error_max,error_p999,error_rms,error_mean", out);
    for (int i = 0; i < tl_figure_count; i++)
        fprintf(out, ",%s", tl_figures[i].name);
    fputc('\n', out);
}

/* Nothing where the case was lit alone, or its layout has no error that is known. */
static void print_packing(FILE *out, const tl_bench_record *r)
{
    const tl_difference *d = &r->error.of;
    const double errors[] = {d->relative_max, d->relative_p999, d->relative_rms,
                             d->relative_mean};
    fprintf(out, ",%u", r->pixel_bytes);
    tl_csv_number(out, r->turns.frame.count ? r->turns.pixel_bytes : (double)NAN);
    for (int i = 0; i < tl_bench_ratio_count; i++) {
        const tl_summary *s = tl_bench_time_of(&tl_bench_ratios[i], r);
        const double values[] = {s->median, s->interval.low, s->interval.high};
        for (size_t k = 0; k < sizeof values / sizeof values[0]; k++)
            tl_csv_number(out, s->count ? values[k] : (double)NAN);
    }
    for (size_t k = 0; k < sizeof errors / sizeof errors[0]; k++)
        tl_csv_number(out, r->error.is_known ? errors[k] : (double)NAN);
}

static void print_record(FILE *out, const tl_bench_record *r)
{
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++) {
        tl_csv_text(out, r->of.words[axis]);
        fputc(',', out);
    }
    tl_csv_text(out, r->device.name);
    fprintf(out, ",%zu", r->frame_ms.count);
    for (int i = 0; i < tl_bench_time_count; i++) {
        const tl_summary *s = tl_bench_time_of(&tl_bench_times[i], r);
        const double values[] = {s->median, s->interval.low, s->interval.high, s->least,
                                 s->p90};
        for (size_t k = 0; k < sizeof values / sizeof values[0]; k++)
            tl_csv_number(out, values[k]);
    }
    tl_csv_number(out, r->shade_processors.median);
    tl_csv_number(out, r->first_ms);
    tl_csv_number(out, r->build_ms);
    fprintf(out, ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64, r->counts.pair_count,
            r->pairs.in_range, r->pairs.lit, r->counts.device_bytes);
    print_packing(out, r);
    for (int i = 0; i < tl_figure_count; i++)
        tl_csv_number(out, tl_figures[i].of(r));
    fputc('\n', out);
}

tl_status tl_bench_csv(const tl_bench_record *records, size_t count, char **out, tl_error *err)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    int failed = !stream;
    if (stream) {
        print_names(stream);
        for (size_t i = 0; i < count; i++)
            print_record(stream, &records[i]);
        failed = ferror(stream);
        failed = fclose(stream) != 0 || failed;
    }
    if (failed) {
        free(text);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the records");
    }
    *out = text;
    return TL_OK;
}
