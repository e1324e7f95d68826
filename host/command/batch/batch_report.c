#include "batch_report.h"

#include "console.h"
#include "json_values.h"
#include "try.h"

#include <stdio.h>

static const char *const outcome_words[] = {
#define WORD(name, word) [name] = word,
    TL_BATCH_OUTCOMES(WORD)
#undef WORD
};

/* "498 of 500 frames are lit, 120 were up to date, 2 failed". */
static void format_sum(const batch *b, char *text, size_t size)
{
    static const struct {
        batch_outcome outcome;
        const char *says;
    } parts[] = {{BATCH_UP_TO_DATE, "were up to date"},
                 {BATCH_FAILED, "failed"},
                 {BATCH_LEFT, "were left"}};
    const size_t *of = b->tally.of;
    size_t used = (size_t)snprintf(text, size, "%zu of %zu frames were lit", of[BATCH_DONE],
                                   b->items->count);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if (of[parts[i].outcome] > 0)
            used += (size_t)snprintf(text + used, size - used, ", %zu %s", of[parts[i].outcome],
                                     parts[i].says);
}

static void tell(batch *b)
{
    batch_notices_tell(&b->notices);
    if (b->tally.of[BATCH_FAILED] > 0)
        console_complain("what failed:");
    for (size_t i = 0; i < b->items->count; i++)
        if (b->results[i].outcome == BATCH_FAILED && b->results[i].sentence)
            console_complain(b->results[i].sentence);
}

static json_t *failed_json(const batch *b)
{
    json_t *list = json_array();
    for (size_t i = 0; i < b->items->count; i++)
        if (b->results[i].outcome == BATCH_FAILED) {
            const batch_result *r = &b->results[i];
            json_array_append_new(list, json_pack("{ss ss si ss}", "name", b->items->of[i].name,
                                                  "input", b->items->of[i].input, "exit_status",
                                                  tl_exit_status(r->status), "sentence",
                                                  r->sentence ? r->sentence : ""));
        }
    return list;
}

static json_t *notices_json(const batch *b)
{
    json_t *list = json_array();
    for (size_t i = 0; i < b->notices.count; i++)
        json_array_append_new(list, json_pack("{ss sI}", "sentence", b->notices.of[i].first,
                                              "frames", (json_int_t)b->notices.of[i].frames));
    return list;
}

static tl_status write_json(batch *b, tl_error *err)
{
    json_t *all = json_pack("{sI sI}", "frames", (json_int_t)b->items->count, "in_flight",
                            (json_int_t)b->options->in_flight);
    json_t *cost = batch_cost_json(&b->cost, b->tally.of[BATCH_DONE]);
    for (int i = 0; i < BATCH_OUTCOME_COUNT; i++)
        json_object_set_new(all, outcome_words[i], json_integer((json_int_t)b->tally.of[i]));
    json_object_set_new(all, "failures", failed_json(b));
    json_object_set_new(all, "notices", notices_json(b));
    json_object_update(all, cost);
    json_decref(cost);
    return tl_json_write("-", all, err);
}

/* Ends the batch in a word. */
static tl_status judge(const batch *b, const batch_progress *progress, tl_error *err)
{
    const tl_error *stopped = &b->tally.stopped;
    char sum[256];
    format_sum(b, sum, sizeof sum);
    if (b->tally.of[BATCH_FAILED] == 0) {
        console_say(sum);
        return TL_OK;
    }
    batch_progress_fail(progress, sum);
    if (stopped->status != TL_OK)
        return tl_fail(err, stopped->status, "%s; %s", stopped->message, sum);
    return tl_fail(err, TL_ERR_DIFFERENT, "%s", sum);
}

tl_status batch_report(batch *b,
                       const batch_progress *progress,
                       const report_options *report,
                       tl_error *err)
{
    tl_status status = TL_OK;
    tell(b);
    if (report->json)
        TRY(write_json(b, err));
    else if (report->timings)
        batch_cost_print(&b->cost, b->tally.of[BATCH_DONE]);
    status = judge(b, progress, err);
done:
    return status;
}
