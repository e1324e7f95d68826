#include "bloom_plan.h"

#include "bloom.h"
#include "tilelight/post.h"

#include <math.h>

/* px^2 that going down and up again takes (kernels/bloom.h). */
static double variance_of_size(uint32_t side)
{
    return 0.25 * side * side;
}

double tl_least_bloom_width(uint32_t side)
{
    return 0.75 * side; /* 5/16 small px^2 are left for taps */
}

double tl_most_bloom_width(uint32_t side)
{
    return floor(sqrt(TL_MOST_BLOOM_PASSES * TL_BLOOM_MOST_VARIANCE) * side);
}

/* exp(-k^2/2s) of seven taps that add up to 1, and their variance. */
static double set_taps(double s, double taps[4])
{
    double sum = 0.0, variance = 0.0;
    for (int k = 0; k <= TL_BLOOM_REACH; k++) {
        taps[k] = exp(-0.5 * k * k / s);
        sum += (k ? 2.0 : 1.0) * taps[k];
    }
    for (int k = 0; k <= TL_BLOOM_REACH; k++) {
        taps[k] /= sum;
        variance += 2.0 * k * k * taps[k];
    }
    return variance;
}

/* Cut at three taps, a Gaussian has less than its variance: the one is looked for that has what is wanted. */
static void taps_of_variance(double wanted, double taps[4])
{
    double low = 1e-3, high = 10.0;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        *(set_taps(middle, taps) < wanted ? &low : &high) = middle;
    }
    set_taps(low, taps);
}

tl_bloom_plan tl_bloom_plan_for(double width, uint32_t side)
{
    const double variance = (width * width - variance_of_size(side)) / (side * side);
    tl_bloom_plan plan = {.passes = (uint32_t)ceil(variance / TL_BLOOM_MOST_VARIANCE)};
    double taps[4], others = 0.0;
    taps_of_variance(variance / plan.passes, taps);
    for (int k = 1; k <= TL_BLOOM_REACH; k++) {
        plan.taps[k] = (float)taps[k];
        others += 2.0 * (double)plan.taps[k];
    }
    plan.taps[0] = (float)(1.0 - others);
    return plan;
}
