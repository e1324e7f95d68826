/* Is a cone of spot.h where the oracle says it is? */
#ifndef TL_TEST_CONE_VERDICT_H
#define TL_TEST_CONE_VERDICT_H

#include "bounds/cone_families.h"

#include "spot.h"

/* The cone of a spot as kernels take it. View space is world space; direction: of any length. */
tl_view_spot tl_test_spot(const double direction[3], float half_angle);

/* Adds one case. Looked at are its position and the way of the box that is deepest in the cone, or close to:
 *
 *   hits           the position is in the cone, as kernels compute it
 *   lost           a position in the box is, as kernels compute it or beyond doubt, and the box is not met
 *   falsely_kept   a position is out of the cone beyond doubt, and kernels light it
 *   falsely_empty  a position is in the cone beyond doubt, and they do not
 *   undecided      the position is at the edge of the cone, within what rounding may move it
 *
 * Beyond doubt: its cosine differs from that of the edge by 16u, u = 2^-24. spot.h derives 7u for the sums,
 * squares and products of in_cone, and the axis is off by 2u of its length and u in each component; with the
 * cosine's own u that is less than 12u. Where squares leave the range of float, nothing is said of the
 * position, but that its box is not lost where it is lit. */
void tl_try_cone(const tl_cone_case *of, tl_tally *tally);

#endif
