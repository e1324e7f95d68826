/* Shading: one work-item per tile, blocks of pixels as vectors, the light loop innermost.
 *
 * PoCL vectorises innermost loops only, and would have to choose the light loop; so the vectors
 * are explicit. No barrier, no local memory: work-groups are one work-item. Lights add up in
 * index order, so the image does not depend on scheduling.
 *
 * A light on a block is a chain of some 200 cycles of latency in some 130 instructions, and a
 * processor's schedulers hold some 200 instructions: one light after another would run at half a
 * pipeline. So the chain is cut into loops over the block's lights, each short enough that several
 * iterations are in flight, with what passes between them in memory (L1). Measured on Zen 5, per
 * frame: one loop 31 ms, three 27 ms, five 24 ms; keeping the squared distance 23 ms; surfaces of
 * a row of blocks first 22.5 ms.
 *
 * Floor, AVX-512 with two multiply-add pipes: per listed light and block 6 of these instructions,
 * 3 cycles; per kept one 53, and a root and two divisions that block one of the pipes for 10
 * cycles: 32 cycles.
 *
 * Where one colour multiplies both lobes (needs.h), diffuse light waits for the lobe and they are added at
 * once: 6 instructions of 76 less per kept light. Golden Cove has two ports for all of them: per listed
 * light 12, 6 cycles; per kept 70, 35 cycles, with a root and two divisions, 32 cycles, beside them. A
 * capture of 1280 x 720 with 13 listed and 5 kept lights a block takes 0.92 of the processor time of two
 * sums and of any_lane as a tree, with which a listed light is 18 instructions.
 *
 * Floor of a frame that lights nothing, 1920 x 1080 at 60 GB/s: the words of the layout read, 12 bytes
 * of radiance read, as a store to a line that is not there does, and written: full float 2.4 ms, 16
 * bytes 1.4 ms. Measured 3.7 ms and 2.1 ms: one and a half times. */
#include "choices.h"
#include "load_pixel.h"
#include "occlusion.h"
#include "shape.h"
#include "sky.h"
#include "store_pixel.h"

/* A row of blocks in the largest tile, 64 px. */
#define MOST_BLOCKS_OF_ROW (64 / BLOCK_COLUMNS)

/* Asks for what the next tile reads and writes there. */
TL_INLINE void ask_for_next_tile(const tl_layout *layout,
                                 uint words,
                                 __global const uchar *planes,
                                 __global const float *radiance,
                                 size_t first,
                                 const tl_frame *frame)
{
    const size_t plane_size = (size_t)frame->rows * frame->pitch;
    ask_for_next(layout, words, planes, first, frame);
    for (uint plane = 0; plane < TL_PICTURE_PLANES(TL_SPLIT); plane++)
        for (uint column = 0; column < frame->tile_size; column += BYTES_PER_LINE / 4)
            ASK_FOR_ROWS(radiance + plane * plane_size + first + frame->tile_size + column,
                         frame->pitch, 1);
}

/* Lights of a list that are taken through the loops together: the arrays below stay in L1. */
#define LIGHTS_AT_ONCE 64

/* Adds lights list[0] to list[count - 1], count up to LIGHTS_AT_ONCE: the steps of kernels/light.h's
 * add_ranged_light, each for all of them. Where a loop's results can stand in place of what it
 * read, they do: the fewer lines of L1 the arrays take, the better. */
TL_INLINE received add_listed_lights(received sum,
                                     tl_needs needs,
                                     surface s,
                                     __global const tl_view_light *lights,
                                     uint light_count,
                                     __global const uint *list,
                                     uint count)
{
    uint kept[LIGHTS_AT_ONCE], kept_count = 0;
    real reach[LIGHTS_AT_ONCE]; /* squared distance, then distance */
    real seen[LIGHTS_AT_ONCE];  /* facing, then what add_diffuse leaves to the lobe */
    real cos2[LIGHTS_AT_ONCE], sin2[LIGHTS_AT_ONCE]; /* of the half vector */
    real log2_of[LIGHTS_AT_ONCE];                    /* the lobe */
    real beside[LIGHTS_AT_ONCE]; /* shine_of, where add_lobe needs `seen` too */
    real *const shine = needs.one_color ? beside : seen;

    /* Those that may add anything; without a branch, for which they are is not predictable. */
    for (uint i = 0; i < count; i++) {
        const tl_view_light light = lights[list[i]];
        const tl_view_spot spot = spot_of(needs, lights, light_count, list[i]);
        const vec3 l = vector_to_light(s.position, light);
        const approach a = approach_of(s, l);
        kept[kept_count] = list[i];
        reach[kept_count] = a.distance2;
        seen[kept_count] = a.facing;
        kept_count += any_lane(may_be_lit(needs, light, spot, l, a));
    }
    for (uint i = 0; i < kept_count; i++) {
        const approach a = {reach[i], seen[i]};
        const tl_view_spot spot = spot_of(needs, lights, light_count, kept[i]);
        sum.diffuse = add_ranged_diffuse(sum.diffuse, needs, s, lights[kept[i]], spot, a,
                                         &reach[i], &seen[i]);
    }
    if (!needs.specular)
        return sum;
    for (uint i = 0; i < kept_count; i++) {
        const vec3 l = vector_to_light(s.position, lights[kept[i]]);
        const half_angle a = highlight_angle(s, l, reach[i]);
        shine[i] = shine_of(needs, s, a, seen[i]);
        cos2[i] = a.cos2;
        sin2[i] = a.sin2;
    }
    for (uint i = 0; i < kept_count; i++)
        log2_of[i] = log2_of_power(cos2[i], sin2[i], s.shininess);
    for (uint i = 0; i < kept_count; i++)
        sum = add_lobe(sum, needs, colors_of(lights[kept[i]]), seen[i], shine[i],
                       power_of_log2(log2_of[i]));
    return sum;
}

/* The same by models that are not plain: add_ranged_light in three steps, for the reasons above. Floor of
 * metal-rough, AVX-512: roots of the distance, of v.h and of the masked cosine, and quotients by the distance
 * and of the lobe, 5 that block one pipe for 10 cycles each: 50 a kept light; of Blinn's power 32. */
TL_INLINE received add_reflected_lights(received sum,
                                        tl_needs needs,
                                        surface s,
                                        finish f,
                                        __global const tl_view_light *lights,
                                        uint light_count,
                                        __global const uint *list,
                                        uint count)
{
    uint kept[LIGHTS_AT_ONCE], kept_count = 0;
    approach seen[LIGHTS_AT_ONCE];
    arrival from[LIGHTS_AT_ONCE];

    for (uint i = 0; i < count; i++) {
        const tl_view_light light = lights[list[i]];
        const tl_view_spot spot = spot_of(needs, lights, light_count, list[i]);
        const vec3 l = vector_to_light(s.position, light);
        const approach a = approach_of(s, l);
        kept[kept_count] = list[i];
        seen[kept_count] = a;
        kept_count += any_lane(may_be_lit(needs, light, spot, l, a));
    }
    for (uint i = 0; i < kept_count; i++)
        from[i] = ranged_arrival(needs, s, lights[kept[i]],
                                 spot_of(needs, lights, light_count, kept[i]), seen[i]);
    for (uint i = 0; i < kept_count; i++)
        sum = add_reflection(sum, needs, s, f, colors_of(lights[kept[i]]),
                             vector_to_light(s.position, lights[kept[i]]), seen[i], from[i]);
    return sum;
}

/* How many lights at the start of a list have no shape: those that add_listed_lights takes. */
TL_INLINE uint count_without_shapes(__global const tl_view_light *lights,
                                    __global const uint *list,
                                    uint count)
{
    uint i = 0;
    while (i < count && !has_shape(lights[list[i]].falloff))
        i++;
    return i;
}

/* A tile's lights: list[start] to list[end - 1], behind those that reach everything. */
typedef struct tile_lights {
    __global const tl_view_light *lights; /* as shade_tiles has them */
    __global const uint *list;
    uint start, end;
} tile_lights;

TL_INLINE received
lit_by(const tl_frame *frame, tl_needs needs, surface s, finish f, tile_lights by)
{
    received sum = nothing_received();
    for (uint i = 0; i < frame->global_count; i++)
        sum = add_any_light(sum, frame, needs, by.lights, s, f, by.lights[i],
                            spot_of(needs, by.lights, frame->light_count, i), 1);
    /* Together, but for those that have shapes. */
    for (uint i = by.start, count; i < by.end; i += count) {
        count = min(by.end - i, (uint)LIGHTS_AT_ONCE);
        if (has_shapes(needs))
            count = count_without_shapes(by.lights, by.list + i, count);
        if (has_shapes(needs) && count == 0) {
            const uint one = by.list[i];
            count = 1;
            sum = add_any_light(sum, frame, needs, by.lights, s, f, by.lights[one],
                                spot_of(needs, by.lights, frame->light_count, one), 0);
        } else if (is_plain(needs)) {
            sum = add_listed_lights(sum, needs, s, by.lights, frame->light_count, by.list + i,
                                    count);
        } else {
            sum = add_reflected_lights(sum, needs, s, f, by.lights, frame->light_count,
                                       by.list + i, count);
        }
    }
    return sum;
}

/* A row of blocks of a tile: `first` is its first pixel, in the image at (column, row). */
typedef struct block_row {
    size_t first;
    uint column, row;
} block_row;

TL_INLINE int shows_surface(surface s)
{
    return any_lane(s.position.z > (real)-INFINITY);
}

/* The surfaces of a row's blocks; of those that are all sky the position alone, and depth is all that is
 * read. Returns whether any is not. */
TL_INLINE int load_surfaces(const tl_frame *frame,
                            tl_needs needs,
                            uint words_there,
                            __global const uchar *planes,
                            tl_brdf_rows rows,
                            block_row of,
                            surface surfaces[MOST_BLOCKS_OF_ROW])
{
    const size_t plane_size = (size_t)frame->rows * frame->pitch;
    const tl_layout layout = layout_of_build();
    const real row = (scalar)(frame->first_row + of.row) + LANE_ROW;
    int shows = 0;
    for (uint b = 0; b < frame->tile_size / BLOCK_COLUMNS; b++) {
        const size_t at = of.first + b * BLOCK_COLUMNS;
        const real column = (scalar)(of.column + b * BLOCK_COLUMNS) + LANE_COLUMN;
        const tl_words depths = load_some_words(&layout, depth_words(&layout), planes,
                                                plane_size, at, frame->pitch);
        surfaces[b].position = position_of(frame, needs, &layout, &depths, column, row);
        if (!shows_surface(surfaces[b]))
            continue;
        const tl_words words =
            load_some_words(&layout, words_there, planes, plane_size, at, frame->pitch);
        surfaces[b] = unpacked_surface(frame, needs, &layout, &words, rows, column, row);
        shows = 1;
    }
    return shows;
}

/* What a block with surfaces reflects and sends out; its terms are stored. Its words are loaded anew after
 * the lights: with them, their loops would have no registers left. (Where lobes are plain, nothing asks for
 * f.) */
TL_INLINE vec3 lit_block(const tl_frame *frame,
                         tl_needs needs,
                         uint words_there,
                         __global const uchar *planes,
                         tl_brdf_rows rows,
                         tile_lights by,
                         surface s,
                         __global float *radiance,
                         size_t at)
{
    const size_t plane_size = (size_t)frame->rows * frame->pitch;
    const tl_layout layout = layout_of_build();
    const tl_words before =
        load_some_words(&layout, words_there, planes, plane_size, at, frame->pitch);
    const pixel to_finish = pixel_of(needs, &layout, &before, -s.position.z);
    finish f = finish_of(needs, s, substance_at(frame, needs, to_finish, rows));
    f.at = at;
    received sum = lit_by(frame, needs, s, f, by);
    const tl_words words =
        load_some_words(&layout, words_there, planes, plane_size, at, frame->pitch);
    pixel in = pixel_of(needs, &layout, &words, -s.position.z);
    in.occlusion = ambient_share(frame, needs, (tl_numbers)by.lights, in.occlusion, at);
    const substance m = substance_at(frame, needs, in, rows);
    sum = add_sky(sum, frame, needs, by.lights, s, m, in.occlusion);
    store_surface_terms(frame, needs, in, m, sum, radiance, at);
    return radiance_of(frame, needs, in, m, sum);
}

/* needs: what the tile computes. Where they leave something out that the build has, that is a constant, and
 * the function compiled once more (cones), or a branch that is the same for all of the tile (lobes,
 * shapes). Of the next tile's planes a row that is all sky asks for depth alone: there, too, it is as a
 * rule. Of a layer such rows are not written. */
TL_INLINE void shade_tile(const tl_frame *frame,
                          tl_needs needs,
                          uint tile,
                          __global const uchar *planes,
                          tile_lights by,
                          __global float *radiance)
{
    const uint column0 = tile % frame->tiles_x * frame->tile_size;
    const uint row0 = tile / frame->tiles_x * frame->tile_size;
    const tl_layout layout = layout_of_build();
    const uint words_there = words_read(&layout, needs);
    const tl_brdf_rows rows = rows_behind(frame, by.lights);
    surface surfaces[MOST_BLOCKS_OF_ROW];

    for (uint row = row0; row < row0 + frame->tile_size; row += BLOCK_ROWS) {
        const block_row of = {(size_t)(frame->buffer_row + row) * frame->pitch + column0,
                              column0, row};
        const int shows = load_surfaces(frame, needs, words_there, planes, rows, of, surfaces);
        if (frame->is_layer && !shows) {
            ask_for_next(&layout, depth_words(&layout), planes, of.first, frame);
            continue;
        }
        ask_for_next_tile(&layout, shows ? words_there : depth_words(&layout), planes, radiance,
                          of.first, frame);
        for (uint b = 0; b < frame->tile_size / BLOCK_COLUMNS; b++) {
            const size_t at = of.first + b * BLOCK_COLUMNS;
            vec3 lit = {frame->sky[0], frame->sky[1], frame->sky[2]};
            if (shows_surface(surfaces[b]))
                lit = lit_block(frame, needs, words_there, planes, rows, by, surfaces[b],
                                radiance, at);
            else
                store_no_terms(frame, needs, radiance, at);
            const vec3 out =
                seen_radiance(frame, needs, by.lights, -surfaces[b].position.z, lit,
                              (scalar)(column0 + b * BLOCK_COLUMNS) + LANE_COLUMN,
                              (scalar)(frame->first_row + row) + LANE_ROW);
            store_seen(frame, needs, -surfaces[b].position.z, out, radiance, at);
        }
    }
}

/* The tile with what its lights call for. */
TL_INLINE void shade_as_called(const tl_frame *frame,
                               uint tile,
                               __global const uchar *planes,
                               tile_lights by,
                               __global float *radiance)
{
    tl_needs needs = needs_of_build();
    uint called = 0;
    if (TL_CHOICES)
        called = calls_of_tile(frame, by.lights, by.list, by.start, by.end);
    if (TL_CHOICES & TL_CHOICE_LOBES)
        needs.specular = (called & TL_CHOICE_LOBES) != 0;
    if ((TL_CHOICES & TL_CHOICE_SHAPES) && !(called & TL_CHOICE_SHAPES))
        needs.shapes = 0;
    if ((TL_CHOICES & TL_CHOICE_CONES) && !(called & TL_CHOICE_CONES)) {
        tl_needs without_cones = needs;
        without_cones.spots = 0;
        shade_tile(frame, without_cones, tile, planes, by, radiance);
        return;
    }
    shade_tile(frame, needs, tile, planes, by, radiance);
}

#if TL_TIMED
#    define TIMES , __global ulong *restrict times
#    define NOTE_TIME(at) (times[at] = clock_now())
/* Ticks of a clock that all threads share, where a kernel can read one; else 0. */
TL_INLINE ulong clock_now(void)
{
#    if defined(__clang__) && defined(__x86_64__)
    return __builtin_readcyclecounter();
#    else
    return 0;
#    endif
}
#else
#    define TIMES
#    define NOTE_TIME(at)
#endif

/* planes    the frame's word planes, [rows][pitch] numbers each: layout.h
 * lights    [light_count]: first the global_count that reach everything; behind them as many
 *           tl_view_spots, where the scene has spots, and sections (frame.h)
 * starts, ends  [tiles_y * tiles_x]: tile t lists list[starts[t]] to list[ends[t] - 1], ascending
 * radiance  [3][rows][pitch], linear Rec. 709; written in full for every tile of the image; with TL_SPLIT
 *           as many for each of its terms behind
 * times     [tiles_y * tiles_x][2], with TL_TIMED alone: when each tile began and ended
 * Global size: tiles_x * tiles_y, tiles row by row. */
__kernel void shade_tiles(const tl_frame frame,
                          __global const uchar *restrict planes,
                          __global const tl_view_light *restrict lights,
                          __global const uint *restrict starts,
                          __global const uint *restrict ends,
                          __global const uint *restrict list,
                          __global float *restrict radiance TIMES)
{
    const uint tile = get_global_id(0);
    const tile_lights by = {lights, list, starts[tile], ends[tile]};
    NOTE_TIME(2 * tile);
    shade_as_called(&frame, tile, planes, by, radiance);
    NOTE_TIME(2 * tile + 1);
}
