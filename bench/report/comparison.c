#include "comparison.h"

#include "bench_json.h"
#include "json_values.h"
#include "try.h"

#include <math.h>
#include <string.h>

#define WORD(name, word, meaning) [name] = word,
const char *const tl_verdict_words[TL_VERDICT_COUNT] = {TL_VERDICTS(WORD)};
#undef WORD

static tl_verdict judge(double low, double high, double threshold)
{
    const double slow = 1.0 + threshold, fast = 1.0 / slow;
    if (low > slow)
        return TL_SLOWER;
    if (high < fast)
        return TL_FASTER;
    return low >= fast && high <= slow ? TL_SAME : TL_UNDECIDED;
}

tl_comparison tl_compare_times(const tl_summary *before,
                               const tl_summary *now,
                               double threshold)
{
    tl_comparison c = {.verdict = TL_UNDECIDED,
                       .before_ms = before->median,
                       .now_ms = now->median,
                       .ratio = now->median / before->median,
                       .low = 0.0,
                       .high = (double)INFINITY};
    if (before->count < 2 || now->count < 2)
        return c;
    c.low = now->interval.low / before->interval.high;
    c.high = now->interval.high / before->interval.low;
    c.verdict = judge(c.low, c.high, threshold);
    return c;
}

tl_status tl_bench_report_read(const char *path, json_t **out, tl_error *err)
{
    tl_status status = TL_OK;
    json_t *report = NULL;
    TRY(tl_json_read(path, &report, err));
    const json_t *version = json_object_get(report, "tilelight_bench");
    if (!json_is_integer(version) || !json_is_array(json_object_get(report, "records")))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: it is no report of `tilelight bench --json' with cases", path));
    if (json_integer_value(version) != TL_BENCH_JSON_VERSION)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: a report of version %lld; this program reads %d",
                    path, (long long)json_integer_value(version), TL_BENCH_JSON_VERSION));
    *out = report;
    report = NULL;
done:
    json_decref(report);
    return status;
}

static int is_same_case(const json_t *record, const tl_bench_case *of)
{
    const json_t *words = json_object_get(record, "case");
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++) {
        const char *word = json_string_value(json_object_get(words, tl_bench_axes[axis].name));
        /* A report from before the axis was there stands for its usual word. */
        if (strcmp(word ? word : tl_bench_axes[axis].usual, of->words[axis]) != 0)
            return 0;
    }
    return 1;
}

/* 0 where the record lacks what is needed. */
static int read_times(const json_t *record, tl_summary *out)
{
    const json_t *frame = json_object_get(json_object_get(record, "times_ms"), "frame");
    const json_t *interval = json_object_get(frame, "interval");
    const json_t *samples = json_object_get(frame, "samples");
    *out = (tl_summary){.median = json_number_value(json_object_get(frame, "median")),
                        .interval = {json_number_value(json_array_get(interval, 0)),
                                     json_number_value(json_array_get(interval, 1)), 0.0},
                        .count = (size_t)json_integer_value(samples)};
    return json_is_integer(samples) && out->median > 0.0 &&
           (json_is_null(interval) || out->interval.low > 0.0);
}

tl_status tl_compare_record(const json_t *report,
                            const char *path,
                            const tl_bench_record *record,
                            double threshold,
                            tl_comparison *out,
                            tl_error *err)
{
    const json_t *records = json_object_get(report, "records");
    tl_summary before;
    *out = (tl_comparison){.verdict = TL_NEW,
                           .now_ms = record->frame_ms.median,
                           .before_ms = (double)NAN,
                           .ratio = (double)NAN,
                           .low = (double)NAN,
                           .high = (double)NAN};
    for (size_t i = 0; i < json_array_size(records); i++) {
        const json_t *one = json_array_get(records, i);
        if (!is_same_case(one, &record->of))
            continue;
        if (!read_times(one, &before))
            return tl_fail(err, TL_ERR_FORMAT, "%s: record %zu has no times to compare with",
                           path, i);
        *out = tl_compare_times(&before, &record->frame_ms, threshold);
        break;
    }
    return TL_OK;
}

json_t *tl_comparison_json(const tl_comparison *c)
{
    return json_pack("{ss so so so s[oo]}", "verdict", tl_verdict_words[c->verdict],
                     "before_ms", tl_json_number(c->before_ms), "now_ms",
                     tl_json_number(c->now_ms), "ratio", tl_json_number(c->ratio), "interval",
                     tl_json_number(c->low), tl_json_number(c->high));
}
