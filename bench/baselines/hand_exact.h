/* Light on a block of pixels at the kernels' contract: the operations of kernels/light.h and
 * specular.h in their order, so the bits are theirs; what is by hand is how they are scheduled.
 *
 * A light on a block is a chain of some 200 cycles of latency in some 120 instructions. A
 * processor holds about 130 vector results in flight, so one light after another runs at one
 * instruction per cycle and a half. The chain is cut into five loops over the block's lights,
 * each short enough that several iterations are in flight, with what passes between them in
 * memory (L1). The first keeps the lights that reach the block and stand above it, without a
 * branch: who is kept is not predictable, and a light that faces no pixel adds exactly 0.
 *
 * Floor, AVX2 on Zen 3 (2 fused multiply-adds, 2 additions, 6 instructions a cycle; division 3,
 * root 5 cycles, one at a time): per block and listed light 22 instructions, 4 cycles; per block
 * and kept light 59 on the multiply-add pipes and 3 on the divider, of 11 cycles that run
 * beside: 30 cycles. */
#ifndef TL_HAND_EXACT_H
#define TL_HAND_EXACT_H

#include "hand_lights.h"

/* The lights of a chunk that are kept, and what one loop leaves to the next. */
typedef struct kept_lights {
    const tl_view_light *of[CHUNK];
    lanes distance[CHUNK];
    lanes seen[CHUNK]; /* weight where the light is within reach and above the surface */
    lanes sin2[CHUNK], cos2[CHUNK];
    lanes log2[CHUNK]; /* of the lobe */
} kept_lights;

LANES_INLINE lanes3 add_diffuse(block_surface s, kept_lights *kept, size_t count, lanes3 sum)
{
    for (size_t i = 0; i < count; i++) {
        const tl_view_light *light = kept->of[i];
        const lanes3 l = towards(&s, light);
        const lanes distance2 = dot(l, l);
        const lanes distance = root(distance2), per_distance = 1.0f / distance;
        const lane_mask within =
            both(below(distance2, all(light->range2)), below(all(1e-24f), distance2));
        const lanes n_dot_l = dot(s.normal, l) * per_distance;
        const lane_mask above = both(within, below(all(0.0f), n_dot_l));
        const lanes seen = keep(above, fade(light, distance2, distance, per_distance));
        sum = add_scaled(light->diffuse, keep(above, seen * n_dot_l), sum);
        kept->distance[i] = distance;
        kept->seen[i] = seen;
    }
    return sum;
}

/* The squared sine and cosine between normal and half vector; `seen` ends where it is below. */
LANES_INLINE void half_vector(
    const block_surface *s, lanes3 h, lanes *sin2, lanes *cos2, lanes *seen)
{
    const lanes3 n = s->normal;
    const lanes n_dot_h = dot(n, h);
    const lanes3 across = {fused_from(n.x, n_dot_h, h.x), fused_from(n.y, n_dot_h, h.y),
                           fused_from(n.z, n_dot_h, h.z)};
    const lanes per_length2 = 1.0f / dot(h, h);
    *sin2 = dot(across, across) * per_length2;
    *cos2 = n_dot_h * n_dot_h * per_length2;
    *seen = keep(below(all(0.0f), n_dot_h), *seen);
}

LANES_INLINE void find_half_vectors(block_surface s, kept_lights *kept, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const lanes3 l = towards(&s, kept->of[i]);
        const lanes d = kept->distance[i];
        const lanes3 h = {fused(s.to_eye.x, d, l.x), fused(s.to_eye.y, d, l.y),
                          fused(s.to_eye.z, d, l.z)};
        half_vector(&s, h, &kept->sin2[i], &kept->cos2[i], &kept->seen[i]);
    }
}

LANES_INLINE lanes log2_of(lanes sin2, lanes cos2)
{
    const lane_mask near_peak = below(sin2, all(0.25f));
    const ints bits = (ints)cos2;
    const ints power = (bits - 0x3f3504f3) >> 23;
    const lanes m = choose(near_peak, -sin2, (lanes)(bits - (power << 23)) - 1.0f);
    const lanes m2 = m * m;
    const lanes p01 = fused(m, all(-0.7213529314f), all(1.442694995f));
    const lanes p23 = fused(m, all(-0.3602251825f), all(0.480916708f));
    const lanes p45 = fused(m, all(-0.2492718221f), all(0.2872888824f));
    const lanes p67 = fused(m, all(-0.1427597344f), all(0.2326525788f));
    const lanes p = fused(fused(p67, m2, p45), m2 * m2, fused(p23, m2, p01));
    return fused(m, p, drop(near_peak, as_floats(power)));
}

LANES_INLINE lanes exp2_of(lanes x)
{
    const lanes bounded = larger(smaller(x, all(0.0f)), all(-64.0f));
    const ints whole = truncated(bounded);
    const lanes r = bounded - as_floats(whole);
    const lanes r2 = r * r;
    const lanes q01 = fused(r, all(0.24021469f), all(0.6931469447f));
    const lanes q23 = fused(r, all(0.009344231012f), all(0.05540855954f));
    const lanes q = fused(fused(r2, all(0.001003630514f), q23), r2, q01);
    return (lanes)((ints)fused(r, q, all(1.0f)) + (whole << 23));
}

LANES_INLINE void find_logarithms(lanes half_exponent, kept_lights *kept, size_t count)
{
    for (size_t i = 0; i < count; i++)
        kept->log2[i] = half_exponent * log2_of(kept->sin2[i], kept->cos2[i]);
}

LANES_INLINE lanes3 add_specular(const kept_lights *kept, size_t count, lanes3 sum)
{
    for (size_t i = 0; i < count; i++)
        sum = add_scaled(kept->of[i]->specular, kept->seen[i] * exp2_of(kept->log2[i]), sum);
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
    if (!specular)
        return;
    find_half_vectors(s, &kept, kept_count);
    find_logarithms(s.half_exponent, &kept, kept_count);
    sum->specular = add_specular(&kept, kept_count, sum->specular);
}

LANES_INLINE void add_directional(block_surface s,
                                  bool specular,
                                  const tl_view_light *light,
                                  block_light *sum)
{
    const lanes3 l = {all(light->position[0]), all(light->position[1]),
                      all(light->position[2])};
    const lanes n_dot_l = dot(s.normal, l);
    lanes seen = keep(below(all(0.0f), n_dot_l), all(1.0f)), sin2, cos2;
    sum->diffuse = add_scaled(light->diffuse, seen * n_dot_l, sum->diffuse);
    if (!specular)
        return;
    half_vector(&s, (lanes3){s.to_eye.x + l.x, s.to_eye.y + l.y, s.to_eye.z + l.z}, &sin2,
                &cos2, &seen);
    const lanes lobe = exp2_of(s.half_exponent * log2_of(sin2, cos2));
    sum->specular = add_scaled(light->specular, seen * lobe, sum->specular);
}

#endif
