/* How light fades with distance: one row a falloff, each with its source.
 *
 *   linear          1 - d/range, cut at 0. Policarpo and Fonseca 2005, equation 2.
 *   linear from     the same between a distance `begin` and the range, 1 before it:
 *                   (range - d)/(range - begin), cut at 0 and 1. The ISPC project's example
 *                   examples/cpu/deferred.
 *   inverse square  max(0, 1 - (d/range)^4) / d^2. KHR_lights_punctual, "Range Property"; without
 *                   a range, 1 / d^2. A light is taken to be 1 cm in size: d is not below that,
 *                   else one pixel beside a bulb would outshine every other.
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
    TL_FADE_COUNT
};

/* A light has room for one number beside its row, and linear-from needs two: its second is where the row
 * stands, as a float. That is 1 and above, whose bits no row's number reaches. */
TL_INLINE tl_u32 falloff_row(tl_u32 falloff)
{
    return falloff < TL_FADE_COUNT ? falloff : (tl_u32)TL_FADE_LINEAR_FROM;
}

#define TL_MOST_PER_DISTANCE2 R(1e4) /* 1/m^2: of the nearest distance, 1 cm */

/* fade: 1/range. Error at most 2u (two roundings of values up to 1). */
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

#endif
