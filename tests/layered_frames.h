/* Random frames with layers before them. */
#ifndef TL_LAYERED_FRAMES_H
#define TL_LAYERED_FRAMES_H

#include "frames.h"

#include "tilelight/layouts.h"

/* Whole tiles without any of it, opacities of 0 and 1, and between. */
static inline float random_opacity(uint32_t x, uint32_t y, uint32_t *seed)
{
    const float a = uniform(seed, -0.3f, 1.2f);
    if ((x / 16 + y / 16) % 3 == 0)
        return 0.0f;
    return a < 0.0f ? 0.0f : a > 1.0f ? 1.0f : a;
}

/* Of `count` layers, each of surfaces of its own, in full float. The caller destroys it. */
static inline tl_gbuffer *layered_gbuffer(const tl_camera *camera,
                                          uint32_t present,
                                          uint32_t count,
                                          uint32_t seed)
{
    tl_gbuffer *g = random_gbuffer(camera, present, seed);
    tl_error err;
    for (uint32_t i = 0; i < count; i++) {
        tl_gbuffer *from = random_gbuffer(camera, present, seed + 17 * (i + 1)), *layer = NULL;
        ASSERT_OK(tl_layers_add(g, &layer, &err), err);
        memcpy(layer->planes, from->planes,
               (size_t)g->pitch * g->rows * tl_gbuffer_pixel_size(g));
        for (uint32_t y = 0; y < camera->height; y++)
            for (uint32_t x = 0; x < camera->width; x++)
                layer->opacity[(size_t)y * g->pitch + x] = random_opacity(x, y, &seed);
        tl_gbuffer_destroy(from);
    }
    ASSERT_OK(tl_gbuffer_repair(g, "layered", false, NULL, &err), err);
    return g;
}

/* The same in another layout; the caller destroys it. */
static inline tl_gbuffer *packed_layers(const tl_gbuffer *from, enum tl_layout_name layout)
{
    tl_gbuffer *made = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_pack(from, layout, &made, NULL, &err), err);
    return made;
}

#endif
