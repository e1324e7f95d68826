/* Let X_i be independent, in [0, c], S their sum and M its expectation. For t > 0, e^(-tx) is convex, so on
 * [0, c] it is at most 1 - (x/c)(1 - e^(-tc)); so E e^(-tS) <= exp(-(M/c)(1 - e^(-tc))), and by Markov's
 * inequality, for s < M,
 *
 *     P(S <= s) <= min over t of exp(ts - (M/c)(1 - e^(-tc))) = exp(-(M - s - s ln(M/s)) / c),
 *
 * t = ln(M/s)/c: Chernoff's bound, in the form of Poisson's distribution. Drawing without putting back has no
 * larger E e^(-tS) (W. Hoeffding, "Probability inequalities for sums of bounded random variables", 1963,
 * theorem 4), so it holds there too. The M at which the right side is e^-doubt is the bound: the largest M
 * that is not refuted by what was seen.
 *
 * Against the empirical Bernstein bound (A. Maurer and M. Pontil, "Empirical Bernstein bounds and sample
 * variance penalization", COLT 2009, theorem 4): that one has 7/3 c ln(2/delta) where nothing was seen, this
 * one c ln(1/delta), and needs no variance, whose estimate from a sample with one pixel a stratum does not
 * exist. */
#include "bound.h"

#include <math.h>

/* M - s - s ln(M/s), rising for M > s. */
static double refuted(double expected, double sum)
{
    return sum > 0.0 ? expected - sum - sum * log(expected / sum) : expected;
}

double tl_sum_bound(double sum, double most, double doubt)
{
    const double wanted = most * doubt;
    double low = sum, high = sum + wanted + sqrt(2.0 * wanted * sum) + wanted;
    if (!(most > 0.0))
        return sum;
    for (int i = 0; i < 200 && low < high; i++) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high)
            break;
        if (refuted(middle, sum) < wanted)
            low = middle;
        else
            high = middle;
    }
    return high;
}
