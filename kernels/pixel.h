/* From the planes of a pixel to its surface, and from the light it receives to its radiance. */
#ifndef TL_PIXEL_H
#define TL_PIXEL_H

#include "brdf_row.h"
#include "finish.h"
#include "light.h"
#include "position.h"
#include "ranges.h"
#include "sky_light.h"
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
    if (needs.specular || mirrors_sky(needs) || some_lobe_has(needs, TL_LOBE_EYE))
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

/* What the specular lobe reflects, where diffuse light is not of both lobes. */
TL_INLINE real add_specular(tl_needs needs,
                            real radiance,
                            real specular,
                            real specular_light,
                            real f90,
                            real grazing_light)
{
    if (needs.specular && !needs.one_color)
        radiance = FMA(specular, received_by(specular, specular_light), radiance);
    if (needs.specular && some_lobe_has(needs, TL_LOBE_GRAZING))
        radiance = FMA(f90 - specular, received_by(f90 - specular, grazing_light), radiance);
    return radiance;
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
                          real sky_light,
                          real emissive)
{
    real radiance = diffuse * received_by(diffuse, diffuse_light);
    radiance = add_specular(needs, radiance, specular, specular_light, f90, grazing_light);
    if (needs.ambient)
        radiance = radiance + ambient_light;
    if (lit_by_sky(needs))
        radiance = radiance + sky_light;
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

/* What multiplies light of the sky that is mirrored, of one channel: the specular colour, as the model tints
 * it, without what keeps a lobe's energy, for the share of the whole sky has that. */
TL_INLINE real
mirror_color(tl_needs needs, substance m, real specular, real diffuse, real f90, received sum)
{
    real c = specular;
    if (some_lobe_has(needs, TL_LOBE_DIFFUSE))
        c = pick(lane_has(needs, m.model, TL_LOBE_DIFFUSE), c * diffuse, c);
    real reflected = c * sum.mirrored_base;
    if (some_lobe_has(needs, TL_LOBE_GRAZING)) {
        const real rest = pick(f90 > specular, f90 - specular, R(0.0));
        const real with_fresnel = FMA(rest, sum.mirrored_grazing, reflected);
        reflected = pick(lane_has(needs, m.model, TL_LOBE_GRAZING), with_fresnel, reflected);
    }
    return pick(lane_has(needs, m.model, TL_LOBE_SPECULAR), reflected, R(0.0));
}

/* Diffuse and mirrored light of the sky that leaves a surface towards the eye: two terms of its radiance. */
typedef struct sky_terms {
    vec3 diffuse, mirrored;
} sky_terms;

TL_INLINE sky_terms sky_terms_of(tl_needs needs, substance m, received sum)
{
    const vec3 diffuse = diffuse_color(needs, m);
    sky_terms terms = {{diffuse.x * sum.sky.x, diffuse.y * sum.sky.y, diffuse.z * sum.sky.z},
                       {R(0.0), R(0.0), R(0.0)}};
    if (mirrors_sky(needs)) {
        const real f90 = grazing_reflectance(m.specular);
        terms.mirrored.x =
            mirror_color(needs, m, m.specular.x, m.diffuse.x, f90, sum) * sum.mirrored.x;
        terms.mirrored.y =
            mirror_color(needs, m, m.specular.y, m.diffuse.y, f90, sum) * sum.mirrored.y;
        terms.mirrored.z =
            mirror_color(needs, m, m.specular.z, m.diffuse.z, f90, sum) * sum.mirrored.z;
    }
    return terms;
}

/* What leaves a pixel towards the eye; the sky's radiance where nothing was hit. */
TL_INLINE vec3
radiance_of(const tl_frame *frame, tl_needs needs, pixel of, substance m, received sum)
{
    const vec3 lobe = lobe_color(needs, m), diffuse = diffuse_color(needs, m);
    const real f90 = grazing_reflectance(m.specular);
    const sky_terms sky = sky_terms_of(needs, m, sum);
    const vec3 lit = {
        channel_of(
            needs, diffuse.x, sum.diffuse.x, lobe.x, sum.specular.x, f90, sum.grazing.x,
            ambient_of(needs, of.albedo.x, frame->ambient[0], sum.ambient.x, of.occlusion),
            sky.diffuse.x + sky.mirrored.x, of.emissive.x),
        channel_of(
            needs, diffuse.y, sum.diffuse.y, lobe.y, sum.specular.y, f90, sum.grazing.y,
            ambient_of(needs, of.albedo.y, frame->ambient[1], sum.ambient.y, of.occlusion),
            sky.diffuse.y + sky.mirrored.y, of.emissive.y),
        channel_of(
            needs, diffuse.z, sum.diffuse.z, lobe.z, sum.specular.z, f90, sum.grazing.z,
            ambient_of(needs, of.albedo.z, frame->ambient[2], sum.ambient.z, of.occlusion),
            sky.diffuse.z + sky.mirrored.z, of.emissive.z)};
    const mask hit = of.depth < (real)INFINITY;
    const vec3 radiance = {pick(hit, lit.x, (scalar)frame->sky[0]),
                           pick(hit, lit.y, (scalar)frame->sky[1]),
                           pick(hit, lit.z, (scalar)frame->sky[2])};
    return radiance;
}

/* Light that a colour multiplies. */
TL_INLINE vec3 tinted_light(vec3 color, vec3 light)
{
    const vec3 tinted = {color.x * received_by(color.x, light.x),
                         color.y * received_by(color.y, light.y),
                         color.z * received_by(color.z, light.z)};
    return tinted;
}

TL_INLINE vec3 specular_term(tl_needs needs, substance m, received sum)
{
    const vec3 lobe = lobe_color(needs, m);
    const real f90 = grazing_reflectance(m.specular);
    if (needs.one_color)
        return tinted_light(diffuse_color(needs, m), sum.specular);
    const vec3 term = {add_specular(needs, R(0.0), lobe.x, sum.specular.x, f90, sum.grazing.x),
                       add_specular(needs, R(0.0), lobe.y, sum.specular.y, f90, sum.grazing.y),
                       add_specular(needs, R(0.0), lobe.z, sum.specular.z, f90, sum.grazing.z)};
    return term;
}

TL_INLINE vec3 ambient_term(const tl_frame *frame, tl_needs needs, pixel of, received sum)
{
    const vec3 term = {
        ambient_of(needs, of.albedo.x, frame->ambient[0], sum.ambient.x, of.occlusion),
        ambient_of(needs, of.albedo.y, frame->ambient[1], sum.ambient.y, of.occlusion),
        ambient_of(needs, of.albedo.z, frame->ambient[2], sum.ambient.z, of.occlusion)};
    return term;
}

/* What a surface sends out of one term, which is not the background; 0 where nothing was hit.
 *
 * The exact sum of all terms, T, is the picture's radiance P to within rounding. No number is below 0, so a
 * rounding is a share u = 2^-24 of what is rounded. P is rounded where each term after the first joins it,
 * and once more with Fresnel's reflectance: 4 times at most; a term of its own twice at most. So with P cut
 * as it is at the largest float, |P - min(T, largest)| <= 6u T, and 2^-146 for what is below floats' normal
 * range. P is the sum in float bit for bit where nothing has highlights, for then each step is the same.
 *
 * With one colour (needs.h) and n lights on the pixel P has both lobes in one sum. It rounds once for a
 * light's factor, n times for their sum and once for the product with the surface's colour; so do terms
 * apart; and P twice more for what joins it: (2n + 6)u T. A sky's light is two terms more, which are added to
 * each other before they join P: 2u T. tests/test_split_terms.c asserts it on every pixel. */
TL_INLINE vec3 surface_term(
    const tl_frame *frame, tl_needs needs, tl_u32 term, pixel of, substance m, received sum)
{
    const vec3 none = {R(0.0), R(0.0), R(0.0)};
    const vec3 scattered = needs.one_color ? sum.apart : sum.diffuse;
    vec3 t = none;
    if (term == TL_AOV_DIFFUSE)
        t = tinted_light(diffuse_color(needs, m), scattered);
    if (term == TL_AOV_SPECULAR && needs.specular)
        t = specular_term(needs, m, sum);
    if (term == TL_AOV_AMBIENT && needs.ambient)
        t = ambient_term(frame, needs, of, sum);
    if (term == TL_AOV_SKY_DIFFUSE && lit_by_sky(needs))
        t = sky_terms_of(needs, m, sum).diffuse;
    if (term == TL_AOV_SKY_SPECULAR && mirrors_sky(needs))
        t = sky_terms_of(needs, m, sum).mirrored;
    if (term == TL_AOV_EMISSIVE && reads_planes(needs, TL_GROUP_EMISSIVE))
        t = of.emissive;
    const vec3 cut = {at_most_largest(t.x), at_most_largest(t.y), at_most_largest(t.z)};
    return pick3(of.depth < (real)INFINITY, cut, none);
}

/* The background's term of what is seen. */
TL_INLINE vec3 background_term(real depth, vec3 seen)
{
    const vec3 none = {R(0.0), R(0.0), R(0.0)};
    return pick3(depth < (real)INFINITY, none, seen);
}

#endif
