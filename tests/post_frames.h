/* Pictures for stages after lighting, and the ways in which a stage is computed. */
#ifndef TL_POST_FRAMES_H
#define TL_POST_FRAMES_H

#include "frames.h"

#include "device.h"

#include "tilelight/post.h"

/* How a picture is run through; the bits are the same. */
typedef struct post_way {
    const char *name;
    tl_precision precision;
    tl_path path;
    uint32_t width;
    uint64_t memory; /* bytes; 0: no limit */
    int by_copy;     /* 1: a device that shares no memory */
} post_way;

/* Of float. The memory is for rows of the picture alone; stages that need more of it add to that. */
static const post_way post_ways[] = {
    {"16 lanes", TL_PRECISION_FLOAT, TL_PATH_CPU, 16, 0, 0},
    {"16 lanes, by copy", TL_PRECISION_FLOAT, TL_PATH_CPU, 16, 0, 1},
    {"16 lanes, in bands", TL_PRECISION_FLOAT, TL_PATH_CPU, 16, 1, 1},
    {"gpu", TL_PRECISION_FLOAT, TL_PATH_GPU, 1, 0, 0},
};

/* A copy of `from`, run through; the caller destroys it. */
static inline tl_image *post_image(tl_device *device,
                                   const post_way *way,
                                   const tl_post_options *options,
                                   const tl_gbuffer *gbuffer,
                                   const tl_image *from,
                                   uint64_t band_memory,
                                   tl_post_counts *counts)
{
    tl_lighting_options lighting = tl_lighting_options_default();
    tl_image *image = NULL;
    tl_post *post = NULL;
    tl_error err;
    const int shared = device ? device->shares_memory : 0;
    lighting.precision = way->precision;
    lighting.path = way->path;
    lighting.vector_width = way->width;
    lighting.memory_limit = way->memory ? band_memory : 0;
    if (device)
        device->shares_memory = shared && !way->by_copy;
    ASSERT_OK(tl_image_create(from->width, from->height, &image, &err), err);
    memcpy(image->planes, from->planes, 3 * (size_t)from->pitch * from->rows * sizeof(float));
    ASSERT_OK(tl_post_create(device, &lighting, options, &post, &err), err);
    ASSERT_OK(tl_post_run(post, gbuffer, &image, NULL, NULL, counts, &err), err);
    tl_post_destroy(post);
    if (device)
        device->shares_memory = shared;
    return image;
}

static inline void fill_color(const tl_image *image,
                              uint32_t x,
                              uint32_t y,
                              const float color[3])
{
    for (unsigned i = 0; i < 3; i++)
        tl_image_plane(image, i)[(size_t)y * image->pitch + x] = color[i];
}

static inline float color_at(const tl_image *image, unsigned channel, int64_t x, int64_t y)
{
    return tl_image_plane(image, channel)[(size_t)y * image->pitch + (size_t)x];
}

/* Radiance of all sizes: one pixel in six black, one in twelve above 1 by far. */
static inline tl_image *random_picture(uint32_t width, uint32_t height, uint32_t seed)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const float kind = uniform(&seed, 0.0f, 1.0f);
            const float scale = kind < 1.0f / 6.0f ? 0.0f : kind > 11.0f / 12.0f ? 40.0f : 1.0f;
            float color[3];
            for (int i = 0; i < 3; i++)
                color[i] = scale * uniform(&seed, 0.0f, 1.0f);
            fill_color(image, x, y, color);
        }
    return image;
}

static inline void assert_same_pixels(const tl_image *got,
                                      const tl_image *want,
                                      const char *what)
{
    assert_int_equal(got->width, want->width);
    assert_int_equal(got->height, want->height);
    for (unsigned i = 0; i < 3; i++)
        for (uint32_t y = 0; y < want->height; y++)
            for (uint32_t x = 0; x < want->width; x++)
                if (!same_bits(color_at(got, i, x, y), color_at(want, i, x, y)))
                    fail_msg("%s: (%u, %u) channel %u is %.9g, not %.9g", what, x, y, i,
                             (double)color_at(got, i, x, y), (double)color_at(want, i, x, y));
}

#endif
