// A shading kernel with one fault. It takes point lights with a range and linear falloff, on Phong
// materials, one work-item a pixel: enough for the frame "spheres".
//
//     tilelight check --kernel faulty.cl --entry faulty --items pixel --frame spheres

#include "light.h"
#include "position.h"

vec3 load3(__global const float *in, size_t plane_size, int first)
{
    const int slot = TL_SLOT(TL_PRESENT, first);
    const vec3 v = {in[slot * plane_size], in[(slot + 1) * plane_size], in[(slot + 2) * plane_size]};
    return v;
}

__kernel void faulty(const tl_frame frame,
                     __global const float *planes,
                     __global const tl_view_light *lights,
                     __global const uint *starts,
                     __global const uint *ends,
                     __global const uint *list,
                     __global float *radiance)
{
    const uint tile = get_group_id(0), item = get_local_id(0), size = frame.tile_size;
    const uint column = tile % frame.tiles_x * size + item % size;
    const uint row = tile / frame.tiles_x * size + item / size;
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;
    const tl_needs needs = needs_of_build();
    __global const float *in = planes + at;
    const float depth = in[0];
    const vec3 n = view_normal(&frame, load3(in, plane_size, TL_NORMAL_X));
    const vec3 point = view_position(frame.rays, needs, (float)column,
                                     (float)(frame.first_row + row), depth);
    const vec3 eye = direction_to_eye(needs, point);
    const vec3 albedo = load3(in, plane_size, TL_ALBEDO_R);
    const vec3 shine = load3(in, plane_size, TL_SPECULAR_R);
    const float exponent = in[TL_SLOT(TL_PRESENT, TL_SHININESS) * plane_size];
    float out[3] = {frame.sky[0], frame.sky[1], frame.sky[2]};

    if (depth < INFINITY) {
        out[0] = albedo.x * frame.ambient[0];
        out[1] = albedo.y * frame.ambient[1];
        out[2] = albedo.z * frame.ambient[2];
        for (uint i = starts[tile]; i < ends[tile]; i++) {
            const tl_view_light light = lights[list[i]];
            const vec3 l = vector_to_light(point, light);
            const float d2 = dot3(l, l), d = sqrt(d2), n_dot_l = dot3(n, l) / d;
            if (!reaches(light, d2) || !(n_dot_l > 0.0f))
                continue;
            const vec3 h = {l.x + eye.x, l.y + eye.y, l.z + eye.z}; // l is d metres long, eye is 1
            const float weight = fade_linear(d, light.fade);
            const float lobe = blinn_phong_specular(n, h, exponent);
            out[0] += weight * (albedo.x * light.diffuse[0] * n_dot_l + shine.x * light.specular[0] * lobe);
            out[1] += weight * (albedo.y * light.diffuse[1] * n_dot_l + shine.y * light.specular[1] * lobe);
            out[2] += weight * (albedo.z * light.diffuse[2] * n_dot_l + shine.z * light.specular[2] * lobe);
        }
    }
    for (int i = 0; i < 3; i++)
        radiance[i * plane_size + at] = out[i];
}
