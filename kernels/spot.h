/* Spot lights: what their cone lets through, which pixels are in it, and which boxes it may meet.
 *
 * KHR_lights_punctual, "Inner and Outer Cone Angles", multiplies a spot's light by
 *
 *     clamp(cd scale + offset, 0, 1)^2,  scale = 1/max(0.001, cos inner - cos outer),
 *                                        offset = -cos outer scale,
 *
 * cd the cosine between the cone's axis and the way from light to surface. The same is computed here as
 * clamp((cd - cos outer) scale, 0, 1)^2: the difference is small where it counts, and rounds once, while
 * the offset would be rounded as often as it is larger than the sum. The extension has half-angles up to
 * pi/2; formula and code hold up to pi. What angles at the ends of that mean, docs/conventions.md says.
 *
 * A spot adds to a pixel if and only if `in_cone` holds there, beside what is asked of every light: the
 * weights are 0 at the edge only up to rounding. It is the test cd > cos outer, multiplied with the
 * distance and squared with its sign, so that it waits for no root:
 *
 *     (l.axis) |l.axis| > cos outer |cos outer| l.l. */
#ifndef TL_SPOT_H
#define TL_SPOT_H

#include "needs.h"
#include "reach.h"

/* Of a light that is no spot: in_cone holds wherever there is a direction, and its share is exactly 1. */
TL_INLINE tl_view_spot whole_space(void)
{
    const tl_view_spot whole = {{0, 0, 0}, -1, -1, 1, -1, 0};
    return whole;
}

#ifdef __OPENCL_C_VERSION__
/* The cone of light i of light_count. */
TL_INLINE tl_view_spot spot_of(tl_needs needs,
                               __global const tl_view_light *lights,
                               uint light_count,
                               uint i)
{
    if (needs.spots)
        return ((__global const tl_view_spot *)(lights + light_count))[i];
    return whole_space();
}
#endif

TL_INLINE vec3 axis_of(tl_view_spot spot)
{
    const vec3 axis = {(real)spot.axis[0], (real)spot.axis[1], (real)spot.axis[2]};
    return axis;
}

TL_INLINE real along_axis(tl_view_spot spot, vec3 l)
{
    return dot3(l, axis_of(spot));
}

/* Grows with its operand, rounded or not. */
TL_INLINE real signed_square(real v)
{
    return v * ABSOLUTE(v);
}

/* l: to the light, m; distance2: l.l. */
TL_INLINE mask in_cone(tl_view_spot spot, vec3 l, real distance2)
{
    return signed_square(along_axis(spot, l)) > spot.least_cos2 * distance2;
}

TL_BEGIN_LOOSE

/* What the cone lets through, 0 to 1, in it. per_distance: 1/|l|. The cosine is off by 3u for its sum, 4.5u
 * for squares, root, quotient and product, u for the axis, which is rounded; what it is compared with by u;
 * so before it is squared the share is off by 9.5u scale + 3u at most (u = 2^-24, scale at most 1000).
 * Asserted by tests/test_falloff_accuracy.c. */
TL_INLINE real cone_share(tl_view_spot spot, vec3 l, real per_distance)
{
    const real above =
        (along_axis(spot, l) * per_distance - (real)spot.least_cos) * (real)spot.scale;
    const real not_above_one = pick(above < R(1.0), above, R(1.0));
    const real share = pick(not_above_one > R(0.0), not_above_one, R(0.0));
    return share * share;
}

TL_END_LOOSE

TL_INLINE real farther(real a, real b)
{
    const real x = ABSOLUTE(a), y = ABSOLUTE(b);
    return pick(x > y, x, y);
}

TL_INLINE real sum3(vec3 v)
{
    return v.x + v.y + v.z;
}

#define TL_CONE_MARGIN R(0x1p-19) /* 32u */
#define TL_LEAST_ACROSS2 R(1e-30) /* m^2: squares below lose digits */

/* A plane through the light that the cone, widened, lies on one side of, and that may have the box on its
 * other side. low, high: the box of ways to the light. Any point g of space gives such a plane: the one
 * that touches the cone on the side of g. With a the axis, c and s cosine and sine of the half-angle, and
 * p = g - (g.a) a, the part of g across the axis, its normal is n = c p - s |p| a, and for every l in the
 * cone n.l <= |p| |l| sin(angle of l - half-angle) <= 0. So the box is apart where the least n.l in it is
 * above 0, by more than rounding may be (products of u left out; all are less than a tenth of the margin):
 *
 *   1. g.a is off by 3u |g|, a.a by 4u, p by u |p| as it is rounded: so p.a, which should be 0, is less
 *      than 9u |g|, and moves n.l by as much times |l|.
 *   2. c and s are rounded, u each; |p| is off by 3u; the products and the sum of n by 3u: 9u |p| |l|.
 *   3. the least n.l, a sum of three: 3u |n| |l|, with |n| <= 1.5 |p|.
 *
 * |p| <= |g|: 23u |g| |l| in all, and a margin of 32u times what the coordinates of g and of the farthest l
 * add up to, which is no less than |g| |l|. */
TL_INLINE mask is_apart(tl_view_spot spot, vec3 low, vec3 high, vec3 g, real farthest)
{
    const vec3 axis = axis_of(spot);
    const vec3 p = fma3(axis, -along_axis(spot, g), g);
    const real across2 = dot3(p, p);
    const real back = (real)-spot.cull_sin * SQRT(across2);
    const vec3 n = {FMA(axis.x, back, p.x * (real)spot.cull_cos),
                    FMA(axis.y, back, p.y * (real)spot.cull_cos),
                    FMA(axis.z, back, p.z * (real)spot.cull_cos)};
    const vec3 nearest = {pick(n.x > R(0.0), low.x, high.x), pick(n.y > R(0.0), low.y, high.y),
                          pick(n.z > R(0.0), low.z, high.z)};
    const vec3 size = {ABSOLUTE(g.x), ABSOLUTE(g.y), ABSOLUTE(g.z)};
    return (dot3(n, nearest) > TL_CONE_MARGIN * (sum3(size) * farthest)) &
           (across2 > TL_LEAST_ACROSS2);
}

/* The point of the box of ways nearest to where the axis passes g: where a long box comes nearest to the
 * cone, if g does not tell. */
TL_INLINE vec3 nearest_to_axis(tl_view_spot spot, vec3 low, vec3 high, vec3 g)
{
    const real along = along_axis(spot, g);
    const real ahead = pick(along > R(0.0), along, R(0.0));
    const vec3 on_axis = {ahead * (real)spot.axis[0], ahead * (real)spot.axis[1],
                          ahead * (real)spot.axis[2]};
    const vec3 not_above = {pick(high.x < on_axis.x, high.x, on_axis.x),
                            pick(high.y < on_axis.y, high.y, on_axis.y),
                            pick(high.z < on_axis.z, high.z, on_axis.z)};
    const vec3 nearest = {pick(low.x > not_above.x, low.x, not_above.x),
                          pick(low.y > not_above.y, low.y, not_above.y),
                          pick(low.z > not_above.z, low.z, not_above.z)};
    return nearest;
}

/* Whether the cone may hold a position in the box; `of` holds the positions computed for the pixels of a
 * tile. Of no meaning where the box is empty.
 *
 * Where a pixel's l is computed, it is within [low, high], bit for bit, for subtraction is monotone. Two
 * tests say that in_cone holds nowhere in there:
 *
 *   - The largest l.axis, at a corner that the signs of the axis choose, squared, is not above what the
 *     least (for a wide cone the largest) l.l asks for. Each step is monotone, as in reach.h: exact,
 *     without a margin. Alone it takes boxes for met that are long as seen from the light.
 *   - A plane parts the two: is_apart, for two choices of g. The cone there is one that contains every l for
 *     which in_cone holds in spite of its rounding. Let it hold: then
 *     (1 + u)(l.a + 3u |l|)^2 > cos^2 |l|^2 (1 - 5u), the stored square being off by u, l.l by 3u, the
 *     product by u; so l.a > (cos - 7u) |l|, and the axis is of length 1 to 2u. cull_cos is of a cosine
 *     16u less (host/frame/spot_cone.c), and where that is not above 0, no plane is asked.
 *
 * What is no number is met. tests/test_spot_culling.c attacks both. Of boxes in reach of a light, as long and
 * wide as a seventh of its range, at a half-angle of 0.2, 1.03 times as many are met as the cone touches; of
 * such as are six times as deep 1.15 times, where g in the middle alone gives 1.5. Tiles of 1000 spots list
 * 1.07 to 1.11 times what their pixels need (tests/test_spot_lists.c). */
TL_INLINE mask cone_meets_box(tl_view_spot spot, tl_view_light light, box of)
{
    const vec3 low = {light.position[0] - of.high.x, light.position[1] - of.high.y,
                      light.position[2] - of.high.z};
    const vec3 high = {light.position[0] - of.low.x, light.position[1] - of.low.y,
                       light.position[2] - of.low.z};
    const vec3 ahead = {spot.axis[0] > 0 ? high.x : low.x, spot.axis[1] > 0 ? high.y : low.y,
                        spot.axis[2] > 0 ? high.z : low.z};
    const vec3 near = {clamp_to(low.x, high.x, 0), clamp_to(low.y, high.y, 0),
                       clamp_to(low.z, high.z, 0)};
    const vec3 far = {farther(low.x, high.x), farther(low.y, high.y), farther(low.z, high.z)};
    const vec3 extreme = spot.least_cos2 < 0 ? far : near;
    const mask met =
        !(signed_square(along_axis(spot, ahead)) <= spot.least_cos2 * dot3(extreme, extreme));
    if (!(spot.cull_cos > 0))
        return met;
    const real farthest = sum3(far);
    const vec3 middle = {R(0.5) * (low.x + high.x), R(0.5) * (low.y + high.y),
                         R(0.5) * (low.z + high.z)};
    return met & !is_apart(spot, low, high, middle, farthest) &
           !is_apart(spot, low, high, nearest_to_axis(spot, low, high, middle), farthest);
}

#endif
