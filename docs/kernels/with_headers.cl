// A shading kernel on the headers of kernels/: one work-item shades one pixel, one work-group one tile.
// The group takes the lights of its list to local memory, as GPUs like it, and the formulas are
// tilelight's, so the picture is the same bit for bit.
//
//     tilelight check --kernel with_headers.cl --entry shade_in_batches --items pixel

#include "occlusion.h"
#include "pixel.h"

#if TL_WIDTH != 1
// The headers are written over `real`, which is as wide as the build: this kernel wants one lane.
#    error "use --width 1"
#endif

enum { BATCH = 64 }; // lights at a time: 5 KiB of local memory; no tile has fewer pixels

float value_of(
    __global const float *in, size_t plane_size, uint group, int plane, float otherwise)
{
    return TL_PRESENT & group ? in[TL_SLOT(TL_PRESENT, plane) * plane_size] : otherwise;
}

vec3 three_of(__global const float *in, size_t plane_size, uint group, int first)
{
    const vec3 v = {value_of(in, plane_size, group, first, 0.0f),
                    value_of(in, plane_size, group, first + 1, 0.0f),
                    value_of(in, plane_size, group, first + 2, 0.0f)};
    return v;
}

pixel load(__global const float *in, size_t size)
{
    pixel p;
    p.depth = in[0];
    p.normal = three_of(in, size, TL_GROUP_BASE, TL_NORMAL_X);
    p.albedo = three_of(in, size, TL_GROUP_BASE, TL_ALBEDO_R);
    p.specular = three_of(in, size, TL_THREE(TL_SPECULAR_R), TL_SPECULAR_R);
    p.shininess = value_of(in, size, TL_HAS(TL_SHININESS), TL_SHININESS, 0.0f);
    p.metallic = value_of(in, size, TL_GROUP_METAL_ROUGH, TL_METALLIC, 0.0f);
    p.roughness = value_of(in, size, TL_GROUP_METAL_ROUGH, TL_ROUGHNESS, 0.0f);
    p.occlusion = value_of(in, size, TL_GROUP_OCCLUSION, TL_OCCLUSION, 1.0f);
    p.emissive = three_of(in, size, TL_GROUP_EMISSIVE, TL_EMISSIVE_R);
    p.brdf = value_of(in, size, TL_GROUP_BRDF, TL_BRDF, 0.0f);
    p.tangent = three_of(in, size, TL_GROUP_TANGENT, TL_TANGENT_X);
    return p;
}

__kernel void shade_in_batches(const tl_frame frame,
                               __global const float *planes,
                               __global const tl_view_light *lights,
                               __global const uint *starts,
                               __global const uint *ends,
                               __global const uint *list,
                               __global float *radiance)
{
    __local tl_view_light batch[BATCH];
    __local tl_view_spot cones[BATCH];
    const uint tile = get_group_id(0), item = get_local_id(0), size = frame.tile_size;
    const uint column = tile % frame.tiles_x * size + item % size;
    const uint row = tile / frame.tiles_x * size + item / size;
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;
    const tl_needs needs = needs_of_build();

    pixel in = load(planes + at, plane_size);
    in.occlusion = ambient_share(&frame, needs, (tl_numbers)lights, in.occlusion, at);
    const substance material = substance_at(&frame, needs, in, rows_behind(&frame, lights));
    const surface s = surface_of(&frame, needs, in, material.shininess, (float)column,
                                 (float)(frame.first_row + row));
    finish f = finish_of(needs, s, material);
    f.at = at;
    received sum = nothing_received();
    for (uint i = 0; i < frame.global_count; i++)
        sum = add_global_light(sum, needs, s, f, lights[i],
                               spot_of(needs, lights, frame.light_count, i));

    // Every item takes part in every barrier, whether its pixel is sky or not.
    for (uint first = starts[tile]; first < ends[tile]; first += BATCH) {
        const uint count = min((uint)BATCH, ends[tile] - first);
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < count) {
            batch[item] = lights[list[first + item]];
            cones[item] = spot_of(needs, lights, frame.light_count, list[first + item]);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        for (uint i = 0; i < count; i++)
            sum = add_ranged_light(sum, needs, s, f, batch[i], cones[i]);
    }

    sum = add_sky(sum, &frame, needs, lights, s, material, in.occlusion);
    const vec3 out = radiance_of(&frame, needs, in, material, sum);
    radiance[at] = out.x;
    radiance[plane_size + at] = out.y;
    radiance[2 * plane_size + at] = out.z;
}
