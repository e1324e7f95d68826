/* Light of the sky on surfaces (docs/sky-light.md): what comes to a surface from all around, and what it
 * mirrors.
 *
 *   diffuse   irradiance over pi, of nine spherical harmonics of the sky: Ramamoorthi and Hanrahan, "An
 *             Efficient Representation for Irradiance Environment Maps", SIGGRAPH 2001, equation 12. With the
 *             moments of the light L that comes from unit directions d, over all solid angle, it is
 *
 *                 E(n)/pi = 3/(32 pi) int L + 1/(2 pi) n . int L d + 15/(32 pi) n^T (int L d d^T) n,
 *
 *             a polynomial of ten terms in the normal, in view space. Beyond its third band a clamped cosine
 *             has little; but what it leaves out may leave less than nothing opposite to a small sun. Light
 *             is not below 0, so 0 is nearer to the truth than any number below it, and stands in for it.
 *   mirrored  the sky as a surface of this roughness would show it seen head-on, looked up in the mirrored
 *             direction: Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013. Levels of roughness,
 *             octahedral maps (normal_code.h) with a border of one texel, so that no seam shows. Between four
 *             texels, and between two levels.
 *   shares    what of light from everywhere alike the lobe reflects, and what does not get below the surface:
 *             a table by the square root of |n.v| and by roughness, between four of its entries.
 *
 * A white surface under a sky of radiance 1 has radiance 1, whatever the model and its units: the sky is
 * radiance, as the picture is. Surfaces without a normal have none of it. */
#ifndef TL_SKY_LIGHT_H
#define TL_SKY_LIGHT_H

#include "finish.h"
#include "normal_code.h"
#include "texture.h"

#define TL_SKY_LEVELS 17 /* of roughness, evenly from the least to 1 */
#define TL_SKY_LAST_LEVEL R(16.0)
#define TL_SKY_TABLE 32 /* entries, each way */
#define TL_SKY_LAST_ENTRY R(31.0)
#define TL_SKY_LEAST_ROUGHNESS R(0.11891476620784007) /* fourth root of TL_LEAST_ALPHA2 */

typedef TL_GLOBAL const tl_view_sky_light *tl_sky_light_at;

TL_INLINE tl_sky_light_at sky_light_behind(const tl_frame *frame, tl_numbers numbers)
{
    return (tl_sky_light_at)(numbers + (size_t)frame->sky_light_at * (TL_SECTION_ROW / 4));
}

/* Of one channel; c: tl_view_sky_light.irradiance. Off by 13u of the sum of its terms' magnitudes: two
 * products each, and ten sums. */
TL_INLINE real irradiance_of(TL_GLOBAL const float *c, vec3 n)
{
    real sum = (real)(scalar)c[0];
    sum = FMA((scalar)c[7], n.x * n.y, sum);
    sum = FMA((scalar)c[8], n.y * n.z, sum);
    sum = FMA((scalar)c[9], n.z * n.x, sum);
    sum = FMA((scalar)c[4], n.x * n.x, sum);
    sum = FMA((scalar)c[5], n.y * n.y, sum);
    sum = FMA((scalar)c[6], n.z * n.z, sum);
    sum = FMA((scalar)c[1], n.x, sum);
    sum = FMA((scalar)c[2], n.y, sum);
    sum = FMA((scalar)c[3], n.z, sum);
    return pick(sum > R(0.0), sum, R(0.0));
}

/* How rough, 0 at the least roughness to 1. */
TL_INLINE real sky_roughness(real alpha2)
{
    return (SQRT(SQRT(alpha2)) - TL_SKY_LEAST_ROUGHNESS) *
           (R(1.0) / (R(1.0) - TL_SKY_LEAST_ROUGHNESS));
}

/* Where e, -1 to 1, stands on an axis of a level, border included. */
TL_INLINE texel_pair pair_on_level(real e, real size)
{
    const real at = FMA(e, R(0.5) * size, FMA(size, R(0.5), R(0.5)));
    const real above = pick(at > R(0.5), at, R(0.5)); /* what is no number, too */
    const real inside = pick(above < size + R(0.5), above, size + R(0.5));
    texel_pair pair;
    pair.first = TO_REAL(TO_INTEGER(inside));
    pair.share = inside - pair.first;
    pair.second = pair.first + R(1.0);
    return pair;
}

/* e: of octahedron_of. level: whole. */
TL_INLINE vec3 level_mix(tl_numbers numbers, tl_sky_light_at sky, integer level, vec2 e)
{
    const tl_numbers levels = numbers + (size_t)sky->levels_at * 4;
    const tl_numbers texels = numbers + (size_t)sky->texels_at * 4;
    const real size = GATHER(levels, level * 2 + 1);
    const texel_pair x = pair_on_level(e.x, size), y = pair_on_level(e.y, size);
    const integer below = TO_INTEGER(size + R(2.0)) * 4;
    const integer corner = TO_INTEGER(GATHER(levels, level * 2)) * 4 +
                           TO_INTEGER(y.first) * below + TO_INTEGER(x.first) * 4;
    real of[3];
    for (int c = 0; c < 3; c++) {
        const integer at = corner + c;
        of[c] =
            mixed(mixed(GATHER(texels, at), GATHER(texels, at + 4), x.share),
                  mixed(GATHER(texels, at + below), GATHER(texels, at + below + 4), x.share),
                  y.share);
    }
    const vec3 color = {of[0], of[1], of[2]};
    return color;
}

TL_INLINE vec3 sky_axis(TL_GLOBAL const float *axis)
{
    const vec3 lanes = {(real)(scalar)axis[0], (real)(scalar)axis[1], (real)(scalar)axis[2]};
    return lanes;
}

/* What comes from direction d in view space, of any length, over a lobe of this roughness (sky_roughness). */
TL_INLINE vec3 sky_mirrored(tl_numbers numbers, tl_sky_light_at sky, vec3 d, real roughness)
{
    const vec3 turned = {dot3(d, sky_axis(sky->right)), dot3(d, sky_axis(sky->ahead)),
                         dot3(d, sky_axis(sky->up))};
    const vec2 e = octahedron_of(turned);
    const texel_pair level =
        pair_clamped(roughness * TL_SKY_LAST_LEVEL, TL_SKY_LAST_LEVEL + R(1.0));
    const vec3 sharp = level_mix(numbers, sky, TO_INTEGER(level.first), e);
    const vec3 soft = level_mix(numbers, sky, TO_INTEGER(level.second), e);
    const vec3 color = {mixed(sharp.x, soft.x, level.share),
                        mixed(sharp.y, soft.y, level.share),
                        mixed(sharp.z, soft.z, level.share)};
    return color;
}

/* What a surface does with light that comes from everywhere alike: host/sky/split_sum.h. */
typedef struct sky_shares {
    real base, grazing, lost;
} sky_shares;

/* eye: |n.v|. */
TL_INLINE sky_shares sky_shares_of(tl_numbers numbers,
                                   tl_sky_light_at sky,
                                   real eye,
                                   real roughness)
{
    const tl_numbers table = numbers + (size_t)sky->table_at * 4;
    const texel_pair x = pair_clamped(SQRT(eye) * TL_SKY_LAST_ENTRY, R(32.0));
    const texel_pair y = pair_clamped(roughness * TL_SKY_LAST_ENTRY, R(32.0));
    const integer near = TO_INTEGER(x.first) * 4, far = TO_INTEGER(x.second) * 4;
    const integer above = TO_INTEGER(y.first) * (4 * TL_SKY_TABLE),
                  below = TO_INTEGER(y.second) * (4 * TL_SKY_TABLE);
    real of[3];
    for (int i = 0; i < 3; i++)
        of[i] = mixed(
            mixed(GATHER(table, above + near + i), GATHER(table, above + far + i), x.share),
            mixed(GATHER(table, below + near + i), GATHER(table, below + far + i), x.share),
            y.share);
    const sky_shares shares = {of[0], of[1], of[2]};
    return shares;
}

/* The square of the lobe's width; of one that is wide one way and narrow the other, that of a round one as
 * large. */
TL_INLINE real sky_alpha2(tl_needs needs, substance m)
{
    return some_lobe_has(needs, TL_LOBE_TANGENT) ? SQRT(m.alpha2 * m.across2) : m.alpha2;
}

/* The share of mirrored light that arrives where `arrives` of light from everywhere does: all of it or
 * nothing where that is so too, the same where the lobe is wide, and less of it at grazing angles, for what
 * stands around stands at the horizon. After Lagarde and de Rousiers, "Moving Frostbite to PBR", SIGGRAPH
 * 2014, listing 26, in whose place of a power stands a root times how narrow the lobe is. */
TL_INLINE real mirrored_share(real arrives, real eye, real alpha2)
{
    const real narrow = R(1.0) - SQRT(alpha2);
    const real share = FMA(narrow, SQRT(eye + arrives) - R(1.0), arrives);
    return at_most_one(pick(share > R(0.0), share, R(0.0)));
}

/* To what the surface received, what comes from the sky, `arrives` of it past what stands around. */
TL_INLINE received add_sky(received sum,
                           const tl_frame *frame,
                           tl_needs needs,
                           TL_GLOBAL const tl_view_light *lights,
                           surface s,
                           substance m,
                           real arrives)
{
    if (!lit_by_sky(needs))
        return sum;
    const tl_numbers numbers = (tl_numbers)lights;
    const tl_sky_light_at sky = sky_light_behind(frame, numbers);
    const mask has_normal = dot3(s.normal, s.normal) > R(0.0);
    const real share = pick(has_normal, arrives, R(0.0));
    sum.sky.x = irradiance_of(sky->irradiance[0], s.normal) * share;
    sum.sky.y = irradiance_of(sky->irradiance[1], s.normal) * share;
    sum.sky.z = irradiance_of(sky->irradiance[2], s.normal) * share;
    if (!mirrors_sky(needs))
        return sum;
    const real n_dot_v = dot3(s.normal, s.to_eye), eye = at_most_one(ABSOLUTE(n_dot_v));
    const real alpha2 = sky_alpha2(needs, m), roughness = sky_roughness(alpha2);
    const sky_shares shares = sky_shares_of(numbers, sky, eye, roughness);
    const vec3 against = {-s.to_eye.x, -s.to_eye.y, -s.to_eye.z};
    const vec3 seen =
        sky_mirrored(numbers, sky, fma3(s.normal, R(2.0) * n_dot_v, against), roughness);
    const real mirrored = pick(has_normal, mirrored_share(arrives, eye, alpha2), R(0.0));
    sum.mirrored.x = seen.x * mirrored;
    sum.mirrored.y = seen.y * mirrored;
    sum.mirrored.z = seen.z * mirrored;
    sum.mirrored_base = shares.base;
    sum.mirrored_grazing = shares.grazing;
    if (some_lobe_has(needs, TL_LOBE_BELOW)) {
        const mask is = lane_has(needs, m.model, TL_LOBE_BELOW);
        const real below = R(1.0) - grazing_reflectance(m.specular) * shares.lost;
        const real kept = pick(is, below, R(1.0));
        sum.sky.x = sum.sky.x * kept;
        sum.sky.y = sum.sky.y * kept;
        sum.sky.z = sum.sky.z * kept;
    }
    return sum;
}

#endif
