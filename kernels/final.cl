/* The last stages: a picture of another size, and the codes of a screen. A work-item a vector of a row.
 *
 * Floors, of 1920 x 1080 at 24 GB/s, as two cores have them: scaled to a half, 24.9 MB are read and 12.4
 * written between, read again, and 6.2 written: 2.3 ms. Codes: 24.9 MB are read and 6.2 written, 1.3 ms; and
 * some 150 operations a pixel, 0.3 Gflop, 3 ms of two cores of 16 lanes at half of their peak. */
#include "scale.h"
#include "tone.h"

/* from     [3][from_rows][from_pitch]
 * tables   of scale.h
 * between  [3][end_row - first_row][from_pitch], written
 * Global size: from_pitch times the rows and 3, by TL_WIDTH; more is ignored. */
__kernel void scale_columns(const tl_view_scale of,
                            __global const float *restrict from,
                            __global const float *restrict tables,
                            __global float *restrict between)
{
    const uint rows = of.end_row - of.first_row;
    const post_item item = item_of_rows(of.from_pitch, 0, 3 * rows, of.from_width);
    if (!item.is_there)
        return;
    const uint color = item.row / rows, row = item.row % rows;
    const real scaled =
        scaled_along_column(&of, from + (size_t)color * of.from_rows * of.from_pitch, tables,
                            of.first_row + row, item.column);
    STORE_FLOAT(scaled, between, (size_t)item.row * of.from_pitch + item.column);
}

/* between  as above
 * to       [3][rows][pitch], written
 * Global size: pitch times the rows and 3, by TL_WIDTH; more is ignored. */
__kernel void scale_rows(const tl_view_scale of,
                         __global const float *restrict between,
                         __global const float *restrict tables,
                         __global float *restrict to)
{
    const uint rows = of.end_row - of.first_row;
    const post_item item = item_of_rows(of.pitch, 0, 3 * rows, of.width);
    if (!item.is_there)
        return;
    const uint color = item.row / rows, row = of.first_row + item.row % rows;
    const real scaled =
        scaled_along_row(&of, between + (size_t)item.row * of.from_pitch, tables, item.column);
    STORE_FLOAT(scaled, to,
                ((size_t)color * of.rows + row - of.plane_row) * of.pitch + item.column);
}

#if TL_WIDTH == 1
#    define STORE_CODES(v, to) ((to)[0] = (int)(v))
#else
#    define STORE_CODES(v, to) TL_LANES(vstore)(TL_LANES(convert_int)(v), 0, to)
#endif

/* A picture and how it is shown. */
typedef struct tl_view_codes {
    tl_view_picture of;
    tl_view_look look;
} tl_view_codes;

/* from     [3][plane_rows][pitch]
 * numbers  of host/picture/show.h: what is added [64][64], thresholds [257]
 * rgb      [end_row - first_row][width][3], written
 * Global size: pitch times the rows, by TL_WIDTH; more is ignored. */
__kernel void show_codes(const tl_view_codes as,
                         __global const float *restrict from,
                         __global const float *restrict numbers,
                         __global uchar *restrict rgb)
{
    const post_item item = item_of_picture(&as.of);
    if (!item.is_there)
        return;
    const vec3 radiance = post_color(&as.of, from, item.row, item.column);
    const vec3 shown = shown_of(radiance, &as.look);
    const real added = LOAD(numbers, item.row % TL_DITHER_SIDE * TL_DITHER_SIDE +
                                         item.column % TL_DITHER_SIDE);
    const tl_numbers thresholds = numbers + TL_DITHER_SIDE * TL_DITHER_SIDE;
    const size_t at = (size_t)(item.row - as.of.first_row) * as.of.width + item.column;
    const uint left = as.of.width - item.column;
    int codes[3][TL_WIDTH];
    STORE_CODES(code_of(shown.x, added, radiance.x, &as.look, thresholds), codes[0]);
    STORE_CODES(code_of(shown.y, added, radiance.y, &as.look, thresholds), codes[1]);
    STORE_CODES(code_of(shown.z, added, radiance.z, &as.look, thresholds), codes[2]);
    for (uint lane = 0; lane < TL_WIDTH && lane < left; lane++)
        for (uint color = 0; color < 3; color++)
            rgb[3 * (at + lane) + color] = (uchar)codes[color][lane];
}
