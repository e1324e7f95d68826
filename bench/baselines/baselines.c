#include "baselines.h"

#include "baseline_tables.h"

#include <string.h>

static const tl_baseline hand = {
    .name = "hand",
    .meaning = "vector C by hand on threads, to the kernels' contract and their bits",
    .source = "the method of the kernels",
    .rms_tolerance = 2e-6,
    .max_tolerance = 0.1, /* a light at N.L = 0 may be taken or left by rounding */
    .create = hand_create_exact,
    .run = hand_run,
    .destroy = hand_destroy,
};

static const tl_baseline hand_relaxed = {
    .name = "hand_relaxed",
    .meaning = "the same with everything relaxed: estimates, short polynomials, -ffast-math",
    .source = "the method of the kernels",
    .rms_tolerance = 2e-3,
    .max_tolerance = 0.1,
    .create = hand_create_relaxed,
    .run = hand_run,
    .destroy = hand_destroy,
};

const tl_baseline *const tl_baselines[] = {&hand, &hand_relaxed};
const int tl_baseline_count = sizeof tl_baselines / sizeof tl_baselines[0];

const tl_baseline *tl_baseline_find(const char *name)
{
    for (int i = 0; i < tl_baseline_count; i++)
        if (strcmp(tl_baselines[i]->name, name) == 0)
            return tl_baselines[i];
    return NULL;
}
