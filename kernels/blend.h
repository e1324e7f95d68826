/* A layer over what lies behind it (tilelight/layers.h).
 *
 * Porter and Duff, "Compositing Digital Images", 1984, section 4.3: A over B, of colours that are not
 * multiplied by their opacity yet. Opacity 0 leaves what is behind, bit for bit, and opacity 1 what is lit.
 * In u = 2^-24 of float the result is off by 3u of itself at most: difference, product and sum, of numbers
 * that are not negative (tests/test_blend.c). */
#ifndef TL_BLEND_H
#define TL_BLEND_H

#include "dialect.h"
#include "ranges.h"

/* Radiance of one colour. opacity: 0 to 1; behind, and lit where opacity is not 0: 0 to TL_MOST_FLOAT, at
 * which rounding is cut. */
TL_INLINE real blended(real opacity, real lit, real behind)
{
    const real sum = FMA(opacity, lit, (R(1.0) - opacity) * behind);
    const real cut = pick(sum > (real)TL_MOST_FLOAT, TL_MOST_FLOAT, sum);
    return pick(opacity > R(0.0), cut, behind);
}

#endif
