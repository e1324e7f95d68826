/* One pixel in C, in the arithmetic of the file that includes this: loaded from planes, lit by all
 * lights in index order, without tiles. */
#ifndef TL_LIT_PIXEL_H
#define TL_LIT_PIXEL_H

#include "pixel.h"

#include "prepared.h"

TL_INLINE real value_at(const float *plane, size_t at, real otherwise)
{
    return plane ? (real)plane[at] : otherwise;
}

TL_INLINE vec3 three_at(float *const planes[TL_PLANE_COUNT], int first, size_t at)
{
    const vec3 v = {value_at(planes[first], at, R(0.0)),
                    value_at(planes[first + 1], at, R(0.0)),
                    value_at(planes[first + 2], at, R(0.0))};
    return v;
}

TL_INLINE pixel pixel_at(float *const planes[TL_PLANE_COUNT], size_t at)
{
    const pixel p = {.depth = (real)planes[TL_DEPTH][at],
                     .normal = three_at(planes, TL_NORMAL_X, at),
                     .albedo = three_at(planes, TL_ALBEDO_R, at),
                     .specular = three_at(planes, TL_SPECULAR_R, at),
                     .emissive = three_at(planes, TL_EMISSIVE_R, at),
                     .shininess = value_at(planes[TL_SHININESS], at, R(0.0)),
                     .metallic = value_at(planes[TL_METALLIC], at, R(0.0)),
                     .roughness = value_at(planes[TL_ROUGHNESS], at, R(0.0)),
                     .occlusion = value_at(planes[TL_OCCLUSION], at, R(1.0))};
    return p;
}

/* What leaves the surface of a pixel towards the eye, lit by every light of the frame. */
TL_INLINE vec3 light_surface(const tl_prepared *prepared, pixel in, surface s)
{
    const tl_frame *frame = &prepared->frame;
    const tl_needs needs = prepared->needs;
    received sum = {{0, 0, 0}, {0, 0, 0}};
    if (in.depth < (real)INFINITY) {
        for (uint32_t i = 0; i < frame->global_count; i++)
            sum = add_global_light(sum, needs, s, prepared->lights[i]);
        for (uint32_t i = frame->global_count; i < frame->light_count; i++)
            sum = add_ranged_light(sum, needs, s, prepared->lights[i]);
    }
    return radiance_of(frame, needs, in, material_of(needs, in), sum);
}

/* Of a pixel that is not packed. */
TL_INLINE vec3 light_pixel(const tl_prepared *prepared, pixel in, uint32_t column, uint32_t row)
{
    const tl_needs needs = prepared->needs;
    return light_surface(prepared, in,
                         surface_of(&prepared->frame, needs, in,
                                    material_of(needs, in).shininess, (real)column,
                                    (scalar)row));
}

#endif
