/* The first frame of a kind: every candidate lights it, and what comes of that is what is expected of the
 * next. */
#ifndef TL_PROMISE_PILOT_H
#define TL_PROMISE_PILOT_H

#include "candidates.h"
#include "choose.h"
#include "measure.h"

/* A frame whose lighting is asked to keep something. */
typedef struct tl_asked {
    tl_device *device;
    tl_lighting_options base; /* what candidates leave as it is */
    tl_goal goal;
    const tl_gbuffer *gbuffer; /* repaired */
    const tl_light_set *lights;
    void (*stage)(
        const char *what); /* is told what is being done, and NULL at the end; may be NULL */
} tl_asked;

/* Lights the frame by one candidate: *image, of its size, becomes the picture, *ms (may be NULL) what
 * lighting took without compiling kernels. The caller destroys *lighting. Fails as tl_lighting_run does. */
tl_status tl_light_by(const tl_asked *asked,
                      uint32_t candidate,
                      tl_image *image,
                      tl_timings *timings,
                      const tl_notices *notices,
                      tl_lighting_counts *counts,
                      double *ms,
                      tl_lighting **lighting,
                      tl_error *err);

/* candidates: [tl_candidate_count], becomes what each took, the median of several times by turns, and was off
 * by at most; INFINITY for those that do not suit, and the time of the reference. *by becomes what they were
 * held against; the caller clears it. Fails as tl_lighting_run and tl_prepare do. */
tl_status tl_pilot(const tl_asked *asked,
                   const tl_prepared *prepared,
                   tl_yardstick *by,
                   tl_expectation *candidates,
                   tl_error *err);

#endif
