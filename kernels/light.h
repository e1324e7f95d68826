/* A surface, lit by one light after another: what each lobe of a model (models.h) receives,
 *
 *     diffuse   weight(d) color max(0, n.l)
 *     specular  weight(d) color max(0, n.h)^shininess, times n.l where the model says so,
 *
 * with l from the point to the light and v from the point to the eye (the listing of Policarpo and
 * Fonseca has v the other way round), and no specular where n.l <= 0. What does not change from light
 * to light multiplies after the last one (pixel.h). */
#ifndef TL_LIGHT_H
#define TL_LIGHT_H

#include "falloff.h"
#include "needs.h"
#include "reach.h"
#include "specular.h"
#include "spot.h"

/* Nearer than 1e-12 m a light is in the surface point: float positions in metres tell no direction
 * there, and squares of what they differ by vanish. */
#define TL_LEAST_DISTANCE2 R(1e-24)

typedef struct surface {
    vec3 position, normal, to_eye; /* view space, m; the last two unit, or normal 0 */
    real shininess;
    real lobe_scale; /* with one colour: what the lobe adds, as a share of diffuse light */
} surface;

/* Light received, per lobe: the surface's colours multiply after the last light. */
typedef struct received {
    vec3 diffuse, specular;
} received;

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

/* `diffuse` and what arrives with `weight` under this cosine, in lanes of `lit`. *seen becomes what the
 * specular lobe is multiplied by: the weight where the light is above the surface, or what arrives.
 * A lane outside `lit` adds exactly 0. */
TL_INLINE vec3 add_diffuse(vec3 diffuse,
                           tl_needs needs,
                           tl_view_light light,
                           real cosine,
                           real weight,
                           mask lit,
                           real *seen)
{
    const vec3 color = {(real)light.diffuse[0], (real)light.diffuse[1], (real)light.diffuse[2]};
    const mask above = lit & (cosine > R(0.0));
    const real arriving = pick(above, weight * cosine, R(0.0));
    *seen = lobe_has(needs, TL_LOBE_COSINE) ? arriving : pick(above, weight, R(0.0));
    return needs.one_color ? diffuse : fma3(color, arriving, diffuse);
}

/* The half vector is taken |l| times as long as usual, l + |l| v, so that it does not wait for the
 * division. */
TL_INLINE half_angle highlight_angle(surface s, vec3 l, real length)
{
    return angle_of(s.normal, fma3(s.to_eye, length, l));
}

/* What the lobe's power is multiplied by, 0 where the half vector is not above the surface. */
TL_INLINE real shine_of(tl_needs needs, surface s, half_angle a, real seen)
{
    return pick(a.above, needs.one_color ? seen * s.lobe_scale : seen, R(0.0));
}

/* The specular lobe; with one colour diffuse light too, for add_diffuse has left it out. */
TL_INLINE received
add_lobe(received sum, tl_needs needs, tl_view_light light, real seen, real shine, real power)
{
    if (needs.one_color) {
        const vec3 color = {(real)light.diffuse[0], (real)light.diffuse[1],
                            (real)light.diffuse[2]};
        sum.diffuse = fma3(color, FMA(power, shine, seen), sum.diffuse);
        return sum;
    }
    const vec3 color = {(real)light.specular[0], (real)light.specular[1],
                        (real)light.specular[2]};
    sum.specular = fma3(color, shine * power, sum.specular);
    return sum;
}

/* The same of a light in direction l, of this length. */
TL_INLINE received add_highlight(received sum,
                                 tl_needs needs,
                                 surface s,
                                 tl_view_light light,
                                 vec3 l,
                                 real length,
                                 real seen)
{
    const half_angle a = highlight_angle(s, l, length);
    return add_lobe(sum, needs, light, seen, shine_of(needs, s, a, seen),
                    exp2_of_negative(log2_of_power(a.cos2, a.sin2, s.shininess)));
}

/* Whether a light with a range fades by this row, which `it_does` says where lights of the scene fade by
 * this and by others. */
TL_INLINE int fades_by(tl_needs needs, tl_u32 row, int it_does)
{
    const tl_u32 ranged = needs.falloffs & ~(1u << TL_FADE_NONE), wanted = 1u << row;
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

/* Whether a light with a range may add to a lane; it adds exactly 0 to all others. For short cuts. */
TL_INLINE mask
may_be_lit(tl_needs needs, tl_view_light light, tl_view_spot spot, vec3 l, approach a)
{
    const mask near = reaches(light, a.distance2) & (a.facing > R(0.0));
    return needs.spots ? near & in_cone(spot, l, a.distance2) : near;
}

/* A point or spot light with a range: its diffuse lobe. A lane adds exactly 0 unless it is within reach
 * and cone itself and the light is above its surface: which other pixels share the vector must not show
 * in the image. A light in the surface point itself, where no direction exists, adds 0. */
TL_INLINE vec3 add_ranged_diffuse(vec3 diffuse,
                                  tl_needs needs,
                                  surface s,
                                  tl_view_light light,
                                  tl_view_spot spot,
                                  approach a,
                                  real *distance,
                                  real *seen)
{
    *distance = SQRT(a.distance2);
    const real per_distance = R(1.0) / *distance;
    mask lit = reaches(light, a.distance2) & (a.distance2 > TL_LEAST_DISTANCE2);
    real weight = fade_of(needs, light, a.distance2, *distance, per_distance);
    if (needs.spots) {
        const vec3 l = vector_to_light(s.position, light);
        lit = lit & in_cone(spot, l, a.distance2);
        weight = weight * cone_share(spot, l, per_distance);
    }
    return add_diffuse(diffuse, needs, light, a.facing * per_distance, weight, lit, seen);
}

/* spot: its cone, whole_space() of a light that has none. */
TL_INLINE received add_ranged_light(
    received sum, tl_needs needs, surface s, tl_view_light light, tl_view_spot spot)
{
    const vec3 l = vector_to_light(s.position, light);
    const approach a = approach_of(s, l);
    real distance, seen;
    if (!any_lane(may_be_lit(needs, light, spot, l, a)))
        return sum;
    sum.diffuse = add_ranged_diffuse(sum.diffuse, needs, s, light, spot, a, &distance, &seen);
    return needs.specular ? add_highlight(sum, needs, s, light, l, distance, seen) : sum;
}

/* A light that reaches everything: directional, or a point or spot light without a range. */
TL_INLINE received add_global_light(
    received sum, tl_needs needs, surface s, tl_view_light light, tl_view_spot spot)
{
    const int is_directional = light.falloff == TL_FADE_NONE;
    const vec3 direction = {(real)light.position[0], (real)light.position[1],
                            (real)light.position[2]};
    const vec3 l = is_directional ? direction : vector_to_light(s.position, light);
    const approach a = approach_of(s, l);
    const real distance = is_directional ? (real)R(1.0) : SQRT(a.distance2);
    const real per_distance = R(1.0) / distance;
    real weight =
        is_directional ? (real)R(1.0) : fade_inverse_square(a.distance2, per_distance, R(0.0));
    mask lit = a.distance2 > R(0.0);
    if (needs.spots) {
        lit = lit & in_cone(spot, l, a.distance2);
        weight = weight * cone_share(spot, l, per_distance);
    }
    real seen;
    sum.diffuse =
        add_diffuse(sum.diffuse, needs, light, a.facing * per_distance, weight, lit, &seen);
    return needs.specular ? add_highlight(sum, needs, s, light, l, distance, seen) : sum;
}

#endif
