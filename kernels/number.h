/* How a number stands in the bits of a packed pixel: one row a format, each with its error.
 *
 *   float     IEEE 754 binary32. Exact.
 *   half      IEEE 754 binary16, rounded to float and then to nearest: 2^-11 of the value, 2^-25 below
 *             2^-14, and 2^-13 of that. Values are cut at 65504; what is not finite reads as 65536 or
 *             more. Read exactly, but as 0 below 2^-14 by a device that flushes denormal floats.
 *   float24   binary32 without sign and the last 7 bits, rounded alike: 2^-17 of the value. Infinity
 *             stays; values below 0 are cut.
 *   unorm     a whole number over 2^bits - 1: half a step.
 *   snorm     a signed whole number over 2^(bits - 1) - 1: half a step. The least number, which no value
 *             needs, means "none" (OpenGL 4.6, 2.3.5.1, reads it as -1).
 *   bytes24   unorm of 24 bits, its highest byte first in memory, as red of RGB.
 *   whole     a whole number, as it is. Exact; of at most 24 bits.
 *
 * Reading a unorm or snorm multiplies by the rounded step: 2u of the value more, at most 1.5u,
 * u = 2^-24; 0 and both ends are exact (tests/test_number_formats.c). Writing is the host's, in double;
 * OpenGL's targets round by themselves. */
#ifndef TL_NUMBER_H
#define TL_NUMBER_H

#include "dialect.h"
#include "ranges.h"

enum tl_number {
    TL_NUMBER_FLOAT,
    TL_NUMBER_HALF,
    TL_NUMBER_FLOAT24,
    TL_NUMBER_UNORM,
    TL_NUMBER_SNORM,
    TL_NUMBER_BYTES24,
    TL_NUMBER_WHOLE,
    TL_NUMBER_COUNT
};

/* `bits` bits from `shift` on, as a whole number. */
TL_INLINE word32 field_of(word32 w, tl_u32 shift, tl_u32 bits)
{
    return bits == 32u ? w : (w >> shift) & ((1u << bits) - 1u);
}

/* Of whole numbers up to 2^bits - 1, and of signed ones. */
TL_INLINE scalar unorm_step(tl_u32 bits)
{
    return R(1.0) / (scalar)((1u << bits) - 1u);
}

TL_INLINE scalar snorm_step(tl_u32 bits)
{
    return R(1.0) / (scalar)((1u << (bits - 1u)) - 1u);
}

/* The exponent's bias is 127 in one and 15 in the other; multiplying moves denormals as well. The field's
 * sign is brought to bit 31 and drawn down over three bits, which are dropped: two shifts and a mask for
 * the lower half of a word, one and a mask for the upper. */
TL_INLINE real value_of_half(word32 w, tl_u32 shift)
{
    const word32 drawn = INT_AS_WORD(WORD_AS_INT(w << (16u - shift)) >> 3);
    return WORD_AS_REAL(drawn & 0x8fffe000u) * R(0x1p112);
}

TL_INLINE word32 swapped_bytes24(word32 field)
{
    return (field & 0xffu) << 16 | (field & 0xff00u) | field >> 16;
}

TL_INLINE real signed_value(word32 w, tl_u32 shift, tl_u32 bits)
{
    return TO_REAL(WORD_AS_INT(w << (32u - shift - bits)) >> (int)(32u - bits)) *
           snorm_step(bits);
}

/* The value of a field. `number` and `bits` are constants wherever speed matters. */
TL_INLINE real number_value(tl_u32 number, word32 w, tl_u32 shift, tl_u32 bits)
{
    if (number == TL_NUMBER_SNORM)
        return signed_value(w, shift, bits);
    if (number == TL_NUMBER_HALF)
        return value_of_half(w, shift);
    const word32 field = field_of(w, shift, bits);
    if (number == TL_NUMBER_FLOAT)
        return WORD_AS_REAL(field);
    if (number == TL_NUMBER_FLOAT24)
        return WORD_AS_REAL(field << 7);
    if (number == TL_NUMBER_BYTES24)
        return WORD_TO_REAL(swapped_bytes24(field)) * unorm_step(24u);
    if (number == TL_NUMBER_WHOLE)
        return WORD_TO_REAL(field);
    return WORD_TO_REAL(field) * unorm_step(bits);
}

#endif
