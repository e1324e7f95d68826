/* Which lights reach which pixels: decided once, for shading and for culling.
 *
 * A light with a range contributes to a pixel if and only if `reaches` holds for the squared
 * distance between the light and the pixel's computed position.
 *
 * Invariant. Let a box contain the positions computed for the pixels of a tile, and q be the
 * point of the box nearest to the light. Then distance2(q) <= distance2(p) for every such
 * position p, as computed, bit for bit, because each step is monotone in IEEE arithmetic:
 *   1. per axis q is the light's coordinate clamped to [low, high] and p is within it, so the
 *      exact difference for q is 0 or of the sign of p's, and no larger in magnitude;
 *   2. rounding is monotone, so that holds for the rounded differences too;
 *   3. products and fused sums of non-negative operands grow with each operand, rounded or not.
 * So a tile whose box fails `reaches` holds no pixel that passes it, and culling needs no margin
 * for rounding. It holds only while both sides call these functions. NaN positions pass
 * nowhere. tests/test_culling_exact.c puts lights one ulp inside and outside their range. */
#ifndef TL_REACH_H
#define TL_REACH_H

#include "frame.h"
#include "vec3.h"

typedef struct box {
    vec3 low, high; /* m, view space; low > high where empty, which no light reaches */
} box;

TL_INLINE vec3 vector_to_light(vec3 from, tl_view_light light)
{
    const vec3 v = {light.position[0] - from.x, light.position[1] - from.y,
                    light.position[2] - from.z};
    return v;
}

TL_INLINE mask reaches(tl_view_light light, real distance2)
{
    return distance2 < light.range2;
}

/* In this order each line is one instruction of vector processors. */
TL_INLINE real clamp_to(real low, real high, scalar at)
{
    const real not_above = pick(high < at, high, at);
    return pick(low > not_above, low, not_above);
}

TL_INLINE mask reaches_box(tl_view_light light, box of)
{
    const vec3 nearest = {clamp_to(of.low.x, of.high.x, light.position[0]),
                          clamp_to(of.low.y, of.high.y, light.position[1]),
                          clamp_to(of.low.z, of.high.z, light.position[2])};
    const vec3 away = vector_to_light(nearest, light);
    return reaches(light, dot3(away, away));
}

#endif
