/* Lighting that keeps what is asked of it: an error that is checked, or a time.
 *
 * What candidates are expected to come to is remembered from frames of the same kind, or found by a pilot.
 * The one that is chosen lights the frame; the picture that is handed over is itself held against the
 * reference, on a sample, and where it does not keep the goal the next candidate lights the frame, in the end
 * the reference. */
#ifndef TL_PROMISE_H
#define TL_PROMISE_H

#include "memory.h"
#include "pilot.h"

/* A candidate that lit the frame. */
typedef struct tl_attempt {
    uint32_t candidate;
    double expected; /* error */
    tl_estimate off; /* as found; 0 of the reference; of TL_GOAL_TIME not looked for: NAN */
} tl_attempt;

typedef struct tl_kept {
    tl_attempt attempts[TL_MOST_CANDIDATES]; /* [attempt_count]; the last made the picture */
    uint32_t attempt_count;
    int was_remembered;     /* else a pilot was lit */
    int keeps;              /* 0: nothing is expected to be so fast (TL_GOAL_TIME) */
    double expected_ms, ms; /* of lighting, by the candidate that made the picture */
    double pilot_ms, check_ms;
    uint64_t checked, of; /* pixels (samples) that the reference was lit at, of how many */
} tl_kept;

/* *image, of the frame's size, becomes the picture. memory: the folder (memory.h); NULL: nothing is
 * remembered. *lighting is that of the picture, which the caller destroys. timings, notices, counts may be
 * NULL. Fails as tl_lighting_run and tl_prepare do. */
tl_status tl_promise_light(const tl_asked *asked,
                           const char *memory,
                           tl_image *image,
                           tl_timings *timings,
                           const tl_notices *notices,
                           tl_lighting_counts *counts,
                           tl_lighting **lighting,
                           tl_kept *out,
                           tl_error *err);

#endif
