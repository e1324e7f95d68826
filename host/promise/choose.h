/* Which candidate is tried next. */
#ifndef TL_PROMISE_CHOOSE_H
#define TL_PROMISE_CHOOSE_H

#include "goal.h"

/* What a candidate is expected to come to on a frame. INFINITY: not known, or not possible. */
typedef struct tl_expectation {
    double ms; /* that lighting takes */
    double
        error; /* in the terms of the goal, an upper bound; of TL_GOAL_TIME that of TL_GOAL_RMS */
} tl_expectation;

/* For a goal of error: the fastest of those that are expected to keep it by its margin, or the most accurate
 * of those that are as fast but for `tl_as_fast`; the last where there is none. For TL_GOAL_TIME: the most
 * accurate of those that are expected to keep it; the fastest where there is none. candidates: [count], count
 * > 0; the last is the reference, whose error is 0. Cannot fail. */
uint32_t tl_choose(const tl_goal *goal, const tl_expectation *candidates, uint32_t count);

/* Times that differ by less than this share are taken for equal. */
extern const double tl_as_fast;

#endif
