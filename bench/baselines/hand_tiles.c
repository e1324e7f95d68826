/* The tiles of a frame for one instruction set (HAND_SET_...) and one arithmetic (HAND_RELAXED);
 * HAND_CODE is the name it is known by. */
#include "hand.h"

#if HAND_RELAXED
#    include "hand_relaxed.h"
#else
#    include "hand_exact.h"
#endif

#include <math.h>

#define TEXT_OF_(name) #name
#define TEXT_OF(name) TEXT_OF_(name)

static float least(lanes v)
{
    float out = v[0];
    for (int i = 1; i < LANES; i++)
        out = v[i] < out ? v[i] : out;
    return out;
}

static float largest(lanes v)
{
    return -least(-v);
}

static void bound_tile(const hand_frame *frame, uint32_t tile_x, uint32_t tile_y)
{
    const tl_frame *f = &frame->prepared->frame;
    const bool orthographic = frame->prepared->needs.orthographic != 0;
    const lanes infinite = all(INFINITY);
    lanes3 low = {infinite, infinite, infinite};
    lanes3 high = {-infinite, -infinite, -infinite};
    for (uint32_t row = tile_y * HAND_TILE; row < (tile_y + 1) * HAND_TILE; row += BLOCK_ROWS)
        for (uint32_t column = tile_x * HAND_TILE; column < (tile_x + 1) * HAND_TILE;
             column += BLOCK_COLUMNS) {
            const lanes depth = load_plane(frame, TL_DEPTH, (size_t)row * f->pitch + column);
            const lanes3 p = block_position(f, orthographic, column, row, depth);
            const lane_mask hit = below(depth, infinite);
            low.x = smaller(choose(hit, p.x, infinite), low.x);
            low.y = smaller(choose(hit, p.y, infinite), low.y);
            low.z = smaller(choose(hit, p.z, infinite), low.z);
            high.x = larger(choose(hit, p.x, -infinite), high.x);
            high.y = larger(choose(hit, p.y, -infinite), high.y);
            high.z = larger(choose(hit, p.z, -infinite), high.z);
        }
    frame->boxes[(size_t)tile_y * f->tiles_x + tile_x] =
        (hand_box){{least(low.x), least(low.y), least(low.z)},
                   {largest(high.x), largest(high.y), largest(high.z)}};
}

/* Lights to the point of [low, high] that is nearest to them. */
static lanes gap(lanes at, float low, float high)
{
    return at - smaller(larger(at, all(low)), all(high));
}

static size_t list_tile(const hand_frame *frame,
                        const hand_candidates *candidates,
                        uint32_t tile_x,
                        uint32_t tile_y,
                        const tl_view_light **list)
{
    const hand_box box = frame->boxes[(size_t)tile_y * frame->prepared->frame.tiles_x + tile_x];
    const lanes tile = all((float)tile_x);
    size_t count = 0;
    if (box.low[2] > box.high[2])
        return 0;
    for (size_t i = 0; i < candidates->count; i += LANES) {
        const lanes3 away = {gap(load_lanes(candidates->x + i), box.low[0], box.high[0]),
                             gap(load_lanes(candidates->y + i), box.low[1], box.high[1]),
                             gap(load_lanes(candidates->z + i), box.low[2], box.high[2])};
        const lane_mask inside = both(below(load_lanes(candidates->first + i), tile + 0.5f),
                                      below(tile, load_lanes(candidates->end + i)));
        const lane_mask met =
            both(inside, below(dot(away, away), load_lanes(candidates->range2 + i)));
        for (unsigned bits = bits_of(met); bits != 0; bits &= bits - 1)
            list[count++] = candidates->lights[i + (size_t)__builtin_ctz(bits)];
    }
    return count;
}

static block_light add_all_lights(const hand_frame *frame,
                                  block_surface s,
                                  const tl_view_light *const *list,
                                  size_t count)
{
    const tl_prepared *prepared = frame->prepared;
    const bool specular = prepared->needs.specular != 0;
    block_light sum = {{all(0.0f), all(0.0f), all(0.0f)}, {all(0.0f), all(0.0f), all(0.0f)}};
    for (uint32_t i = 0; i < prepared->frame.global_count; i++) {
        const tl_view_light *light = &prepared->lights[i];
        if (light->falloff == TL_FADE_NONE)
            add_directional(s, specular, light, &sum);
        else
            add_lights(s, specular, &light, 1, &sum);
    }
    for (size_t first = 0; first < count; first += CHUNK)
        add_lights(s, specular, list + first, count - first < CHUNK ? count - first : CHUNK,
                   &sum);
    return sum;
}

static void shade_tile(const hand_frame *frame,
                       uint32_t tile_x,
                       uint32_t tile_y,
                       const tl_view_light *const *list,
                       size_t count)
{
    const size_t pitch = frame->prepared->frame.pitch;
    for (uint32_t row = tile_y * HAND_TILE; row < (tile_y + 1) * HAND_TILE; row += BLOCK_ROWS)
        for (uint32_t column = tile_x * HAND_TILE; column < (tile_x + 1) * HAND_TILE;
             column += BLOCK_COLUMNS) {
            block_pixel pixel = {.at = row * pitch + column};
            block_light light = {{all(0.0f), all(0.0f), all(0.0f)},
                                 {all(0.0f), all(0.0f), all(0.0f)}};
            pixel.depth = load_plane(frame, TL_DEPTH, pixel.at);
            pixel.metallic = load_or(frame, TL_METALLIC, pixel.at, 0.0f);
            pixel.hit = below(pixel.depth, all(INFINITY));
            if (bits_of(pixel.hit))
                light = add_all_lights(frame, surface_of_block(frame, pixel, column, row), list,
                                       count);
            store_radiance(frame, pixel, light);
        }
}

static bool is_supported(void)
{
#if defined(HAND_SET_AVX512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#elif defined(HAND_SET_AVX2)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

const hand_code HAND_CODE = {
    TEXT_OF(HAND_CODE), is_supported, bound_tile, list_tile, shade_tile,
};
