/* Pictures after lighting (tilelight/post.h): what every stage of post-processing is given of one.
 *
 * A stage reads a picture and writes another, so that no pixel is read that was written before. It has rows
 * [first_row, end_row) to write and may read `halo` rows around them, a number that the stage states: a pixel
 * is computed from those alone, whatever else is there. So bands of rows, vectors, paths and the twin in C
 * give the same bits. Beyond the picture's edges there is nothing in memory that may be counted: a stage says
 * what it takes for what would be there. */
#ifndef TL_POST_KERNELS_H
#define TL_POST_KERNELS_H

#include "dialect.h"
#include "ranges.h"
#include "vec3.h"

/* A picture, or a band of it. Planes are [3][plane_rows][pitch] floats, R, G, B; their first row is row
 * plane_row of the picture. */
typedef struct tl_view_picture {
    tl_u32 width, height; /* px, of the whole picture */
    tl_u32 pitch, plane_rows;
    tl_u32 plane_row;
    tl_u32 first_row, end_row; /* rows of the picture that are to be written */
    tl_u32 unused;
} tl_view_picture;
TL_STATIC_ASSERT(sizeof(tl_view_picture) == 32, view_picture_is_two_rows);

/* Where pixel (column, row) of a colour stands in planes that have that row. */
TL_INLINE size_t post_at(const tl_view_picture *of, tl_u32 color, tl_u32 row, tl_u32 column)
{
    return ((size_t)color * of->plane_rows + (row - of->plane_row)) * of->pitch + column;
}

TL_INLINE vec3 post_color(const tl_view_picture *of,
                          tl_numbers planes,
                          tl_u32 row,
                          tl_u32 column)
{
    const size_t at = post_at(of, 0, row, column), plane = (size_t)of->plane_rows * of->pitch;
    const vec3 color = {LOAD(planes, at), LOAD(planes, at + plane),
                        LOAD(planes, at + 2 * plane)};
    return color;
}

/* The number at `column` of a row of a plane, of columns beyond the picture's edges that at the edge. A
 * vector that reaches beyond them is gathered, for there may be no memory. */
TL_INLINE real clamped_column(tl_numbers row, int column, int width)
{
    if (column >= 0 && column + TL_LANE_COUNT <= width)
        return LOAD(row, column);
    const real last = (real)(scalar)(width - 1), wanted = (scalar)column + LANE_INDEX;
    const real kept = pick(wanted < R(0.0), R(0.0), pick(wanted > last, last, wanted));
    return GATHER(row, TO_INTEGER(kept));
}

/* Lanes whose pixel, `column` of the first, is in the picture. */
TL_INLINE mask is_in_row(int column, tl_u32 width)
{
    const real at = (scalar)column + LANE_INDEX;
    return (at >= R(0.0)) & (at < (real)(scalar)width);
}

TL_INLINE tl_u32 clamped_row(int row, tl_u32 height)
{
    return row < 0 ? 0u : row >= (int)height ? height - 1 : (tl_u32)row;
}

/* Of rows and columns beyond the edges the colour at the edge. */
TL_INLINE vec3 clamped_color(const tl_view_picture *of, tl_numbers planes, int row, int column)
{
    const size_t plane = (size_t)of->plane_rows * of->pitch;
    const tl_numbers at = planes + post_at(of, 0, clamped_row(row, of->height), 0);
    const int width = (int)of->width;
    const vec3 color = {clamped_column(at, column, width),
                        clamped_column(at + plane, column, width),
                        clamped_column(at + 2 * plane, column, width)};
    return color;
}

/* What rounding may have brought beyond the largest floats is cut there. */
TL_INLINE real within_float(real v)
{
    const real most = (real)TL_MOST_FLOAT;
    return pick(v > most, most, pick(v < -most, -most, v));
}

#ifdef __OPENCL_C_VERSION__
/* A work-item has a vector of a row. Rows are filled up to whole groups of them. */
typedef struct post_item {
    uint row, column;
    int is_there;
} post_item;

TL_INLINE post_item item_of_rows(uint pitch, uint first_row, uint end_row, uint width)
{
    const size_t at = get_global_id(0) * (size_t)TL_WIDTH;
    post_item item;
    item.row = first_row + (uint)(at / pitch);
    item.column = (uint)(at % pitch);
    item.is_there = item.row < end_row && item.column < width;
    return item;
}

TL_INLINE post_item item_of_picture(const tl_view_picture *of)
{
    return item_of_rows(of->pitch, of->first_row, of->end_row, of->width);
}

TL_INLINE void store_color(
    const tl_view_picture *of, vec3 color, __global float *planes, uint row, uint column)
{
    const size_t at = post_at(of, 0, row, column), plane = (size_t)of->plane_rows * of->pitch;
    STORE_FLOAT(color.x, planes, at);
    STORE_FLOAT(color.y, planes, at + plane);
    STORE_FLOAT(color.z, planes, at + 2 * plane);
}
#endif

#endif
