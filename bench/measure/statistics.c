#include "statistics.h"

#include <math.h>
#include <stdlib.h>

static const double wanted_coverage = 0.95;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The largest rank k, counted from 1, for which [x_k, x_(n + 1 - k)] covers enough, and what it
 * covers; 1 where none does. */
static size_t rank_of_bounds(size_t count, double *coverage)
{
    /* tail: the probability of fewer than k heads. In logarithms: 2^-n vanishes from 1075 on. */
    double log_term = -(double)count * log(2.0), tail = exp(log_term);
    size_t k = 1;
    *coverage = 1.0 - 2.0 * tail;
    for (size_t next = 2; 2 * next <= count; next++) {
        log_term += log((double)(count - next + 2) / (double)(next - 1));
        tail += exp(log_term);
        if (1.0 - 2.0 * tail < wanted_coverage)
            break;
        k = next;
        *coverage = 1.0 - 2.0 * tail;
    }
    return k;
}

tl_summary tl_summarize(double *samples, size_t count)
{
    tl_summary s = {.count = count};
    if (count == 0)
        return s;
    qsort(samples, count, sizeof *samples, ascending);
    s.median = 0.5 * (samples[(count - 1) / 2] + samples[count / 2]);
    s.least = samples[0];
    s.p90 = samples[(9 * count + 9) / 10 - 1]; /* the least that 90 % do not exceed */
    const size_t k = rank_of_bounds(count, &s.interval.coverage);
    s.interval.low = samples[k - 1];
    s.interval.high = samples[count - k];
    return s;
}

double tl_relative_deviation(const tl_summary *summary)
{
    if (summary->count < 2 || summary->median <= 0.0)
        return (double)INFINITY;
    return 0.5 * (summary->interval.high - summary->interval.low) / summary->median;
}
