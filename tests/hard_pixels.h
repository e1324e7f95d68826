/* Pixels and lights at the limits of what arithmetic in float can tell, among random ones. */
#ifndef TL_HARD_PIXELS_H
#define TL_HARD_PIXELS_H

#include "frames.h"

enum { HARD_WIDTH = 61, HARD_HEIGHT = 40, HARD_LIGHT_COUNT = 64 };

/* Case i makes pixel i, and a light at `offset` (view space) from the surface there. In m. */
static const struct {
    const char *name;
    float depth, normal[3], shininess, offset[3], range;
} hard_pixels[] = {
    {"light in the surface point", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 0}, 1.0f},
    {"light a denormal away", 1e-40f, {0, 0, 1}, 10.0f, {0, 0, 1e-40f}, 1.0f},
    {"denormal square of the distance", 1e-20f, {0, 0, 1}, 10.0f, {0, 0, 1e-21f}, 1.0f},
    {"denormal square of the range", 1e-21f, {0, 0, 1}, 10.0f, {0, 0, 5e-23f}, 1e-22f},
    {"light 1 mm away", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 1e-3f}, 1.0f},
    {"denormal shininess", 4.0f, {0, 0, 1}, 1e-40f, {0, 0, 1}, 2.0f},
    {"exponent 0", 4.0f, {0, 0, 1}, 0.0f, {0.5f, 0, 1}, 2.0f},
    {"exponent 0, grazing", 4.0f, {0, 0, 1}, 0.0f, {1, 0, 1e-6f}, 2.0f},
    {"exponent 10000, in the peak", 4.0f, {0, 0, 1}, 10000.0f, {0, 0, 1}, 2.0f},
    {"exponent 10000, off the peak", 4.0f, {0, 0, 1}, 10000.0f, {0.02f, 0, 1}, 2.0f},
    {"exponent 10000, grazing", 4.0f, {0, 0, 1}, 10000.0f, {1, 0, 1e-6f}, 2.0f},
    {"light behind the surface", 4.0f, {0, 0, 1}, 10.0f, {0, 0, -1}, 2.0f},
    {"normal away from the eye", 4.0f, {0, 0, -1}, 10.0f, {0, 0, -1}, 2.0f},
    {"no normal", 4.0f, {0, 0, 0}, 10.0f, {0, 0, 1}, 2.0f},
    {"tiny normal", 4.0f, {0, 0, 1e-17f}, 10.0f, {0, 0, 1}, 2.0f},
    {"light exactly at its range", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 1}, 1.0f},
    {"light one ulp within its range", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 1}, 0x1.000002p0f},
    {"light in the eye", 4.0f, {0, 0, 1}, 10.0f, {0, 0, 4}, 5.0f},
    {"square of the distance near overflow", 1e17f, {0, 0, 1}, 10.0f, {0, 0, 1}, 1e17f},
    {"nothing hit", INFINITY, {0, 0, 0}, 0.0f, {0, 0, 0}, 1.0f},
};

/* At the origin and along -z: view space is world space, so the cases keep their bits. */
static inline tl_camera plain_camera(tl_projection projection)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    /* A narrow view, so that (0, 0, 1) faces the eye everywhere. */
    tl_camera camera =
        tl_camera_look_at(eye, target, up, 0.02, HARD_WIDTH, HARD_HEIGHT, 1e-30, 1e30);
    camera.projection = projection;
    return camera;
}

static inline void place_case(tl_gbuffer *g, tl_light_set *lights, uint32_t i)
{
    const tl_camera *camera = &g->camera;
    const float z = isinf(hard_pixels[i].depth) ? 1.0f : hard_pixels[i].depth;
    const float scale = camera->projection == TL_PERSPECTIVE ? z : 1.0f;
    const float step = (camera->right - camera->left) / (float)HARD_WIDTH;
    const float place[3] = {(camera->left + ((float)i + 0.5f) * step) * scale,
                            (camera->top - 0.5f * step) * scale, -z};
    tl_light light = tl_light_default();
    tl_error err;

    set_pixel(g, TL_DEPTH, i, hard_pixels[i].depth);
    for (int axis = 0; axis < 3; axis++) {
        set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), i, hard_pixels[i].normal[axis]);
        light.position[axis] = place[axis] + hard_pixels[i].offset[axis];
    }
    for (int p = TL_ALBEDO_R; p <= TL_SPECULAR_B; p++)
        set_pixel(g, (enum tl_plane)p, i, isinf(hard_pixels[i].depth) ? 0.0f : 0.5f);
    set_pixel(g, TL_SHININESS, i, hard_pixels[i].shininess);
    light.range = hard_pixels[i].range;
    for (int falloff = 0; falloff < TL_FALLOFF_TABLE; falloff++) {
        light.falloff = (tl_falloff)falloff;
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
    light.falloff =
        TL_FALLOFF_LINEAR; /* begins half way, one float before its end, and there */
    for (int k = 0; k < 3; k++) {
        light.begin = k == 0   ? 0.5f * light.range
                      : k == 1 ? nextafterf(light.range, 0.0f)
                               : light.range;
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

/* A sun, a lamp without a range, ambient light and a sky beside the cases. */
static inline void add_global_lights(tl_light_set *lights)
{
    tl_light sun = tl_light_default(), lamp = tl_light_default();
    tl_error err;
    sun.type = TL_LIGHT_DIRECTIONAL;
    lamp.position[1] = 1.0f;
    ASSERT_OK(tl_light_set_add(lights, &sun, &err), err);
    ASSERT_OK(tl_light_set_add(lights, &lamp, &err), err);
    for (int i = 0; i < 3; i++) {
        lights->ambient[i] = 0.1f * (float)i;
        lights->sky[i] = 0.3f;
    }
}

/* Makes the lights spots, but for every sixth: those at the cases aimed at the surface they are put at, or past
 * it by less than rounding, or away. */
static inline void make_hard_spots(tl_light_set *lights)
{
    static const float outer[] = {0.5f, 1.57079637f, 3e-4f, 3.14159274f, 2.0f, 0.0f};
    uint32_t seed = 1875;
    for (size_t i = 0; i < lights->count; i++) {
        tl_light *light = &lights->lights[i];
        if (i % 6 == 5 || light->type == TL_LIGHT_DIRECTIONAL)
            continue;
        aim_at_random(light, &seed);
        if (i % 2 == 0)
            for (int axis = 0; axis < 3; axis++)
                light->direction[axis] = axis == 2 ? (i % 4 ? 1.0f : -1.0f) : 0.0f;
        if (i % 3 != 0) {
            light->outer_cone = outer[i % COUNT_OF(outer)];
            light->inner_cone = i % 5 ? 0.0f : light->outer_cone;
        }
    }
}

/* Every case, random pixels and random lights; lights are added to an empty set. The caller
 * destroys the frame and clears the lights. */
static inline tl_gbuffer *hard_frame(tl_projection projection,
                                     uint32_t present,
                                     tl_light_set *lights)
{
    const tl_camera camera = plain_camera(projection);
    tl_gbuffer *g = random_gbuffer(&camera, present, 1977);
    uint32_t seed = 20110901;
    tl_error err;
    for (uint32_t i = 0; i < COUNT_OF(hard_pixels); i++)
        place_case(g, lights, i);
    for (int i = 0; i < HARD_LIGHT_COUNT; i++) {
        const tl_light light = random_light(&camera, &seed, 0.5f, 5.0f);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
    add_global_lights(lights);
    return g;
}

#endif
