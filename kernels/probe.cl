/* Device-side answers to questions the tests ask. Not part of a frame. */
#include "frame.h"

#define OFFSET(object, member) \
    ((uint)((__private const char *)&(object).member - (__private const char *)&(object)))

/* sizeof and offsetof as the device compiler sees them, in the order of
 * tests/test_frame_layout.c. Global size: 1. */
__kernel void probe_layout(__global uint *out)
{
    tl_frame frame;
    tl_view_light light;
    tl_view_spot spot;
    uint n = 0;
    out[n++] = sizeof(tl_frame);
    out[n++] = OFFSET(frame, rays);
    out[n++] = OFFSET(frame, view_from_world);
    out[n++] = OFFSET(frame, ambient);
    out[n++] = OFFSET(frame, tile_size);
    out[n++] = OFFSET(frame, sky);
    out[n++] = OFFSET(frame, box_count);
    out[n++] = OFFSET(frame, pitch);
    out[n++] = OFFSET(frame, rows);
    out[n++] = OFFSET(frame, tiles_x);
    out[n++] = OFFSET(frame, tiles_y);
    out[n++] = OFFSET(frame, box_pitch);
    out[n++] = OFFSET(frame, global_count);
    out[n++] = OFFSET(frame, light_count);
    out[n++] = OFFSET(frame, first_row);
    out[n++] = OFFSET(frame, buffer_row);
    out[n++] = OFFSET(frame, list_capacity);
    out[n++] = OFFSET(frame, cell_capacity);
    out[n++] = OFFSET(frame, has_cells);
    out[n++] = OFFSET(frame, depth_slope);
    out[n++] = OFFSET(frame, depth_offset);
    out[n++] = OFFSET(frame, slack_x);
    out[n++] = OFFSET(frame, slack_y);
    out[n++] = OFFSET(frame, brdfs_at);
    out[n++] = OFFSET(frame, shapes_at);
    out[n++] = OFFSET(frame, sky_at);
    out[n++] = OFFSET(frame, calls_at);
    out[n++] = OFFSET(frame, surroundings_at);
    out[n++] = OFFSET(frame, exponent);
    out[n++] = OFFSET(frame, is_layer);
    out[n++] = OFFSET(frame, sky_light_at);
    out[n++] = sizeof(tl_view_light);
    out[n++] = OFFSET(light, position);
    out[n++] = OFFSET(light, range2);
    out[n++] = OFFSET(light, diffuse);
    out[n++] = OFFSET(light, fade);
    out[n++] = OFFSET(light, specular);
    out[n++] = OFFSET(light, falloff);
    out[n++] = sizeof(tl_view_spot);
    out[n++] = OFFSET(spot, axis);
    out[n++] = OFFSET(spot, least_cos);
    out[n++] = OFFSET(spot, least_cos2);
    out[n++] = OFFSET(spot, scale);
    out[n++] = OFFSET(spot, cull_cos);
    out[n++] = OFFSET(spot, cull_sin);
}
