/* Frames that pictures are promised of, small enough to know all of them: the float twin of the kernels, and
 * the reference. */
#ifndef TL_PROMISE_FRAMES_H
#define TL_PROMISE_FRAMES_H

#include "frames.h"

#include "bench_scene.h"

typedef struct promise_frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    tl_image *picture, *reference;
} promise_frame;

static inline void light_both(promise_frame *f)
{
    tl_lighting_options options = tl_lighting_options_default();
    f->picture = image_like(f->gbuffer);
    f->reference = image_like(f->gbuffer);
    options.precision = TL_PRECISION_TWIN;
    light_frame(NULL, &options, f->gbuffer, &f->lights, f->picture);
    options.precision = TL_PRECISION_REFERENCE;
    light_frame(NULL, &options, f->gbuffer, &f->lights, f->reference);
}

/* A scene of the bench, with so many lights. */
static inline promise_frame bench_frame(const char *scene,
                                        uint32_t width,
                                        uint32_t height,
                                        uint32_t lights)
{
    promise_frame f = {0};
    tl_error err;
    tl_bench_scene_options options = tl_bench_scene_options_default();
    options.width = width;
    options.height = height;
    options.light_count = lights;
    ASSERT_OK(
        tl_bench_scene_make(tl_bench_scene_find(scene), &options, &f.gbuffer, &f.lights, &err),
        err);
    ASSERT_OK(tl_gbuffer_repair(f.gbuffer, scene, false, NULL, &err), err);
    light_both(&f);
    return f;
}

static inline void promise_frame_clear(promise_frame *f)
{
    tl_image_destroy(f->picture);
    tl_image_destroy(f->reference);
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

/* RMS of all channels over the mean of b, in double. */
static inline double true_rms(const tl_image *a, const tl_image *b)
{
    double square = 0.0, sum = 0.0;
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < a->height; y++)
            for (uint32_t x = 0; x < a->width; x++) {
                const size_t at = (size_t)y * a->pitch + x;
                const double want = (double)tl_image_plane(b, c)[at];
                const double d = (double)tl_image_plane(a, c)[at] - want;
                square += d * d;
                sum += want;
            }
    const double values = 3.0 * (double)a->width * a->height;
    return sqrt(square / values) / (sum / values);
}

#endif
