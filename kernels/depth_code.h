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
 * that far away it keeps u far/near of the result's digits; here q is exact (1 - d is, from 1/2 on) and
 * nothing cancels: 3u of the depth, u = 2^-24, beside what d has lost when it was stored:
 *
 *     |error| <= (h + 3u) depth, h = |dq| depth (1/near - 1/far),
 *
 * dq half a step of d. Under an orthographic camera depth = far - q (far - near). */
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
