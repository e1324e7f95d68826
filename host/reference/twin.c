/* Compiled once per arithmetic and instruction set: TL_TWIN is the name it then has. */
#include "pixel.h"

#include "twin.h"

tl_twin_rows TL_TWIN;

static real value_at(const float *plane, size_t at, real otherwise)
{
    return plane ? (real)plane[at] : otherwise;
}

static vec3 three_at(float *const planes[TL_PLANE_COUNT], int first, size_t at)
{
    const vec3 v = {value_at(planes[first], at, R(0.0)),
                    value_at(planes[first + 1], at, R(0.0)),
                    value_at(planes[first + 2], at, R(0.0))};
    return v;
}

static pixel pixel_at(float *const planes[TL_PLANE_COUNT], size_t at)
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

static vec3 light_pixel(const tl_prepared *prepared, pixel in, uint32_t column, uint32_t row)
{
    const tl_frame *frame = &prepared->frame;
    const tl_needs needs = prepared->needs;
    const phong_material m = material_of(needs, in);
    const surface s = surface_of(frame, needs, in, m.shininess, (real)column, (scalar)row);
    received sum = {{0, 0, 0}, {0, 0, 0}};
    if (in.depth < (real)INFINITY) {
        for (uint32_t i = 0; i < frame->global_count; i++)
            sum = add_global_light(sum, needs, s, prepared->lights[i]);
        for (uint32_t i = frame->global_count; i < frame->light_count; i++)
            sum = add_ranged_light(sum, needs, s, prepared->lights[i]);
    }
    return radiance_of(frame, needs, in, m, sum);
}

void TL_TWIN(const tl_prepared *prepared,
             float *const planes[TL_PLANE_COUNT],
             float *const radiance[3],
             size_t begin,
             size_t end)
{
    const uint32_t tile = prepared->frame.tile_size;
    const uint32_t width = prepared->frame.tiles_x * tile;
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        for (uint32_t column = 0; column < width; column++) {
            const size_t at = (size_t)row * prepared->frame.pitch + column;
            const vec3 out = light_pixel(prepared, pixel_at(planes, at), column, row);
            radiance[0][at] = (float)out.x;
            radiance[1][at] = (float)out.y;
            radiance[2][at] = (float)out.z;
        }
    }
}
