/* Lights whose range ends at a pixel to the last bit of the kernels' own squared distance, in any layout:
 * at it, one float beyond it, one float before it. */
#ifndef TL_RIM_LIGHTS_H
#define TL_RIM_LIGHTS_H

#include "packed_frames.h"

#include "prepared.h"
#include "reach.h"

/* Where a light's range ends: range2 is d2 of this pixel and so many floats more. 1 is the least with which
 * it reaches the pixel. */
typedef struct rim {
    uint32_t x, y;
    int floats_beyond; /* -1, 0 or 1 */
} rim;

/* The frame as kernels have it, none of the lights left out; the caller clears it. */
static inline tl_prepared prepared_of(const tl_gbuffer *g, const tl_light_set *lights)
{
    static const tl_prepare_options options = {
        .tile_size = 8, .box_count = 1, .effects = TL_EFFECTS_ALL};
    tl_prepared prepared = {0};
    tl_error err;
    ASSERT_OK(tl_prepare(g, lights, &options, NULL, &prepared, &err), err);
    return prepared;
}

/* Where the kernels see the pixel, view space; z is -INFINITY where nothing was hit. */
static inline vec3 seen_position(const tl_prepared *prepared,
                                 const tl_gbuffer *g,
                                 uint32_t x,
                                 uint32_t y)
{
    const tl_word_planes planes = tl_word_planes_of(g);
    const tl_words words = tl_words_at(&planes, (size_t)y * g->pitch + x);
    return position_of(&prepared->frame, prepared->needs, planes.layout, &words, (float)x,
                       (float)y);
}

/* The same, of one pixel. */
static inline vec3 position_at(const tl_gbuffer *g, uint32_t x, uint32_t y)
{
    const tl_light_set none = {0};
    tl_prepared prepared = prepared_of(g, &none);
    const vec3 p = seen_position(&prepared, g, x, y);
    tl_prepared_clear(&prepared);
    return p;
}

/* The light as the kernels have it. */
static inline tl_view_light seen_light(const tl_gbuffer *g, const tl_light *light)
{
    const tl_light_set alone = {.count = 1, .lights = (tl_light[]){*light}};
    tl_prepared prepared = prepared_of(g, &alone);
    const tl_view_light view = prepared.lights[0];
    tl_prepared_clear(&prepared);
    return view;
}

/* A range whose square, as it is prepared, is this float; 0 where there is none. */
static inline float range_of_square(float square)
{
    float range = nextafterf(sqrtf(square), 0.0f);
    for (int i = 0; i < 3; i++, range = nextafterf(range, INFINITY))
        if ((float)((double)range * (double)range) == square)
            return range;
    return 0.0f;
}

static inline float floats_beyond(float value, int count)
{
    return count == 0 ? value : nextafterf(value, count > 0 ? INFINITY : 0.0f);
}

/* Puts a light at `offset` (view space, m) from the pixel, which is no sky, with a range that ends there. Two
 * floats of three are no square of a float: the light moves by some ulps until the wanted one is; straight
 * beside a pixel that may never be, and it is the next square on that side. As bright up to its rim as
 * anywhere, so that what is lost there shows. */
static inline tl_light rim_light(const tl_gbuffer *g, rim at, const float offset[3])
{
    enum { TRY_COUNT = 60 };
    const vec3 p = position_at(g, at.x, at.y);
    const double view[3] = {(double)p.x + (double)offset[0], (double)p.y + (double)offset[1],
                            (double)p.z + (double)offset[2]};
    tl_light light = tl_light_default();
    double world[3];
    tl_camera_world_point(&g->camera, view, world);
    for (int axis = 0; axis < 3; axis++)
        light.position[axis] = (float)world[axis];
    light.range = 0.0f;
    for (int i = 0; light.range == 0.0f; i++) {
        light.position[i % 3] = nextafterf(light.position[i % 3], INFINITY);
        const vec3 l = vector_to_light(p, seen_light(g, &light));
        float square = dot3(l, l);
        for (int k = 0; k < (i < TRY_COUNT ? 1 : 4) && light.range == 0.0f; k++) {
            square = floats_beyond(square, at.floats_beyond);
            light.range = range_of_square(square);
        }
        assert_true(i < 2 * TRY_COUNT);
    }
    light.falloff = TL_FALLOFF_LINEAR;
    light.begin = light.range;
    return light;
}

/* The first or the last column or row of a tile of 8 px, and so of larger ones, as often as any; ranges end
 * before it, at it, beyond it by turns. */
static inline rim rim_of_tile(const tl_gbuffer *g, uint32_t *seed, uint32_t i)
{
    rim at = {(uint32_t)uniform(seed, 0.0f, (float)g->camera.width),
              (uint32_t)uniform(seed, 0.0f, (float)g->camera.height), (int)(i % 3) - 1};
    const uint32_t last = i % 2 ? 7u : 0u;
    if (i % 4 < 2)
        at.x = at.x / 8 * 8 + last;
    else
        at.y = at.y / 8 * 8 + last;
    if (at.x >= g->camera.width)
        at.x = g->camera.width - 1;
    if (at.y >= g->camera.height)
        at.y = g->camera.height - 1;
    return at;
}

#endif
