#include "choose.h"

#include <math.h>

const double tl_as_fast = 0.03;

static uint32_t most_accurate_within(const tl_expectation *candidates,
                                     uint32_t count,
                                     double ms,
                                     double error,
                                     uint32_t otherwise)
{
    uint32_t best = otherwise;
    double least = (double)INFINITY;
    for (uint32_t i = 0; i < count; i++)
        if (candidates[i].ms <= ms && candidates[i].error <= error &&
            candidates[i].error < least) {
            best = i;
            least = candidates[i].error;
        }
    return best;
}

/* The least time of those that are no farther off than `error`. */
static double fastest(const tl_expectation *candidates, uint32_t count, double error)
{
    double least = (double)INFINITY;
    for (uint32_t i = 0; i < count; i++)
        if (candidates[i].error <= error && candidates[i].ms < least)
            least = candidates[i].ms;
    return least;
}

uint32_t tl_choose(const tl_goal *goal, const tl_expectation *candidates, uint32_t count)
{
    const double any = (double)INFINITY;
    const uint32_t reference = count - 1;
    if (goal->kind == TL_GOAL_TIME) {
        const double ms = fmax(goal->limit, fastest(candidates, count, any));
        return most_accurate_within(candidates, reference, ms, any, reference);
    }
    const double error = goal->limit / tl_goal_rows[goal->kind].margin;
    const double ms = fastest(candidates, reference, error);
    if (ms == any)
        return reference;
    return most_accurate_within(candidates, reference, ms * (1.0 + tl_as_fast), error,
                                reference);
}
