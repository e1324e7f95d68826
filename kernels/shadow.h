/* What of a light arrives: the share of it that nothing stands before, by its shadow map (shadow_code.h).
 *
 * Percentage-closer filtering: Reeves, Salesin and Cook, "Rendering Antialiased Shadows with Depth Maps",
 * SIGGRAPH 1987. Each texel under a square of `filter` texels around the surface's place is compared, and
 * what is lit of them counts by the area that the square covers of it: so the share is continuous in the
 * place, and changes by 1/filter per texel at most.
 *
 * Which surface is before which. A texel tells of its centre c, a surface point of its own place p up to
 * (filter + 1)/2 texels away each way, and between the two a surface that shadows nothing may rise. With
 * depths that are larger nearer to the light, and affine over a plane (shadow_code.h), let the texel's
 * surface have slope g and the point's own slope h, per texel. A surface that runs from c to p on these
 * two planes falls by at most
 *
 *     b = -min(0, g.(p - c), h.(p - c)),
 *
 * for it follows one for a part of the way and the other for the rest. So the point is in the texel's
 * shadow only where it is deeper than the texel's depth less b; on one plane, at a fold between two, and on a
 * curved surface, that is never by itself. That is the slope-scaled bias, of the true slope of what
 * stands in the light (which the map has), and only in the direction in which it falls: where the two slopes
 * are opposite it leaves a gap of a texel's width at most.
 *
 * The point's own slope has five values: that of its normal, which normal maps and smooth shading turn away
 * from its triangle's, and those of the four texels whose centres are around it, one of which is of its
 * triangle where that is wider than a texel. h.(p - c) is the least of theirs.
 *
 * What rounding needs beside that:
 *
 *   1. Places of surfaces, in the map and in the G-buffer, are off by metres: `slack` with what is known of
 *      both. The point is moved out along its normal by as much, which is 1/cos of it towards the light.
 *   2. Places in the map are off by parts of a texel: those of corners are rounded to 1/256 of one by the
 *      rasteriser, and depth between them is off by 4u of a map's size in texels, as is the place
 *      that is looked up (u = 2^-24): 2^-9 + 2^-9 for maps up to 4096. Slopes are halves, off by 2^-11 of
 *      themselves. TL_SHADOW_PLACE of a slope allows for it all.
 *   3. Depths themselves are off by u of what they are a share of, when stored; looked up, by 9u for the
 *      sum of products ahead (in the corner of a cube's view |v| is 1.8 of what is ahead), 6u for quotient
 *      and product on devices: TL_SHADOW_DEPTH.
 *
 * Beyond that, what folds within a texel has slopes that no texel's centre tells of: the point is moved
 * towards the light by TL_SHADOW_OFFSET texels. Not along its normal, which would take it through the other
 * side of a corner.
 *
 * The slope of a normal grows beyond bounds towards grazing angles, and so would b; from TL_SHADOW_GRAZING on
 * it is cut, for there is little light to lose, and the texels around still tell the true one.
 *
 * tests/test_shadow_formulas.c has planes, folds and edges at every angle; tests/test_shadow_rays.c
 * holds whole scenes against rays. */
#ifndef TL_SHADOW_H
#define TL_SHADOW_H

#include "frame.h"
#include "number.h"
#include "shadow_code.h"
#include "surface.h"

#define TL_SHADOW_PLACE R(0x1p-7)   /* texels */
#define TL_SHADOW_DEPTH R(0x1p-19)  /* 32u; of the depth, or in parallel maps of all of it */
#define TL_SHADOW_GRAZING R(0x1p-4) /* cosine */

/* The side of a cube that a direction meets, lane by lane: along one of its axes or against it. */
typedef struct cube_side {
    mask along_x, along_y; /* else along z */
    real sign;
    real view; /* the index of its view: 2 axis, or 1 more against it */
} cube_side;

TL_INLINE cube_side cube_side_of(mask along_x, mask along_y, mask against)
{
    cube_side side;
    side.along_x = along_x;
    side.along_y = along_y;
    side.sign = pick(against, R(-1.0), R(1.0));
    side.view =
        pick(along_x, R(0.0), pick(along_y, R(2.0), R(4.0))) + pick(against, R(1.0), R(0.0));
    return side;
}

TL_INLINE cube_side side_met_by(vec3 v)
{
    const real x = ABSOLUTE(v.x), y = ABSOLUTE(v.y), z = ABSOLUTE(v.z);
    const mask along_x = (x >= y) & (x >= z), along_y = (y > x) & (y >= z);
    return cube_side_of(along_x, along_y, pick(along_x, v.x, pick(along_y, v.y, v.z)) < R(0.0));
}

/* v, along the axes of the cube, as right, down and ahead of a side's view: of axis k those are the axes
 * behind it, k + 1 and k + 2, and itself; the last two are turned with the sign. */
TL_INLINE vec3 seen_from_side(cube_side side, vec3 v)
{
    const vec3 seen = {
        pick(side.along_x, v.y, pick(side.along_y, v.z, v.x)),
        side.sign * pick(side.along_x, v.z, pick(side.along_y, v.x, v.y)),
        side.sign * pick(side.along_x, v.x, pick(side.along_y, v.y, v.z)),
    };
    return seen;
}

/* Where a surface point is in a map, and the depth of its plane there. */
typedef struct shadow_place {
    real x, y;                     /* texels from the view's upper left corner */
    real depth;                    /* as texels have it */
    real slope_x, slope_y;         /* what that changes by, per texel */
    real around_x[4], around_y[4]; /* the same, of the texels around it */
    real view;                     /* of a cube's */
    mask inside;                   /* the view has all that the filter needs */
} shadow_place;

TL_INLINE vec3 along_rows(tl_view_shadow map, vec3 v)
{
    const vec3 right = {(real)map.right[0], (real)map.right[1], (real)map.right[2]};
    const vec3 down = {(real)map.down[0], (real)map.down[1], (real)map.down[2]};
    const vec3 ahead = {(real)map.ahead[0], (real)map.ahead[1], (real)map.ahead[2]};
    const vec3 along = {dot3(v, right), dot3(v, down), dot3(v, ahead)};
    return along;
}

/* The place of v, as the map's view sees it, on a plane whose normal that sees as n. facing: above 0, as far
 * as light is to arrive. */
TL_INLINE shadow_place place_in_view(tl_view_shadow map, vec3 v, vec3 n, real facing, real view)
{
    const real margin = (real)(R(0.5) * (scalar)map.filter + R(1.0));
    const real end = (real)((scalar)map.size) - margin;
    const real middle = (real)(R(0.5) * (scalar)map.size);
    const real steepness = pick(facing > R(0.0), R(-1.0) / facing, R(0.0));
    shadow_place at;
    if (map.kind == TL_SHADOW_PARALLEL) {
        at.x = v.x + map.right_at;
        at.y = v.y + map.down_at;
        at.depth = v.z + map.ahead_at;
    } else {
        const real per_ahead = pick(v.z > R(0.0), R(1.0) / v.z, R(0.0));
        at.x = FMA(v.x * per_ahead, map.scale, map.right_at);
        at.y = FMA(v.y * per_ahead, map.scale, map.down_at);
        at.depth = per_ahead * map.near;
    }
    at.slope_x = n.x * map.slope_x * steepness;
    at.slope_y = n.y * map.slope_y * steepness;
    at.view = view;
    at.inside =
        (at.x > margin) & (at.x < end) & (at.y > margin) & (at.y < end) & (at.depth > R(0.0));
    at.x = pick(at.inside, at.x, middle);
    at.y = pick(at.inside, at.y, middle);
    return at;
}

/* v: of perspective maps from the light to the surface, of parallel ones the position. */
TL_INLINE shadow_place place_in_shadow(tl_view_shadow map, vec3 v, vec3 normal, real facing)
{
    const vec3 along = along_rows(map, v), n = along_rows(map, normal);
    if (map.kind != TL_SHADOW_CUBE)
        return place_in_view(map, along, n, facing, R(0.0));
    const cube_side side = side_met_by(along);
    return place_in_view(map, seen_from_side(side, along), seen_from_side(side, n), facing,
                         side.view);
}

/* A texel's depth, and what that changes by. */
typedef struct shadow_texel {
    real depth, slope_x, slope_y;
} shadow_texel;

/* Of what depths and slopes are shares. */
TL_INLINE real shadow_unit(tl_view_shadow map, real depth)
{
    return map.kind == TL_SHADOW_PARALLEL ? (real)R(1.0) : depth;
}

TL_INLINE shadow_texel texel_of_shadow(tl_view_shadow map, tl_numbers texels, integer i)
{
    shadow_texel texel;
    texel.depth = GATHER(texels, i * 2);
    const word32 slopes = GATHER_WORDS(texels, i * 2 + 1);
    const real per_slope =
        shadow_unit(map, texel.depth) * (real)(R(1.0) / (scalar)TL_SLOPE_SCALE);
    texel.slope_x = value_of_half(slopes, 0u) * per_slope;
    texel.slope_y = value_of_half(slopes, 16u) * per_slope;
    return texel;
}

TL_INLINE tl_numbers texels_of_shadow(tl_numbers numbers, tl_view_shadow map)
{
    return numbers + (size_t)map.texels_at * 4;
}

/* The index of a texel of the place's view. */
TL_INLINE integer shadow_index(tl_view_shadow map, shadow_place at, integer column, integer row)
{
    const integer size = (integer)(int)map.size;
    return (TO_INTEGER(at.view) * size + row) * size + column;
}

/* The place with the slopes around it: of the four texels whose centres are around (x, y). */
TL_INLINE shadow_place
with_slopes_around(tl_numbers numbers, tl_view_shadow map, shadow_place at, real x, real y)
{
    const tl_numbers texels = texels_of_shadow(numbers, map);
    const integer first = shadow_index(map, at, TO_INTEGER(x - R(0.5)), TO_INTEGER(y - R(0.5)));
    for (int k = 0; k < 4; k++) {
        const integer i = first + (integer)((k >> 1) * (int)map.size + (k & 1));
        const shadow_texel texel = texel_of_shadow(map, texels, i);
        at.around_x[k] = texel.slope_x;
        at.around_y[k] = texel.slope_y;
    }
    return at;
}

/* What texel i of the map leaves lit of a place that is (x, y) away from its centre. off: parts of a texel
 * beyond TL_SHADOW_PLACE by which the place may be off. */
TL_INLINE mask is_before_texel(tl_view_shadow map,
                               tl_numbers texels,
                               integer i,
                               shadow_place at,
                               real x,
                               real y,
                               scalar off)
{
    const shadow_texel texel = texel_of_shadow(map, texels, i);
    const real by_texel = FMA(texel.slope_x, x, texel.slope_y * y);
    const real by_place = FMA(at.slope_x, x, at.slope_y * y);
    real lower = pick(by_texel < by_place, by_texel, by_place);
    for (int k = 0; k < 4; k++) {
        const real around = FMA(at.around_x[k], x, at.around_y[k] * y);
        lower = pick(around < lower, around, lower);
    }
    const real fall = pick(lower < R(0.0), lower, R(0.0));
    const real rough =
        (ABSOLUTE(texel.slope_x) + ABSOLUTE(texel.slope_y)) * (TL_SHADOW_PLACE + off);
    const real least = texel.depth + fall * (R(1.0) + TL_SHADOW_PLACE) - rough -
                       shadow_unit(map, texel.depth) * TL_SHADOW_DEPTH;
    return !(at.depth < least) | !(texel.depth > R(0.0));
}

/* How much of a row or column of texels a filter covers: all, but for the first and the last. */
TL_INLINE real covered(tl_u32 i, tl_u32 filter, real part)
{
    return i == 0u ? (real)R(1.0) - part : i == filter ? part : (real)R(1.0);
}

/* The share of light at a place with slopes around it, exactly 0 and exactly 1 where texels agree. numbers:
 * the buffer of lights. */
TL_INLINE real share_at(tl_numbers numbers, tl_view_shadow map, shadow_place at, scalar off)
{
    const tl_numbers texels = texels_of_shadow(numbers, map);
    const real half_width = (real)(R(0.5) * (scalar)map.filter);
    const integer column = TO_INTEGER(at.x - half_width), row = TO_INTEGER(at.y - half_width);
    const real part_x = at.x - half_width - TO_REAL(column);
    const real part_y = at.y - half_width - TO_REAL(row);
    const integer size = (integer)(int)map.size;
    const integer first = shadow_index(map, at, column, row);
    real dark = R(0.0);
    mask any_lit = !at.inside;
    for (tl_u32 j = 0; j <= map.filter; j++)
        for (tl_u32 i = 0; i <= map.filter; i++) {
            const integer texel = first + (integer)(int)j * size + (integer)(int)i;
            const mask lit = is_before_texel(map, texels, texel, at,
                                             at.x - TO_REAL(column) - ((scalar)i + R(0.5)),
                                             at.y - TO_REAL(row) - ((scalar)j + R(0.5)), off);
            const real area = covered(i, map.filter, part_x) * covered(j, map.filter, part_y);
            dark = dark + pick(lit, R(0.0), area);
            any_lit = any_lit | lit;
        }
    const real left =
        (real)R(1.0) - dark * (real)(R(1.0) / ((scalar)map.filter * (scalar)map.filter));
    const real share = pick(left > R(0.0), left, R(0.0));
    return pick(at.inside, pick(any_lit, share, R(0.0)), R(1.0));
}

/* Where the surface's point is looked up: moved out along its normal by what places may be off, and
 * towards the light by TL_SHADOW_OFFSET. l: to the light, m, or of a directional light its direction. */
TL_INLINE vec3 shadowed_point(tl_view_shadow map, surface s, vec3 l)
{
    const real depth = -s.position.z;
    const real off =
        FMA(depth, FMA(depth, map.slack_per_depth2, map.slack_per_depth), map.slack);
    const vec3 from_light = {-l.x, -l.y, -l.z};
    const vec3 place = map.kind == TL_SHADOW_PARALLEL ? s.position : from_light;
    return fma3(s.normal, off, fma3(l, (real)map.offset, place));
}

/* n.l, times the distance as `facing` is, cut at grazing angles. */
TL_INLINE real facing_shadow(real facing, real distance)
{
    const real least = distance * TL_SHADOW_GRAZING;
    const real cut = pick(facing > least, facing, least);
    return pick(facing > R(0.0), cut, R(0.0));
}

/* The share of a light in direction l, of this length, that arrives. facing: n.l. */
TL_INLINE real unshadowed_share(
    tl_numbers numbers, tl_view_shadow map, surface s, vec3 l, real distance, real facing)
{
    const shadow_place at = place_in_shadow(map, shadowed_point(map, s, l), s.normal,
                                            facing_shadow(facing, distance));
    return share_at(numbers, map, with_slopes_around(numbers, map, at, at.x, at.y), R(0.0));
}

TL_INLINE tl_view_shadow shadow_behind(tl_numbers numbers, tl_u32 shadow_at)
{
    return *(TL_GLOBAL const tl_view_shadow *)(numbers + (size_t)shadow_at * 4);
}

#endif
