/* How light fades with distance: one row a falloff, each with its source.
 *
 *   linear          1 - d/range, cut at 0. Policarpo and Fonseca 2005, equation 2.
 *   linear from     the same between a distance `begin` and the range, 1 before it:
 *                   (range - d)/(range - begin), cut at 0 and 1. The ISPC project's example
 *                   examples/cpu/deferred.
 *   inverse square  max(0, 1 - (d/range)^4) / d^2. KHR_lights_punctual, "Range Property"; without
 *                   a range, 1 / d^2. A light is taken to be 1 cm in size: d is not below that,
 *                   else one pixel beside a bulb would outshine every other.
 *   table           between samples that are evenly spaced from 0 to the range, as a lookup table does.
 *   none            1: directional light.
 *
 * What the weight is multiplied by decides `reaches` beforehand: the weights here are 0 at the
 * range only up to rounding. */
#ifndef TL_FALLOFF_H
#define TL_FALLOFF_H

#include "dialect.h"

enum tl_falloff_row {
    TL_FADE_LINEAR,
    TL_FADE_INVERSE_SQUARE,
    TL_FADE_NONE,
    TL_FADE_LINEAR_FROM,
    TL_FADE_TABLE, /* of shapes alone */
    TL_FADE_COUNT
};

/* A light has room for one number beside its row, and linear-from needs two: its second is where the row
 * stands, as a float. That is 1 and above, whose bits no row's number reaches. Between rows and those bits
 * stands the number of a light's shape (shape.h), which has its row then. */
#define TL_BITS_OF_ONE 0x3f800000u

TL_INLINE tl_u32 falloff_row(tl_u32 falloff)
{
    return falloff < TL_FADE_COUNT ? falloff : (tl_u32)TL_FADE_LINEAR_FROM;
}

TL_INLINE int has_shape(tl_u32 falloff)
{
    return falloff >= TL_FADE_COUNT && falloff < TL_BITS_OF_ONE;
}

/* fade: `last` over the range. table: [last + 1] weights, the first at distance 0. Between two of them
 * linear. The place among them is off by 2u of itself for the product and fade; the weight by 4u of the
 * larger of the two beside that. 0 or above: rounded or not, a - b is no less than -b. */
TL_INLINE real fade_by_table(real distance, scalar fade, tl_numbers table, tl_u32 last)
{
    const real place = distance * fade;
    const real end = (real)(scalar)last;
    const real inside = pick(place < end, place, end); /* what is no number, too */
    const real whole = TO_REAL(TO_INTEGER(inside));
    const real before = pick(whole < end, whole, end - R(1.0));
    const integer at = TO_INTEGER(before);
    const real low = GATHER(table, at), high = GATHER(table, at + 1);
    return FMA(inside - before, high - low, low);
}

TL_BEGIN_LOOSE

#define TL_MOST_PER_DISTANCE2 R(1e4) /* 1/m^2: of the nearest distance, 1 cm */

/* fade: 1/range. Error at most u: fade's of d/range, and the sum's of what that leaves of 1. */
TL_INLINE real fade_linear(real distance, scalar fade)
{
    const real weight = FMA(-distance, fade, R(1.0));
    return pick(weight > R(0.0), weight, R(0.0));
}

/* fade: 1/(range - begin); offset: range/(range - begin), the bits of a float. Where begin is the range:
 * 0 and 1. Error at most 3u offset: both numbers are rounded, and the sum. */
TL_INLINE real fade_linear_from(real distance, scalar fade, tl_u32 offset)
{
    const real weight = FMA(-distance, fade, WORD_AS_REAL((word32)offset));
    const real not_above = pick(weight < R(1.0), weight, R(1.0));
    return pick(not_above > R(0.0), not_above, R(0.0));
}

/* fade: 1/range^2, 0 without a range. per_distance: 1/d. The window is off by 4u absolute, the
 * quotient by 6u of itself. */
TL_INLINE real fade_inverse_square(real distance2, real per_distance, scalar fade)
{
    const real share = distance2 * fade;
    const real window = FMA(-share, share, R(1.0));
    const real per_distance2 = per_distance * per_distance;
    const real near_one =
        pick(per_distance2 < TL_MOST_PER_DISTANCE2, per_distance2, TL_MOST_PER_DISTANCE2);
    return pick(window > R(0.0), window, R(0.0)) * near_one;
}

TL_END_LOOSE

#endif
