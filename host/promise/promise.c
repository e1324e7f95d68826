#include "promise.h"

#include "bound.h"
#include "try.h"

#include <math.h>
#include <string.h>

/* A frame on its way to a picture that keeps the goal. */
typedef struct way {
    const tl_asked *asked;
    const char *memory;
    tl_image *image;
    tl_timings *timings;
    const tl_notices *notices;
    tl_lighting_counts *counts;
    tl_lighting *lighting; /* of the picture; owned */
    tl_prepared prepared;  /* of the reference */
    json_t *kind;
    tl_expectation candidates[TL_MOST_CANDIDATES]; /* [tl_candidate_count] */
    tl_yardstick by;
    tl_kept *kept;
} way;

/* Of a time that was measured, in what is expected from then on. */
static const double new_share = 0.25;

static void stage(const way *w, const char *what)
{
    if (w->asked->stage)
        w->asked->stage(what);
}

static tl_status know(way *w, tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    w->kept->was_remembered = tl_memory_read(w->memory, w->kind, w->candidates, w->notices);
    if (w->kept->was_remembered)
        return TL_OK;
    tl_notice(w->notices,
              "the first frame of its kind on this device: a pilot lights it in every "
              "way that may do, which takes a while and is remembered");
    TRY(tl_pilot(w->asked, &w->prepared, &w->by, w->candidates, err));
    w->kept->pilot_ms = 1e3 * (tl_seconds() - start);
    tl_timings_add(w->timings, "pilot", w->kept->pilot_ms);
done:
    return status;
}

/* The bound allows for so many pictures having been held against one sample. */
static double doubt_of(uint32_t attempts)
{
    return TL_PROMISE_DOUBT + log((double)attempts);
}

static tl_status check(way *w, tl_estimate *off, tl_error *err)
{
    tl_status status = TL_OK;
    const tl_asked *asked = w->asked;
    const double start = tl_seconds();
    stage(w, "checking");
    if (!w->by.sample)
        TRY(tl_yardstick_make(&asked->goal, asked->gbuffer, asked->lights, w->image, &w->by,
                              err));
    TRY(tl_measure(&asked->goal, &w->by, w->image, doubt_of(w->kept->attempt_count), off, err));
    w->kept->checked = tl_yardstick_pixels(&w->by);
    w->kept->check_ms += 1e3 * (tl_seconds() - start);
    tl_timings_end(w->timings, "check", start);
done:
    return status;
}

/* *now becomes an attempt that has a picture. What is said of a frame is said once. */
static tl_status light(way *w, tl_attempt *now, tl_error *err)
{
    const tl_goal *goal = &w->asked->goal;
    tl_expectation *expected = &w->candidates[now->candidate];
    const tl_notices *notices = w->kept->attempt_count == 1 ? w->notices : NULL;
    tl_status status = TL_OK;
    stage(w, "lighting");
    tl_lighting_destroy(w->lighting);
    w->lighting = NULL;
    TRY(tl_light_by(w->asked, now->candidate, w->image, w->timings, notices, w->counts,
                    &w->kept->ms, &w->lighting, err));
    w->kept->expected_ms = expected->ms;
    w->kept->keeps = goal->kind != TL_GOAL_TIME || expected->ms <= goal->limit;
    if (isfinite(expected->ms))
        expected->ms += new_share * (w->kept->ms - expected->ms);
done:
    return status;
}

static void tell_failure(const way *w, const tl_attempt *of)
{
    char name[128];
    tl_candidate_name(of->candidate, name, sizeof name);
    tl_notice(
        w->notices,
        "%s is off by %.3g as far as a sample of this picture tells, which may be %.3g in "
        "all of it: above %g, so the next way is tried",
        name, of->off.seen, of->off.bound, w->asked->goal.limit);
}

/* Pictures until one keeps the goal. What is expected from now on is what was found, where that is worse; so
 * each candidate that fails is not chosen again, and the reference ends it. */
static tl_status attempt(way *w, tl_error *err)
{
    const tl_goal *goal = &w->asked->goal;
    tl_status status = TL_OK;
    for (;;) {
        const uint32_t chosen = tl_choose(goal, w->candidates, tl_candidate_count);
        tl_expectation *expected = &w->candidates[chosen];
        tl_attempt *now = &w->kept->attempts[w->kept->attempt_count++];
        *now = (tl_attempt){chosen, expected->error, {0.0, 0.0}};
        TRY(light(w, now, err));
        if (goal->kind == TL_GOAL_TIME)
            now->off = (tl_estimate){(double)NAN, (double)NAN};
        if (goal->kind == TL_GOAL_TIME || chosen == tl_candidate_count - 1)
            break;
        TRY(check(w, &now->off, err));
        if (!(now->off.bound <=
              expected->error)) /* no number counts as none that is small enough */
            expected->error = now->off.bound >= 0.0 ? now->off.bound : (double)INFINITY;
        if (now->off.bound <= goal->limit)
            break;
        tell_failure(w, now);
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
    way w = {.asked = asked,
             .memory = memory,
             .image = image,
             .timings = timings,
             .notices = notices,
             .counts = counts,
             .kept = out};
    if (asked->gbuffer->layers.count > 0 && asked->base.layers > 0)
        TRY(tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "nothing is promised of pictures through layers of surfaces that blend, and "
            "this capture has %u: light it without a promise, or capture it with "
            "--layers 0",
            asked->gbuffer->layers.count));
    if (asked->lights->link_count > 0)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "nothing is promised of lights that are linked to objects: light the frame "
                    "without a promise, or with lights that are for all objects"));
    *out =
        (tl_kept){.of = (uint64_t)asked->gbuffer->camera.width * asked->gbuffer->camera.height};
    TRY(tl_prepare(asked->gbuffer, asked->lights, &plain, NULL, &w.prepared, err));
    w.kind = tl_memory_kind(&device, &asked->base, &asked->goal, asked->gbuffer, &w.prepared);
    TRY(know(&w, err));
    TRY(attempt(&w, err));
    tl_memory_write(memory, w.kind, w.candidates);
    *lighting = w.lighting;
    w.lighting = NULL;
done:
    tl_lighting_destroy(w.lighting);
    json_decref(w.kind);
    tl_yardstick_clear(&w.by);
    tl_prepared_clear(&w.prepared);
    return status;
}
