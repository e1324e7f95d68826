/* What channels hold, from what a pixel shows: the codes of normal_code.h, depth_code.h and color_code.h
 * written, and numbers as bits (number.h). The host packs with it in double (pack.h), the geometry pass in
 * float (raster/shaders/layout.glsl).
 *
 * The common subset of C and GLSL: beyond the rules of dialect.h no casts but TO_REAL and its like, no
 * enumerations, no floats in hexadecimal, whole numbers with their u. */
#ifndef TL_ENCODE_H
#define TL_ENCODE_H

#include "normal_code.h"
#include "ranges.h"

/* --- numbers ----------------------------------------------------------------------------------- */

/* The bits of a float's magnitude without the last `dropped`: to nearest, ties to even, by what is added
 * below the last one that stays. */
TL_INLINE word32 rounded_bits(word32 with_sign, tl_u32 dropped)
{
    const word32 bits = with_sign & 0x7fffffffu;
    return (bits + (1u << (dropped - 1u)) - 1u + (bits >> dropped & 1u)) >> dropped;
}

/* value: a whole number but for rounding; may be negative. */
TL_INLINE word32 whole_of(real value)
{
    return WHOLE_TO_WORD(FLOOR(value + R(0.5)));
}

/* value: within [0, 1]. Below 2^24 in float; `bits` up to 24. */
TL_INLINE word32 unorm_bits(real value, tl_u32 bits)
{
    return whole_of(value * TO_REAL((1u << bits) - 1u));
}

/* value: within [-1, 1]. */
TL_INLINE word32 snorm_bits(real value, tl_u32 bits)
{
    return whole_of(value * TO_REAL((1u << (bits - 1u)) - 1u)) & ((1u << bits) - 1u);
}

/* The number that no value needs. */
TL_INLINE word32 none_bits(tl_u32 bits)
{
    return 1u << (bits - 1u);
}

/* --- normals ----------------------------------------------------------------------------------- */

/* For channels that hold no negative numbers. */
TL_INLINE vec3 raised_normal(vec3 v)
{
    const vec3 raised = {FMA(v.x, R(0.5), R(0.5)), FMA(v.y, R(0.5), R(0.5)),
                         FMA(v.z, R(0.5), R(0.5))};
    return raised;
}

/* Of the four points around octahedron_of(v), of the grid with `most` steps from 0 to 1, the one whose
 * direction is nearest to v, a unit vector. (Rounding each number by itself misses it by up to a step.)
 * Nearest by the distance between ends: cosines of such small angles are all 1 in float. */
TL_INLINE vec2 nearest_octahedron(vec3 v, real most)
{
    const vec2 e = octahedron_of(v);
    real least = R(4.0);
    vec2 nearest = e;
    for (int corner = 0; corner < 4; corner++) {
        const real x = FLOOR(e.x * most) + TO_REAL(corner & 1);
        const real y = FLOOR(e.y * most) + TO_REAL(corner >> 1);
        if (x > most || y > most)
            continue;
        const vec2 at = {x / most, y / most};
        const vec3 apart = fma3(unit3(direction_of_octahedron(at)), R(-1.0), v);
        const real distance2 = dot3(apart, apart);
        if (distance2 < least) {
            least = distance2;
            nearest = at;
        }
    }
    return nearest;
}

/* --- depth ------------------------------------------------------------------------------------- */

/* 1 on the near plane, 0 on the far plane, and within them. far may be infinite, but not under parallel
 * rays. */
TL_INLINE real nearness_at(real depth, real near, real far, mask parallel)
{
    const real q = pick(parallel, (far - depth) / (far - near),
                        (R(1.0) / depth - R(1.0) / far) / (R(1.0) / near - R(1.0) / far));
    return pick(q < R(0.0), R(0.0), pick(q > R(1.0), R(1.0), q));
}

/* Depths of a surface, which is never written as sky: the last number before the far plane's is a step
 * short of 1. */
TL_INLINE real forward_of_nearness(real q, real step)
{
    return pick(R(1.0) - q < R(1.0) - step, R(1.0) - q, R(1.0) - step);
}

TL_INLINE real ndc_of_nearness(real q, real step)
{
    const real ndc = R(1.0) - R(2.0) * q;
    return pick(ndc < R(1.0) - step, ndc, R(1.0) - step);
}

/* A forward depth in 24 bits; nearness is taken from the far end, where it has digits. */
TL_INLINE word32 forward24_of_nearness(real q)
{
    const word32 from_far = unorm_bits(q, 24u);
    return 0xffffffu - (from_far > 1u ? from_far : 1u);
}

TL_INLINE real fraction_of_depth(real depth, real near, real far)
{
    return (depth - near) / (far - near);
}

/* --- colours and exponents ---------------------------------------------------------------------- */

TL_INLINE vec3 roots_of(vec3 c)
{
    const vec3 roots = {SQRT(c.x), SQRT(c.y), SQRT(c.z)};
    return roots;
}

TL_INLINE real greatest_of(vec3 c)
{
    return pick(c.x > c.y, pick(c.x > c.z, c.x, c.z), pick(c.y > c.z, c.y, c.z));
}

TL_INLINE real least_of(vec3 c)
{
    return pick(c.x < c.y, pick(c.x < c.z, c.x, c.z), pick(c.y < c.z, c.y, c.z));
}

TL_INLINE real gray_of(vec3 c)
{
    return R(0.5) * (least_of(c) + greatest_of(c));
}

/* RGB9E5; channels within [0, TL_MOST_SHARED]. The exponent stored is that of the greatest, [1/2, 1) 2^e,
 * plus 15; mantissas are 9 bits below it. In float's exponent field stands e + 126. */
TL_INLINE word32 shared_of(vec3 c)
{
    const real most = greatest_of(c);
    word32 field = REAL_AS_WORD(most) >> 23u;
    field = field > 111u ? field : 111u;
    if (whole_of(most * WORD_AS_REAL((262u - field) << 23u)) > 511u)
        field = field + 1u;
    const real scale = WORD_AS_REAL((262u - field) << 23u); /* 2^(9 - e) */
    return whole_of(c.x * scale) | whole_of(c.y * scale) << 9u | whole_of(c.z * scale) << 18u |
           (field - 111u) << 27u;
}

/* exponent: 0 to TL_MOST_SHININESS. */
TL_INLINE real logarithm_of_shininess(real exponent)
{
    return LIBRARY_LOG2(R(1.0) + exponent) / TL_LOG2_MOST_LOBE;
}

#endif
