/* log2 and exp2 for powers of cosines. By polynomials of our own, for a library's are slow and differ from
 * device to device: minimax fits of tests/tools/fit_powers.py. */
#ifndef TL_POWER_H
#define TL_POWER_H

#include "dialect.h"

#if TL_REAL_DOUBLE
#    define MANTISSA_BITS 52
#    define SQRT_HALF_BITS 0x3fe6a09e667f3bcd
#else
#    define MANTISSA_BITS 23
#    define SQRT_HALF_BITS 0x3f3504f3
#endif
#define MANTISSA_ONE ((integer)1 << MANTISSA_BITS) /* 1 in the exponent field */

TL_BEGIN_LOOSE

/* log2(cos2) = power + log2(1 + m), m in [sqrt(1/2) - 1, sqrt(2) - 1]. */
typedef struct split_cos2 {
    real power, m;
} split_cos2;

TL_INLINE split_cos2 split_of(real cos2, real sin2)
{
    const mask near_peak = sin2 < R(0.25);
    const integer bits = AS_INTEGER(cos2);
    const integer power = (bits - SQRT_HALF_BITS) >> MANTISSA_BITS; /* arithmetic: floor */
    const real mantissa = AS_REAL(bits - power * MANTISSA_ONE);
    const split_cos2 s = {pick(near_peak, R(0.0), TO_REAL(power)),
                          pick(near_peak, -sin2, mantissa - R(1.0))};
    return s;
}

/* x = whole + r, x from -64 to 0, where it is cut; r in (-1, 0]. */
typedef struct split_power {
    integer whole;
    real r;
} split_power;

TL_INLINE split_power split_power_of(real x)
{
    const real below = pick(x < R(0.0), x, R(0.0)); /* a vanishing half vector may give more */
    const real bounded = pick(below > R(-64.0), below, R(-64.0));
    const integer whole = TO_INTEGER(bounded); /* truncates: floor() is slow on PoCL */
    const split_power s = {whole, bounded - TO_REAL(whole)};
    return s;
}

TL_INLINE real scaled_by(real x, integer power)
{
    return AS_REAL(AS_INTEGER(x) + power * MANTISSA_ONE);
}

#if TL_PRECISE_POWER
/* The library's functions, which differ from library to library in the last bits: for the
 * reference, and to measure what the polynomials below cost and save. */
#    ifdef __OPENCL_C_VERSION__
#        define LOG2(v) log2(v)
#        define LOG1P(v) log1p(v)
#        define EXP2(v) exp2(v)
#    elif TL_REAL_DOUBLE
#        define LOG2(v) log2(v)
#        define LOG1P(v) log1p(v)
#        define EXP2(v) exp2(v)
#    else
#        define LOG2(v) log2f(v)
#        define LOG1P(v) log1pf(v)
#        define EXP2(v) exp2f(v)
#    endif

TL_INLINE real log2_of_cos2(real cos2, real sin2)
{
    const mask near_peak = sin2 < R(0.25);
    const real away = LOG2(pick(cos2 > R(1e-30), cos2, R(1e-30)));
    return pick(near_peak, LOG1P(-pick(near_peak, sin2, R(0.0))) * R(1.4426950408889634), away);
}

TL_INLINE real exp2_of_negative(real x)
{
    return EXP2(x);
}
#else
/* log2(cos2), cos2 + sin2 = 1: power + m P(m), m in [sqrt(1/2) - 1, sqrt(2) - 1].
 * |P(m) - log2(1 + m) / m| <= 3.3e-7 (tests/tools/fit_powers.py), so 4.6u of the result, and 5u of
 * rounding: Estrin's order, whose chain is half as long as Horner's and which costs 1u more. Finite for
 * every cos2, 0 and NaN too, so that exponent 0 times it is 0. */
TL_INLINE real log2_of_cos2(real cos2, real sin2)
{
    const split_cos2 s = split_of(cos2, sin2);
    const real m = s.m, m2 = m * m;
    const real p01 = FMA(m, R(-0.7213529314), R(1.442694995));
    const real p23 = FMA(m, R(-0.3602251825), R(0.480916708));
    const real p45 = FMA(m, R(-0.2492718221), R(0.2872888824));
    const real p67 = FMA(m, R(-0.1427597344), R(0.2326525788));
    const real p = FMA(FMA(p67, m2, p45), m2 * m2, FMA(p23, m2, p01));
    return FMA(m, p, s.power);
}

/* 2^x for x <= 0, not below 2^-64, so that no later product is denormal; exactly 1 at 0:
 * 2^whole (1 + r Q(r)), r in (-1, 0].
 * |Q(r) - (2^r - 1) / r| <= 2.4e-7 (tests/tools/fit_powers.py): 4u absolute, and 3u of rounding. */
TL_INLINE real exp2_of_negative(real x)
{
    const split_power s = split_power_of(x);
    const real r = s.r, r2 = r * r;
    const real q01 = FMA(r, R(0.24021469), R(0.6931469447));
    const real q23 = FMA(r, R(0.009344231012), R(0.05540855954));
    const real q = FMA(FMA(r2, R(0.001003630514), q23), r2, q01);
    return scaled_by(FMA(r, q, R(1.0)), s.whole);
}
#endif

/* What lobes take in place of both, by TL_POWER. */

/* P and Q of lower degree, in Horner's order. What they are off by stands in knobs.h, rounded up; it
 * counts 0.31 and 1 times in a power, as a share of the peak: log2(1 + m) is m P(m), P at least 1.2, and no
 * t e^-t is above 0.37. */
TL_INLINE real lower_log2_polynomial(real m)
{
    real p;
    if (TL_POWER == TL_POWER_DEGREE_6) {
        p = FMA(m, R(-0.2115355856), R(0.3198277931));
        p = FMA(m, p, R(-0.3658550573));
        p = FMA(m, p, R(0.4796711301));
        p = FMA(m, p, R(-0.7212235231));
        return FMA(m, p, R(1.442703028));
    }
    if (TL_POWER == TL_POWER_DEGREE_5) {
        p = FMA(m, R(0.2611699885), R(-0.3924614911));
        p = FMA(m, p, R(0.4846482816));
        p = FMA(m, p, R(-0.7204624276));
        return FMA(m, p, R(1.442655846));
    }
    if (TL_POWER == TL_POWER_DEGREE_4) {
        p = FMA(m, R(-0.3356954013), R(0.5127350531));
        p = FMA(m, p, R(-0.7236443176));
        return FMA(m, p, R(1.442225986));
    }
    if (TL_POWER == TL_POWER_DEGREE_3) {
        p = FMA(m, R(0.4597966802), R(-0.7524073076));
        return FMA(m, p, R(1.443581459));
    }
    return FMA(m, R(-0.7071067812), R(1.471294242));
}

TL_INLINE real lower_exp2_polynomial(real r)
{
    real q;
    if (TL_IS_ONE_OF(TL_POWER, 1u << TL_POWER_DEGREE_6 | 1u << TL_POWER_DEGREE_5)) {
        q = FMA(r, R(0.007344164232), R(0.05416480556));
        q = FMA(r, q, R(0.2399678219));
        return FMA(r, q, R(0.6931393277));
    }
    if (TL_IS_ONE_OF(TL_POWER, 1u << TL_POWER_DEGREE_4 | 1u << TL_POWER_DEGREE_3)) {
        q = FMA(r, R(0.04321138553), R(0.2358994694));
        return FMA(r, q, R(0.6929176322));
    }
    return FMA(r, R(0.1931471806), R(0.6877438564));
}

/* What the device's functions are given: above 0, and 1 at most. A vanishing half vector gives anything. */
TL_INLINE real cos2_for_library(real cos2, real sin2)
{
    const real best = pick(sin2 < R(0.25), R(1.0) - sin2, cos2);
    const real above_0 = pick(best > R(1e-30), best, R(1e-30));
    return pick(above_0 < R(1.0), above_0, R(1.0));
}

#ifdef __OPENCL_C_VERSION__
#    if TL_REAL_DOUBLE /* has no native functions */
#        define NATIVE_LOG2(v) log2(v)
#        define NATIVE_EXP2(v) exp2(v)
#    else
#        define NATIVE_LOG2(v) native_log2(v)
#        define NATIVE_EXP2(v) native_exp2(v)
#    endif
#    define POWR(v, e) powr(v, e)
#else /* rows of the device's functions are not there */
#    define NATIVE_LOG2(v) (v)
#    define NATIVE_EXP2(v) (v)
#    define POWR(v, e) ((v) + (e))
#endif

TL_INLINE real powr_of_cos2(real cos2, real sin2, real exponent)
{
    return POWR(cos2_for_library(cos2, sin2), exponent);
}

#define TL_HAS_LOWER_DEGREE                                                        \
    TL_IS_ONE_OF(TL_POWER, 1u << TL_POWER_DEGREE_6 | 1u << TL_POWER_DEGREE_5 |     \
                               1u << TL_POWER_DEGREE_4 | 1u << TL_POWER_DEGREE_3 | \
                               1u << TL_POWER_DEGREE_2)

/* log2_of_cos2. */
TL_INLINE real lobe_log2(real cos2, real sin2)
{
    if (TL_HAS_LOWER_DEGREE) {
        const split_cos2 s = split_of(cos2, sin2);
        return FMA(s.m, lower_log2_polynomial(s.m), s.power);
    }
    if (TL_POWER == TL_POWER_NATIVE)
        return NATIVE_LOG2(cos2_for_library(cos2, sin2));
    return log2_of_cos2(cos2, sin2);
}

/* exp2_of_negative. */
TL_INLINE real lobe_exp2(real x)
{
    if (TL_HAS_LOWER_DEGREE) {
        const split_power s = split_power_of(x);
        return scaled_by(FMA(s.r, lower_exp2_polynomial(s.r), R(1.0)), s.whole);
    }
    if (TL_POWER == TL_POWER_NATIVE)
        return NATIVE_EXP2(x);
    if (TL_POWER == TL_POWER_LIBRARY)
        return exp2_of_negative(pick(x < R(0.0), x, R(0.0)));
    return exp2_of_negative(x);
}

TL_END_LOOSE

#endif
