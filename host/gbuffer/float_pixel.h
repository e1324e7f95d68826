/* A pixel from planes of full float, in the arithmetic of the file that includes this. */
#ifndef TL_FLOAT_PIXEL_H
#define TL_FLOAT_PIXEL_H

#include "pixel.h"

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

/* planes: NULL where absent; depth is there. at: the pixel, counted in the planes. */
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
                     .occlusion = value_at(planes[TL_OCCLUSION], at, R(1.0)),
                     .brdf = value_at(planes[TL_BRDF], at, R(0.0)),
                     .tangent = three_at(planes, TL_TANGENT_X, at)};
    return p;
}

#endif
