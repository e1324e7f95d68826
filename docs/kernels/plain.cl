// A whole shading kernel that stands on the interface alone: the structs tl_frame, tl_view_light and
// tl_view_spot and the numbers of the planes. One work-item shades one tile. It is meant to be read, not
// to be fast.
//
//     tilelight check --kernel plain.cl --entry plain

float3 vector_of(const float *numbers)
{
    return (float3)(numbers[0], numbers[1], numbers[2]);
}

// Plane `plane` of this frame at offset `at`, or what stands for it where the frame has none.
float plane_at(__global const float *planes, size_t plane_size, int plane, size_t at,
               float otherwise)
{
    if (!(TL_PRESENT & (1u << plane)))
        return otherwise;
    return planes[TL_SLOT(TL_PRESENT, plane) * plane_size + at];
}

float3 three_at(__global const float *planes, size_t plane_size, int first, size_t at)
{
    return (float3)(plane_at(planes, plane_size, first, at, 0.0f),
                    plane_at(planes, plane_size, first + 1, at, 0.0f),
                    plane_at(planes, plane_size, first + 2, at, 0.0f));
}

// World to view: the upper left 3 x 3 of the matrix. A normal may have any length, and none.
float3 unit_view_normal(const tl_frame *frame, float3 world)
{
    const float3 n = (float3)(dot(vector_of(frame->view_from_world[0]), world),
                              dot(vector_of(frame->view_from_world[1]), world),
                              dot(vector_of(frame->view_from_world[2]), world));
    const float length2 = dot(n, n);
    return length2 > 0.0f ? n / sqrt(length2) : (float3)(0.0f);
}

// (n.h / |h|)^exponent. Near the peak 1 - cos^2 is taken from the part of h across n: pow(n.h, e)
// would lose e times what n.h loses.
float specular_lobe(float3 n, float3 h, float exponent)
{
    const float n_dot_h = dot(n, h);
    if (!(n_dot_h > 0.0f))
        return 0.0f;
    const float3 across = h - n_dot_h * n;
    const float length2 = dot(h, h);
    const float sin2 = dot(across, across) / length2;
    const float cos2 = n_dot_h * n_dot_h / length2;
    return sin2 < 0.25f ? exp(0.5f * exponent * log1p(-sin2)) : pow(cos2, 0.5f * exponent);
}

// How a light fades over `distance`.
float weight_at(tl_view_light light, float distance)
{
    const float share = distance * distance * light.fade;
    const float near_one = fmax(distance, 0.01f); // a light is 1 cm in size
    if (light.falloff >= TL_FADE_COUNT) // linear from a distance on: a second number stands there
        return clamp(as_float(light.falloff) - distance * light.fade, 0.0f, 1.0f);
    switch (light.falloff) {
    case TL_FADE_LINEAR: return fmax(1.0f - distance * light.fade, 0.0f);
    case TL_FADE_INVERSE_SQUARE: return fmax(1.0f - share * share, 0.0f) / (near_one * near_one);
    default: return 1.0f; // directional
    }
}

// What the cone of a spot light lets through towards a surface from which l leads to it, d metres
// long.
float cone_at(tl_view_spot spot, float3 l, float d)
{
    const float cosine = dot(vector_of(spot.axis), l) / d;
    const float share = clamp((cosine - spot.least_cos) * spot.scale, 0.0f, 1.0f);
    return share * share;
}

__kernel void plain(const tl_frame frame,
                    __global const float *planes,
                    __global const tl_view_light *lights,
                    __global const uint *starts,
                    __global const uint *ends,
                    __global const uint *list,
                    __global float *radiance)
{
    const uint tile = get_global_id(0), size = frame.tile_size;
    const uint column0 = tile % frame.tiles_x * size, row0 = tile / frame.tiles_x * size;
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const uint listed = ends[tile] - starts[tile];
    __global const tl_view_spot *spots =
        (__global const tl_view_spot *)(lights + frame.light_count);

    for (uint i = 0; i < size * size; i++) {
        const uint column = column0 + i % size, row = row0 + i / size;
        const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;
        const float depth = plane_at(planes, plane_size, TL_DEPTH, at, 0.0f);
        float3 out = vector_of(frame.sky);

        if (depth < INFINITY) {
            // Where the surface is, and which way it and the eye are.
            const float x = frame.rays.x0 + (frame.rays.column0 + (float)column) * frame.rays.dx;
            const float y = frame.rays.y0 +
                            (frame.rays.row0 + (float)(frame.first_row + row)) * frame.rays.dy;
            const float3 point = TL_ORTHOGRAPHIC ? (float3)(x, y, -depth)
                                                 : (float3)(x * depth, y * depth, -depth);
            const float3 eye = TL_ORTHOGRAPHIC ? (float3)(0.0f, 0.0f, 1.0f)
                                               : -point / sqrt(dot(point, point));
            const float3 n =
                unit_view_normal(&frame, three_at(planes, plane_size, TL_NORMAL_X, at));

            // What it is made of: Phong as stored, or mapped from metallic and roughness.
            const float3 albedo = three_at(planes, plane_size, TL_ALBEDO_R, at);
            float3 diffuse = albedo, specular = three_at(planes, plane_size, TL_SPECULAR_R, at);
            float exponent = plane_at(planes, plane_size, TL_SHININESS, at, 0.0f);
            if (TL_PRESENT & TL_GROUP_METAL_ROUGH) {
                const float metallic = plane_at(planes, plane_size, TL_METALLIC, at, 0.0f);
                const float roughness = plane_at(planes, plane_size, TL_ROUGHNESS, at, 0.0f);
                const float alpha = roughness * roughness;
                diffuse = albedo * (1.0f - metallic);
                specular = 0.04f + metallic * (albedo - 0.04f);
                exponent = 2.0f / fmax(alpha * alpha, 0.0001999600f) - 2.0f;
            }
            if (TL_FIXED_EXPONENT)
                exponent = frame.exponent;
            const bool normalized = TL_MODEL == TL_MODEL_BLINN_PHONG_NORMALIZED;
            if (normalized)
                specular *= diffuse * ((exponent + 2.0f) / 8.0f);

            // Ambient light and emission, then light after light: first those that reach
            // everything, which no list has.
            out = albedo * vector_of(frame.ambient) *
                      plane_at(planes, plane_size, TL_OCCLUSION, at, 1.0f) +
                  three_at(planes, plane_size, TL_EMISSIVE_R, at);
            for (uint k = 0; k < frame.global_count + listed; k++) {
                const bool global_light = k < frame.global_count;
                const uint index = global_light ? k : list[starts[tile] + k - frame.global_count];
                const tl_view_light light = lights[index];
                const float3 position = vector_of(light.position);
                const float3 l = light.falloff == TL_FADE_NONE ? position : position - point;
                const float d2 = dot(l, l), d = sqrt(d2);
                if (!(d2 > 1e-24f) || (!global_light && !(d2 < light.range2)))
                    continue; // in the surface point itself, or out of range
                const float n_dot_l = dot(n, l) / d;
                if (!(n_dot_l > 0.0f))
                    continue;
                float weight = weight_at(light, d);
                if (TL_SPOTS)
                    weight *= cone_at(spots[index], l, d);
                float lobe = TL_SPECULAR ? specular_lobe(n, l / d + eye, exponent) : 0.0f;
                if (normalized)
                    lobe *= n_dot_l;
                out += diffuse * vector_of(light.diffuse) * (weight * n_dot_l);
                out += specular * vector_of(light.specular) * (weight * lobe);
            }
        }
        radiance[at] = out.x;
        radiance[plane_size + at] = out.y;
        radiance[2 * plane_size + at] = out.z;
    }
}
