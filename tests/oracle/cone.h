/* Which ways lead into a cone, by the cosine of their angle, and where in a box one is deep in it.
 *
 * Nothing of it is shared with kernels/spot.h, which compares squares, and parts boxes from cones by
 * planes. */
#ifndef TL_ORACLE_CONE_H
#define TL_ORACLE_CONE_H

#include "oracle/wide.h"

/* What a half-angle of a file means, in radians: it is a float, and those nearest to a quarter and to half a
 * turn are these (docs/conventions.md). */
wide tl_oracle_half_angle(float half_angle);

/* The cosine of the angle between way and axis less that of the half-angle: above 0 in the cone. Both are of
 * any length but 0. Off by 12v: the product of the two, 3v of their lengths', over these, 3v; 4v of the
 * cosine; v of the difference. */
wide tl_oracle_above_edge(const wide axis[3], wide half_angle, const wide way[3]);

/* Makes `way` a way of the box [low, high] where l.a - cosine |l| is large, the largest where the cosine is
 * not below 0: then the sum is concave, so going along one axis of space after the other, `steps` of them,
 * ends at its only top. Of wider cones it is one of the tops, from the corner ahead on. axis: of length 1.
 * In double, and a witness at best: whether it is in the cone is another question. */
void tl_oracle_deepest_way(const double axis[3],
                           double cosine,
                           const double low[3],
                           const double high[3],
                           int steps,
                           double way[3]);

#endif
