/* Which rays meet a sphere between the near and the far plane, by angles.
 *
 * Along one axis the sphere is a disc; the eye sees it in the directions theta +- phi, theta being that of
 * its centre and tan phi = r/sqrt(D^2 - r^2), cut where its edge crosses the two planes. Nothing of it is
 * shared with kernels/sphere_bounds.h, which works with slopes. */
#ifndef TL_ORACLE_SPHERE_H
#define TL_ORACLE_SPHERE_H

#include "oracle/wide.h"

#define TL_SPAN_ERROR 0x1p-84Q /* 2^29 v */
#define TL_QUICK_SPAN_ERROR \
    0x1p-35L /* the same of long double, of 64 bits of mantissa or more */

/* The largest and the least x/depth (parallel rays: x, in m) of what is between the planes. */
typedef struct tl_span {
    wide low, high;
    int empty; /* exactly where nothing is between the planes */
} tl_span;

typedef struct tl_quick_span {
    long double low, high;
    int empty;
} tl_quick_span;

/* Along one axis. c: the centre's coordinate; depth: its depth, of any sign; r >= 0; near < far, near > 0
 * unless orthographic, far may be infinite. All are floats.
 *
 * An end m is off by TL_SPAN_ERROR max(1, |m|) at most, and by TL_SPAN_ERROR |m| under parallel rays:
 *   1. A tangent less steep than 45 degrees: theta and phi by 4v pi/2 each, its slope by 8v more: 32v.
 *   2. A steeper one: the angle from the axis across is the difference of two, by 4v of them each. Where it
 *      is small beside them, so is depth - r or depth + r beside r; but floats that differ, differ by
 *      2^-25 of themselves. So it is off by 2^28 v of itself, and its slope by as much. Where they do not
 *      differ the tangent's point is beside the eye, and left out as such.
 *   3. An end on a plane: 16v of itself, for all that cancels there is added up by wide_sum.
 *   4. Where a tangent's point is on a plane but for its rounding, it may count or not: the plane's end is
 *      as close to it as the square of that.
 * Asserted against a third way, the distance of rays, by tests/test_oracle.c. */
tl_span tl_oracle_sphere_span(
    wide c, wide depth, wide r, wide near, wide far, int orthographic);

/* The same text in long double, with errors that are 2^49 times as large: for what can be decided so. */
tl_quick_span tl_oracle_sphere_quick_span(long double c,
                                          long double depth,
                                          long double r,
                                          long double near,
                                          long double far,
                                          int orthographic);

#endif
