/* The numbers of the oracle: 128-bit floats, 113 bits of mantissa.
 *
 * v = 2^-113. Sums, products, quotients and sqrtq are rounded correctly: v of the result at most. Functions
 * of libquadmath are taken to be off by 4v. Floats convert exactly, and products of two floats are exact.
 * Floats have squares and fourth powers from 1e-180 to 1e155, far from the ends of these numbers. */
#ifndef TL_ORACLE_WIDE_H
#define TL_ORACLE_WIDE_H

#include <quadmath.h>
#include <stddef.h>

typedef __float128 wide;

/* Defines the sum of `count` terms, as if added up with twice the digits and then rounded (Ogita, Rump, Oishi
 * 2005, "Accurate Sum and Dot Product", Sum2). */
#define TL_ACCURATE_SUM(name, number)                                     \
    static inline number name(const number *terms, size_t count)          \
    {                                                                     \
        number sum = 0, error = 0;                                        \
        for (size_t i = 0; i < count; i++) {                              \
            const number next = sum + terms[i], from_term = next - sum;   \
            error += (sum - (next - from_term)) + (terms[i] - from_term); \
            sum = next;                                                   \
        }                                                                 \
        return sum + error;                                               \
    }

/* Off by 2v of itself and by v^2 count^2 of the sum of magnitudes. */
TL_ACCURATE_SUM(wide_sum, wide)

static inline wide wide_sum3(wide a, wide b, wide c)
{
    const wide terms[] = {a, b, c};
    return wide_sum(terms, 3);
}

#endif
