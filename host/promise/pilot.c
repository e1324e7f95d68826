#include "pilot.h"

#include "bound.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 3 };

/* A candidate that took longer than this is not timed again, ms. */
static const double long_enough = 1000.0;

/* Stages that a second frame does not have. */
static int is_of_the_first(const char *stage)
{
    return strcmp(stage, "compile") == 0 || strcmp(stage, "keep") == 0;
}

static double lighting_ms(const tl_timings *timings)
{
    double sum = 0.0;
    for (int i = 0; i < timings->count; i++)
        if (!is_of_the_first(timings->stages[i].name))
            sum += timings->stages[i].ms;
    return sum;
}

tl_status tl_light_by(const tl_asked *asked,
                      uint32_t candidate,
                      tl_image *image,
                      tl_timings *timings,
                      const tl_notices *notices,
                      tl_lighting_counts *counts,
                      double *ms,
                      tl_lighting **lighting,
                      tl_error *err)
{
    const tl_lighting_options options = tl_candidate_options(candidate, &asked->base);
    tl_status status = TL_OK;
    tl_timings own = {0};
    tl_lighting *made = NULL;
    TRY(tl_lighting_create(asked->device, &options, &made, err));
    TRY(tl_lighting_run(made, asked->gbuffer, asked->lights, image, &own, notices, counts,
                        err));
    for (int i = 0; i < own.count; i++)
        tl_timings_add(timings, own.stages[i].name, own.stages[i].ms);
    if (ms)
        *ms = lighting_ms(&own);
    *lighting = made;
    made = NULL;
done:
    tl_lighting_destroy(made);
    return status;
}

static tl_status light_once(
    const tl_asked *asked, uint32_t candidate, tl_image *image, double *ms, tl_error *err)
{
    tl_lighting *lighting = NULL;
    const tl_status status =
        tl_light_by(asked, candidate, image, NULL, NULL, NULL, ms, &lighting, err);
    tl_lighting_destroy(lighting);
    return status;
}

static void tell(const tl_asked *asked, uint32_t candidate, int round)
{
    char name[128], what[192];
    if (!asked->stage)
        return;
    tl_candidate_name(candidate, name, sizeof name);
    snprintf(what, sizeof what, "trying %s, %d of %d", name, round + 1, ROUNDS + 1);
    asked->stage(what);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* times: [TL_MOST_CANDIDATES][ROUNDS]. The first frame compiles, warms up, and is held against the reference.
 * */
static tl_status first_frames(const tl_asked *asked,
                              const int *suits,
                              tl_image *image,
                              tl_yardstick *by,
                              tl_expectation *candidates,
                              tl_error *err)
{
    tl_status status = TL_OK;
    for (uint32_t i = 0; i + 1 < tl_candidate_count; i++) {
        tl_estimate off;
        if (!suits[i])
            continue;
        tell(asked, i, 0);
        TRY(light_once(asked, i, image, &candidates[i].ms, err));
        if (!by->sample)
            TRY(tl_yardstick_make(&asked->goal, asked->gbuffer, asked->lights, image, by, err));
        TRY(tl_measure(&asked->goal, by, image, TL_PROMISE_DOUBT, &off, err));
        candidates[i].error = off.bound;
    }
done:
    return status;
}

/* By turns, so that what else the machine does is shared by all. */
static tl_status time_frames(const tl_asked *asked,
                             const int *suits,
                             tl_image *image,
                             tl_expectation *candidates,
                             tl_error *err)
{
    tl_status status = TL_OK;
    double times[TL_MOST_CANDIDATES][ROUNDS];
    for (int round = 0; round < ROUNDS; round++)
        for (uint32_t i = 0; i + 1 < tl_candidate_count; i++) {
            times[i][round] = candidates[i].ms;
            if (!suits[i] || (round > 0 && times[i][0] > long_enough))
                continue;
            tell(asked, i, round + 1);
            TRY(light_once(asked, i, image, &times[i][round], err));
        }
    for (uint32_t i = 0; i + 1 < tl_candidate_count; i++) {
        qsort(times[i], times[i][0] > long_enough ? 1 : ROUNDS, sizeof times[i][0], by_value);
        candidates[i].ms = times[i][times[i][0] > long_enough ? 0 : ROUNDS / 2];
    }
done:
    return status;
}

tl_status tl_pilot(const tl_asked *asked,
                   const tl_prepared *prepared,
                   tl_yardstick *by,
                   tl_expectation *candidates,
                   tl_error *err)
{
    const tl_device_info device = tl_device_describe(asked->device);
    const tl_camera *camera = &asked->gbuffer->camera;
    tl_status status = TL_OK;
    tl_image *image = NULL;
    int suits[TL_MOST_CANDIDATES];
    for (uint32_t i = 0; i < tl_candidate_count; i++) {
        candidates[i] = (tl_expectation){(double)INFINITY, (double)INFINITY};
        suits[i] = tl_candidate_suits(i, &device, prepared);
    }
    candidates[tl_candidate_count - 1].error = 0.0;
    TRY(tl_image_create(camera->width, camera->height, &image, err));
    TRY(first_frames(asked, suits, image, by, candidates, err));
    TRY(time_frames(asked, suits, image, candidates, err));
done:
    if (asked->stage)
        asked->stage(NULL);
    tl_image_destroy(image);
    return status;
}
