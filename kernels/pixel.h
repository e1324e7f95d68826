/* From the planes of a pixel to its surface, and from the light it receives to its radiance. */
#ifndef TL_PIXEL_H
#define TL_PIXEL_H

#include "brdf_row.h"
#include "finish.h"
#include "light.h"
#include "position.h"
#include "ranges.h"
#include "substance.h"

/* (e + 2)/8, rounded once. */
TL_INLINE real lobe_energy(real shininess)
{
    return FMA(shininess, R(0.125), R(0.25));
}

/* position, normal: in view space, the normal unit or 0. specular: the material's grey, of no matter
 * unless there is one colour. */
TL_INLINE surface
surface_at(tl_needs needs, vec3 position, vec3 normal, real shininess, real specular)
{
    surface s;
    s.position = position;
    s.normal = normal;
    s.to_eye = normal;
    if (needs.specular || some_lobe_has(needs, TL_LOBE_EYE))
        s.to_eye = direction_to_eye(needs, position);
    s.shininess = shininess;
    s.lobe_scale = shininess; /* a number at hand, so that none is read for it */
    if (needs.one_color)
        s.lobe_scale =
            lobe_has(needs, TL_LOBE_ENERGY) ? specular * lobe_energy(shininess) : specular;
    return s;
}

/* Of a pixel that is not packed: its position is on its ray, its normal in world space. */
TL_INLINE surface surface_of(
    const tl_frame *frame, tl_needs needs, pixel of, real shininess, real column, real row)
{
    return surface_at(needs, view_position(frame->rays, needs, column, row, of.depth),
                      view_normal(frame, of.normal), shininess, of.specular.x);
}

/* Light received, of which this share is reflected: where none is, it is of no matter, though there be more
 * than floats hold. That is infinite in every precision. */
TL_INLINE real received_by(real share, real light)
{
#if TL_REAL_DOUBLE
    light = pick(light <= TL_MOST_FLOAT, light, (real)INFINITY);
#endif
    return pick(share > R(0.0), light, R(0.0));
}

/* Of numbers that are not negative. */
TL_INLINE real at_most_largest(real radiance)
{
    return pick(radiance < TL_MOST_FLOAT, radiance, TL_MOST_FLOAT);
}

/* Radiance of one channel. Ambient light multiplies the albedo plane, not the diffuse colour, so
 * that metals answer to it too. */
TL_INLINE real channel_of(tl_needs needs,
                          real diffuse,
                          real diffuse_light,
                          real specular,
                          real specular_light,
                          real f90,
                          real grazing_light,
                          real ambient_light,
                          real emissive)
{
    real radiance = diffuse * received_by(diffuse, diffuse_light);
    if (needs.specular && !needs.one_color)
        radiance = FMA(specular, received_by(specular, specular_light), radiance);
    if (needs.specular && some_lobe_has(needs, TL_LOBE_GRAZING))
        radiance = FMA(f90 - specular, received_by(f90 - specular, grazing_light), radiance);
    if (needs.ambient)
        radiance = radiance + ambient_light;
    if (reads_planes(needs, TL_GROUP_EMISSIVE))
        radiance = radiance + emissive;
    return at_most_largest(radiance);
}

/* lamps: of lights with ambient lobes. */
TL_INLINE real
ambient_of(tl_needs needs, real albedo, scalar ambient, real lamps, real occlusion)
{
    const real light = needs.shapes & TL_SHAPE_AMBIENT
                           ? albedo * received_by(albedo, lamps + (real)ambient)
                           : albedo * ambient;
    if (reads_planes(needs, TL_GROUP_OCCLUSION) || needs.surroundings)
        return occlusion * received_by(occlusion, light);
    return light;
}

/* What multiplies the light that the specular lobe received. */
TL_INLINE vec3 lobe_color(tl_needs needs, substance m)
{
    vec3 c = m.specular;
    if (some_lobe_has(needs, TL_LOBE_ENERGY)) {
        const real energy = lobe_energy(m.shininess);
        const vec3 scaled = {c.x * energy, c.y * energy, c.z * energy};
        c = pick3(lane_has(needs, m.model, TL_LOBE_ENERGY), scaled, c);
    }
    if (some_lobe_has(needs, TL_LOBE_DIFFUSE)) {
        const vec3 tinted = {c.x * m.diffuse.x, c.y * m.diffuse.y, c.z * m.diffuse.z};
        c = pick3(lane_has(needs, m.model, TL_LOBE_DIFFUSE), tinted, c);
    }
    return c;
}

/* What multiplies the diffuse light that it received. */
TL_INLINE vec3 diffuse_color(tl_needs needs, substance m)
{
    if (!some_lobe_has(needs, TL_LOBE_BELOW))
        return m.diffuse;
    const vec3 below = {m.diffuse.x * m.below, m.diffuse.y * m.below, m.diffuse.z * m.below};
    return pick3(lane_has(needs, m.model, TL_LOBE_BELOW), below, m.diffuse);
}

/* What leaves a pixel towards the eye; the sky's radiance where nothing was hit. */
TL_INLINE vec3
radiance_of(const tl_frame *frame, tl_needs needs, pixel of, substance m, received sum)
{
    const vec3 lobe = lobe_color(needs, m), diffuse = diffuse_color(needs, m);
    const real f90 = grazing_reflectance(m.specular);
    const vec3 lit = {
        channel_of(
            needs, diffuse.x, sum.diffuse.x, lobe.x, sum.specular.x, f90, sum.grazing.x,
            ambient_of(needs, of.albedo.x, frame->ambient[0], sum.ambient.x, of.occlusion),
            of.emissive.x),
        channel_of(
            needs, diffuse.y, sum.diffuse.y, lobe.y, sum.specular.y, f90, sum.grazing.y,
            ambient_of(needs, of.albedo.y, frame->ambient[1], sum.ambient.y, of.occlusion),
            of.emissive.y),
        channel_of(
            needs, diffuse.z, sum.diffuse.z, lobe.z, sum.specular.z, f90, sum.grazing.z,
            ambient_of(needs, of.albedo.z, frame->ambient[2], sum.ambient.z, of.occlusion),
            of.emissive.z)};
    const mask hit = of.depth < (real)INFINITY;
    const vec3 radiance = {pick(hit, lit.x, (scalar)frame->sky[0]),
                           pick(hit, lit.y, (scalar)frame->sky[1]),
                           pick(hit, lit.z, (scalar)frame->sky[2])};
    return radiance;
}

#endif
