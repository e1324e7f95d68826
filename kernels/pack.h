/* From what a pixel shows to its words: unpack.h the other way. For the host, in double, so that what is
 * lost is what the layout loses. The geometry pass packs with the same formulas (encode.h). */
#ifndef TL_PACK_H
#define TL_PACK_H

#include "encode.h"
#include "unpack.h"

#if !TL_REAL_DOUBLE
#    error "packing is done in double"
#endif

/* A pixel, and where it is. */
typedef struct tl_packing {
    const tl_layout *layout;
    const tl_frame *frame; /* rays, view_from_world */
    tl_needs needs;        /* present: what is stored */
    double near, far;      /* m, of the camera */
    tl_words words;        /* what has been packed */
    tl_u32 cut; /* planes whose value was beyond what can be stored, bits 1 << plane */
} tl_packing;

/* Cut to [low, high]; says so where it was beyond, by more than rounding. */
TL_INLINE real cut_to(tl_packing *p, tl_u32 planes, real low, real high, real value)
{
    const real slack = R(1e-6) * (high - low);
    if (value < low - slack || value > high + slack)
        p->cut |= planes;
    return value < low ? low : value > high ? high : value;
}

/* value: cut to the range already; infinity is what is not finite in halves. */
TL_INLINE word32 half_of(real value)
{
    const real magnitude = value < R(0.0) ? -value : value;
    const word32 sign = value < R(0.0) ? 0x8000u : 0u;
    return sign |
           (magnitude > TL_MOST_HALF ? 0x7c00u
                                     : rounded_bits(REAL_AS_WORD(magnitude * 0x1p-112), 13u));
}

TL_INLINE word32 number_of(tl_packing *p, tl_channel c, tl_u32 planes, real value)
{
    const real finite =
        isinf(value) ? value : cut_to(p, planes, -TL_MOST_FLOAT, TL_MOST_FLOAT, value);
    if (c.number == TL_NUMBER_FLOAT)
        return REAL_AS_WORD(finite);
    if (c.number == TL_NUMBER_HALF)
        return half_of(isinf(value) ? value
                                    : cut_to(p, planes, -TL_MOST_HALF, TL_MOST_HALF, value));
    if (c.number == TL_NUMBER_FLOAT24) {
        p->cut |= value < R(0.0) ? planes : 0u;
        return value < R(0.0) ? 0u : rounded_bits(REAL_AS_WORD(finite), 7u);
    }
    if (c.number == TL_NUMBER_WHOLE)
        return whole_of(cut_to(p, planes, R(0.0), TO_REAL((1u << c.bits) - 1u), value));
    if (c.number == TL_NUMBER_SNORM)
        return snorm_bits(cut_to(p, planes, R(-1.0), R(1.0), value), c.bits);
    const word32 bits = unorm_bits(cut_to(p, planes, R(0.0), R(1.0), value), c.bits);
    return c.number == TL_NUMBER_BYTES24 ? swapped_bytes24(bits) : bits;
}

TL_INLINE void put_bits(tl_packing *p, tl_channel c, word32 bits)
{
    p->words.of[c.word] |= bits << c.shift;
}

TL_INLINE void put(tl_packing *p, tl_channel c, tl_u32 planes, real value)
{
    put_bits(p, c, number_of(p, c, planes, value));
}

/* first: the bit of the first of three planes, 0: none is named when cut. */
TL_INLINE void put_three(tl_packing *p, const tl_attribute *a, tl_u32 first, vec3 v)
{
    put(p, a->channels[0], first, v.x);
    put(p, a->channels[1], first << 1, v.y);
    put(p, a->channels[2], first << 2, v.z);
}

/* --- normals ----------------------------------------------------------------------------------- */

TL_INLINE void put_octahedron(tl_packing *p, const tl_attribute *a, vec3 v)
{
    const tl_channel first = a->channels[0], second = a->channels[1];
    const vec2 e = nearest_octahedron(v, (real)((1u << (first.bits - 1u)) - 1u));
    put(p, first, 0u, e.x);
    put(p, second, 0u, e.y);
}

/* v: unit, or 0: none; in the layout's space. */
TL_INLINE void put_direction(tl_packing *p, const tl_attribute *a, vec3 v)
{
    const int is_none = v.x == R(0.0) && v.y == R(0.0) && v.z == R(0.0);
    if (a->code == TL_NORMAL_XYZ && a->channels[0].number == TL_NUMBER_UNORM) {
        put_three(p, a, 0u, raised_normal(v));
    } else if (a->code == TL_NORMAL_XYZ) {
        put_three(p, a, 0u, v);
    } else if (a->code == TL_NORMAL_SPHEREMAP) {
        const vec2 e = spheremap_of(v);
        put(p, a->channels[0], 0u, is_none ? R(0.0) : e.x);
        put(p, a->channels[1], 0u, is_none ? R(0.0) : e.y);
    } else if (is_none) {
        put_bits(p, a->channels[0], none_bits(a->channels[0].bits));
    } else {
        put_octahedron(p, a, v);
    }
}

TL_INLINE void put_normal(tl_packing *p, vec3 v)
{
    put_direction(p, &p->layout->normal, v);
}

/* In world space in every layout that has a place for it. */
TL_INLINE void put_tangent(tl_packing *p, vec3 v)
{
    const tl_attribute *a = &p->layout->tangent;
    put_direction(p, a, a->channels[0].number == TL_NUMBER_FLOAT ? v : unit3(v));
}

/* --- depth and position ------------------------------------------------------------------------ */

/* Says so where a surface is off the depths of the camera, by more than rounding them: nearness itself
 * cannot tell, which far away hardly moves. */
TL_INLINE void note_depth(tl_packing *p, real depth)
{
    const real parallel = p->needs.orthographic ? p->far - p->near : R(0.0);
    const real before = R(1e-6) * (ABSOLUTE(p->near) + parallel);
    const real behind = R(1e-6) * (ABSOLUTE(p->far) + parallel);
    if (depth < p->near - before || depth > p->far + behind)
        p->cut |= TL_HAS(TL_DEPTH);
}

/* Of a surface, which is never written as sky: the last number before it is the far plane's. */
TL_INLINE real stored_nearness(const tl_packing *p, real depth)
{
    const tl_channel c = p->layout->depth.channels[0];
    const real q = nearness_at(depth, p->near, p->far, p->needs.orthographic != 0u);
    const real step = c.number == TL_NUMBER_FLOAT ? R(0x1p-24) : unorm_step(24u);
    if (p->layout->depth.code == TL_DEPTH_REVERSED)
        return q > R(0x1p-126) ? q : R(0x1p-126);
    return p->layout->depth.code == TL_DEPTH_FORWARD ? forward_of_nearness(q, step)
                                                     : ndc_of_nearness(q, step);
}

TL_INLINE vec3 world_point(const tl_frame *frame, vec3 view)
{
    real from[3], to[3];
    from[0] = view.x - (real)frame->view_from_world[0][3];
    from[1] = view.y - (real)frame->view_from_world[1][3];
    from[2] = view.z - (real)frame->view_from_world[2][3];
    for (int i = 0; i < 3; i++)
        to[i] = (real)frame->view_from_world[0][i] * from[0] +
                (real)frame->view_from_world[1][i] * from[1] +
                (real)frame->view_from_world[2][i] * from[2];
    const vec3 world = {to[0], to[1], to[2]};
    return world;
}

/* Of view or world; all three numbers are the plane of depth. */
TL_INLINE void put_position(tl_packing *p, vec3 at)
{
    const tl_channel *const channels = p->layout->depth.channels;
    put(p, channels[0], TL_HAS(TL_DEPTH), at.x);
    put(p, channels[1], TL_HAS(TL_DEPTH), at.y);
    put(p, channels[2], TL_HAS(TL_DEPTH), at.z);
}

TL_INLINE void put_depth(tl_packing *p, real depth, real column, real row)
{
    const tl_attribute *a = &p->layout->depth;
    const int is_sky = isinf(depth);
    if (TL_IS_POSITION(a->code)) {
        const vec3 sky = {(real)INFINITY, R(0.0), R(0.0)};
        const vec3 view = view_position(p->frame->rays, p->needs, column, row, depth);
        put_position(p, is_sky                              ? sky
                        : a->code == TL_DEPTH_VIEW_POSITION ? view
                                                            : world_point(p->frame, view));
    } else if (TL_IS_NEARNESS(a->code)) {
        const real sky = a->code == TL_DEPTH_REVERSED ? R(0.0) : R(1.0);
        if (!is_sky)
            note_depth(p, depth);
        put(p, a->channels[0], TL_HAS(TL_DEPTH), is_sky ? sky : stored_nearness(p, depth));
    } else if (a->code == TL_DEPTH_FRACTION) {
        put(p, a->channels[0], TL_HAS(TL_DEPTH), fraction_of_depth(depth, p->near, p->far));
    } else {
        put(p, a->channels[0], TL_HAS(TL_DEPTH), depth);
    }
}

/* --- colours and exponents ---------------------------------------------------------------------- */

TL_INLINE void put_shared(tl_packing *p, tl_u32 first, tl_channel c, vec3 color)
{
    const vec3 cut = {cut_to(p, first, R(0.0), TL_MOST_SHARED, color.x),
                      cut_to(p, first << 1, R(0.0), TL_MOST_SHARED, color.y),
                      cut_to(p, first << 2, R(0.0), TL_MOST_SHARED, color.z)};
    put_bits(p, c, shared_of(cut));
}

TL_INLINE void put_color(tl_packing *p, const tl_attribute *a, tl_u32 first, vec3 c)
{
    if (a->code == TL_COLOR_SHARED)
        put_shared(p, first, a->channels[0], c);
    else if (a->code == TL_COLOR_GRAY)
        put(p, a->channels[0], first * 7u, gray_of(c));
    else if (a->code == TL_COLOR_RGB)
        put_three(p, a, first, c);
    else
        put_three(p, a, first, roots_of(c));
}

TL_INLINE void put_shininess(tl_packing *p, real exponent)
{
    const tl_attribute *a = &p->layout->shininess;
    put(p, a->channels[0], TL_HAS(TL_SHININESS),
        a->code == TL_VALUE_LOGARITHM ? logarithm_of_shininess(exponent) : exponent);
}

/* --- pixels ------------------------------------------------------------------------------------- */

/* As the layout has it; floats keep its length. */
TL_INLINE vec3 normal_to_store(const tl_packing *p, vec3 world)
{
    if (p->layout->normal_space == TL_NORMALS_IN_VIEW)
        return view_normal(p->frame, world);
    return p->layout->normal.channels[0].number == TL_NUMBER_FLOAT ? world : unit3(world);
}

/* The words of a pixel at (column, row): p->words and p->cut start as 0. of.normal is in world space, of
 * any length; of planes that p->needs.present lacks nothing is read. */
TL_INLINE void pack_pixel(tl_packing *p, pixel of, real column, real row)
{
    const tl_layout *layout = p->layout;
    put_depth(p, of.depth, column, row);
    put_normal(p, normal_to_store(p, of.normal));
    put_color(p, &layout->albedo, TL_HAS(TL_ALBEDO_R), of.albedo);
    if (p->needs.present & TL_THREE(TL_SPECULAR_R))
        put_color(p, &layout->specular, TL_HAS(TL_SPECULAR_R), of.specular);
    if (p->needs.present & TL_HAS(TL_SHININESS))
        put_shininess(p, of.shininess);
    if (p->needs.present & TL_GROUP_METAL_ROUGH) {
        put(p, layout->metallic.channels[0], TL_HAS(TL_METALLIC), of.metallic);
        put(p, layout->roughness.channels[0], TL_HAS(TL_ROUGHNESS), of.roughness);
    }
    if (p->needs.present & TL_GROUP_OCCLUSION)
        put(p, layout->occlusion.channels[0], TL_HAS(TL_OCCLUSION), of.occlusion);
    if (p->needs.present & TL_GROUP_EMISSIVE)
        put_color(p, &layout->emissive, TL_HAS(TL_EMISSIVE_R), of.emissive);
    if (p->needs.present & TL_GROUP_BRDF)
        put(p, layout->brdf.channels[0], TL_HAS(TL_BRDF), of.brdf);
    if (p->needs.present & TL_GROUP_TANGENT)
        put_tangent(p, of.tangent);
}

#endif
