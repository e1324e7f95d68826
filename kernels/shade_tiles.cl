/* Shading: one work-item per tile, vectors of pixels, the light loop innermost.
 *
 * PoCL vectorises innermost loops only, and would have to choose the light loop; so the vectors
 * are explicit. No barrier, no local memory: work-groups are one work-item. Lights add up in
 * index order, so the image does not depend on scheduling. */
#include "pixel.h"

#define PLANE_AT(plane) (in + TL_SLOT(TL_PRESENT, plane) * plane_size)
#define LOAD_PLANE(plane) LOAD(PLANE_AT(plane), 0)
#define LOAD_IF(group, plane, otherwise) \
    ((TL_PRESENT & (group)) ? LOAD_PLANE(plane) : (real)(otherwise))

/* in: the pixel's first plane; planes are plane_size floats apart. */
TL_INLINE pixel load_pixel(__global const float *in, size_t plane_size)
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

/* planes    [popcount(TL_PRESENT)][rows][pitch], planes.h
 * lights    [light_count]: first the global_count that reach everything
 * starts, ends  [tiles_y * tiles_x]: tile t lists list[starts[t]] to list[ends[t] - 1], ascending
 * radiance  [3][rows][pitch], linear Rec. 709; written in full for every tile of the image
 * Global size: tiles_x * tiles_y, tiles row by row. */
__kernel void shade_tiles(const tl_frame frame,
                          __global const float *restrict planes,
                          __global const tl_view_light *restrict lights,
                          __global const uint *restrict starts,
                          __global const uint *restrict ends,
                          __global const uint *restrict list,
                          __global float *restrict radiance)
{
    const uint tile = get_global_id(0);
    const uint column0 = tile % frame.tiles_x * frame.tile_size;
    const uint row0 = tile / frame.tiles_x * frame.tile_size;
    const uint start = starts[tile], end = ends[tile];
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const tl_needs needs = needs_of_build();

    for (uint row = row0; row < row0 + frame.tile_size; row++) {
        for (uint column = column0; column < column0 + frame.tile_size; column += TL_WIDTH) {
            const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;
            const pixel in = load_pixel(planes + at, plane_size);
            const phong_material m = material_of(needs, in);
            const surface s =
                surface_of(&frame, needs, in, m.shininess, (scalar)column + LANE_INDEX,
                           (scalar)(frame.first_row + row));

            received sum = {{0, 0, 0}, {0, 0, 0}};
            if (any_lane(in.depth < (real)INFINITY)) {
                for (uint i = 0; i < frame.global_count; i++)
                    sum = add_global_light(sum, needs, s, lights[i]);
                for (uint i = start; i < end; i++)
                    sum = add_ranged_light(sum, needs, s, lights[list[i]]);
            }

            const vec3 out = radiance_of(&frame, needs, in, m, sum);
            STORE_FLOAT(out.x, radiance, at);
            STORE_FLOAT(out.y, radiance, plane_size + at);
            STORE_FLOAT(out.z, radiance, 2 * plane_size + at);
        }
    }
}
