/* Pixels from the planes of a frame. OpenCL only. */
#ifndef TL_LOAD_PIXEL_H
#define TL_LOAD_PIXEL_H

#include "block.h"
#include "pixel.h"

#define PLANE_AT(plane) (in + TL_SLOT(TL_PRESENT, plane) * plane_size)
#define LOAD_PLANE(plane) load_block(PLANE_AT(plane), pitch)
#define LOAD_IF(group, plane, otherwise) \
    ((TL_PRESENT & (group)) ? LOAD_PLANE(plane) : (real)(otherwise))

/* in: the block in the first plane; planes are plane_size floats apart. */
TL_INLINE pixel load_pixel(__global const float *in, size_t plane_size, uint pitch)
{
    pixel p;
    p.depth = LOAD_PLANE(TL_DEPTH);
    p.normal.x = LOAD_PLANE(TL_NORMAL_X);
    p.normal.y = LOAD_PLANE(TL_NORMAL_Y);
    p.normal.z = LOAD_PLANE(TL_NORMAL_Z);
    p.albedo.x = LOAD_PLANE(TL_ALBEDO_R);
    p.albedo.y = LOAD_PLANE(TL_ALBEDO_G);
    p.albedo.z = LOAD_PLANE(TL_ALBEDO_B);
    p.specular.x = LOAD_IF(TL_GROUP_PHONG, TL_SPECULAR_R, 0);
    p.specular.y = LOAD_IF(TL_GROUP_PHONG, TL_SPECULAR_G, 0);
    p.specular.z = LOAD_IF(TL_GROUP_PHONG, TL_SPECULAR_B, 0);
    p.shininess = LOAD_IF(TL_GROUP_PHONG, TL_SHININESS, 0);
    p.metallic = LOAD_IF(TL_GROUP_METAL_ROUGH, TL_METALLIC, 0);
    p.roughness = LOAD_IF(TL_GROUP_METAL_ROUGH, TL_ROUGHNESS, 0);
    p.occlusion = LOAD_IF(TL_GROUP_OCCLUSION, TL_OCCLUSION, 1);
    p.emissive.x = LOAD_IF(TL_GROUP_EMISSIVE, TL_EMISSIVE_R, 0);
    p.emissive.y = LOAD_IF(TL_GROUP_EMISSIVE, TL_EMISSIVE_G, 0);
    p.emissive.z = LOAD_IF(TL_GROUP_EMISSIVE, TL_EMISSIVE_B, 0);
    return p;
}

#endif
