/* Shading on a GPU: one work-item per pixel, in groups of TL_GROUP that are part of one tile, so that
 * a group walks over one list. Formulas and order are those of shade_tiles.cl, and so are the bits. */
#include "load_pixel.h"
#include "occlusion.h"
#include "options.h"
#include "shape.h"
#include "sky.h"
#include "store_pixel.h"

#if TL_BY_PIXEL

/* Arguments as those of shade_tiles. Global size: tile_size * tile_size * tiles_x * tiles_y, in groups
 * of TL_GROUP; a tile's pixels row by row, tiles row by row. */
__kernel void shade_pixels(const tl_frame frame,
                           __global const uchar *restrict planes,
                           __global const tl_view_light *restrict lights,
                           __global const uint *restrict starts,
                           __global const uint *restrict ends,
                           __global const uint *restrict list,
                           __global float *restrict radiance)
{
    const uint pixels_per_tile = frame.tile_size * frame.tile_size;
    const uint tile = get_global_id(0) / pixels_per_tile;
    const uint pixel_of_tile = get_global_id(0) % pixels_per_tile;
    const uint column =
        tile % frame.tiles_x * frame.tile_size + pixel_of_tile % frame.tile_size;
    const uint row = tile / frame.tiles_x * frame.tile_size + pixel_of_tile / frame.tile_size;
    const size_t plane_size = (size_t)frame.rows * frame.pitch;
    const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;
    const tl_needs needs = needs_of_build();

    const tl_layout layout = layout_of_build();
    const tl_brdf_rows rows = rows_behind(&frame, lights);
    const tl_words words = load_words(&layout, planes, plane_size, at, frame.pitch);
    const surface s = unpacked_surface(&frame, needs, &layout, &words, rows, (scalar)column,
                                       (scalar)(frame.first_row + row));
    pixel in = pixel_of(needs, &layout, &words, -s.position.z);
    in.occlusion = ambient_share(&frame, needs, (tl_numbers)lights, in.occlusion, at);
    const substance m = substance_at(&frame, needs, in, rows);
    finish f = finish_of(needs, s, m);
    f.at = at;
    received sum = nothing_received();
    if (in.depth < (real)INFINITY) {
        for (uint i = 0; i < frame.global_count; i++)
            sum = add_any_light(sum, &frame, needs, lights, s, f, lights[i],
                                spot_of(needs, lights, frame.light_count, i), 1);
        for (uint i = starts[tile]; i < ends[tile]; i++)
            sum = add_any_light(sum, &frame, needs, lights, s, f, lights[list[i]],
                                spot_of(needs, lights, frame.light_count, list[i]), 0);
        sum = add_sky(sum, &frame, needs, lights, s, m, in.occlusion);
    }
    const vec3 out =
        seen_radiance(&frame, needs, lights, in.depth, radiance_of(&frame, needs, in, m, sum),
                      (scalar)column, (scalar)(frame.first_row + row));
    store_surface_terms(&frame, needs, in, m, sum, radiance, at);
    store_seen(&frame, needs, in.depth, out, radiance, at);
}

#endif
