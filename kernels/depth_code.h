/* Depth, and with it the position of a pixel, from what is stored: one row a convention.
 *
 *   metres          depth itself; sky is +infinity
 *   forward         0 on the near plane, 1 on the far plane: Direct3D's clip space, OpenGL's depth buffer
 *   ndc             -1 on the near plane, 1 on the far plane: OpenGL's normalised device coordinates
 *   reversed        1 on the near plane, 0 on the far plane
 *   fraction        (depth - near) / (far - near); sky is +infinity
 *   view position   x, y, z in view space, m; sky is x = +infinity
 *   world position  x, y, z in world space, m; sky is x = +infinity
 *
 * The three of the depth buffer are brought to nearness q, 1 on the near plane and 0 on the far plane.
 * Under a perspective camera
 *
 *     1/depth = q (1/near - 1/far) + 1/far,
 *
 * one fma and one division; sky is q <= 0, and no surface is written there. That is "Deferred Shading
 * Tricks"' 1/depth = d/P34 + P33/P34 moved to its other end. Theirs adds terms of opposite sign, so
 * what rounding them leaves far away is u far/near of the depth; here nothing cancels:
 *
 *     |error| <= (h + r + 3u) depth, h = |dq| depth (1/near - 1/far), u = 2^-24.
 *
 *   1. dq is what q has lost when its number was stored: half a step of it, and where half a step would be
 *      sky, the whole one that keeps a surface from it.
 *   2. r is what reading q adds: 0 reversed, u of 1 - d and (1 - d)/2 (exact from d = 1/2 on: Sterbenz),
 *      2u of whole numbers, (most - raw) step: the step is rounded, and the product.
 *   3. Slope and offset are rounded once each, and both terms are positive: u of their sum. The fma and
 *      the division: u each. (A device that does not round divisions correctly: 5u in place of that u.)
 *
 * Where h is not small, 1/depth is off by h/depth. Under an orthographic camera depth = far - q (far -
 * near), off by (|dq| + (r + u) q) (far - near) + u |depth|, far being exact; a fraction by
 * 2u |depth - near| + u |depth|. Asserted by tests/test_position_from_depth.c, where the textbook form
 * fails. */
#ifndef TL_DEPTH_CODE_H
#define TL_DEPTH_CODE_H

#include "frame.h"
#include "needs.h"

enum tl_depth_code {
    TL_DEPTH_NOT_STORED,
    TL_DEPTH_METRES,
    TL_DEPTH_FORWARD,
    TL_DEPTH_NDC,
    TL_DEPTH_REVERSED,
    TL_DEPTH_FRACTION,
    TL_DEPTH_VIEW_POSITION,
    TL_DEPTH_WORLD_POSITION,
    TL_DEPTH_CODE_COUNT
};

#define TL_IS_POSITION(code) ((code) >= TL_DEPTH_VIEW_POSITION)
#define TL_IS_NEARNESS(code) ((code) >= TL_DEPTH_FORWARD && (code) <= TL_DEPTH_REVERSED)

/* 1 on the near plane, 0 on the far plane. */
TL_INLINE real nearness_of(tl_u32 code, real stored)
{
    if (code == TL_DEPTH_FORWARD)
        return R(1.0) - stored;
    if (code == TL_DEPTH_NDC)
        return FMA(stored, R(-0.5), R(0.5));
    return stored;
}

/* m; +infinity is sky. stored: the number, or the nearness of conventions that have one. */
TL_INLINE real depth_of(const tl_frame *frame, tl_needs needs, tl_u32 code, real stored)
{
    if (code == TL_DEPTH_METRES)
        return stored;
    if (code == TL_DEPTH_FRACTION)
        return FMA(stored, frame->depth_slope, frame->depth_offset);
    const real line = FMA(stored, frame->depth_slope, frame->depth_offset);
    return pick(stored > R(0.0), needs.orthographic ? line : R(1.0) / line, (real)INFINITY);
}

#endif
