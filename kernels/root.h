/* 1/sqrt and 1/x of what lights are divided by, by TL_ROOT: knobs.h.
 *
 * newton-N begins with a guess: of a float's bits as a whole number, which is its logarithm, near enough,
 * half is taken away, or all. Lomont, "Fast Inverse Square Root" (2003); the constant for 1/x is that whose
 * guess is best. Guesses are off by 3.44e-2 and 5.06e-2 of themselves, and steps of Newton from e to 3/2
 * e^2 + 1/2 |e|^3 and e^2, and by 3u of rounding. For floats alone, and for 1e-30 to 1e30: other numbers
 * give other numbers. */
#ifndef TL_ROOT_H
#define TL_ROOT_H

#include "dialect.h"

#define TL_GUESS_OF_PER_ROOT 0x5f3759df
#define TL_GUESS_OF_RECIPROCAL 0x7ef31200

#ifdef __OPENCL_C_VERSION__
#    define RSQRT(x) rsqrt(x)
#    if TL_REAL_DOUBLE /* has no native functions */
#        define NATIVE_RSQRT(x) rsqrt(x)
#        define NATIVE_RECIPROCAL(x) (R(1.0) / (x))
#    else
#        define NATIVE_RSQRT(x) native_rsqrt(x)
#        define NATIVE_RECIPROCAL(x) native_recip(x)
#    endif
#else /* rows of the device's functions are not there */
#    define RSQRT(x) (x)
#    define NATIVE_RSQRT(x) (x)
#    define NATIVE_RECIPROCAL(x) (x)
#endif

TL_BEGIN_LOOSE

TL_INLINE int newton_steps(void)
{
    return TL_ROOT == TL_ROOT_NEWTON_0 ? 0 : TL_ROOT == TL_ROOT_NEWTON_1 ? 1 : 2;
}

TL_INLINE real newton_per_root(real x)
{
    real y = AS_REAL(TL_GUESS_OF_PER_ROOT - (AS_INTEGER(x) >> 1));
    for (int step = 0; step < newton_steps(); step++)
        y = y * FMA(R(-0.5) * x * y, y, R(1.5));
    return y;
}

TL_INLINE real newton_reciprocal(real x)
{
    real y = AS_REAL(TL_GUESS_OF_RECIPROCAL - AS_INTEGER(x));
    for (int step = 0; step < newton_steps(); step++)
        y = y * FMA(-x, y, R(2.0));
    return y;
}

/* A length and 1 over it. */
typedef struct length_pair {
    real length, per_length;
} length_pair;

/* Of a square. */
TL_INLINE length_pair lengths_of(real length2)
{
    length_pair r;
    if (TL_ROOT == TL_ROOT_EXACT) {
        r.length = SQRT(length2);
        r.per_length = R(1.0) / r.length;
        return r;
    }
    r.per_length = TL_ROOT == TL_ROOT_RSQRT    ? RSQRT(length2)
                   : TL_ROOT == TL_ROOT_NATIVE ? NATIVE_RSQRT(length2)
                                               : newton_per_root(length2);
    r.length = length2 * r.per_length;
    return r;
}

TL_INLINE real reciprocal(real x)
{
    if (TL_IS_ONE_OF(TL_ROOT, 1u << TL_ROOT_EXACT | 1u << TL_ROOT_RSQRT))
        return R(1.0) / x;
    return TL_ROOT == TL_ROOT_NATIVE ? NATIVE_RECIPROCAL(x) : newton_reciprocal(x);
}

TL_END_LOOSE

#endif
