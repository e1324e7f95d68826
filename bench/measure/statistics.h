/* What samples of a time say: the median and how far it is known, without assuming any
 * distribution, since times are skewed and have outliers. */
#ifndef TL_STATISTICS_H
#define TL_STATISTICS_H

#include <stddef.h>

/* Where the median of what was sampled lies, at 95 %. The bounds are samples: of n independent ones
 * the k smallest are all above the median with the probability of fewer than k heads in n tosses
 * of a coin (Conover, "Practical Nonparametric Statistics", 1999, section 3.2). */
typedef struct tl_interval {
    double low, high;
    /* at least 0.95 from 6 samples on; below that all of them: 1 - 2^(1 - n) */
    double coverage;
} tl_interval;

typedef struct tl_summary {
    size_t count; /* 0: all else is 0 */
    double median, least, p90;
    tl_interval interval; /* of the median */
} tl_summary;

/* samples: [count], sorted by the call. Cannot fail. */
tl_summary tl_summarize(double *samples, size_t count);

/* Half the interval's width over the median: how well the median is known. Infinite where there is
 * no interval worth the name (one sample). */
double tl_relative_deviation(const tl_summary *summary);

#endif
