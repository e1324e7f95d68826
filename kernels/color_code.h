/* Colours and exponents in few bits: one row a code.
 *
 *   rgb      the three values
 *   squared  their square roots, so that steps are fine where colours are dark: half a step h of the root
 *            is h (2 sqrt(c) + h) of the colour
 *   gray     one value, half of what the least and the greatest of the three add up to
 *   shared   RGB9E5: mantissas of 9 bits and one exponent of 5 (OpenGL 4.6, 8.5.2): 1/511.5 of the
 *            largest, 2^-25 below 2^-15, up to 65408
 *
 * Exponents of highlights: `plain`, or `logarithm`, log2(1 + e) over that of the largest, 10000, so
 * that a step is one share of any lobe's width: half a step of 8 bits is 1.8 % of 1 + e. */
#ifndef TL_COLOR_CODE_H
#define TL_COLOR_CODE_H

#include "number.h"
#include "specular.h"
#include "vec3.h"

enum tl_color_code {
    TL_COLOR_NOT_STORED,
    TL_COLOR_RGB,
    TL_COLOR_SQUARED,
    TL_COLOR_GRAY,
    TL_COLOR_SHARED,
    TL_COLOR_CODE_COUNT
};

enum tl_value_code {
    TL_VALUE_NOT_STORED,
    TL_VALUE_PLAIN,
    TL_VALUE_LOGARITHM, /* of exponents only */
    TL_VALUE_CODE_COUNT
};

TL_INLINE real shininess_of_logarithm(real stored)
{
    const real lobe = exp2_of_negative((stored - R(1.0)) * TL_LOG2_MOST_LOBE);
    return pick(stored > R(0.0), FMA(lobe, TL_MOST_SHININESS + R(1.0), R(-1.0)), R(0.0));
}

/* The mantissas' common power: 2^(exponent - 15 - 9). */
TL_INLINE vec3 color_of_shared(word32 w)
{
    const real unit = WORD_AS_REAL(((w >> 27) + (127u - 24u)) << 23);
    const vec3 c = {WORD_TO_REAL(field_of(w, 0u, 9u)) * unit,
                    WORD_TO_REAL(field_of(w, 9u, 9u)) * unit,
                    WORD_TO_REAL(field_of(w, 18u, 9u)) * unit};
    return c;
}

#endif
