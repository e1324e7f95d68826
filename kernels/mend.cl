/* Pixels that are no colour: counted, and mended where there are any (mend.h). A work-item a vector of pixels
 * of a row.
 *
 * Floor: counting reads 12 bytes a pixel, mending reads 12 more and writes 12: of 1920 x 1080 at 24 GB/s, as
 * two cores have them, 1.0 ms and 2.1 ms; without such pixels the second pass is not there. */
#include "mend.h"

/* from   [3][plane_rows][pitch]
 * count  is raised by the pixels that are no colours
 * Global size: pixels of the rows, padding included, by TL_WIDTH; more is ignored. */
__kernel void count_no_colors(const tl_view_picture of,
                              __global const float *restrict from,
                              __global uint *restrict count)
{
    const post_item item = item_of_picture(&of);
    if (!item.is_there)
        return;
    const mask is = is_color(post_color(&of, from, item.row, item.column));
    const mask counts = is_in_row((int)item.column, of.width);
    const real bad = pick(is, R(0.0), pick(counts, R(1.0), R(0.0)));
    if (any_lane(bad > R(0.0)))
        atomic_add(count, (uint)SUM_LANES(bad));
}

/* from  as above
 * to    the same, written in full in the rows
 * Global size as above. */
__kernel void mend_picture(const tl_view_picture of,
                           __global const float *restrict from,
                           __global float *restrict to)
{
    const post_item item = item_of_picture(&of);
    if (!item.is_there)
        return;
    const vec3 own = post_color(&of, from, item.row, item.column);
    const mask is_not = !is_color(own);
    if (any_lane(is_not))
        store_color(&of, mended(&of, from, (int)item.row, (int)item.column), to, item.row,
                    item.column);
    else
        store_color(&of, own, to, item.row, item.column);
}
