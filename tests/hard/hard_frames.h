/* Frames and lights of hard cases. */
#ifndef TL_HARD_FRAMES_H
#define TL_HARD_FRAMES_H

#include "rim_lights.h"

/* No multiples of any tile. */
enum { FRAME_WIDTH = 45, FRAME_HEIGHT = 29 };

/* Cameras that bounds are tried under: turned, wide, off their axis. */
enum { VIEW_COUNT = 3 };

static inline tl_camera view_of(int i)
{
    static const double eye[3] = {3, -2, 5}, target[3] = {2.5, -2.2, 1}, up[3] = {0.1, 1, 0.2};
    static const double fields_of_view[VIEW_COUNT] = {1.2, 2.6, 0.9};
    tl_camera camera = tl_camera_look_at(eye, target, up, fields_of_view[i], FRAME_WIDTH,
                                         FRAME_HEIGHT, 0.1, 100.0);
    const float across = i == 2 ? 2.5f * camera.right : 0.0f;
    const float along = i == 2 ? -1.5f * camera.top : 0.0f;
    camera.left += across;
    camera.right += across;
    camera.bottom += along;
    camera.top += along;
    return camera;
}

static inline size_t pixel_at(const tl_gbuffer *g, uint32_t x, uint32_t y)
{
    return (size_t)y * g->pitch + x;
}

static inline float depth_at(const tl_gbuffer *g, uint32_t x, uint32_t y)
{
    return tl_gbuffer_plane(g, TL_DEPTH)[pixel_at(g, x, y)];
}

/* Random surfaces; their depths, m, all octaves alike, under an orthographic camera all metres alike. */
static inline tl_gbuffer *surfaces_between(const tl_camera *camera,
                                           float nearest,
                                           float farthest)
{
    tl_gbuffer *g = random_gbuffer(camera, TL_GROUP_BASE | TL_GROUP_PHONG, 1977);
    uint32_t seed = 1665;
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++) {
            const float share = uniform(&seed, 0.0f, 1.0f);
            const float some = camera->projection == TL_ORTHOGRAPHIC
                                   ? nearest + share * (farthest - nearest)
                                   : nearest * powf(farthest / nearest, share);
            if (isfinite(depth_at(g, x, y)))
                set_pixel(g, TL_DEPTH, pixel_at(g, x, y),
                          fminf(fmaxf(some, nearest), farthest));
        }
    return g;
}

/* A pixel that is no sky; ranges of lights end before it, at it, beyond it by turns. */
static inline rim random_rim(const tl_gbuffer *g, uint32_t *seed, uint32_t i)
{
    rim at = {0, 0, (int)(i % 3) - 1};
    do {
        at.x = (uint32_t)uniform(seed, 0.0f, (float)g->camera.width);
        at.y = (uint32_t)uniform(seed, 0.0f, (float)g->camera.height);
    } while (isinf(depth_at(g, at.x, at.y)));
    return at;
}

/* A light at `place` (view space, m) whose range ends at a random pixel. */
static inline void add_light_at(tl_light_set *lights,
                                const tl_gbuffer *g,
                                rim at,
                                const float place[3])
{
    const vec3 p = position_at(g, at.x, at.y);
    const float offset[3] = {place[0] - p.x, place[1] - p.y, place[2] - p.z};
    const tl_light light = rim_light(g, at, offset);
    tl_error err;
    ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
}

/* One so far from the pixel, in a random direction. */
static inline void add_light_around(
    tl_light_set *lights, const tl_gbuffer *g, rim at, uint32_t *seed, float distance)
{
    double direction[3];
    random_direction(seed, direction);
    const float offset[3] = {(float)direction[0] * distance, (float)direction[1] * distance,
                             (float)direction[2] * distance};
    const tl_light light = rim_light(g, at, offset);
    tl_error err;
    ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
}

#endif
