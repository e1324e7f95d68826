/* Pixels that are no colour: NaN or infinite in a channel. One of them, blurred, spoils all around it, so
 * none may reach a stage that mixes pixels.
 *
 * Such a pixel becomes the mean of those of its 8 neighbours that are colours; black where none is. Mended
 * are all from the picture as it was, so the order does not show, and a hole wider than 2 px keeps a black
 * middle: it is told of, not painted over.
 *
 * Of n neighbours, colours of one sign, the mean is off by (n + 1) u of itself at most in float, u = 2^-24:
 * eighths are exact but for denormal numbers, n - 1 sums, a quotient and a product. Eighths keep sums within
 * the range of float. */
#ifndef TL_MEND_H
#define TL_MEND_H

#include "post.h"

/* Of a channel: x - x is 0 of what is finite, else NaN. */
TL_INLINE mask is_finite_number(real v)
{
    return v - v == R(0.0);
}

TL_INLINE mask is_color(vec3 c)
{
    return is_finite_number(c.x) & is_finite_number(c.y) & is_finite_number(c.z);
}

/* What stands for the pixel (column, row), which is no colour. */
TL_INLINE vec3 mean_around(const tl_view_picture *of, tl_numbers planes, int row, int column)
{
    vec3 sum = {R(0.0), R(0.0), R(0.0)};
    real count = R(0.0);
    for (int y = -1; y <= 1; y++) {
        if (row + y < 0 || row + y >= (int)of->height)
            continue;
        for (int x = -1; x <= 1; x++) {
            const vec3 c = clamped_color(of, planes, row + y, column + x);
            const mask counts = is_color(c) & is_in_row(column + x, of->width) &
                                (x != 0 || y != 0 ? EVERY_LANE : NO_LANE);
            const vec3 more = fma3(c, R(0.125), sum);
            sum = pick3(counts, more, sum);
            count = pick(counts, count + R(1.0), count);
        }
    }
    const real share = pick(count > R(0.0), R(8.0) / count, R(0.0));
    const vec3 mean = {within_float(sum.x * share), within_float(sum.y * share),
                       within_float(sum.z * share)};
    return mean;
}

TL_INLINE vec3 mended(const tl_view_picture *of, tl_numbers planes, int row, int column)
{
    const vec3 own = clamped_color(of, planes, row, column);
    const mask is = is_color(own);
    const vec3 other = mean_around(of, planes, row, column);
    return pick3(is, own, other);
}

#endif
