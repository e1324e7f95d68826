/* The broad phase: one work-item per LIGHTS_PER_ITEM lights, their rectangles in tiles.
 *
 * In double, because the eye may be one ulp outside a light's sphere; on a device without it the
 * host runs the same header (host/lighting/frame.c). */
#include "tile_rect.h"

#ifdef TL_HAS_SPHERE_BOUNDS

enum { LIGHTS_PER_ITEM = 32 };

/* depths  [tiles_y][2]: least and largest depth of the surfaces in a row of tiles, m
 * lights  [light_count]
 * rects   [light_count]; written from global_count on
 * Global size: light_count / LIGHTS_PER_ITEM, rounded up. */
__kernel void light_rects(const tl_frame frame,
                          __global const float *restrict depths,
                          __global const tl_view_light *restrict lights,
                          __global tl_tile_rect *restrict rects)
{
    double near = (double)INFINITY, far = (double)-INFINITY;
    for (uint row = 0; row < frame.tiles_y; row++) {
        near = min(near, (double)depths[2 * row]);
        far = max(far, (double)depths[2 * row + 1]);
    }
    const tl_view_window window = view_window(&frame, near, far, TL_ORTHOGRAPHIC);
    const uint first = get_global_id(0) * LIGHTS_PER_ITEM;
    const uint end = min(first + LIGHTS_PER_ITEM, frame.light_count);
    for (uint i = max(first, frame.global_count); i < end; i++)
        rects[i] = tile_rect_of(window, &frame, lights[i]);
}

#endif
