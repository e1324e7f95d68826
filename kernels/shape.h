/* Lights with more to them: falloff by a table, a picture that they shine through, an ambient lobe, a
 * profile, a shadow map.
 *
 * What few lights have stands apart from the rest, in a tl_view_shape behind the lights, and the light says
 * where by its `falloff`. Such a light is lit by the code here, one after another, and adds up in index order
 * with the others.
 *
 *   texture  both lobes' colours are multiplied with what the picture shows in the direction from the light
 *            (texture.h), per channel.
 *   ambient  weight color albedo occlusion, without n.l: Policarpo and Fonseca, "Deferred Shading
 *            Tutorial" (2005), table 1, give every light an ambient colour. It counts where the light
 *            reaches, in cone and range, whatever the normal.
 *   profile  what arrives, of every lobe, is the share of the largest intensity in the direction from the
 *            light (profile.h).
 *   shadow   what arrives, of every lobe, is the share that nothing stands before (shadow.h).
 *   link     it lights some objects alone (link.h). */
#ifndef TL_SHAPE_H
#define TL_SHAPE_H

#include "light.h"
#include "link.h"
#include "profile.h"
#include "shadow.h"
#include "texture.h"

/* The shape of a light that has one. lights: the buffer. */
TL_INLINE tl_view_shape shape_of(TL_GLOBAL const tl_view_light *lights,
                                 tl_u32 shapes_at,
                                 tl_view_light light)
{
    TL_GLOBAL const tl_view_shape *shapes =
        (TL_GLOBAL const tl_view_shape *)((tl_numbers)lights + (size_t)shapes_at * 4);
    return shapes[light.falloff - TL_FADE_COUNT];
}

/* As fade_of, and by table. light: with the shape's falloff. */
TL_INLINE real shaped_fade(tl_needs needs,
                           tl_numbers numbers,
                           tl_view_shape shape,
                           tl_view_light light,
                           int is_global,
                           real distance2,
                           real distance,
                           real per_distance)
{
    if ((needs.shapes & TL_SHAPE_TABLE) && light.falloff == TL_FADE_TABLE)
        return fade_by_table(distance, light.fade, numbers + (size_t)shape.table_at * 4,
                             shape.table_last);
    if (light.falloff == TL_FADE_NONE)
        return (real)R(1.0);
    if (is_global)
        return fade_inverse_square(distance2, per_distance, R(0.0));
    return fade_of(needs, light, distance2, distance, per_distance);
}

/* A light's colour as a texture leaves it, cut as that of a light is (largest.h). */
TL_INLINE vec3 tinted_by(vec3 color, vec3 tint)
{
    const vec3 most = {(real)TL_BRIGHTEST, (real)TL_BRIGHTEST, (real)TL_BRIGHTEST};
    const vec3 c = {color.x * tint.x, color.y * tint.y, color.z * tint.z};
    const vec3 cut = {pick(c.x < most.x, c.x, most.x), pick(c.y < most.y, c.y, most.y),
                      pick(c.z < most.z, c.z, most.z)};
    return cut;
}

/* What the light shines through in direction -l, by a texture that is there. */
TL_INLINE vec3 tint_of(tl_needs needs, tl_numbers numbers, tl_view_shape shape, vec3 l)
{
    const vec3 from = {-l.x, -l.y, -l.z};
    if (!(needs.shapes & TL_SHAPE_AROUND) ||
        ((needs.shapes & TL_SHAPE_PROJECTED) && (shape.spot_and_link & 1u)))
        return map_projected(numbers, shape.map, from);
    return map_around(numbers, shape.map, from);
}

/* The weight of a light by its profile. */
TL_INLINE real
profiled(tl_needs needs, tl_numbers numbers, tl_view_shape shape, vec3 l, real weight)
{
    const vec3 from = {-l.x, -l.y, -l.z};
    if (!(needs.shapes & TL_SHAPE_PROFILE) || shape.profile_at == 0)
        return weight;
    return weight * profile_share(numbers, profile_behind(numbers, shape.profile_at), from);
}

/* What arrives of a light that has this shape: its weight, or less. */
TL_INLINE real unshadowed(tl_needs needs,
                          tl_numbers numbers,
                          tl_view_shape shape,
                          surface s,
                          vec3 l,
                          approach a,
                          arrival from)
{
    const mask facing = a.facing > R(0.0);
    const mask counts = (needs.shapes & TL_SHAPE_AMBIENT) ? from.lit : from.lit & facing;
    if (!(needs.shapes & TL_SHAPE_SHADOW) || shape.shadow_at == 0 || !any_lane(counts))
        return from.weight;
    return from.weight * unshadowed_share(numbers, shadow_behind(numbers, shape.shadow_at), s,
                                          l, from.distance, a.facing);
}

/* As add_ranged_light and add_global_light, of a light that has this shape. */
TL_INLINE received add_shaped_light(received sum,
                                    const tl_frame *frame,
                                    tl_needs needs,
                                    TL_GLOBAL const tl_view_light *lights,
                                    tl_view_shape shape,
                                    surface s,
                                    finish f,
                                    tl_view_light light,
                                    tl_view_spot spot,
                                    int is_global)
{
    const tl_numbers numbers = (tl_numbers)lights;
    const int is_directional = shape.falloff == TL_FADE_NONE;
    const vec3 direction = {(real)light.position[0], (real)light.position[1],
                            (real)light.position[2]};
    const vec3 l = is_directional ? direction : vector_to_light(s.position, light);
    const approach a = approach_of(s, l);
    light_colors colors = colors_of(light);
    arrival from;
    light.falloff = shape.falloff;
    from.lit = is_global ? a.distance2 > R(0.0)
                         : reaches(light, a.distance2) & (a.distance2 > TL_LEAST_DISTANCE2);
    if (needs.shapes & TL_SHAPE_LINK)
        from.lit = from.lit & lanes_of_link(frame, needs, numbers, shape, f.at);
    if (!any_lane(from.lit))
        return sum;
    from.distance = is_directional ? (real)R(1.0) : SQRT(a.distance2);
    from.per_distance = R(1.0) / from.distance;
    from.weight = shaped_fade(needs, numbers, shape, light, is_global, a.distance2,
                              from.distance, from.per_distance);
    from = through_cone(from, needs, spot, l, a.distance2);
    from.weight = profiled(needs, numbers, shape, l, from.weight);
    from.weight = unshadowed(needs, numbers, shape, s, l, a, from);
    vec3 ambient = lanes_of(shape.ambient);
    if ((needs.shapes & (TL_SHAPE_PROJECTED | TL_SHAPE_AROUND)) && shape.map.pixels_at != 0) {
        const vec3 tint = tint_of(needs, numbers, shape, l);
        colors.diffuse = tinted_by(colors.diffuse, tint);
        colors.specular = tinted_by(colors.specular, tint);
        ambient = tinted_by(ambient, tint);
    }
    if (needs.shapes & TL_SHAPE_AMBIENT)
        sum.ambient = fma3(ambient, pick(from.lit, from.weight, R(0.0)), sum.ambient);
    return add_light(sum, needs, s, f, colors, l, a, from);
}

/* A light of any kind, as it stands in the buffer. spot, f: as of add_ranged_light. */
TL_INLINE received add_any_light(received sum,
                                 const tl_frame *frame,
                                 tl_needs needs,
                                 TL_GLOBAL const tl_view_light *lights,
                                 surface s,
                                 finish f,
                                 tl_view_light light,
                                 tl_view_spot spot,
                                 int is_global)
{
    if (has_shapes(needs) && has_shape(light.falloff))
        return add_shaped_light(sum, frame, needs, lights,
                                shape_of(lights, frame->shapes_at, light), s, f, light, spot,
                                is_global);
    if (is_global)
        return add_global_light(sum, needs, s, f, light, spot);
    return add_ranged_light(sum, needs, s, f, light, spot);
}

#endif
