/* Does a rectangle keep the contract of tl_sphere_bounds (tilelight/bounds.h)? */
#ifndef TL_TEST_SPHERE_VERDICT_H
#define TL_TEST_SPHERE_VERDICT_H

#include "bounds/tally.h"

#include "tilelight/bounds.h"

/* Center in view space and radius, in m. */
typedef struct tl_sphere_case {
    tl_camera camera;
    float center[3], radius;
} tl_sphere_case;

/* What a rectangle has lost and kept of a sphere. */
typedef struct tl_sphere_verdict {
    uint64_t lost_px; /* whose centre is in both closed intervals, and not in the rectangle */
    uint64_t seen_px; /* of the first kind, in all */
    int extra, falsely_empty, falsely_kept, undecided;
} tl_sphere_verdict;

/* Lost and extra pixels are judged without slack: where the oracle cannot tell whether a centre is in the
 * interval, it counts as in the one for pixels that are lost and as out of it for those that are extra.
 *
 * That a rectangle is empty is decided at the edges of the image, by an interval that doubles have rounded:
 * host/scene/bounds.c has its end off by 14u of itself, u = 2^-53, and exact where it is a sum that a double
 * holds. Closer to an edge both answers are right; that is counted, as `undecided`. Whether an axis is empty
 * has no slack. */
tl_sphere_verdict tl_judge_sphere(const tl_sphere_case *of, const tl_pixel_rect *rect);

/* Adds one case, of tl_sphere_bounds. A first look in long double, which can only find that the contract is
 * kept, saves most cases the verdict in 128-bit floats. */
void tl_try_sphere(const tl_sphere_case *of, tl_tally *tally);

#endif
