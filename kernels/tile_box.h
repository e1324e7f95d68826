/* What bounds the surfaces of a tile, how boxes stand in memory, and what lights reach them: one text
 * for rows of tiles (cull_rows.cl) and for work-groups (cull_tiles.cl), so both make the same lists.
 * OpenCL only. */
#ifndef TL_TILE_BOX_H
#define TL_TILE_BOX_H

#include "position.h"
#include "spot.h"

/* Six values per box, as planes of [tiles_y][box_pitch] scalars. */
enum { LOW_X, LOW_Y, LOW_Z, HIGH_X, HIGH_Y, HIGH_Z, VALUES };

typedef struct tile_box {
    scalar low[3], high[3]; /* as a box, for one tile */
} tile_box;

TL_INLINE tile_box empty_box(void)
{
    const tile_box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    return b;
}

TL_INLINE void include(real *low, real *high, mask covered, real value)
{
    *low = pick(covered & (value < *low), value, *low);
    *high = pick(covered & (value > *high), value, *high);
}

TL_INLINE void store_box(tile_box b, __global scalar *to, size_t plane)
{
    to[LOW_X * plane] = b.low[0];
    to[LOW_Y * plane] = b.low[1];
    to[LOW_Z * plane] = b.low[2];
    to[HIGH_X * plane] = b.high[0];
    to[HIGH_Y * plane] = b.high[1];
    to[HIGH_Z * plane] = b.high[2];
}

/* Deeper than wide and tall: surfaces that are apart, at an edge, or one seen at a grazing angle. Any
 * answer is right; it decides where a second box is worth its time. */
TL_INLINE int is_deep(tile_box b)
{
    const scalar wide = b.high[0] - b.low[0], tall = b.high[1] - b.low[1];
    return b.high[2] - b.low[2] > max(wide, tall);
}

/* Between the nearest and the farthest surface of the box. */
TL_INLINE scalar middle_depth(tile_box b)
{
    return R(-0.5) * (b.low[2] + b.high[2]);
}

TL_INLINE box load_boxes(__global const scalar *from, size_t plane)
{
    const vec3 low = {LOAD(from, LOW_X * plane), LOAD(from, LOW_Y * plane),
                      LOAD(from, LOW_Z * plane)};
    const vec3 high = {LOAD(from, HIGH_X * plane), LOAD(from, HIGH_Y * plane),
                       LOAD(from, HIGH_Z * plane)};
    const box b = {low, high};
    return b;
}

TL_INLINE mask light_meets_box(tl_view_light light, tl_view_spot spot, box of)
{
    const mask reached = reaches_box(light, of);
    if (!needs_of_build().spots || !any_lane(reached))
        return reached;
    return reached & cone_meets_box(spot, light, of);
}

/* Which of TL_WIDTH tiles from `tile` on, in a row of tiles, the light may reach; its rectangle has
 * the columns [x0, x1). row_boxes: of the row's first tile. */
TL_INLINE mask reached_tiles(const tl_frame *frame,
                             __global const scalar *row_boxes,
                             tl_view_light light,
                             tl_view_spot spot,
                             uint tile,
                             int x0,
                             int x1)
{
    const size_t plane = (size_t)frame->tiles_y * frame->box_pitch;
    const real index = (scalar)tile + LANE_INDEX;
    const mask in_rect = (index >= (real)(scalar)x0) & (index < (real)(scalar)x1);
    if (frame->box_count == 0)
        return in_rect;
    const box near = load_boxes(row_boxes + tile, plane);
    mask reached = light_meets_box(light, spot, near);
    if (frame->box_count > 1) {
        const box far = load_boxes(row_boxes + VALUES * plane + tile, plane);
        if (any_lane(far.low.x <= far.high.x))
            reached = reached | light_meets_box(light, spot, far);
    }
    return in_rect & reached;
}

/* Takes `length` entries of the list; where they start, or UINT_MAX where they do not fit. */
TL_INLINE uint take_list(volatile __global uint *list_end, ulong length, uint capacity)
{
    uint end = atomic_or(list_end, 0u), seen; /* a plain load would race with the others */
    do {
        if (length > capacity || end > capacity - (uint)length)
            return UINT_MAX;
        seen = end;
        end = atomic_cmpxchg(list_end, seen, seen + (uint)length);
    } while (end != seen);
    return end;
}

#endif
