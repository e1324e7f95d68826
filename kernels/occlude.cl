/* Ambient light that surroundings keep from pixels (occlusion.h), in three passes over the whole picture: a
 * pixel needs those around it, in the first two finished. A work-item has a patch, on the path for GPUs one
 * pixel. Bits depend on neither: a pixel is computed from the planes alone.
 *
 * Floor of a sample, in a block of 16 with AVX-512: 16 loads of a gather, two a cycle, 8 cycles; a root and
 * a quotient that block one pipe for 10 cycles each, 20; and some 40 other instructions on two pipes,
 * beside them. 20 cycles a sample and block, 1.25 a pixel. Bytes: planes of words read once, 16 bytes a
 * pixel written, read and read again, 4 written and read, 4 written: 44 a pixel beside the words, 1.5 ms of
 * 1920 x 1080 at 60 GB/s, in the caches as a rule. docs/occlusion.md has what is measured. */
#include "load_pixel.h"
#include "occlusion.h"
#include "unpack.h"

/* Pixels of a work-item: columns x rows of them, from (column, row) of the picture on. */
typedef struct item_pixels {
    uint column, row, columns, rows;
} item_pixels;

TL_INLINE item_pixels pixels_of_item(const tl_frame *frame)
{
    const uint pixels = TL_BY_PIXEL ? TL_PATCH_COLUMNS * TL_PATCH_ROWS : 1;
    const uint patches_x = around_width(frame) / TL_PATCH_COLUMNS;
    const uint patch = get_global_id(0) / pixels, pixel_of_patch = get_global_id(0) % pixels;
    item_pixels of;
    of.column = patch % patches_x * TL_PATCH_COLUMNS + pixel_of_patch % TL_PATCH_COLUMNS;
    of.row = patch / patches_x * TL_PATCH_ROWS + pixel_of_patch / TL_PATCH_COLUMNS;
    of.columns = TL_BY_PIXEL ? 1 : TL_PATCH_COLUMNS;
    of.rows = TL_BY_PIXEL ? 1 : TL_PATCH_ROWS;
    return of;
}

#define FOR_RUNS_OF(item, width, height)                                           \
    for (uint row = (item).row; row < (item).row + (item).rows; row += (height))   \
        for (uint column = (item).column; column < (item).column + (item).columns; \
             column += (width))

#define COLUMNS_OF_RUN ((scalar)column + LANE_INDEX)
#define ROWS_OF_RUN ((real)(scalar)row)

TL_INLINE __global float *plane_of(const tl_frame *frame,
                                   around_view a,
                                   __global float *numbers,
                                   enum tl_around_plane plane)
{
    return numbers + (around_plane(frame, a, plane) - (tl_numbers)numbers);
}

/* planes   the frame's word planes, [rows][pitch] numbers each: layout.h. The whole picture's
 * numbers  the buffer of lights: of its planes of surroundings (occlusion.h), depth and normals are written
 *          in
 *          full for every patch
 * Global size: the patches, on the path for GPUs times their pixels, in groups of TL_GROUP. */
__kernel void gather_surroundings(const tl_frame frame,
                                  __global const uchar *restrict planes,
                                  __global float *restrict numbers)
{
    const around_view a = around_behind(&frame, numbers);
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const tl_needs needs = needs_of_build();
    const tl_layout layout = layout_of_build();
    const item_pixels item = pixels_of_item(&frame);
    FOR_RUNS_OF(item, BLOCK_COLUMNS, BLOCK_ROWS)
    {
        const size_t at = (size_t)row * frame.pitch + column;
        const tl_words words = load_words(&layout, planes, plane_size, at, frame.pitch);
        const near_surface s =
            near_surface_of(&frame, needs, &layout, &words, (scalar)column + LANE_COLUMN,
                            (scalar)row + LANE_ROW);
        store_block(s.depth, plane_of(&frame, a, numbers, TL_AROUND_DEPTH) + at, frame.pitch);
        store_block(s.normal.x, plane_of(&frame, a, numbers, TL_AROUND_NORMAL_X) + at,
                    frame.pitch);
        store_block(s.normal.y, plane_of(&frame, a, numbers, TL_AROUND_NORMAL_Y) + at,
                    frame.pitch);
        store_block(s.normal.z, plane_of(&frame, a, numbers, TL_AROUND_NORMAL_Z) + at,
                    frame.pitch);
    }
}

/* numbers  as above: the rough share is written, from depth and normals. Global size as above. */
__kernel void occlude(const tl_frame frame, __global float *numbers)
{
    const around_view a = around_behind(&frame, numbers);
    const tl_needs needs = needs_of_build();
    const item_pixels item = pixels_of_item(&frame);
    FOR_RUNS_OF(item, TL_WIDTH, 1)
    {
        const size_t at = (size_t)row * frame.pitch + column;
        const real depth = LOAD(around_plane(&frame, a, TL_AROUND_DEPTH), at);
        real share = R(1.0);
        if (any_lane(depth < (real)INFINITY)) {
            const vec3 normal = around_normal(&frame, a, at);
            share = rough_share(&frame, needs, a, depth, normal, COLUMNS_OF_RUN, ROWS_OF_RUN);
        }
        STORE_FLOAT(share, plane_of(&frame, a, numbers, TL_AROUND_ROUGH), at);
    }
}

/* numbers  as above: the share is written, from all the others. Global size as above. */
__kernel void smooth_surroundings(const tl_frame frame, __global float *numbers)
{
    const around_view a = around_behind(&frame, numbers);
    const tl_needs needs = needs_of_build();
    const item_pixels item = pixels_of_item(&frame);
    FOR_RUNS_OF(item, TL_WIDTH, 1)
    {
        const size_t at = (size_t)row * frame.pitch + column;
        const real depth = LOAD(around_plane(&frame, a, TL_AROUND_DEPTH), at);
        real share = R(1.0);
        if (any_lane(depth < (real)INFINITY))
            share = smooth_share(&frame, needs, a, at, COLUMNS_OF_RUN, ROWS_OF_RUN);
        STORE_FLOAT(share, plane_of(&frame, a, numbers, TL_AROUND_SHARE), at);
    }
}
