/* Edges of surfaces, smoothed (edges.h), in two passes: what edges are looked for in is unpacked first, for
 * each pixel is asked nine times.
 *
 * Floor, in bytes a pixel: the words that depth and normal are in, 16 in full float, read; 16 written; 16
 * read again, 12 of the picture read and 12 written: 72, of 1920 x 1080 at 24 GB/s 6.2 ms; 4 and 12 of each
 * 16 fall away where normals or depths alone are asked for. Around an edge 96 bytes of the caches are read
 * for 12. */
#include "edges.h"
#include "load_pixel.h"
#include "unpack.h"

/* planes  the frame's word planes
 * edges   [TL_EDGE_PLANE_COUNT][rows][pitch], rows a multiple of BLOCK_ROWS: those that edges.which asks for
 * Global size: blocks of the rows, padding included; more is ignored. */
__kernel void gather_edges(const tl_view_gather of,
                           __global const uchar *restrict planes,
                           __global float *restrict edges)
{
    const uint pitch = of.frame.pitch, blocks_x = pitch / BLOCK_COLUMNS;
    const size_t plane_size = (size_t)of.frame.rows * pitch;
    const size_t edge_plane = (size_t)of.edges.rows * pitch;
    const uint column = get_global_id(0) % blocks_x * BLOCK_COLUMNS;
    const uint row = get_global_id(0) / blocks_x * BLOCK_ROWS;
    const tl_needs needs = needs_of_build();
    const tl_layout layout = layout_of_build();
    if (row >= of.edges.rows)
        return;
    const size_t from = (size_t)(of.frame.buffer_row + row) * pitch + column;
    __global float *const to = edges + (size_t)row * pitch + column;
    const tl_words words = load_words(&layout, planes, plane_size, from, pitch);
    const near_surface s =
        near_surface_of(&of.frame, needs, &layout, &words, (scalar)column + LANE_COLUMN,
                        (scalar)(of.edges.first_row + row) + LANE_ROW);
    if (of.edges.which & TL_EDGE_DEPTH)
        store_block(edge_place(needs.orthographic, s.depth), to, pitch);
    if (of.edges.which & TL_EDGE_NORMALS) {
        store_block(s.normal.x, to + TL_EDGE_NORMAL_X * edge_plane, pitch);
        store_block(s.normal.y, to + TL_EDGE_NORMAL_Y * edge_plane, pitch);
        store_block(s.normal.z, to + TL_EDGE_NORMAL_Z * edge_plane, pitch);
    }
}

/* edges  as above, of the rows and those around them
 * from   [3][plane_rows][pitch]
 * to     the same, written in full in the rows
 * Global size: pixels of the rows, padding included, by TL_WIDTH; more is ignored. */
__kernel void smooth_edges(const tl_view_edge_stage stage,
                           __global const float *restrict edges,
                           __global const float *restrict from,
                           __global float *restrict to)
{
    const post_item item = item_of_picture(&stage.picture);
    if (!item.is_there)
        return;
    const int row = (int)item.row, column = (int)item.column;
    const real factor = edge_factor(&stage, edges, row, column);
    if (any_lane(factor > R(0.0)))
        store_color(&stage.picture, smoothed_edge(&stage, from, factor, row, column), to,
                    item.row, item.column);
    else
        store_color(&stage.picture, post_color(&stage.picture, from, item.row, item.column), to,
                    item.row, item.column);
}
