/* One frame lit in all the ways that must not show in the picture. */
#include "hard_case.h"

#include "tilelight/check.h"

static const uint32_t tile_sizes[] = {8, 16, 32, 64};
static const tl_path paths[] = {TL_PATH_CPU, TL_PATH_GPU};

uint64_t hard_different_pixels(const tl_image *a, const tl_image *b)
{
    uint64_t different = 0;
    for (uint32_t y = 0; y < a->height; y++)
        for (uint32_t x = 0; x < a->width; x++) {
            const size_t at = (size_t)y * a->pitch + x;
            int same = 1;
            for (unsigned c = 0; c < 3; c++)
                same &= same_bits(tl_image_plane(a, c)[at], tl_image_plane(b, c)[at]);
            different += !same;
        }
    return different;
}

tl_image *hard_picture(const tl_gbuffer *g, const tl_light_set *lights)
{
    const tl_lighting_options twin = {.precision = TL_PRECISION_TWIN, .tile_size = 16};
    tl_image *image = image_like(g);
    light_frame(NULL, &twin, g, lights, image);
    return image;
}

void hard_judge(hard_bench *bench,
                const tl_gbuffer *g,
                const tl_light_set *lights,
                const tl_image *image)
{
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    ASSERT_OK(tl_check_create(g, lights, 0.0f, TL_COSINE_STABLE, &check, &err), err);
    ASSERT_OK(tl_check_image(check, image, NULL, &report, &err), err);
    bench->result.beyond += report.failed_count;
    bench->result.error = fmax(bench->result.error, report.rounding_ratio);
    tl_check_destroy(check);
}

/* Of one way. */
static void light_in_turn(hard_bench *bench,
                          const tl_lighting_options *options,
                          const hard_scene scenes[],
                          size_t count)
{
    tl_lighting *lighting = NULL;
    tl_error err;
    ASSERT_OK(tl_lighting_create(bench->device, options, &lighting, &err), err);
    for (size_t i = 0; i < count; i++) {
        tl_image *got = image_like(scenes[i].g);
        ASSERT_OK(tl_lighting_run(lighting, scenes[i].g, scenes[i].lights, got, NULL, NULL,
                                  NULL, &err),
                  err);
        bench->result.pixels += (uint64_t)got->width * got->height;
        bench->result.lost += hard_different_pixels(got, scenes[i].want);
        tl_image_destroy(got);
    }
    tl_lighting_destroy(lighting);
}

void hard_light_in_turn(hard_bench *bench, const hard_scene scenes[], size_t count)
{
    for (size_t path = 0; path < COUNT_OF(paths); path++)
        for (size_t tile = 0; tile < COUNT_OF(tile_sizes); tile++)
            for (int cull = 0; cull < TL_CULL_COUNT; cull++)
                light_in_turn(bench,
                              &(tl_lighting_options){.cull = (tl_cull)cull,
                                                     .tile_size = tile_sizes[tile],
                                                     .path = paths[path],
                                                     .effects = TL_EFFECTS_ALL},
                              scenes, count);
}

void hard_light(hard_bench *bench, const tl_gbuffer *g, const tl_light_set *lights)
{
    tl_image *want = hard_picture(g, lights);
    hard_judge(bench, g, lights, want);
    hard_light_in_turn(bench, &(hard_scene){g, lights, want}, 1);
    tl_image_destroy(want);
}
