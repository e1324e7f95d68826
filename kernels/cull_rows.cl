/* Culling: one work-item per row of tiles, vectors of tiles, lists in index order.
 *
 * A row's work-item is alone in writing its tiles' lists, so there are no atomics, and lights
 * are appended in index order because that is the order of the loop. A list cannot overflow: the
 * same kernel runs twice, first counting, then writing where the counts say, and the two passes
 * cannot disagree about a light because they are one text. The invariant that makes a light
 * never lost to rounding is in reach.h; rectangles (tile_rect.h) come before it. */
#include "position.h"
#include "reach.h"
#include "tile_rect.h"

/* Six values per box, as planes of [tiles_y][box_pitch] scalars. */
enum { LOW_X, LOW_Y, LOW_Z, HIGH_X, HIGH_Y, HIGH_Z };

#define MIN_HALVES(v) min((v).lo, (v).hi)
#define MAX_HALVES(v) max((v).lo, (v).hi)

TL_INLINE box cube(scalar low, scalar high)
{
    const box b = {{low, low, low}, {high, high, high}};
    return b;
}

TL_INLINE void include(real *low, real *high, mask covered, real value)
{
    *low = pick(covered & (value < *low), value, *low);
    *high = pick(covered & (value > *high), value, *high);
}

/* One box per lane; together they hold every position shade_tiles will compute in the tile. */
TL_INLINE box boxes_of_tile(const tl_frame *frame,
                            __global const float *depths,
                            uint column0,
                            uint row0)
{
    const tl_needs needs = needs_of_build();
    box b = cube(INFINITY, -INFINITY);
    for (uint row = row0; row < row0 + frame->tile_size; row++) {
        for (uint column = column0; column < column0 + frame->tile_size; column += TL_WIDTH) {
            const real depth =
                LOAD(depths, (size_t)(frame->buffer_row + row) * frame->pitch + column);
            const vec3 p = view_position(frame->rays, needs, (scalar)column + LANE_INDEX,
                                         (scalar)(frame->first_row + row), depth);
            const mask covered = depth < (real)INFINITY;
            include(&b.low.x, &b.high.x, covered, p.x);
            include(&b.low.y, &b.high.y, covered, p.y);
            include(&b.low.z, &b.high.z, covered, p.z);
        }
    }
    return b;
}

/* surface   [rows][pitch], m: the plane TL_DEPTH
 * boxes   [6][tiles_y][box_pitch], written in full; empty beyond the last tile of a row
 * depths  [tiles_y][2]: least and largest depth in the row, INFINITY and -INFINITY if all sky
 * Global size: tiles_y. */
__kernel void bound_rows(const tl_frame frame,
                         __global const float *restrict surface,
                         __global scalar *restrict boxes,
                         __global float *restrict depths)
{
    const uint tile_row = get_global_id(0);
    const size_t plane = (size_t)frame.tiles_y * frame.box_pitch;
    scalar near = INFINITY, far = -INFINITY;

    for (uint tile = 0; tile < frame.box_pitch; tile++) {
        box b = cube(INFINITY, -INFINITY);
        if (tile < frame.tiles_x)
            b = boxes_of_tile(&frame, surface, tile * frame.tile_size,
                              tile_row * frame.tile_size);
        __global scalar *to = boxes + (size_t)tile_row * frame.box_pitch + tile;
        const scalar low_z = FOLD(MIN_HALVES, b.low.z), high_z = FOLD(MAX_HALVES, b.high.z);
        to[LOW_X * plane] = FOLD(MIN_HALVES, b.low.x);
        to[LOW_Y * plane] = FOLD(MIN_HALVES, b.low.y);
        to[LOW_Z * plane] = low_z;
        to[HIGH_X * plane] = FOLD(MAX_HALVES, b.high.x);
        to[HIGH_Y * plane] = FOLD(MAX_HALVES, b.high.y);
        to[HIGH_Z * plane] = high_z;
        near = min(near, -high_z);
        far = max(far, -low_z);
    }
    depths[2 * tile_row] = (float)near;
    depths[2 * tile_row + 1] = (float)far;
}

/* Appends light i to the lists of the tiles in `met`; counts only where there is no list. */
TL_INLINE void append(mask met, __global uint *end, __global uint *list, uint i)
{
    int met_by[TL_WIDTH];
    STORE_MASK(met, met_by);
    for (uint lane = 0; lane < TL_WIDTH; lane++) {
        if (met_by[lane] == 0)
            continue;
        const uint at = end[lane]++;
        if (list)
            list[at] = i;
    }
}

/* The lists of the tiles [x0, x1) of a row, as far as light i reaches them. */
TL_INLINE void list_light(const tl_frame *frame,
                          __global const scalar *row_boxes,
                          tl_view_light light,
                          uint i,
                          int x0,
                          int x1,
                          __global uint *row_ends,
                          __global uint *list)
{
    const size_t plane = (size_t)frame->tiles_y * frame->box_pitch;
    for (uint tile = (uint)x0 / TL_WIDTH * TL_WIDTH; tile < (uint)x1; tile += TL_WIDTH) {
        const real index = (scalar)tile + LANE_INDEX;
        mask met = (index >= (real)(scalar)x0) & (index < (real)(scalar)x1);
        if (frame->cull_depth) {
            __global const scalar *from = row_boxes + tile;
            const vec3 low = {LOAD(from, LOW_X * plane), LOAD(from, LOW_Y * plane),
                              LOAD(from, LOW_Z * plane)};
            const vec3 high = {LOAD(from, HIGH_X * plane), LOAD(from, HIGH_Y * plane),
                               LOAD(from, HIGH_Z * plane)};
            const box tiles = {low, high};
            met = met & reaches_box(light, tiles);
        }
        if (any_lane(met))
            append(met, row_ends + tile, list, i);
    }
}

/* Which of the lights [first, first + LIGHTS_AT_ONCE) have a rectangle in this row. */
#define LIGHTS_AT_ONCE 16
#define OR_INT_HALVES(v) ((v).lo | (v).hi)
TL_INLINE int any_in_row(__global const int *rects, uint pitch, uint first, int tile_row)
{
    const int16 y0 = vload16(0, rects + TL_RECT_Y0 * pitch + first);
    const int16 y1 = vload16(0, rects + TL_RECT_Y1 * pitch + first);
    const int16 in_row = (y0 <= tile_row) & (y1 > tile_row);
    const int4 quarter = OR_INT_HALVES(OR_INT_HALVES(in_row));
    return (quarter.x | quarter.y | quarter.z | quarter.w) != 0;
}

/* boxes   as bound_rows leaves them
 * lights  [light_count]; rects as light_rects leaves them
 * ends    [tiles_y * tiles_x]. Counting (list is NULL): becomes the length of each tile's list.
 *         Listing: is where each list starts and becomes where it ends.
 * list    indices of lights, ascending within a tile
 * Global size: tiles_y. */
__kernel void list_rows(const tl_frame frame,
                        __global const scalar *restrict boxes,
                        __global const tl_view_light *restrict lights,
                        __global const int *restrict rects,
                        __global uint *restrict ends,
                        __global uint *restrict list)
{
    const int tile_row = (int)get_global_id(0);
    const uint pitch = TL_RECT_PITCH(frame.light_count);
    __global const scalar *row_boxes = boxes + (size_t)tile_row * frame.box_pitch;
    __global uint *row_ends = ends + (size_t)tile_row * frame.tiles_x;

    for (uint tile = 0; !list && tile < frame.tiles_x; tile++)
        row_ends[tile] = 0;
    for (uint first = 0; first < frame.light_count; first += LIGHTS_AT_ONCE) {
        if (!any_in_row(rects, pitch, first, tile_row))
            continue;
        for (uint i = first; i < first + LIGHTS_AT_ONCE; i++)
            if (rects[TL_RECT_Y0 * pitch + i] <= tile_row &&
                rects[TL_RECT_Y1 * pitch + i] > tile_row)
                list_light(&frame, row_boxes, lights[i], i, rects[TL_RECT_X0 * pitch + i],
                           rects[TL_RECT_X1 * pitch + i], row_ends, list);
    }
}
