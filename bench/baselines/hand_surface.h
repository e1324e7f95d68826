/* A block of pixels as surfaces, and what leaves them: the formulas of kernels/position.h,
 * material.h and pixel.h, written for blocks. */
#ifndef TL_HAND_SURFACE_H
#define TL_HAND_SURFACE_H

#include "hand.h"
#include "lanes.h"

typedef struct block_surface {
    lanes3 position, normal, to_eye;
    lanes half_exponent; /* of Blinn-Phong, halved */
    lanes lobe_scale;    /* with one colour: what the lobe adds, as a share of diffuse light */
    bool has_one_color;
} block_surface;

/* What the lights bring, per lobe; the surface's colours multiply it afterwards. */
typedef struct block_light {
    lanes3 diffuse, specular;
} block_light;

typedef struct block_pixel {
    size_t at; /* of its first pixel in a plane */
    lanes depth, metallic;
    lane_mask hit;
} block_pixel;

LANES_INLINE lanes load_plane(const hand_frame *frame, enum tl_plane plane, size_t at)
{
    return load_block(frame->planes[plane] + at, frame->prepared->frame.pitch);
}

LANES_INLINE lanes load_or(const hand_frame *frame, enum tl_plane plane, size_t at, float other)
{
    return frame->planes[plane] ? load_plane(frame, plane, at) : all(other);
}

LANES_INLINE lanes3 block_position(
    const tl_frame *frame, bool orthographic, uint32_t column, uint32_t row, lanes depth)
{
    const lanes ray_x =
        fused(column_in_block() + (float)column, all(frame->rays.dx), all(frame->rays.x0));
    const lanes ray_y =
        fused(row_in_block() + (float)row, all(frame->rays.dy), all(frame->rays.y0));
    if (orthographic)
        return (lanes3){ray_x, ray_y, -depth};
    return (lanes3){ray_x * depth, ray_y * depth, -depth};
}

LANES_INLINE lanes rotated(const float row[4], lanes3 v)
{
    return dot((lanes3){all(row[0]), all(row[1]), all(row[2])}, v);
}

LANES_INLINE lanes3 block_normal(const hand_frame *frame, size_t at)
{
    const float(*rows)[4] = frame->prepared->frame.view_from_world;
    const lanes3 world = {load_plane(frame, TL_NORMAL_X, at),
                          load_plane(frame, TL_NORMAL_Y, at),
                          load_plane(frame, TL_NORMAL_Z, at)};
    const lanes3 n = {rotated(rows[0], world), rotated(rows[1], world),
                      rotated(rows[2], world)};
    const lanes length2 = dot(n, n);
    const lanes k = keep(below(all(0.0f), length2), 1.0f / root(length2));
    return (lanes3){n.x * k, n.y * k, n.z * k};
}

LANES_INLINE lanes block_exponent(const hand_frame *frame, size_t at)
{
    if (!frame->planes[TL_ROUGHNESS])
        return load_or(frame, TL_SHININESS, at, 0.0f);
    const lanes roughness = load_plane(frame, TL_ROUGHNESS, at);
    const lanes alpha = roughness * roughness;
    return 2.0f / larger(alpha * alpha, all(0.0001999600f)) - 2.0f;
}

LANES_INLINE block_surface surface_of_block(const hand_frame *frame,
                                            block_pixel pixel,
                                            uint32_t column,
                                            uint32_t row)
{
    const bool orthographic = frame->prepared->needs.orthographic != 0;
    block_surface s;
    s.position =
        block_position(&frame->prepared->frame, orthographic, column, row, pixel.depth);
    s.normal = block_normal(frame, pixel.at);
    const lanes k = -1.0f / root(dot(s.position, s.position));
    s.to_eye = (lanes3){s.position.x * k, s.position.y * k, s.position.z * k};
    if (orthographic)
        s.to_eye = (lanes3){all(0.0f), all(0.0f), all(1.0f)};
    s.half_exponent = 0.5f * block_exponent(frame, pixel.at);
    s.has_one_color = frame->has_one_color;
    s.lobe_scale = all(0.0f);
    if (s.has_one_color)
        s.lobe_scale = load_or(frame, TL_SPECULAR_R, pixel.at, 0.0f) *
                       fused(s.half_exponent, all(0.25f), all(0.25f));
    return s;
}

/* One channel of the radiance. */
LANES_INLINE void store_channel(
    const hand_frame *frame, block_pixel pixel, unsigned channel, lanes diffuse, lanes specular)
{
    const tl_frame *f = &frame->prepared->frame;
    const lanes albedo = load_plane(frame, TL_ALBEDO_R + channel, pixel.at);
    lanes ambient = albedo * f->ambient[channel], color = albedo;
    if (frame->planes[TL_OCCLUSION])
        ambient = ambient * load_plane(frame, TL_OCCLUSION, pixel.at);
    if (frame->planes[TL_METALLIC])
        color = albedo * (1.0f - pixel.metallic);
    lanes radiance = color * diffuse;
    if (frame->prepared->needs.specular && !frame->has_one_color) {
        const lanes reflected = frame->planes[TL_METALLIC]
                                    ? fused(pixel.metallic, albedo - 0.04f, all(0.04f))
                                    : load_or(frame, TL_SPECULAR_R + channel, pixel.at, 0.0f);
        radiance = fused(reflected, specular, radiance);
    }
    radiance = radiance + ambient;
    if (frame->planes[TL_EMISSIVE_R])
        radiance = radiance + load_plane(frame, TL_EMISSIVE_R + channel, pixel.at);
    store_block(choose(pixel.hit, radiance, all(f->sky[channel])),
                frame->radiance[channel] + pixel.at, f->pitch);
}

LANES_INLINE void store_radiance(const hand_frame *frame, block_pixel pixel, block_light light)
{
    store_channel(frame, pixel, 0, light.diffuse.x, light.specular.x);
    store_channel(frame, pixel, 1, light.diffuse.y, light.specular.y);
    store_channel(frame, pixel, 2, light.diffuse.z, light.specular.z);
}

#endif
