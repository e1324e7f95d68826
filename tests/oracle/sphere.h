/* Which rays meet a sphere between the near and the far plane, by angles.
 *
 * Along one axis the sphere is a disc; the eye sees it in the directions theta +- phi, theta being that of
 * its centre and tan phi = r/sqrt(D^2 - r^2), cut where its edge crosses the two planes. Nothing of it is
 * shared with kernels/sphere_bounds.h, which works with slopes. */
#ifndef TL_ORACLE_SPHERE_H
#define TL_ORACLE_SPHERE_H

#include "oracle/wide.h"

/* The largest and the least x/depth (parallel rays: x, in m) of what is between the planes. */
typedef struct tl_span {
    wide low, high;
    int empty; /* exactly where nothing is between the planes */
} tl_span;

/* Along one axis. c: the centre's coordinate; depth: its depth, of any sign; r >= 0; near < far, near > 0
 * unless orthographic, far may be infinite. All are floats.
 *
 * An end m that is the tangent's is off by 16v (1 + m^2): theta and phi by 4v pi/2 each, their tangent by
 * 4v more. An end on a plane is off by 16v of itself: all that cancels there is added up by wide_sum.
 * Asserted against a third way, the distance of rays, by tests/test_oracle.c. */
tl_span tl_oracle_sphere_span(
    wide c, wide depth, wide r, wide near, wide far, int orthographic);

#endif
