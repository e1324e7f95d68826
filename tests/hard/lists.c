/* Lists of lights: cases 15 and 21. */
#include "hard_case.h"
#include "hard_frames.h"

/* All of them reach every pixel. */
static tl_light_set lights_everywhere(const tl_gbuffer *g, uint32_t count)
{
    tl_light_set lights = {0};
    uint32_t seed = 15;
    tl_error err;
    for (uint32_t i = 0; i < count; i++) {
        tl_light light = random_light(&g->camera, &seed, 90.0f, 100.0f);
        light.intensity = powf(10.0f, uniform(&seed, -3.0f, 3.0f));
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    }
    return lights;
}

enum { USUAL_LIST = 256 };

/* Around the lengths of groups, blocks and of lists by cells, and back to few. */
void hard_long_lists(hard_bench *bench)
{
    static const uint32_t counts[] = {1,    63,   64,   65,   255,  256, 257,
                                      1023, 1024, 1025, 2049, 4097, 2};
    const tl_camera camera = camera_of(17, 2, TL_PERSPECTIVE);
    tl_gbuffer *g = surfaces_between(&camera, 3.0f, 6.0f);
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        tl_light_set lights = lights_everywhere(g, counts[i]);
        tl_lighting_options options = tl_lighting_options_default();
        tl_image *image = image_like(g);
        options.tile_size = 8;
        options.effects = TL_EFFECTS_ALL;
        const tl_lighting_counts n = light_frame(bench->device, &options, g, &lights, image);
        for (uint32_t k = 0; k < n.tile_count; k++)
            hard_count(bench, n.list_length == (uint64_t)counts[i] * n.tile_count,
                       counts[i] <= USUAL_LIST);
        tl_image_destroy(image);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
    }
    tl_gbuffer_destroy(g);
}

static void reverse(tl_light_set *lights)
{
    for (size_t i = 0; i < lights->count / 2; i++) {
        const tl_light first = lights->lights[i];
        lights->lights[i] = lights->lights[lights->count - 1 - i];
        lights->lights[lights->count - 1 - i] = first;
    }
}

/* A picture again and again, on both paths, whatever order work-items come in; against the picture of lists
 * in another order. */
void hard_light_order(hard_bench *bench)
{
    static const tl_path paths[] = {TL_PATH_CPU, TL_PATH_GPU};
    const tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = surfaces_between(&camera, 3.0f, 6.0f);
    tl_light_set lights = lights_everywhere(g, 60);
    tl_image *want = hard_picture(g, &lights), *got = image_like(g);
    hard_light(bench, g, &lights);
    reverse(&lights);
    tl_image *reversed = hard_picture(g, &lights);
    hard_light(bench, g, &lights);
    reverse(&lights);
    const uint64_t usual = hard_different_pixels(reversed, want);
    for (int run = 0; run < 8; run++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.tile_size = 8;
        options.effects = TL_EFFECTS_ALL;
        options.path = paths[run % 2];
        light_frame(bench->device, &options, g, &lights, got);
        bench->result.tried += (uint64_t)camera.width * camera.height;
        bench->result.wrong += hard_different_pixels(got, want);
        bench->result.usual_wrong += usual;
    }
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_image_destroy(reversed);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}
