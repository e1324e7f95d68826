/* The broad phase: the rectangles of lights in tiles, a work-item per run of lights.
 *
 * In double, because the eye may be one ulp outside a light's sphere; on a device without it the
 * host runs the same header (host/lighting/cull_pass.c). */
#include "spot.h"
#include "tile_rect.h"

#ifdef TL_HAS_SPHERE_BOUNDS

/* lights    [light_count], and behind them the tl_view_spots of scenes with spots
 * rects     [TL_RECT_PLANE_COUNT][TL_RECT_PITCH(light_count)], written in full
 * list_end  [2], become 0: where the lists of the frame start, those of tiles and those of cells
 * Global size: a divisor of TL_RECT_PITCH(light_count). */
__kernel void light_rects(const tl_frame frame,
                          __global const tl_view_light *restrict lights,
                          __global int *restrict rects,
                          __global uint *restrict list_end)
{
    const tl_view_window window = view_window(&frame, TL_LEAST_DEPTH(TL_ORTHOGRAPHIC),
                                              TL_GREATEST_DEPTH, TL_ORTHOGRAPHIC);
    const uint pitch = TL_RECT_PITCH(frame.light_count);
    const uint run = pitch / get_global_size(0), first = get_global_id(0) * run;
    for (uint i = first; i < first + run; i++) {
        tl_tile_rect rect = {0, 0, 0, 0};
        if (i >= frame.global_count && i < frame.light_count)
            rect = tile_rect_of_spot(window, &frame, lights[i],
                                     spot_of(needs_of_build(), lights, frame.light_count, i));
        rects[TL_RECT_X0 * pitch + i] = rect.x0;
        rects[TL_RECT_X1 * pitch + i] = rect.x1;
        rects[TL_RECT_Y0 * pitch + i] = rect.y0;
        rects[TL_RECT_Y1 * pitch + i] = rect.y1;
    }
    if (first == 0)
        list_end[0] = list_end[1] = 0;
}

#endif
