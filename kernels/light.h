/* A surface, lit by one light after another: what each lobe of a model (models.h) receives,
 *
 *     diffuse   weight(d) color max(0, n.l)
 *     specular  weight(d) color max(0, n.h)^shininess, times n.l where the model says so,
 *
 * with l from the point to the light and v from the point to the eye (the listing of Policarpo and
 * Fonseca has v the other way round), and no specular where n.l <= 0. What does not change from light
 * to light multiplies after the last one (pixel.h).
 *
 * What vectors and cosines are off by, u = 2^-24, where the surface point is exact:
 *
 *   n, v        turned by u, of length 1 to within 4.5u (vec3.h)
 *   l           turned by u, as its parts round; |l| off by 2.5u, and 1/|l| by 3.5u of themselves: 3u of
 *               squares and sums, which the root halves, root, quotient
 *   n.l, off l  3u sum |n_i l_i| + 9u n.l + 2u: its sum; lengths of n and l, and their product; both turns
 *   n.v, off v  3u sum |n_i v_i| + 9u n.v + 2u
 *
 * Where they leave open whether a cosine is above 0, either may be. Each lobe's header carries them on, and
 * tests/test_model_accuracy.c holds every model against 128-bit floats, from a light of 1e-11 m to one of
 * 1e18 m, at grazing angles and with light and eye opposite. */
#ifndef TL_LIGHT_H
#define TL_LIGHT_H

#include "falloff.h"
#include "lobes.h"
#include "reach.h"
#include "spot.h"

/* Nearer than 1e-12 m a light is in the surface point: float positions in metres tell no direction
 * there, and squares of what they differ by vanish. */
#define TL_LEAST_DISTANCE2 R(1e-24)

/* How a surface sees a light in direction l, which is as long as the light is far. */
typedef struct approach {
    real distance2; /* m^2 */
    real facing;    /* n.l: the cosine times the distance, above 0 where the light is above */
} approach;

TL_INLINE approach approach_of(surface s, vec3 l)
{
    const approach a = {dot3(l, l), dot3(s.normal, l)};
    return a;
}

/* What the colours of a light say, cd or lx: the same in every lane, unless it shines through a picture. */
typedef struct light_colors {
    vec3 diffuse, specular;
} light_colors;

TL_INLINE light_colors colors_of(tl_view_light light)
{
    const light_colors colors = {
        {(real)light.diffuse[0], (real)light.diffuse[1], (real)light.diffuse[2]},
        {(real)light.specular[0], (real)light.specular[1], (real)light.specular[2]}};
    return colors;
}

TL_BEGIN_LOOSE

/* `diffuse` and what arrives with `weight` under this cosine, in lanes of `lit`. *seen becomes what the
 * specular lobe is multiplied by: the weight where the light is above the surface, or what arrives.
 * A lane outside `lit` adds exactly 0. */
TL_INLINE vec3 add_diffuse(vec3 diffuse,
                           tl_needs needs,
                           light_colors colors,
                           real cosine,
                           real weight,
                           mask lit,
                           real *seen)
{
    const mask above = lit & (cosine > R(0.0));
    const real arriving = pick(above, weight * cosine, R(0.0));
    *seen = lobe_has(needs, TL_LOBE_COSINE) ? arriving : pick(above, weight, R(0.0));
    return needs.one_color ? diffuse : fma3(colors.diffuse, arriving, diffuse);
}

/* What the lobe's power is multiplied by, 0 where the half vector is not above the surface. */
TL_INLINE real shine_of(tl_needs needs, surface s, half_angle a, real seen)
{
    return pick(a.above, needs.one_color ? seen * s.lobe_scale : seen, R(0.0));
}

/* The specular lobe; with one colour diffuse light too, for add_diffuse has left it out. Where terms are
 * split, each by itself as well. */
TL_INLINE received
add_lobe(received sum, tl_needs needs, light_colors colors, real seen, real shine, real power)
{
    if (needs.one_color)
        sum.diffuse = fma3(colors.diffuse, FMA(power, shine, seen), sum.diffuse);
    if (needs.one_color && needs.split)
        sum.apart = fma3(colors.diffuse, seen, sum.apart);
    if (!needs.one_color || needs.split)
        sum.specular = fma3(colors.specular, shine * power, sum.specular);
    return sum;
}

/* The same of a light in direction l, of this length. */
TL_INLINE received add_highlight(received sum,
                                 tl_needs needs,
                                 surface s,
                                 light_colors colors,
                                 vec3 l,
                                 real length,
                                 real seen)
{
    const half_angle a = highlight_angle(s, l, length);
    return add_lobe(sum, needs, colors, seen, shine_of(needs, s, a, seen),
                    power_of_log2(log2_of_power(a.cos2, a.sin2, s.shininess)));
}

/* Whether a light with a range fades by this row, which `it_does` says where lights of the scene fade by
 * this and by others. */
TL_INLINE int fades_by(tl_needs needs, tl_u32 row, int it_does)
{
    const tl_u32 others = 1u << TL_FADE_NONE | 1u << TL_FADE_TABLE;
    const tl_u32 ranged = needs.falloffs & ~others, wanted = 1u << row;
    return ranged == wanted || ((ranged & wanted) && it_does);
}

/* The weight of a light at a distance. Uniform branches: every lane has the same light. */
TL_INLINE real
fade_of(tl_needs needs, tl_view_light light, real distance2, real distance, real per_distance)
{
    if (fades_by(needs, TL_FADE_LINEAR, light.falloff == TL_FADE_LINEAR))
        return fade_linear(distance, light.fade);
    if (fades_by(needs, TL_FADE_LINEAR_FROM, light.falloff >= TL_FADE_COUNT))
        return fade_linear_from(distance, light.fade, light.falloff);
    return fade_inverse_square(distance2, per_distance, light.fade);
}

TL_END_LOOSE

/* Whether a light with a range may add to a lane; it adds exactly 0 to all others. For short cuts. */
TL_INLINE mask
may_be_lit(tl_needs needs, tl_view_light light, tl_view_spot spot, vec3 l, approach a)
{
    const mask near = reaches(light, a.distance2) & (a.facing > R(0.0));
    return needs.spots ? near & in_cone(spot, l, a.distance2) : near;
}

TL_BEGIN_LOOSE

/* What comes from a light, of what its colours say, in lanes of `lit`. */
typedef struct arrival {
    real distance, per_distance; /* m; 1 of a directional light */
    real weight;
    mask lit;
} arrival;

/* The same, as the cone of a spot leaves it. */
TL_INLINE arrival
through_cone(arrival from, tl_needs needs, tl_view_spot spot, vec3 l, real distance2)
{
    if (needs.spots) {
        from.lit = from.lit & in_cone(spot, l, distance2);
        from.weight = from.weight * cone_share(spot, l, from.per_distance);
    }
    return from;
}

/* Of a point or spot light with a range. A lane adds exactly 0 unless it is within reach and cone itself
 * and the light is above its surface: which other pixels share the vector must not show in the image. A
 * light in the surface point itself, where no direction exists, adds 0. */
TL_INLINE arrival
ranged_arrival(tl_needs needs, surface s, tl_view_light light, tl_view_spot spot, approach a)
{
    const length_pair d = lengths_of(a.distance2);
    arrival from;
    from.distance = d.length;
    from.per_distance = d.per_length;
    from.lit = reaches(light, a.distance2) & (a.distance2 > TL_LEAST_DISTANCE2);
    from.weight = fade_of(needs, light, a.distance2, from.distance, from.per_distance);
    return through_cone(from, needs, spot, vector_to_light(s.position, light), a.distance2);
}

/* The diffuse lobe of such a light, where lobes are plain. */
TL_INLINE vec3 add_ranged_diffuse(vec3 diffuse,
                                  tl_needs needs,
                                  surface s,
                                  tl_view_light light,
                                  tl_view_spot spot,
                                  approach a,
                                  real *distance,
                                  real *seen)
{
    const arrival from = ranged_arrival(needs, s, light, spot, a);
    *distance = from.distance;
    return add_diffuse(diffuse, needs, colors_of(light), a.facing * from.per_distance,
                       from.weight, from.lit, seen);
}

/* A light in direction l that is reflected by whatever model a lane has. */
TL_INLINE received add_reflection(received sum,
                                  tl_needs needs,
                                  surface s,
                                  finish f,
                                  light_colors colors,
                                  vec3 l,
                                  approach a,
                                  arrival from)
{
    const real cosine = a.facing * from.per_distance;
    const mask above = from.lit & (cosine > R(0.0));
    const meeting m = {l,
                       from.distance,
                       from.per_distance,
                       pick(above, at_most_one(cosine), R(0.0)),
                       pick(above, from.weight, R(0.0)),
                       pick(above, from.weight * cosine, R(0.0))};
    const reflection r = reflection_of(needs, s, f, m);
    sum.diffuse = fma3(colors.diffuse, r.diffuse, sum.diffuse);
    if (needs.specular)
        sum.specular = fma3(colors.specular, r.specular, sum.specular);
    if (needs.specular && some_lobe_has(needs, TL_LOBE_GRAZING))
        sum.grazing = fma3(colors.specular, r.grazing, sum.grazing);
    return sum;
}

/* The same, by the short code where it does. */
TL_INLINE received add_light(received sum,
                             tl_needs needs,
                             surface s,
                             finish f,
                             light_colors colors,
                             vec3 l,
                             approach a,
                             arrival from)
{
    real seen;
    if (!is_plain(needs))
        return add_reflection(sum, needs, s, f, colors, l, a, from);
    sum.diffuse = add_diffuse(sum.diffuse, needs, colors, a.facing * from.per_distance,
                              from.weight, from.lit, &seen);
    return needs.specular ? add_highlight(sum, needs, s, colors, l, from.distance, seen) : sum;
}

/* spot: its cone, whole_space() of a light that has none. f: finish_of the surface, of no matter where
 * is_plain(needs). */
TL_INLINE received add_ranged_light(
    received sum, tl_needs needs, surface s, finish f, tl_view_light light, tl_view_spot spot)
{
    const vec3 l = vector_to_light(s.position, light);
    const approach a = approach_of(s, l);
    if (!any_lane(may_be_lit(needs, light, spot, l, a)))
        return sum;
    return add_light(sum, needs, s, f, colors_of(light), l, a,
                     ranged_arrival(needs, s, light, spot, a));
}

/* A light that reaches everything: directional, or a point or spot light without a range. */
TL_INLINE received add_global_light(
    received sum, tl_needs needs, surface s, finish f, tl_view_light light, tl_view_spot spot)
{
    const int is_directional = light.falloff == TL_FADE_NONE;
    const vec3 direction = {(real)light.position[0], (real)light.position[1],
                            (real)light.position[2]};
    const vec3 l = is_directional ? direction : vector_to_light(s.position, light);
    const approach a = approach_of(s, l);
    arrival from;
    from.distance = is_directional ? (real)R(1.0) : SQRT(a.distance2);
    from.per_distance = R(1.0) / from.distance;
    from.weight = is_directional ? (real)R(1.0)
                                 : fade_inverse_square(a.distance2, from.per_distance, R(0.0));
    from.lit = a.distance2 > R(0.0);
    from = through_cone(from, needs, spot, l, a.distance2);
    return add_light(sum, needs, s, f, colors_of(light), l, a, from);
}

TL_END_LOOSE

#endif
