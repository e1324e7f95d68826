/* Random frames, the same for the same seed, and how two results are compared. */
#ifndef TL_FRAMES_H
#define TL_FRAMES_H

#include "testing.h"

#include "tilelight/lighting.h"

static inline float uniform(uint32_t *seed, float low, float high) /* xorshift32 */
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return low + (high - low) * (float)(*seed >> 8) * 0x1p-24f;
}

/* Of length 1. */
static inline void random_direction(uint32_t *seed, double out[3])
{
    double length2;
    do {
        length2 = 0.0;
        for (int i = 0; i < 3; i++) {
            out[i] = (double)uniform(seed, -1.0f, 1.0f);
            length2 += out[i] * out[i];
        }
    } while (length2 > 1.0 || length2 < 0.01);
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(length2);
}

/* Turned and moved, so that world and view space differ in every axis. */
static inline tl_camera camera_of(uint32_t width, uint32_t height, tl_projection projection)
{
    static const double eye[3] = {3.0, -2.0, 5.0}, target[3] = {2.5, -2.2, 1.0};
    static const double up[3] = {0.1, 1.0, 0.2};
    tl_camera camera = tl_camera_look_at(eye, target, up, 1.2, width, height, 0.1, 100.0);
    camera.projection = projection;
    if (projection == TL_ORTHOGRAPHIC) {
        camera.left *= 5.0f;
        camera.right *= 5.0f;
        camera.bottom *= 5.0f;
        camera.top *= 5.0f;
    }
    return camera;
}

static inline void set_pixel(tl_gbuffer *g, enum tl_plane plane, size_t at, float value)
{
    float *values = tl_gbuffer_plane(g, plane);
    if (values)
        values[at] = value;
}

/* One pixel in five is sky, never the first. Depths from 4 to 5 m; normals in the half-space of
 * the eye. The caller destroys it. */
static inline tl_gbuffer *random_gbuffer(const tl_camera *camera,
                                         uint32_t present,
                                         uint32_t seed)
{
    static const float exponents[] = {0.0f, 1.0f, 10.0f, 100.0f, 1000.0f, 10000.0f};
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(camera, present, &g, &err), err);
    for (uint32_t i = 0; i < camera->width * camera->height; i++) {
        const size_t at = (size_t)(i / camera->width) * g->pitch + i % camera->width;
        const float x = uniform(&seed, -0.6f, 0.6f), y = uniform(&seed, -0.6f, 0.6f);
        const double view[3] = {(double)x, (double)y, sqrt(1.0 - (double)(x * x + y * y))};
        double world[3];
        if (uniform(&seed, 0.0f, 1.0f) < 0.2f && i > 0)
            continue;
        tl_camera_world_direction(camera, view, world);
        set_pixel(g, TL_DEPTH, at, uniform(&seed, 4.0f, 5.0f));
        for (int axis = 0; axis < 3; axis++)
            set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), at, (float)world[axis]);
        for (int p = TL_ALBEDO_R; p < TL_BRDF; p++)
            set_pixel(g, (enum tl_plane)p, at, uniform(&seed, 0.0f, 1.0f));
        set_pixel(g, TL_SHININESS, at, exponents[(int)uniform(&seed, 0.0f, 6.0f)]);
        if (present & TL_GROUP_BRDF)
            set_pixel(g, TL_BRDF, at, floorf(uniform(&seed, 0.0f, 255.9f)));
        for (int p = TL_TANGENT_X; p <= TL_TANGENT_Z && (present & TL_GROUP_TANGENT); p++)
            set_pixel(g, (enum tl_plane)p, at, uniform(&seed, -1.0f, 1.0f));
    }
    return g;
}

/* A point light in and around the surfaces of random_gbuffer, range in [low, high]. */
static inline tl_light random_light(const tl_camera *camera,
                                    uint32_t *seed,
                                    float low,
                                    float high)
{
    tl_light light = tl_light_default();
    const double view[3] = {(double)uniform(seed, -5.0f, 5.0f),
                            (double)uniform(seed, -3.0f, 3.0f),
                            (double)uniform(seed, -6.0f, -2.0f)};
    double world[3];
    tl_camera_world_point(camera, view, world);
    for (int i = 0; i < 3; i++) {
        light.position[i] = (float)world[i];
        light.color[i] = uniform(seed, 0.0f, 1.0f);
    }
    light.range = uniform(seed, low, high);
    light.falloff =
        uniform(seed, 0.0f, 1.0f) < 0.5f ? TL_FALLOFF_LINEAR : TL_FALLOFF_INVERSE_SQUARE;
    light.specular = uniform(seed, 0.0f, 2.0f);
    return light;
}

/* Makes the light a spot of some direction and half-angle, up to half of space as a rule; every fourth edge
 * is hard. */
static inline void aim_at_random(tl_light *light, uint32_t *seed)
{
    float length2;
    do {
        length2 = 0.0f;
        for (int i = 0; i < 3; i++) {
            light->direction[i] = uniform(seed, -1.0f, 1.0f);
            length2 += light->direction[i] * light->direction[i];
        }
    } while (length2 > 1.0f || length2 < 0.01f);
    for (int i = 0; i < 3; i++)
        light->direction[i] /= sqrtf(length2);
    light->type = TL_LIGHT_SPOT;
    light->outer_cone = uniform(seed, 0.0f, 1.0f) < 0.8f ? uniform(seed, 0.1f, 1.5f)
                                                         : uniform(seed, 1.5f, 3.1f);
    light->inner_cone = light->outer_cone * fminf(1.0f, uniform(seed, 0.0f, 1.33f));
}

static inline tl_image *image_like(const tl_gbuffer *g)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(g->camera.width, g->camera.height, &image, &err), err);
    return image;
}

/* Lights `g` and fails the test on an error. device may be NULL where options need none. */
static inline tl_lighting_counts light_frame(tl_device *device,
                                             const tl_lighting_options *options,
                                             const tl_gbuffer *g,
                                             const tl_light_set *lights,
                                             tl_image *image)
{
    tl_lighting *lighting = NULL;
    tl_lighting_counts counts;
    tl_error err;
    ASSERT_OK(tl_lighting_create(device, options, &lighting, &err), err);
    ASSERT_OK(tl_lighting_run(lighting, g, lights, image, NULL, NULL, &counts, &err), err);
    tl_lighting_destroy(lighting);
    return counts;
}

/* Fails at the first value of the picture whose bits differ, or that is not finite. */
static inline void assert_same_image(const tl_image *got,
                                     const tl_image *want,
                                     const char *what)
{
    for (unsigned channel = 0; channel < 3; channel++) {
        const float *a = tl_image_plane(got, channel), *b = tl_image_plane(want, channel);
        for (uint32_t y = 0; y < got->height; y++)
            for (uint32_t x = 0; x < got->width; x++) {
                const size_t at = (size_t)y * got->pitch + x;
                if (!isfinite(a[at]) || !same_bits(a[at], b[at]))
                    fail_msg("%s: pixel (%u, %u), channel %u is %a, want %a", what, x, y,
                             channel, (double)a[at], (double)b[at]);
            }
    }
}

/* Group setup: *state is the default device. Ends the process as skipped where there is none. */
static inline int open_device(void **state)
{
    tl_device *device = NULL;
    tl_error err;
    if (tl_device_open(NULL, &device, &err) != TL_OK) {
        fprintf(stderr, "skipped: %s\n", err.message);
        exit(TL_SKIPPED);
    }
    *state = device;
    return 0;
}

static inline int close_device(void **state)
{
    tl_device_close(*state);
    return 0;
}

#endif
