/* Culling on a GPU: a work-group of TL_GROUP per tile, after one per cell of TL_CELL x TL_CELL tiles
 * where there are many lights.
 *
 * A group tests TL_GROUP lights at a time and keeps their order: each that is met sets its bit, and
 * its place is how many bits are set below it. So lists are the ones that cull_rows.cl makes. As
 * there, the lights are walked over twice, for the length and for the list, and between the two the
 * group takes its part of what all share; if that is too short it writes nothing, and the host sees
 * it from the counts.
 *
 * Barriers stand only where all work-items of a group come to them: loops have the same bounds for
 * all, and branches around a barrier depend on nothing that differs. */
#include "load_pixel.h"
#include "options.h"
#include "tile_box.h"
#include "tile_rect.h"

#if TL_BY_PIXEL

#    define GROUP_WORDS (TL_GROUP / 32)

/* The smallest and the largest of each value of the group's boxes; `all` is [6][TL_GROUP]. Ends with
 * a barrier, so that `all` may be used again. */
TL_INLINE tile_box join_boxes(tile_box mine, __local scalar *all)
{
    const uint item = get_local_id(0);
    for (uint axis = 0; axis < 3; axis++) {
        all[(LOW_X + axis) * TL_GROUP + item] = mine.low[axis];
        all[(HIGH_X + axis) * TL_GROUP + item] = mine.high[axis];
    }
    for (uint half_size = TL_GROUP / 2; half_size > 0; half_size /= 2) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < half_size)
            for (uint axis = 0; axis < 3; axis++) {
                __local scalar *low = all + (LOW_X + axis) * TL_GROUP + item;
                __local scalar *high = all + (HIGH_X + axis) * TL_GROUP + item;
                *low = min(low[0], low[half_size]);
                *high = max(high[0], high[half_size]);
            }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    tile_box joined;
    for (uint axis = 0; axis < 3; axis++) {
        joined.low[axis] = all[(LOW_X + axis) * TL_GROUP];
        joined.high[axis] = all[(HIGH_X + axis) * TL_GROUP];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    return joined;
}

/* The box of every position that shading computes in the tile where above < depth <= up_to. */
TL_INLINE tile_box box_of_tile(const tl_frame *frame,
                               __global const uchar *planes,
                               uint tile,
                               scalar above,
                               scalar up_to,
                               __local scalar *all)
{
    const tl_needs needs = needs_of_build();
    const tl_layout layout = layout_of_build();
    const size_t plane_size = (size_t)frame->rows * frame->pitch;
    const uint column0 = tile % frame->tiles_x * frame->tile_size;
    const uint row0 = tile / frame->tiles_x * frame->tile_size;
    tile_box b = empty_box();
    for (uint i = get_local_id(0); i < frame->tile_size * frame->tile_size; i += TL_GROUP) {
        const uint column = column0 + i % frame->tile_size, row = row0 + i / frame->tile_size;
        const tl_words words =
            load_words(&layout, planes, plane_size,
                       (size_t)(frame->buffer_row + row) * frame->pitch + column, frame->pitch);
        const vec3 p = position_of(frame, needs, &layout, &words, (scalar)column,
                                   (scalar)(frame->first_row + row));
        const mask within = -p.z > above && -p.z <= up_to;
        include(&b.low[0], &b.high[0], within, p.x);
        include(&b.low[1], &b.high[1], within, p.y);
        include(&b.low[2], &b.high[2], within, p.z);
    }
    return join_boxes(b, all);
}

/* planes   the frame's word planes, of which positions are read
 * boxes    [2][6][tiles_y][box_pitch], written for every tile
 * Global size: TL_GROUP * tiles_x * tiles_y, in groups of TL_GROUP. */
__kernel void bound_tiles(const tl_frame frame,
                          __global const uchar *restrict planes,
                          __global scalar *restrict boxes)
{
    __local scalar all[VALUES * TL_GROUP];
    const uint tile = get_group_id(0);
    const size_t plane = (size_t)frame.tiles_y * frame.box_pitch;
    __global scalar *to =
        boxes + (size_t)(tile / frame.tiles_x) * frame.box_pitch + tile % frame.tiles_x;
    tile_box near = box_of_tile(&frame, planes, tile, -INFINITY, MAXFLOAT, all);
    tile_box far = empty_box();
    if (frame.box_count > 1 && is_deep(near)) {
        const scalar middle = middle_depth(near);
        far = box_of_tile(&frame, planes, tile, middle, MAXFLOAT, all);
        near = box_of_tile(&frame, planes, tile, -INFINITY, middle, all);
    }
    if (get_local_id(0) == 0) {
        store_box(near, to, plane);
        store_box(far, to + VALUES * plane, plane);
    }
}

/* How many of the group's work-items before this one are met; *count grows by all that are. */
TL_INLINE uint rank_in_group(int met, __local uint *words, uint *count)
{
    const uint item = get_local_id(0);
    uint rank = 0, sum = 0;
    if (item < GROUP_WORDS)
        words[item] = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (met)
        atomic_or(&words[item / 32], 1u << item % 32);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint word = 0; word < GROUP_WORDS; word++) {
        const uint bits = words[word];
        if (word == item / 32)
            rank = sum + popcount(bits & ((1u << item % 32) - 1));
        sum += popcount(bits);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    *count += sum;
    return rank;
}

/* Where the group's `length` entries start, the same for all its work-items. */
TL_INLINE uint take_list_in_group(volatile __global uint *list_end,
                                  uint length,
                                  uint capacity,
                                  __local uint *shared)
{
    if (get_local_id(0) == 0)
        *shared = take_list(list_end, length, capacity);
    barrier(CLK_LOCAL_MEM_FENCE);
    return *shared;
}

/* Whether light i has a rectangle that touches the tiles [x0, x1) x [y0, y1). */
TL_INLINE int meets_tiles(
    __global const int *rects, uint pitch, uint i, int x0, int x1, int y0, int y1)
{
    return rects[TL_RECT_X0 * pitch + i] < x1 && rects[TL_RECT_X1 * pitch + i] > x0 &&
           rects[TL_RECT_Y0 * pitch + i] < y1 && rects[TL_RECT_Y1 * pitch + i] > y0;
}

/* Whether light i of the cell is to be listed. */
TL_INLINE int meets_cell(const tl_frame *frame, __global const int *rects, uint i, uint cell)
{
    const uint cells_x = TL_CELLS(frame->tiles_x);
    const int x = (int)(cell % cells_x * TL_CELL), y = (int)(cell / cells_x * TL_CELL);
    return meets_tiles(rects, TL_RECT_PITCH(frame->light_count), i, x, x + TL_CELL, y,
                       y + TL_CELL);
}

/* Whether light i of the tile is to be listed. */
TL_INLINE int meets_tile(const tl_frame *frame,
                         __global const int *rects,
                         __global const tl_view_light *lights,
                         __global const scalar *boxes,
                         uint i,
                         uint tile)
{
    const uint pitch = TL_RECT_PITCH(frame->light_count);
    const uint x = tile % frame->tiles_x, y = tile / frame->tiles_x;
    return meets_tiles(rects, pitch, i, (int)x, (int)x + 1, (int)y, (int)y + 1) &&
           reached_tiles(frame, boxes + (size_t)y * frame->box_pitch, lights[i],
                         spot_of(needs_of_build(), lights, frame->light_count, i), x,
                         rects[TL_RECT_X0 * pitch + i], rects[TL_RECT_X1 * pitch + i]);
}

/* rects     as light_rects leaves them
 * cells     [3][cells]: where each cell's list starts, where it ends, its length; start and end are 0
 *           where the lists do not fit
 * list_end  [2]: the second is 0, becomes where the last list of a cell ends
 * list      [cell_capacity], indices of lights, ascending within a cell
 * Global size: TL_GROUP * cells, in groups of TL_GROUP. */
__kernel void list_cells(const tl_frame frame,
                         __global const int *restrict rects,
                         __global uint *restrict cells,
                         volatile __global uint *restrict list_end,
                         __global uint *restrict list)
{
    __local uint words[GROUP_WORDS], shared;
    const uint cell = get_group_id(0), cell_count = get_num_groups(0);
    uint length = 0;
    for (uint first = 0; first < frame.light_count; first += TL_GROUP) {
        const uint i = first + get_local_id(0);
        rank_in_group(i < frame.light_count && meets_cell(&frame, rects, i, cell), words,
                      &length);
    }
    const uint start = take_list_in_group(list_end + 1, length, frame.cell_capacity, &shared);
    const int fits = start != UINT_MAX;
    if (get_local_id(0) == 0) {
        cells[cell] = fits ? start : 0;
        cells[cell_count + cell] = fits ? start + length : 0;
        cells[2 * cell_count + cell] = length;
    }
    uint end = start;
    for (uint first = 0; fits && first < frame.light_count; first += TL_GROUP) {
        const uint i = first + get_local_id(0), before = end;
        const int met = i < frame.light_count && meets_cell(&frame, rects, i, cell);
        const uint rank = rank_in_group(met, words, &end);
        if (met)
            list[before + rank] = i;
    }
}

/* lights    [light_count], and behind them the tl_view_spots of scenes with spots
 * rects     as light_rects leaves them
 * boxes     as bound_tiles leaves them
 * cells, cell_list  as list_cells leaves them; not read unless frame.has_cells
 * counts    [tiles_y][box_pitch], written for every tile: lengths of lists
 * starts, ends  [tiles_y * tiles_x]: where each tile's list stands; of no meaning if the counts add
 *           up to more than frame.list_capacity
 * list_end  [2]: the first is 0, becomes where the last list of a tile ends
 * list      [list_capacity], indices of lights, ascending within a tile
 * Global size: TL_GROUP * tiles_x * tiles_y, in groups of TL_GROUP. */
__kernel void list_tiles(const tl_frame frame,
                         __global const tl_view_light *restrict lights,
                         __global const int *restrict rects,
                         __global const scalar *restrict boxes,
                         __global const uint *restrict cells,
                         __global const uint *restrict cell_list,
                         __global int *restrict counts,
                         __global uint *restrict starts,
                         __global uint *restrict ends,
                         volatile __global uint *restrict list_end,
                         __global uint *restrict list)
{
    __local uint words[GROUP_WORDS], shared;
    const uint tile = get_group_id(0);
    const uint x = tile % frame.tiles_x, y = tile / frame.tiles_x;
    const uint cells_x = TL_CELLS(frame.tiles_x);
    const uint cell = y / TL_CELL * cells_x + x / TL_CELL;
    uint from = 0, to = frame.light_count, length = 0;
    if (frame.has_cells) {
        from = cells[cell];
        to = cells[cells_x * TL_CELLS(frame.tiles_y) + cell];
    }
    for (uint first = from; first < to; first += TL_GROUP) {
        const uint at = first + get_local_id(0);
        int met = 0;
        if (at < to)
            met = meets_tile(&frame, rects, lights, boxes, frame.has_cells ? cell_list[at] : at,
                             tile);
        rank_in_group(met, words, &length);
    }
    const uint start = take_list_in_group(list_end, length, frame.list_capacity, &shared);
    if (get_local_id(0) == 0) {
        counts[y * frame.box_pitch + x] = (int)length;
        starts[tile] = start;
        ends[tile] = start + length;
    }
    uint end = start;
    for (uint first = from; start != UINT_MAX && first < to; first += TL_GROUP) {
        const uint at = first + get_local_id(0), before = end;
        uint i = 0;
        int met = 0;
        if (at < to) {
            i = frame.has_cells ? cell_list[at] : at;
            met = meets_tile(&frame, rects, lights, boxes, i, tile);
        }
        const uint rank = rank_in_group(met, words, &end);
        if (met)
            list[before + rank] = i;
    }
}

#endif
