#include "promise.h"

#include "bound.h"
#include "try.h"

#include <math.h>
#include <string.h>

/* A frame on its way to a picture that keeps the goal. */
typedef struct way {
    const tl_asked *asked;
    tl_prepared prepared; /* of the reference */
    json_t *kind;
    tl_expectation candidates[TL_MOST_CANDIDATES]; /* [tl_candidate_count] */
    tl_yardstick by;
} way;

static const double new_share =
    0.25; /* of a time that was measured, in what is expected from then on */

static tl_status know(way *w,
                      const char *memory,
                      tl_timings *timings,
                      const tl_notices *notices,
                      tl_kept *out,
                      tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    out->was_remembered = tl_memory_read(memory, w->kind, w->candidates, notices);
    if (out->was_remembered)
        return TL_OK;
    tl_notice(notices, "the first frame of its kind on this device: a pilot lights it in every "
                       "way that may do, which takes a while and is remembered");
    TRY(tl_pilot(w->asked, &w->prepared, &w->by, w->candidates, err));
    out->pilot_ms = 1e3 * (tl_seconds() - start);
    tl_timings_add(timings, "pilot", out->pilot_ms);
done:
    return status;
}

/* The bound allows for so many pictures having been held against one sample. */
static double doubt_of(uint32_t attempts)
{
    return TL_PROMISE_DOUBT + log((double)attempts);
}

static tl_status check(
    way *w, const tl_image *image, tl_timings *timings, tl_kept *out, tl_error *err)
{
    tl_status status = TL_OK;
    const tl_asked *asked = w->asked;
    const double start = tl_seconds();
    if (asked->stage)
        asked->stage("checking");
    if (!w->by.sample)
        TRY(tl_yardstick_make(&asked->goal, asked->gbuffer, asked->lights, image, &w->by, err));
    TRY(tl_measure(&asked->goal, &w->by, image, doubt_of(out->attempt_count),
                   &out->attempts[out->attempt_count - 1].off, err));
    out->checked = tl_yardstick_pixels(&w->by);
    out->check_ms += 1e3 * (tl_seconds() - start);
    tl_timings_end(timings, "check", start);
done:
    return status;
}

/* One picture, and whether it keeps the goal; what is expected from now on is what was found, where that is
 * worse. */
static tl_status attempt(way *w,
                         tl_image *image,
                         tl_timings *timings,
                         const tl_notices *notices,
                         tl_lighting_counts *counts,
                         tl_lighting **lighting,
                         tl_kept *out,
                         int *keeps,
                         tl_error *err)
{
    const tl_goal *goal = &w->asked->goal;
    const uint32_t chosen = tl_choose(goal, w->candidates, tl_candidate_count);
    const int is_reference = chosen == tl_candidate_count - 1;
    tl_expectation *expected = &w->candidates[chosen];
    tl_status status = TL_OK;
    tl_attempt *now = &out->attempts[out->attempt_count++];
    *now = (tl_attempt){chosen, expected->error, {0.0, 0.0}};
    if (w->asked->stage)
        w->asked->stage("lighting");
    TRY(tl_light_by(w->asked, chosen, image, timings, notices, counts, &out->ms, lighting,
                    err));
    out->expected_ms = expected->ms;
    out->keeps = goal->kind != TL_GOAL_TIME || expected->ms <= goal->limit;
    *keeps = 1;
    if (isfinite(expected->ms))
        expected->ms += new_share * (out->ms - expected->ms);
    if (goal->kind == TL_GOAL_TIME)
        now->off = (tl_estimate){(double)NAN, (double)NAN};
    if (is_reference || goal->kind == TL_GOAL_TIME)
        return TL_OK;
    TRY(check(w, image, timings, out, err));
    *keeps = now->off.bound <= goal->limit;
    expected->error = fmax(expected->error, now->off.bound);
done:
    return status;
}

static void tell_failure(const tl_attempt *of, const tl_goal *goal, const tl_notices *notices)
{
    char name[128];
    tl_candidate_name(of->candidate, name, sizeof name);
    tl_notice(
        notices,
        "%s is off by %.3g as far as a sample of this picture tells, which may be %.3g in all "
        "of it: above %g, so the next way is tried",
        name, of->off.seen, of->off.bound, goal->limit);
}

static tl_status attempts(way *w,
                          tl_image *image,
                          tl_timings *timings,
                          const tl_notices *notices,
                          tl_lighting_counts *counts,
                          tl_lighting **lighting,
                          tl_kept *out,
                          tl_error *err)
{
    tl_status status = TL_OK;
    int keeps = 0;
    while (!keeps) {
        TRY(attempt(w, image, timings, out->attempt_count == 0 ? notices : NULL, counts,
                    lighting, out, &keeps, err));
        if (keeps)
            break;
        tell_failure(&out->attempts[out->attempt_count - 1], &w->asked->goal, notices);
        tl_lighting_destroy(*lighting);
        *lighting = NULL;
    }
done:
    return status;
}

tl_status tl_promise_light(const tl_asked *asked,
                           const char *memory,
                           tl_image *image,
                           tl_timings *timings,
                           const tl_notices *notices,
                           tl_lighting_counts *counts,
                           tl_lighting **lighting,
                           tl_kept *out,
                           tl_error *err)
{
    const tl_device_info device = tl_device_describe(asked->device);
    const tl_prepare_options plain = {.tile_size = TL_RIM_TILE, .effects = asked->base.effects};
    tl_status status = TL_OK;
    way w = {.asked = asked};
    *out =
        (tl_kept){.of = (uint64_t)asked->gbuffer->camera.width * asked->gbuffer->camera.height};
    TRY(tl_prepare(asked->gbuffer, asked->lights, &plain, NULL, &w.prepared, err));
    w.kind = tl_memory_kind(&device, &asked->base, &asked->goal, asked->gbuffer, &w.prepared);
    TRY(know(&w, memory, timings, notices, out, err));
    TRY(attempts(&w, image, timings, notices, counts, lighting, out, err));
    tl_memory_write(memory, w.kind, w.candidates);
done:
    json_decref(w.kind);
    tl_yardstick_clear(&w.by);
    tl_prepared_clear(&w.prepared);
    return status;
}
