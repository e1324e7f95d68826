/* What a sample says of all. */
#ifndef TL_PROMISE_BOUND_H
#define TL_PROMISE_BOUND_H

/* The chance that is taken: of 1000 promises that are checked on samples alone, one may not hold. As its
 * natural logarithm, negated: ln 1000. */
#define TL_PROMISE_DOUBT 6.907755278982137

/* An upper bound on the expected sum of independent numbers, or of numbers drawn without putting back, of
 * which none is below 0 and none above `most`: `sum` was seen. It holds but for a chance of exp(-doubt).
 * `sum` itself where most is 0. Cannot fail. */
double tl_sum_bound(double sum, double most, double doubt);

#endif
