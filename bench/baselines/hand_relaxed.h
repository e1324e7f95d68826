/* Light on a block of pixels with everything relaxed: what a careful hand makes of it when an
 * error of about 1e-3 of the light will do and no bits are promised.
 *
 * Against hand_exact.h: 1/d is the processor's estimate (1.5 2^-12); the range is where the falloff
 * ends, without a comparison; the half vector is never formed, and the specular lobe is a power
 * of
 *
 *     cos^2 = (n.l + d n.v)^2 / (d2 + d (2 l.v + d))
 *
 * with d = d2 / estimate in every place, so that the peak stays a peak: numerator and denominator
 * are those of one vector l + d v, whatever d is. Polynomials of degree 3. Compiled with
 * -ffast-math (but NaN and infinity are data here).
 *
 * Under the model blinn-phong-normalized with one colour (hand.h), both lobes are added at once.
 *
 * Floor, AVX2 on Zen 3: per block and kept light 34 instructions on the multiply-add pipes and a
 * division of 3 cycles beside them: 17 cycles; per listed light 4 cycles, as hand_exact.h. */
#ifndef TL_HAND_RELAXED_H
#define TL_HAND_RELAXED_H

#include "hand_lights.h"

/* tests/tools/fit_powers.py: log2(1 + m)/m on [sqrt(1/2) - 1, sqrt(2) - 1] within 6e-4, 2^r on
 * [-1/2, 1/2] within 8.1e-5. */
#define LOG_0 1.442307054f
#define LOG_1 -0.7246998474f
#define LOG_2 0.5101832372f
#define LOG_3 -0.3226235908f
#define EXP_0 0.999924557f
#define EXP_1 0.6931367339f
#define EXP_2 0.2426394785f
#define EXP_3 0.05583828295f

typedef struct kept_lights {
    const tl_view_light *of[CHUNK];
    lanes seen[CHUNK]; /* weight where it is above the surface; with one colour what arrives */
    lanes cos2[CHUNK]; /* of normal and half vector */
} kept_lights;

/* Diffuse light, and what the specular lobe needs. */
LANES_INLINE lanes3 add_diffuse(block_surface s, kept_lights *kept, size_t count, lanes3 sum)
{
    const lanes n_dot_v = dot(s.normal, s.to_eye);
    for (size_t i = 0; i < count; i++) {
        const tl_view_light *light = kept->of[i];
        const lanes3 l = towards(&s, light);
        const lanes distance2 = dot(l, l) + 1e-24f;
        const lanes per = rough_reciprocal_root(distance2);
        const lanes distance = distance2 * per;
        const lanes n_dot_l = dot(s.normal, l), l_dot_v = dot(l, s.to_eye);
        const lanes seen = keep_unless_negative(n_dot_l, fade(light, distance2, distance, per));
        const lanes n_dot_h = larger(fused(distance, n_dot_v, n_dot_l), all(0.0f));
        const lanes length2 =
            fused(distance, fused(all(2.0f), l_dot_v, distance), distance2 + 1e-20f);
        const lanes arriving = seen * (n_dot_l * per);
        if (!s.has_one_color)
            sum = add_scaled(light->diffuse, arriving, sum);
        kept->seen[i] = s.has_one_color ? arriving : seen;
        kept->cos2[i] = n_dot_h * n_dot_h / length2;
    }
    return sum;
}

/* Within 6e-4 (1 - cos2) near 1, 3e-4 elsewhere; about -127 for 0. */
LANES_INLINE lanes log2_of(lanes cos2)
{
    const ints bits = (ints)cos2 - 0x3f3504f3;
    const lanes m = (lanes)((bits & 0x7fffff) + 0x3f3504f3) - 1.0f;
    const lanes p =
        fused(fused(fused(m, all(LOG_3), all(LOG_2)), m, all(LOG_1)), m, all(LOG_0));
    return fused(m, p, as_floats(bits >> 23));
}

/* 2^x for x < 1, not below 2^-60, so that no later product is denormal. */
LANES_INLINE lanes exp2_of(lanes x)
{
    const lanes bounded = larger(x, all(-60.0f));
    const ints whole = nearest(bounded);
    const lanes r = bounded - as_floats(whole);
    const lanes p =
        fused(fused(fused(r, all(EXP_3), all(EXP_2)), r, all(EXP_1)), r, all(EXP_0));
    return (lanes)((ints)p + (whole << 23));
}

LANES_INLINE lanes3 add_specular(block_surface s,
                                 const kept_lights *kept,
                                 size_t count,
                                 lanes3 sum)
{
    for (size_t i = 0; i < count; i++) {
        const lanes lobe = exp2_of(s.half_exponent * log2_of(kept->cos2[i]));
        sum = add_scaled(kept->of[i]->specular, kept->seen[i] * lobe, sum);
    }
    return sum;
}

/* Both lobes at once. */
LANES_INLINE lanes3 add_both(block_surface s, const kept_lights *kept, size_t count, lanes3 sum)
{
    for (size_t i = 0; i < count; i++) {
        const lanes lobe = exp2_of(s.half_exponent * log2_of(kept->cos2[i]));
        const lanes share = fused(lobe * s.lobe_scale, kept->seen[i], kept->seen[i]);
        sum = add_scaled(kept->of[i]->diffuse, share, sum);
    }
    return sum;
}

/* Adds up to CHUNK lights with positions. */
LANES_INLINE void add_lights(block_surface s,
                             bool specular,
                             const tl_view_light *const *list,
                             size_t count,
                             block_light *sum)
{
    kept_lights kept;
    const size_t kept_count = keep_lights(s, list, count, kept.of);
    sum->diffuse = add_diffuse(s, &kept, kept_count, sum->diffuse);
    if (s.has_one_color)
        sum->diffuse = add_both(s, &kept, kept_count, sum->diffuse);
    else if (specular)
        sum->specular = add_specular(s, &kept, kept_count, sum->specular);
}

LANES_INLINE void add_directional(block_surface s,
                                  bool specular,
                                  const tl_view_light *light,
                                  block_light *sum)
{
    const lanes3 l = {all(light->position[0]), all(light->position[1]),
                      all(light->position[2])};
    const lanes n_dot_l = dot(s.normal, l);
    const lanes seen = keep_unless_negative(n_dot_l, all(1.0f));
    sum->diffuse = add_scaled(light->diffuse, seen * n_dot_l, sum->diffuse);
    if (!specular)
        return;
    const lanes n_dot_h = larger(n_dot_l + dot(s.normal, s.to_eye), all(0.0f));
    const lanes length2 = 2.0f + 2.0f * dot(l, s.to_eye);
    const lanes cos2 = n_dot_h * n_dot_h / larger(length2, all(1e-20f));
    const lanes lobe = exp2_of(s.half_exponent * log2_of(cos2));
    sum->specular = add_scaled(light->specular, seen * lobe, sum->specular);
}

#endif
