/* A surface, lit by one light after another: equations 1 to 4 of Policarpo and Fonseca, "Deferred
 * Shading Tutorial" (2005),
 *
 *     weight(d) color (diffuse max(0, n.l) + specular max(0, n.h)^shininess),
 *
 * with l from the point to the light and v from the point to the eye (their listing has v the
 * other way round), and no specular where n.l <= 0. */
#ifndef TL_LIGHT_H
#define TL_LIGHT_H

#include "falloff.h"
#include "needs.h"
#include "reach.h"
#include "specular.h"

/* Nearer than 1e-12 m a light is in the surface point: float positions in metres tell no direction
 * there, and squares of what they differ by vanish. */
#define TL_LEAST_DISTANCE2 R(1e-24)

typedef struct surface {
    vec3 position, normal, to_eye; /* view space, m; the last two unit, or normal 0 */
    real shininess;
} surface;

/* Light received, per lobe: the surface's colours multiply after the last light. */
typedef struct received {
    vec3 diffuse, specular;
} received;

/* `sum` and what arrives from direction l with `weight`, in lanes of `lit`; length is |l| and
 * per_length 1/|l|. A lane outside `lit` adds exactly 0. The half vector is taken |l| times as long
 * as usual, l + |l| v, so that it does not wait for the division. */
TL_INLINE received add_lobes(received sum,
                             tl_needs needs,
                             surface s,
                             tl_view_light light,
                             vec3 l,
                             real length,
                             real per_length,
                             real weight,
                             mask lit)
{
    const real n_dot_l = dot3(s.normal, l) * per_length;
    const mask above = lit & (n_dot_l > R(0.0));
    const real seen = pick(above, weight, R(0.0));
    const vec3 diffuse = {(real)light.diffuse[0], (real)light.diffuse[1],
                          (real)light.diffuse[2]};
    received now = sum;
    now.diffuse = fma3(diffuse, pick(above, seen * n_dot_l, R(0.0)), sum.diffuse);
    if (needs.specular) {
        const vec3 specular = {(real)light.specular[0], (real)light.specular[1],
                               (real)light.specular[2]};
        const real lobe =
            blinn_phong_specular(s.normal, fma3(s.to_eye, length, l), s.shininess);
        now.specular = fma3(specular, seen * lobe, sum.specular);
    }
    return now;
}

/* The weight of a light at a distance. Uniform branches: every lane has the same light. */
TL_INLINE real
fade_of(tl_needs needs, tl_view_light light, real distance2, real distance, real per_distance)
{
    const tl_u32 linear = needs.falloffs & (1u << TL_FADE_LINEAR);
    const tl_u32 inverse = needs.falloffs & (1u << TL_FADE_INVERSE_SQUARE);
    if (linear && (!inverse || light.falloff == TL_FADE_LINEAR))
        return fade_linear(distance, light.fade);
    return fade_inverse_square(distance2, per_distance, light.fade);
}

/* A point light with a range. A lane adds exactly 0 unless it is within reach itself and the light
 * is above its surface: which other pixels share the vector must not show in the image. So the
 * early return is a shortcut and nothing else. A light in the surface point itself, where no
 * direction exists, adds 0. */
TL_INLINE received add_ranged_light(received sum,
                                    tl_needs needs,
                                    surface s,
                                    tl_view_light light)
{
    const vec3 l = vector_to_light(s.position, light);
    const real distance2 = dot3(l, l);
    const mask within = reaches(light, distance2);
    if (!any_lane(within))
        return sum;
    const real distance = SQRT(distance2);
    const real per_distance = R(1.0) / distance;
    const real weight = fade_of(needs, light, distance2, distance, per_distance);
    return add_lobes(sum, needs, s, light, l, distance, per_distance, weight,
                     within & (distance2 > TL_LEAST_DISTANCE2));
}

/* A light that reaches everything: directional, or a point light without a range. */
TL_INLINE received add_global_light(received sum,
                                    tl_needs needs,
                                    surface s,
                                    tl_view_light light)
{
    if (light.falloff == TL_FADE_NONE) {
        const vec3 l = {(real)light.position[0], (real)light.position[1],
                        (real)light.position[2]};
        return add_lobes(sum, needs, s, light, l, (real)R(1.0), (real)R(1.0), (real)R(1.0),
                         s.position.z == s.position.z);
    }
    const vec3 l = vector_to_light(s.position, light);
    const real distance2 = dot3(l, l);
    const real distance = SQRT(distance2);
    const real per_distance = R(1.0) / distance;
    return add_lobes(sum, needs, s, light, l, distance, per_distance,
                     fade_inverse_square(distance2, per_distance, R(0.0)), distance2 > R(0.0));
}

#endif
