/* Lights with all that few lights have, and skies with more than one colour. */
#ifndef TL_RICH_LIGHTS_H
#define TL_RICH_LIGHTS_H

#include "frames.h"

/* A picture of random colours, some pixels black, some a million times as bright as others. */
static inline uint32_t add_random_image(tl_light_set *set,
                                        uint32_t width,
                                        uint32_t height,
                                        uint32_t seed)
{
    float *pixels = malloc(3 * (size_t)width * height * sizeof *pixels);
    uint32_t image = 0;
    tl_error err;
    assert_non_null(pixels);
    for (size_t i = 0; i < 3 * (size_t)width * height; i++) {
        const float kind = uniform(&seed, 0.0f, 1.0f);
        pixels[i] = uniform(&seed, 0.0f, 1.0f) * (kind < 0.1f    ? 0.0f
                                                  : kind > 0.97f ? 1e6f
                                                                 : 1.0f);
    }
    ASSERT_OK(tl_light_set_add_image(set, "random", width, height, pixels, &image, &err), err);
    return image;
}

static inline uint32_t add_random_table(tl_light_set *set, uint32_t count, uint32_t seed)
{
    float values[64];
    uint32_t table = 0;
    tl_error err;
    assert_true(count <= COUNT_OF(values));
    for (uint32_t i = 0; i < count; i++)
        values[i] = i % 5 == 4 ? 0.0f : uniform(&seed, 0.0f, i % 7 == 0 ? 1e4f : 2.0f);
    ASSERT_OK(tl_light_set_add_table(set, values, count, &table, &err), err);
    return table;
}

/* Gives two lights in three tables, textures, ambient lobes, in every combination that their kind and range
 * allow. Cones of half of space and more stay without textures. */
static inline void make_rich(tl_light_set *set)
{
    uint32_t seed = 1898;
    const uint32_t tables[] = {add_random_table(set, 2, 5), add_random_table(set, 61, 6)};
    const uint32_t images[] = {add_random_image(set, 1, 1, 7), add_random_image(set, 5, 3, 8),
                               add_random_image(set, 64, 32, 9)};
    for (size_t i = 0; i < set->count; i++) {
        tl_light *light = &set->lights[i];
        const uint32_t choice = (uint32_t)uniform(&seed, 0.0f, 24.0f);
        if (i % 3 == 0)
            continue;
        if ((choice & 1) != 0 && light->type != TL_LIGHT_DIRECTIONAL &&
            isfinite(light->range)) {
            light->falloff = TL_FALLOFF_TABLE;
            light->begin = 0.0f;
            light->table = tables[i % COUNT_OF(tables)];
        }
        if ((choice & 2) != 0 && (light->type == TL_LIGHT_POINT ||
                                  (light->type == TL_LIGHT_SPOT && light->outer_cone < 1.57f)))
            light->texture = images[i % COUNT_OF(images)];
        if ((choice & 4) != 0 || light->type == TL_LIGHT_DIRECTIONAL)
            light->ambient = uniform(&seed, 0.0f, 2.0f);
        if (light->texture != 0 && choice > 12)
            memcpy(light->up, (float[]){0.36f, 0.48f, 0.8f}, sizeof light->up);
    }
}

static inline void make_gradient_sky(tl_light_set *set)
{
    set->sky_type = TL_SKY_GRADIENT;
    for (int i = 0; i < 3; i++) {
        set->sky[i] = 0.25f * (float)(i + 1);
        set->zenith[i] = 3.0f - (float)i;
        set->ground[i] = i == 1 ? 0.0f : 100.0f;
    }
}

static inline void make_image_sky(tl_light_set *set)
{
    set->sky_type = TL_SKY_IMAGE;
    memset(set->sky, 0, sizeof set->sky);
    set->sky_image = add_random_image(set, 67, 33, 11);
    set->sky_intensity = 0.7f;
    set->sky_rotation = 2.5f;
}

#endif
