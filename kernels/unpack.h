/* From the words of a pixel to what they say. */
#ifndef TL_UNPACK_H
#define TL_UNPACK_H

#include "layout.h"
#include "pixel.h"

/* A pixel (a vector of them) as it is packed; what the frame does not store is 0. */
typedef struct tl_words {
    word32 of[TL_MAX_WORDS];
} tl_words;

TL_INLINE real channel_value(tl_channel c, const tl_words *words)
{
    return number_value(c.number, words->of[c.word], c.shift, c.bits);
}

TL_INLINE vec3 three_channels(const tl_attribute *a, const tl_words *words)
{
    const vec3 v = {channel_value(a->channels[0], words), channel_value(a->channels[1], words),
                    channel_value(a->channels[2], words)};
    return v;
}

/* A direction of any length, in the layout's space; 0 where there is none. */
TL_INLINE vec3 stored_direction(const tl_attribute *a, const tl_words *words)
{
    const tl_channel first = a->channels[0];
    const vec3 none = {R(0.0), R(0.0), R(0.0)};
    if (a->code == TL_NORMAL_XYZ) {
        vec3 v = three_channels(a, words);
        if (first.number != TL_NUMBER_UNORM && first.number != TL_NUMBER_SNORM)
            return v;
        if (first.number == TL_NUMBER_UNORM) {
            v.x = FMA(v.x, R(2.0), R(-1.0));
            v.y = FMA(v.y, R(2.0), R(-1.0));
            v.z = FMA(v.z, R(2.0), R(-1.0));
        }
        return pick3(dot3(v, v) > R(0.25), v, none);
    }
    const vec2 e = {channel_value(first, words), channel_value(a->channels[1], words)};
    if (a->code == TL_NORMAL_SPHEREMAP)
        return direction_of_spheremap(e);
    return pick3(e.x >= R(-1.0), direction_of_octahedron(e), none);
}

TL_INLINE vec3 stored_normal(const tl_layout *layout, const tl_words *words)
{
    return stored_direction(&layout->normal, words);
}

TL_INLINE vec3 stored_color(const tl_attribute *a, const tl_words *words)
{
    if (a->code == TL_COLOR_SHARED)
        return color_of_shared(words->of[a->channels[0].word]);
    if (a->code == TL_COLOR_GRAY) {
        const real gray = channel_value(a->channels[0], words);
        const vec3 c = {gray, gray, gray};
        return c;
    }
    const vec3 c = three_channels(a, words);
    if (a->code == TL_COLOR_RGB)
        return c;
    const vec3 squares = {c.x * c.x, c.y * c.y, c.z * c.z};
    return squares;
}

TL_INLINE real stored_shininess(const tl_layout *layout, const tl_words *words)
{
    const real stored = channel_value(layout->shininess.channels[0], words);
    return layout->shininess.code == TL_VALUE_LOGARITHM ? shininess_of_logarithm(stored)
                                                        : stored;
}

/* The position in view space that is stored; z is -infinity where nothing was hit. */
TL_INLINE vec3 stored_position(const tl_frame *frame,
                               const tl_layout *layout,
                               const tl_words *words)
{
    vec3 p = three_channels(&layout->depth, words);
    const mask hit =
        p.x < (layout->depth.channels[0].number == TL_NUMBER_HALF ? TL_MOST_HALF + R(1.0)
                                                                  : (scalar)INFINITY);
    if (layout->depth.code == TL_DEPTH_WORLD_POSITION)
        p = view_point(frame, p);
    p.z = pick(hit, p.z, (real)-INFINITY);
    return p;
}

/* What depth_of takes: nearness from whole numbers without a rounding at either end. */
TL_INLINE real stored_depth(const tl_layout *layout, const tl_words *words)
{
    const tl_channel c = layout->depth.channels[0];
    const tl_u32 code = layout->depth.code;
    if (!TL_IS_NEARNESS(code))
        return channel_value(c, words);
    if (code != TL_DEPTH_FORWARD || c.number == TL_NUMBER_FLOAT)
        return nearness_of(code, channel_value(c, words));
    const word32 field = field_of(words->of[c.word], c.shift, c.bits);
    const word32 whole = c.number == TL_NUMBER_BYTES24 ? swapped_bytes24(field) : field;
    return WORD_TO_REAL(0xffffffu - whole) * unorm_step(24u);
}

/* Where the surface of pixel (column, row) is, and the depth of it: shading and culling have both from
 * here, so they use the same bits. */
TL_INLINE vec3 position_of(const tl_frame *frame,
                           tl_needs needs,
                           const tl_layout *layout,
                           const tl_words *words,
                           real column,
                           real row)
{
    if (TL_IS_POSITION(layout->depth.code))
        return stored_position(frame, layout, words);
    return view_position(
        frame->rays, needs, column, row,
        depth_of(frame, needs, layout->depth.code, stored_depth(layout, words)));
}

/* `depth`: of its position. What the frame lacks, or need not read, has the value planes.h gives it. */
TL_INLINE pixel pixel_of(tl_needs needs,
                         const tl_layout *layout,
                         const tl_words *words,
                         real depth)
{
    const vec3 black = {R(0.0), R(0.0), R(0.0)};
    pixel p;
    p.depth = depth;
    p.normal = stored_normal(layout, words);
    p.albedo = stored_color(&layout->albedo, words);
    p.specular = p.emissive = p.tangent = black;
    p.shininess = p.metallic = p.roughness = p.brdf = R(0.0);
    p.occlusion = R(1.0);
    if (reads_planes(needs, TL_THREE(TL_SPECULAR_R)))
        p.specular = stored_color(&layout->specular, words);
    if (reads_planes(needs, TL_HAS(TL_SHININESS)))
        p.shininess = stored_shininess(layout, words);
    if (reads_planes(needs, TL_HAS(TL_METALLIC)))
        p.metallic = channel_value(layout->metallic.channels[0], words);
    if (reads_planes(needs, TL_HAS(TL_ROUGHNESS)))
        p.roughness = channel_value(layout->roughness.channels[0], words);
    if (reads_planes(needs, TL_GROUP_OCCLUSION))
        p.occlusion = channel_value(layout->occlusion.channels[0], words);
    if (reads_planes(needs, TL_GROUP_EMISSIVE))
        p.emissive = stored_color(&layout->emissive, words);
    if (reads_planes(needs, TL_GROUP_BRDF))
        p.brdf = channel_value(layout->brdf.channels[0], words);
    if (reads_planes(needs, TL_GROUP_TANGENT))
        p.tangent = stored_direction(&layout->tangent, words);
    return p;
}

/* In view space, unit or 0. */
TL_INLINE vec3 normal_of(const tl_frame *frame, const tl_layout *layout, const tl_words *words)
{
    const vec3 stored = stored_normal(layout, words);
    return layout->normal_space == TL_NORMALS_IN_VIEW ? unit3(stored)
                                                      : view_normal(frame, stored);
}

/* As much of a surface as others around it need. */
typedef struct near_surface {
    real depth;  /* m along the view axis */
    vec3 normal; /* view space, unit or 0 */
} near_surface;

TL_INLINE near_surface near_surface_of(const tl_frame *frame,
                                       tl_needs needs,
                                       const tl_layout *layout,
                                       const tl_words *words,
                                       real column,
                                       real row)
{
    near_surface s;
    s.depth = -position_of(frame, needs, layout, words, column, row).z;
    s.normal = normal_of(frame, layout, words);
    return s;
}

/* How a packed pixel is lit. rows: brdf_row.h. */
TL_INLINE surface unpacked_surface(const tl_frame *frame,
                                   tl_needs needs,
                                   const tl_layout *layout,
                                   const tl_words *words,
                                   tl_brdf_rows rows,
                                   real column,
                                   real row)
{
    const vec3 position = position_of(frame, needs, layout, words, column, row);
    const pixel in = pixel_of(needs, layout, words, -position.z);
    return surface_at(needs, position, normal_of(frame, layout, words),
                      substance_at(frame, needs, in, rows).shininess, in.specular.x);
}

#endif
