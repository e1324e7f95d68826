/* Bloom (bloom.h), in steps over small pictures between which all of a step has to be there.
 *
 * Floor, in bytes a pixel of the picture: 12 read by the bright pass, 12 read and 12 written by what adds,
 * and of small planes, a quarter of that at half and a sixteenth at quarter size: 12 written, 48 a pair of
 * taps' passes, 12 read. At a quarter with one pair of passes 40.5, of 1920 x 1080 at 24 GB/s 3.5 ms; at
 * half 54, 4.7 ms. A picture without anything bright is read once: 12, 1.0 ms. */
#include "bloom.h"

#if TL_WIDTH == 1
#    define PIXELS_OF_ITEM(side) (side)
#else
#    define PIXELS_OF_ITEM(side) TL_WIDTH
#endif

/* The sums of 2 or 4 neighbours, in pairs. */
#if TL_WIDTH > 1
#    define PAIRS(v) ((v).even + (v).odd)
#    if TL_WIDTH == 16
#        define STORE_HALVES(v, to) vstore8(convert_float8(PAIRS(v)), 0, to)
#        define STORE_QUARTERS(v, to) vstore4(convert_float4(PAIRS(PAIRS(v))), 0, to)
#    elif TL_WIDTH == 8
#        define STORE_HALVES(v, to) vstore4(convert_float4(PAIRS(v)), 0, to)
#        define STORE_QUARTERS(v, to) vstore2(convert_float2(PAIRS(PAIRS(v))), 0, to)
#    else
#        define STORE_HALVES(v, to) vstore2(convert_float2(PAIRS(v)), 0, to)
#        define STORE_QUARTERS(v, to) (*(to) = (float)PAIRS(PAIRS(v)))
#    endif
TL_INLINE void store_means(tl_u32 side, real columns, __global float *to)
{
    if (side == 4)
        STORE_QUARTERS(columns, to);
    else
        STORE_HALVES(columns, to);
}
#endif

/* from   [3][plane_rows][pitch] of the picture
 * small  [3][rows][pitch] of the small picture: rows from_row to to_row - 1 are written in full
 * count  becomes 1 where something is bright
 * Global size: rows times pitch times PIXELS_OF_ITEM by that; more is ignored. */
__kernel void gather_bright(const tl_view_bloom_stage stage,
                            __global const float *restrict from,
                            __global float *restrict small,
                            __global uint *restrict count)
{
    const tl_view_bloom b = stage.bloom;
    const uint pixels = PIXELS_OF_ITEM(b.side), items = b.pitch * b.side / pixels;
    const int row = b.from_row + (int)(get_global_id(0) / items);
    const uint at = get_global_id(0) % items * pixels / b.side;
    if (row >= b.to_row)
        return;
    const int top = row * (int)b.side, left = ((int)at - (int)b.guard) * (int)b.side;
#if TL_WIDTH == 1
    vec3 of[4];
    for (uint x = 0; x < 4; x++)
        of[x] = bright_columns(&stage, from, top, left + (int)(x < b.side ? x : 0));
    vec3 mean = {of[0].x + of[1].x, of[0].y + of[1].y, of[0].z + of[1].z};
    if (b.side == 4) {
        mean.x = mean.x + (of[2].x + of[3].x);
        mean.y = mean.y + (of[2].y + of[3].y);
        mean.z = mean.z + (of[2].z + of[3].z);
    }
    small[bloom_at(&b, 0, row, at)] = (float)mean.x;
    small[bloom_at(&b, 1, row, at)] = (float)mean.y;
    small[bloom_at(&b, 2, row, at)] = (float)mean.z;
#else
    const vec3 mean = bright_columns(&stage, from, top, left);
    store_means(b.side, mean.x, small + bloom_at(&b, 0, row, at));
    store_means(b.side, mean.y, small + bloom_at(&b, 1, row, at));
    store_means(b.side, mean.z, small + bloom_at(&b, 2, row, at));
#endif
    if (any_lane((mean.x > R(0.0)) | (mean.y > R(0.0)) | (mean.z > R(0.0))))
        atomic_or(count, 1u);
}

/* from  [3][rows][pitch] of the small picture
 * to    the same: rows from_row to to_row - 1 are written, but for TL_BLOOM_ENDS at either end
 * Global size: rows times pitch by TL_WIDTH; more is ignored. */
TL_INLINE void blur(const tl_view_bloom *b,
                    __global const float *restrict from,
                    __global float *restrict to,
                    long apart)
{
    const size_t pixel = get_global_id(0) * (size_t)TL_WIDTH;
    const int row = b->from_row + (int)(pixel / b->pitch);
    const uint at = pixel % b->pitch;
    if (row >= b->to_row || at < TL_BLOOM_ENDS || at >= b->pitch - TL_BLOOM_ENDS)
        return;
    for (uint color = 0; color < 3; color++) {
        const size_t here = bloom_at(b, color, row, at);
        STORE_FLOAT(seven_taps(b, from + here, apart), to, here);
    }
}

__kernel void blur_across(const tl_view_bloom_stage stage,
                          __global const float *restrict from,
                          __global float *restrict to)
{
    blur(&stage.bloom, from, to, 1);
}

__kernel void blur_down(const tl_view_bloom_stage stage,
                        __global const float *restrict from,
                        __global float *restrict to)
{
    blur(&stage.bloom, from, to, (long)stage.bloom.pitch);
}

/* A vector of pixels lies between few small ones, the first of which is before it: they are loaded at once
 * and dealt out. SMALL: how many are loaded; LEFT, RIGHT: whose turn it is before and beyond each pixel. */
#if TL_WIDTH == 16
#    define HALF_SMALL 16
#    define HALF_LEFT s0112233445566778
#    define HALF_RIGHT s1223344556677889
#    define QUARTER_SMALL 8
#    define QUARTER_LEFT s0011112222333344
#    define QUARTER_RIGHT s1122223333444455
#elif TL_WIDTH == 8
#    define HALF_SMALL 8
#    define HALF_LEFT s01122334
#    define HALF_RIGHT s12233445
#    define QUARTER_SMALL 4
#    define QUARTER_LEFT s00111122
#    define QUARTER_RIGHT s11222233
#elif TL_WIDTH == 4
#    define HALF_SMALL 4
#    define HALF_LEFT s0112
#    define HALF_RIGHT s1223
#    define QUARTER_SMALL 4
#    define QUARTER_LEFT s0011
#    define QUARTER_RIGHT s1122
#endif

#if TL_WIDTH > 1
#    define SMALL_LANES(type, lanes) TL_PASTE(type, lanes)
#    define LOAD_SMALL(lanes, from) \
        SMALL_LANES(TL_PASTE(convert_, TL_SCALAR), lanes)(SMALL_LANES(vload, lanes)(0, from))
/* Between two rows, then between columns. beyond: of the row below; shares: of the columns to the right. */
#    define GLOW(NAME, lanes, left, right)                                                     \
        TL_INLINE real NAME(__global const float *top, uint pitch, scalar beyond, real shares) \
        {                                                                                      \
            typedef SMALL_LANES(TL_SCALAR, lanes) small_lanes;                                 \
            const small_lanes above = LOAD_SMALL(lanes, top),                                  \
                              below = LOAD_SMALL(lanes, top + pitch);                          \
            const small_lanes row =                                                            \
                fma((small_lanes)beyond, below, (small_lanes)(R(1.0) - beyond) * above);       \
            return between(shares, row.left, row.right);                                       \
        }
GLOW(glow_of_halves, HALF_SMALL, HALF_LEFT, HALF_RIGHT)
GLOW(glow_of_quarters, QUARTER_SMALL, QUARTER_LEFT, QUARTER_RIGHT)
#endif

TL_INLINE real
glow_at(const tl_view_bloom *b, __global const float *small, uint color, uint row, uint column)
{
    const scalar beyond = bloom_beyond(row, b->side);
    __global const float *const top =
        small + bloom_at(b, color, bloom_before(row, b->side),
                         (uint)(bloom_before(column, b->side) + (int)b->guard));
#if TL_WIDTH == 1
    return between(bloom_beyond(column, b->side), between(beyond, top[0], top[b->pitch]),
                   between(beyond, top[1], top[b->pitch + 1]));
#else
    /* Columns' shares have the period of the small pixels, and vectors begin with one. */
    const real side = (real)(scalar)b->side, half_period = R(0.5) * (side + R(1.0));
    const real phase = (LANE_INDEX + half_period) / side;
    const real shares = phase - TO_REAL(TO_INTEGER(phase));
    return b->side == 4 ? glow_of_quarters(top, b->pitch, beyond, shares)
                        : glow_of_halves(top, b->pitch, beyond, shares);
#endif
}

/* small  [3][rows][pitch] of the small picture, blurred
 * from   [3][plane_rows][pitch] of the picture
 * to     the same, written in full in the rows
 * Global size: pixels of the rows, padding included, by TL_WIDTH; more is ignored. */
__kernel void add_glow(const tl_view_bloom_stage stage,
                       __global const float *restrict small,
                       __global const float *restrict from,
                       __global float *restrict to)
{
    const tl_view_bloom b = stage.bloom;
    const post_item item = item_of_picture(&stage.picture);
    if (!item.is_there)
        return;
    const vec3 own = post_color(&stage.picture, from, item.row, item.column);
    const vec3 seen = {with_glow(&b, own.x, glow_at(&b, small, 0, item.row, item.column)),
                       with_glow(&b, own.y, glow_at(&b, small, 1, item.row, item.column)),
                       with_glow(&b, own.z, glow_at(&b, small, 2, item.row, item.column))};
    store_color(&stage.picture, seen, to, item.row, item.column);
}
