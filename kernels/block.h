/* A vector of pixels as a block of the picture, as square as it goes: the squarer, the fewer blocks
 * a light's edge crosses. Lanes are the block's pixels row by row. OpenCL only. */
#ifndef TL_BLOCK_H
#define TL_BLOCK_H

#include "dialect.h"

#if TL_WIDTH == 16
#    define BLOCK_COLUMNS 4
#    define BLOCK_ROWS 4
#    define LANE_COLUMN ((real)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3))
#    define LANE_ROW ((real)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3))
#elif TL_WIDTH == 8
#    define BLOCK_COLUMNS 4
#    define BLOCK_ROWS 2
#    define LANE_COLUMN ((real)(0, 1, 2, 3, 0, 1, 2, 3))
#    define LANE_ROW ((real)(0, 0, 0, 0, 1, 1, 1, 1))
#elif TL_WIDTH == 4
#    define BLOCK_COLUMNS 4
#    define BLOCK_ROWS 1
#    define LANE_COLUMN ((real)(0, 1, 2, 3))
#    define LANE_ROW ((real)0)
#else
#    define BLOCK_COLUMNS 1
#    define BLOCK_ROWS 1
#    define LANE_COLUMN ((real)0)
#    define LANE_ROW ((real)0)
#endif

/* The smallest tile has 8 x 8 pixels, and the others are multiples of it. */
TL_STATIC_ASSERT(8 % BLOCK_COLUMNS == 0 && 8 % BLOCK_ROWS == 0, tiles_are_whole_blocks);

/* Asks for the line at a global address, to be read (0) or written (1). OpenCL's prefetch() does
 * nothing on PoCL; where all address spaces are one, the compiler's own works. */
#if defined(__clang__) && (defined(__x86_64__) || defined(__aarch64__))
#    define PREFETCH(at, is_written) \
        __builtin_prefetch((const __private void *)(size_t)(at), is_written)
#else
#    define PREFETCH(at, is_written) ((void)(at))
#endif
#define BYTES_PER_LINE 64

/* A line in each row of a row of blocks, `bytes` apart. */
#define ASK_FOR_ROWS(from, bytes, is_written)                   \
    do {                                                        \
        _Pragma("unroll") for (uint r = 0; r < BLOCK_ROWS; r++) \
            PREFETCH((from) + r * (size_t)(bytes), is_written); \
    } while (0)

/* Blocks of planes of whole numbers. `from` and `to` are the block's first pixel in a plane of `pitch`
 * numbers a row. A row of four is aligned as such, for planes, pitch and blocks' columns are; said so, it
 * is one load, while PoCL's vload4 takes it in halves: 12 instructions a block in place of 5, a tenth of
 * a frame of full float that does nothing but read and write pixels. */
#if TL_WIDTH == 1
#    define NUMBERS(type, from, pitch) ((void)(pitch), (word32) * (__global const type *)(from))
#elif TL_WIDTH == 4
#    define NUMBERS(type, from, pitch) ((void)(pitch), NUMBER_ROW(type, from, 0))
#elif TL_WIDTH == 8
#    define NUMBERS(type, from, pitch) \
        ((word32)(NUMBER_ROW(type, from, 0), NUMBER_ROW(type, from, pitch)))
#else
#    define NUMBERS(type, from, pitch)                                      \
        ((word32)(NUMBER_ROW(type, from, 0), NUMBER_ROW(type, from, pitch), \
                  NUMBER_ROW(type, from, 2 * (size_t)(pitch)),              \
                  NUMBER_ROW(type, from, 3 * (size_t)(pitch))))
#endif
#define NUMBER_ROW(type, from, offset) \
    convert_uint4(*(__global const type##4 *)((__global const type *)(from) + (offset)))

TL_INLINE word32 load_bytes(__global const uchar *from, uint pitch)
{
    return NUMBERS(uchar, from, pitch);
}

TL_INLINE word32 load_shorts(__global const uchar *from, uint pitch)
{
    return NUMBERS(ushort, from, pitch);
}

TL_INLINE word32 load_ints(__global const uchar *from, uint pitch)
{
    return NUMBERS(uint, from, pitch);
}

#if TL_WIDTH == 1
TL_INLINE void store_block(real v, __global float *to, uint pitch)
{
    (void)pitch;
    *to = (float)v;
}
#else
#    define STORED_ROW(to, offset) (*(__global float4 *)((to) + (offset)))
TL_INLINE void store_block(real v, __global float *to, uint pitch)
{
    const TL_LANES(float) f = TL_LANES(convert_float)(v);
#    if TL_WIDTH == 16
    STORED_ROW(to, 0) = f.s0123;
    STORED_ROW(to, pitch) = f.s4567;
    STORED_ROW(to, 2 * (size_t)pitch) = f.s89ab;
    STORED_ROW(to, 3 * (size_t)pitch) = f.scdef;
#    elif TL_WIDTH == 8
    STORED_ROW(to, 0) = f.lo;
    STORED_ROW(to, pitch) = f.hi;
#    else
    (void)pitch;
    STORED_ROW(to, 0) = f;
#    endif
}
#endif

#endif
