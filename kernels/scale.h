/* Pictures of another size: each pixel is a weighted sum of those around its place, along columns first, then
 * along rows. Weights are the host's (host/post/filters.c): of a pixel of the new picture they add up to 1.
 *
 * The sum is taken of differences from the pixel with the largest weight, c + sum of w (x - c), so that where
 * all are alike the result is that value bit for bit, whatever rounding made of the weights. With n taps it
 * is off by (n + 3) u of sum |w| |x - c|, and u of itself, in each direction, u = 2^-24;
 * tests/test_post_final.c.
 *
 * Radiance beyond 2^126 counts as that, so that no sum leaves the range of float: weights of filters that
 * ring add up to less than 2 without their signs. A pixel reads the rows between its first tap and its last,
 * of the picture as it is, whatever band it is computed in. */
#ifndef TL_SCALE_H
#define TL_SCALE_H

#include "post.h"

/* Tables are 32-bit words behind one another, of the new picture's rows, then of its columns:
 * first tap [count], tap with the largest weight [count], weights [taps][count]; floats but for the first
 * two, which are whole numbers. count is padded to 64. */
typedef struct tl_view_scale {
    tl_u32 from_width, from_pitch, from_rows; /* px; of the planes that are read */
    tl_u32 from_row;                          /* of the picture: the first that they hold */
    tl_u32 width, pitch, rows;                /* of what is written; as tl_view_picture's */
    tl_u32 plane_row;
    tl_u32 first_row, end_row;      /* of the new picture: to be written */
    tl_u32 row_taps, column_taps;   /* numbers of weights */
    tl_u32 row_count, column_count; /* padded */
    tl_u32 column_table;            /* where the tables of columns begin, in words */
    tl_u32 unused;
} tl_view_scale;
TL_STATIC_ASSERT(sizeof(tl_view_scale) == 64, view_scale_is_four_rows);

/* What a sum takes for a number. */
TL_INLINE real within_sums(real x)
{
    return pick(x < R(0x1p126), pick(x > R(-0x1p126), x, R(-0x1p126)), R(0x1p126));
}

/* A word of a table that all lanes share: a whole number below 2^31. */
TL_INLINE tl_u32 table_word(tl_numbers tables, tl_u32 at)
{
#ifdef __OPENCL_C_VERSION__
    return WORD_AT(tables, at);
#else
    return GATHER_WORDS(tables, (integer)at);
#endif
}

/* Column x of row y of the picture between, as tall as the new one and as wide as the old: `from` is one
 * plane. */
TL_INLINE real scaled_along_column(
    const tl_view_scale *of, tl_numbers from, tl_numbers tables, tl_u32 y, tl_u32 x)
{
    const tl_u32 first = table_word(tables, y) - of->from_row;
    const tl_u32 middle = table_word(tables, of->row_count + y) - of->from_row;
    const tl_numbers weights = tables + 2 * of->row_count + y;
    const real c = within_sums(LOAD(from, (size_t)middle * of->from_pitch + x));
    real sum = R(0.0);
    for (tl_u32 tap = 0; tap < of->row_taps; tap++) {
        const real value = within_sums(LOAD(from, (size_t)(first + tap) * of->from_pitch + x));
        sum = FMA((real)(scalar)weights[(size_t)tap * of->row_count], value - c, sum);
    }
    return c + sum;
}

/* Of the vector of columns at x of a row of that picture. */
TL_INLINE real scaled_along_row(const tl_view_scale *of,
                                tl_numbers row,
                                tl_numbers tables,
                                tl_u32 x)
{
    const tl_numbers table = tables + of->column_table;
    const tl_numbers weights = table + 2 * of->column_count + x;
    const integer lanes = TO_INTEGER((scalar)x + LANE_INDEX);
    const integer first = TO_INTEGER(WORD_TO_REAL(GATHER_WORDS(table, lanes)));
    const integer middle =
        TO_INTEGER(WORD_TO_REAL(GATHER_WORDS(table + of->column_count, lanes)));
    const real c = within_sums(GATHER(row, middle));
    real sum = R(0.0);
    for (tl_u32 tap = 0; tap < of->column_taps; tap++) {
        const real value = within_sums(GATHER(row, first + (int)tap));
        sum = FMA(LOAD(weights, (size_t)tap * of->column_count), value - c, sum);
    }
    return c + sum;
}

#endif
