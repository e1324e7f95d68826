#include "job_promise.h"

#include "console.h"
#include "json_values.h"
#include "program_cache.h"
#include "promise.h"
#include "try.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct sentence {
    char text[512];
    size_t used;
} sentence;

static void add(sentence *s, const char *format, ...) TL_PRINTF_LIKE(2, 3);

static void add(sentence *s, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int count = vsnprintf(s->text + s->used, sizeof s->text - s->used, format, args);
    va_end(args);
    if (count > 0)
        s->used += (size_t)count < sizeof s->text - s->used ? (size_t)count
                                                            : sizeof s->text - s->used - 1;
}

/* What was asked, after "for". */
static void add_goal(sentence *s, const tl_goal *goal)
{
    if (goal->kind == TL_GOAL_RMS)
        add(s, "an RMS error of at most %g of the mean radiance", goal->limit);
    else if (goal->kind == TL_GOAL_CODES)
        add(s, "no channel off by more than 1 of 255");
    else if (goal->kind == TL_GOAL_FLIP)
        add(s, "a mean FLIP of at most %g", goal->limit);
    else
        add(s, "at most %g ms", goal->limit);
}

static void add_found(sentence *s, const tl_goal *goal, const tl_kept *kept)
{
    const tl_attempt *last = &kept->attempts[kept->attempt_count - 1];
    if (goal->kind == TL_GOAL_TIME) {
        add(s, ": expected %.3g ms, took %.3g ms", kept->expected_ms, kept->ms);
        if (isfinite(last->expected))
            add(s, "; the RMS error of such frames was at most %.2g of the mean radiance",
                last->expected);
        return;
    }
    add(s, ": expected at most %.2g, found %.2g on ", last->expected, last->off.seen);
    if (kept->checked >= kept->of)
        add(s, "all pixels");
    else
        add(s, "%" PRIu64 " of %" PRIu64 " pixels, at most %.2g on all", kept->checked,
            kept->of, last->off.bound);
    add(s, "; lit in %.3g ms, checked in %.3g", kept->ms, kept->check_ms);
}

static void tell(const tl_goal *goal, const tl_kept *kept)
{
    const uint32_t chosen = kept->attempts[kept->attempt_count - 1].candidate;
    sentence s = {.used = 0};
    char name[128];
    if (chosen == tl_candidate_count - 1) {
        add(&s, "lit by the reference, for nothing faster holds ");
        add_goal(&s, goal);
    } else {
        tl_candidate_name(chosen, name, sizeof name);
        add(&s, "lit with %s for ", name);
        add_goal(&s, goal);
        add_found(&s, goal, kept);
    }
    tl_notice(&console_notices, "%s", s.text);
    if (!kept->keeps)
        tl_notice(
            &console_notices,
            "no way of lighting this frame is expected to take no more than %g ms: it was lit "
            "in the fastest",
            goal->limit);
}

static json_t *attempts_json(const tl_kept *kept)
{
    json_t *array = json_array();
    for (uint32_t i = 0; i < kept->attempt_count; i++) {
        const tl_attempt *a = &kept->attempts[i];
        char name[128];
        tl_candidate_name(a->candidate, name, sizeof name);
        json_array_append_new(array, json_pack("{ss so so so}", "options", name, "expected",
                                               tl_json_number(a->expected), "found",
                                               tl_json_number(a->off.seen), "at_most",
                                               tl_json_number(a->off.bound)));
    }
    return array;
}

static void report(job *j, const tl_goal *goal, const tl_kept *kept)
{
    char name[128];
    tl_candidate_name(kept->attempts[kept->attempt_count - 1].candidate, name, sizeof name);
    job_report(j, "promise",
               json_pack("{s{ss so} ss sb sb so sI sI so so so so}", "asked", "of",
                         tl_goal_rows[goal->kind].word, "limit", tl_json_number(goal->limit),
                         "chosen", name, "remembered", kept->was_remembered, "kept",
                         kept->keeps, "attempts", attempts_json(kept), "checked_pixels",
                         (json_int_t)kept->checked, "pixels", (json_int_t)kept->of,
                         "expected_ms", tl_json_number(kept->expected_ms), "lighting_ms",
                         tl_json_number(kept->ms), "check_ms", tl_json_number(kept->check_ms),
                         "pilot_ms", tl_json_number(kept->pilot_ms)));
}

tl_status job_promise_light(job *j,
                            const tl_goal *goal,
                            tl_device *device,
                            tl_lighting_options *options,
                            tl_lighting_counts *counts,
                            tl_lighting **lighting,
                            tl_error *err)
{
    const tl_asked asked = {.device = device,
                            .base = *options,
                            .goal = *goal,
                            .gbuffer = j->gbuffer,
                            .lights = &j->lights,
                            .stage = console_stage};
    tl_status status = TL_OK;
    tl_kept kept;
    char *memory = tl_program_cache_folder();
    TRY(tl_promise_light(&asked, memory, j->image, &j->timings, &console_notices, counts,
                         lighting, &kept, err));
    *options = tl_candidate_options(kept.attempts[kept.attempt_count - 1].candidate, options);
    tell(goal, &kept);
    report(j, goal, &kept);
done:
    free(memory);
    return status;
}
