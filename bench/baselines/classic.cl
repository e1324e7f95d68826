/* The classic kernel of tiled deferred shading on GPUs, in one launch: a work-group per tile finds
 * its depth bounds and its light list in local memory by atomics, then each work-item shades its
 * pixel, with the language's own functions. Andersson, "Parallel Graphics in Frostbite" (SIGGRAPH
 * 2009); Lauritzen, "Deferred Rendering for Current and Future Rendering Pipelines" (SIGGRAPH 2010).
 *
 * Joined behind the texts of kernels/, of whose headers it uses the formulas; built with one lane. */
#line 10 "classic.cl"
#define CLASSIC_TILE 16 /* px, and work-items per side of a work-group */
#define CLASSIC_CAP 256 /* lights per tile: local memory is of one size */

/* Depths in the order of their bits, negative ones (orthographic) too. */
TL_INLINE int ordered(float depth)
{
    const int bits = as_int(depth);
    return bits < 0 ? bits ^ 0x7fffffff : bits;
}

TL_INLINE float unordered(int bits)
{
    return as_float(bits < 0 ? bits ^ 0x7fffffff : bits);
}

/* Whether a sphere reaches over the plane x = edge depth, or x = edge, to its positive side. */
TL_INLINE int reaches_over(float sign, float edge, float x, float depth, float radius)
{
    const float over =
        TL_ORTHOGRAPHIC ? x - edge : (x - edge * depth) / sqrt(1.0f + edge * edge);
    return sign * over > -radius;
}

TL_INLINE int meets_tile(tl_rays rays, tl_view_light light, float nearest, float farthest)
{
    const float left = rays.x0 + ((float)(get_group_id(0) * CLASSIC_TILE) - 0.5f) * rays.dx;
    const float top = rays.y0 + ((float)(get_group_id(1) * CLASSIC_TILE) - 0.5f) * rays.dy;
    const float right = left + CLASSIC_TILE * rays.dx, bottom = top + CLASSIC_TILE * rays.dy;
    const float x = light.position[0], y = light.position[1], depth = -light.position[2];
    const float radius = sqrt(light.range2);
    return depth + radius >= nearest && depth - radius <= farthest &&
           reaches_over(1.0f, left, x, depth, radius) &&
           reaches_over(-1.0f, right, x, depth, radius) &&
           reaches_over(-1.0f, top, y, depth, radius) &&
           reaches_over(1.0f, bottom, y, depth, radius);
}

/* Light from the unit direction l. */
TL_INLINE received
add_classic(received sum, surface s, tl_view_light light, vec3 l, float weight)
{
    const float n_dot_l = dot3(s.normal, l);
    if (!(n_dot_l > 0.0f))
        return sum;
    const vec3 diffuse = {light.diffuse[0], light.diffuse[1], light.diffuse[2]};
    sum.diffuse = fma3(diffuse, weight * n_dot_l, sum.diffuse);
    if (TL_SPECULAR) {
        const vec3 specular = {light.specular[0], light.specular[1], light.specular[2]};
        const float3 h =
            normalize((float3)(l.x + s.to_eye.x, l.y + s.to_eye.y, l.z + s.to_eye.z));
        const float n_dot_h = max(0.0f, dot((float3)(s.normal.x, s.normal.y, s.normal.z), h));
        sum.specular = fma3(specular, weight * pow(n_dot_h, s.shininess), sum.specular);
    }
    return sum;
}

TL_INLINE received
add_point(received sum, tl_needs needs, surface s, tl_view_light light, int ranged)
{
    const vec3 away = vector_to_light(s.position, light);
    const float distance2 = dot3(away, away);
    if (!(distance2 > 0.0f) || (ranged && !reaches(light, distance2)))
        return sum;
    const float distance = sqrt(distance2), per_distance = 1.0f / distance;
    const vec3 l = {away.x * per_distance, away.y * per_distance, away.z * per_distance};
    const float weight = ranged ? fade_of(needs, light, distance2, distance, per_distance)
                                : fade_inverse_square(distance2, per_distance, 0.0f);
    return add_classic(sum, s, light, l, weight);
}

TL_INLINE received add_unlisted(received sum, tl_needs needs, surface s, tl_view_light light)
{
    const vec3 l = {light.position[0], light.position[1], light.position[2]};
    return light.falloff == TL_FADE_NONE ? add_classic(sum, s, light, l, 1.0f)
                                         : add_point(sum, needs, s, light, 0);
}

/* A plane of the pixel at `in` in the first one; `otherwise` where the frame lacks it. */
TL_INLINE float plane_of(__global const float *in,
                         size_t plane_size,
                         uint plane,
                         float otherwise)
{
    return TL_PRESENT & TL_HAS(plane) ? in[TL_SLOT(TL_PRESENT, plane) * plane_size] : otherwise;
}

TL_INLINE vec3 three_of(__global const float *in, size_t plane_size, uint first)
{
    const vec3 v = {plane_of(in, plane_size, first, 0.0f),
                    plane_of(in, plane_size, first + 1, 0.0f),
                    plane_of(in, plane_size, first + 2, 0.0f)};
    return v;
}

TL_INLINE pixel load_classic(__global const float *in, size_t plane_size)
{
    pixel p;
    p.depth = plane_of(in, plane_size, TL_DEPTH, INFINITY);
    p.normal = three_of(in, plane_size, TL_NORMAL_X);
    p.albedo = three_of(in, plane_size, TL_ALBEDO_R);
    p.specular = three_of(in, plane_size, TL_SPECULAR_R);
    p.emissive = three_of(in, plane_size, TL_EMISSIVE_R);
    p.shininess = plane_of(in, plane_size, TL_SHININESS, 0.0f);
    p.metallic = plane_of(in, plane_size, TL_METALLIC, 0.0f);
    p.roughness = plane_of(in, plane_size, TL_ROUGHNESS, 0.0f);
    p.occlusion = plane_of(in, plane_size, TL_OCCLUSION, 1.0f);
    return p;
}

/* planes    [popcount(TL_PRESENT)][rows][pitch], planes.h
 * lights    [light_count]: first the global_count that reach everything
 * radiance  [3][rows][pitch], linear Rec. 709; written in full for every tile of the image
 * longest   [2]: raised to the most lights that a tile has met; what a list holds. Where the first
 *           is above the second, lights are missing
 * shades    0: lists are made and no light is added
 * Global size: (16 tiles_x, 16 tiles_y), work-groups of (16, 16). */
__kernel __attribute__((reqd_work_group_size(CLASSIC_TILE, CLASSIC_TILE, 1))) void
light_tiles_classic(const tl_frame frame,
                    __global const float *restrict planes,
                    __global const tl_view_light *restrict lights,
                    __global float *restrict radiance,
                    __global uint *restrict longest,
                    const int shades)
{
    __local int nearest, farthest;
    __local uint count, list[CLASSIC_CAP];
    const uint column = get_global_id(0), row = get_global_id(1);
    const uint item = get_local_id(1) * CLASSIC_TILE + get_local_id(0);
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const size_t at = (size_t)row * frame.pitch + column;
    const tl_needs needs = needs_of_build();
    const pixel in = load_classic(planes + at, plane_size);
    const substance m = substance_of(&frame, needs, in);

    if (item == 0) {
        nearest = INT_MAX;
        farthest = INT_MIN;
        count = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (in.depth < INFINITY) {
        atomic_min(&nearest, ordered(in.depth));
        atomic_max(&farthest, ordered(in.depth));
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = frame.global_count + item; nearest <= farthest && i < frame.light_count;
         i += CLASSIC_TILE * CLASSIC_TILE)
        if (meets_tile(frame.rays, lights[i], unordered(nearest), unordered(farthest))) {
            const uint slot = atomic_inc(&count);
            if (slot < CLASSIC_CAP)
                list[slot] = i;
        }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item == 0) {
        atomic_max(&longest[0], count);
        longest[1] = CLASSIC_CAP;
    }

    const uint listed = min(count, (uint)CLASSIC_CAP);
    const surface s = surface_of(&frame, needs, in, m.shininess, (scalar)column, (scalar)row);
    received sum = nothing_received();
    if (shades && in.depth < INFINITY) {
        for (uint i = 0; i < frame.global_count; i++)
            sum = add_unlisted(sum, needs, s, lights[i]);
        for (uint i = 0; i < listed; i++)
            sum = add_point(sum, needs, s, lights[list[i]], 1);
    }
    const vec3 out = radiance_of(&frame, needs, in, m, sum);
    radiance[at] = out.x;
    radiance[plane_size + at] = out.y;
    radiance[2 * plane_size + at] = out.z;
}
