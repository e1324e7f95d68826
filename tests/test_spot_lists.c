/* Are lists of spots hardly longer than they must be?
 *
 * What they must be: the pairs of a tile and a spot that lights a pixel of it, counted pixel by pixel with
 * the kernels' own decisions. */
#include "frames.h"

#include "position.h"
#include "prepared.h"
#include "ray_cast.h"
#include "spot.h"

enum { WIDTH = 640, HEIGHT = 360, TILE = 16, SPOT_COUNT = 1000 };

static void random_unit(uint32_t *seed, float out[3])
{
    float length2;
    do {
        length2 = 0.0f;
        for (int i = 0; i < 3; i++) {
            out[i] = uniform(seed, -1.0f, 1.0f);
            length2 += out[i] * out[i];
        }
    } while (length2 > 1.0f || length2 < 0.01f);
    for (int i = 0; i < 3; i++)
        out[i] /= sqrtf(length2);
}

/* All over the view, half of them straight down like lamps, of the angles that lamps have. */
static void add_spots(const tl_camera *camera, tl_light_set *lights)
{
    uint32_t seed = 1889;
    tl_error err;
    for (int k = 0; k < SPOT_COUNT; k++) {
        const float depth = uniform(&seed, 2.0f, 30.0f);
        const double view[3] = {(double)(uniform(&seed, camera->left, camera->right) * depth),
                                (double)(uniform(&seed, camera->bottom, camera->top) * depth),
                                -(double)depth};
        tl_light light = tl_light_default();
        double world[3];
        tl_camera_world_point(camera, view, world);
        random_unit(&seed, light.direction);
        for (int i = 0; i < 3; i++) {
            light.position[i] = (float)world[i];
            if (k % 2)
                light.direction[i] = i == 1 ? -1.0f : 0.0f;
        }
        light.type = TL_LIGHT_SPOT;
        light.range = uniform(&seed, 2.0f, 6.0f);
        light.outer_cone = uniform(&seed, 0.2f, 1.1f);
        light.inner_cone = 0.7f * light.outer_cone;
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

static int lights_pixel(const tl_prepared *prepared, uint32_t light, vec3 position)
{
    const vec3 l = vector_to_light(position, prepared->lights[light]);
    const float d2 = dot3(l, l);
    return reaches(prepared->lights[light], d2) && in_cone(prepared->spots[light], l, d2);
}

static int lights_tile(const tl_prepared *prepared,
                       const tl_gbuffer *g,
                       uint32_t light,
                       uint32_t tile_x,
                       uint32_t tile_y)
{
    for (uint32_t y = tile_y * TILE; y < (tile_y + 1) * TILE && y < HEIGHT; y++)
        for (uint32_t x = tile_x * TILE; x < (tile_x + 1) * TILE && x < WIDTH; x++) {
            const float depth = tl_gbuffer_plane(g, TL_DEPTH)[(size_t)y * g->pitch + x];
            if (!isinf(depth) &&
                lights_pixel(prepared, light,
                             view_position(prepared->frame.rays, prepared->needs, (float)x,
                                           (float)y, depth)))
                return 1;
        }
    return 0;
}

static uint64_t least_pairs(const tl_prepared *prepared, const tl_gbuffer *g)
{
    uint64_t pairs = 0;
    for (uint32_t light = 0; light < prepared->frame.light_count; light++)
        for (uint32_t y = 0; y < prepared->frame.tiles_y; y++)
            for (uint32_t x = 0; x < prepared->frame.tiles_x; x++)
                pairs += (uint64_t)lights_tile(prepared, g, light, x, y);
    return pairs;
}

static uint64_t listed(tl_device *device,
                       tl_cull cull,
                       const tl_gbuffer *g,
                       const tl_light_set *lights,
                       tl_image *image)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.cull = cull;
    options.tile_size = TILE;
    return light_frame(device, &options, g, lights, image).list_length;
}

static void lists_are_short(void **state)
{
    static const char *const scenes[] = {"spheres", "grazing"};
    for (size_t s = 0; s < COUNT_OF(scenes); s++) {
        tl_gbuffer *g = NULL;
        tl_light_set lights = {0};
        tl_prepared prepared = {0};
        tl_error err;
        ASSERT_OK(
            tl_ray_cast(tl_bench_scene_find(scenes[s]), TL_GROUP_BASE, WIDTH, HEIGHT, &g, &err),
            err);
        ASSERT_OK(tl_gbuffer_repair(g, scenes[s], false, NULL, &err), err);
        tl_image *cones = image_like(g), *points = image_like(g);
        add_spots(&g->camera, &lights);
        ASSERT_OK(tl_prepare(g, &lights, &(tl_prepare_options){.tile_size = TILE}, NULL,
                             &prepared, &err),
                  err);
        const uint64_t least = least_pairs(&prepared, g);
        const uint64_t split = listed(*state, TL_CULL_SPLIT, g, &lights, cones);
        const uint64_t depth = listed(*state, TL_CULL_DEPTH, g, &lights, points);
        assert_same_image(points, cones, scenes[s]);
        const uint64_t rect = listed(*state, TL_CULL_RECT, g, &lights, points);
        assert_same_image(points, cones, scenes[s]);
        for (size_t i = 0; i < lights.count; i++)
            lights.lights[i].type = TL_LIGHT_POINT;
        const uint64_t spheres = listed(*state, TL_CULL_SPLIT, g, &lights, points);
        const uint64_t sphere_rects = listed(*state, TL_CULL_RECT, g, &lights, points);
        print_message("%s: %.3f times the least %u with split, %.3f with depth, %.2f with "
                      "rect; as points %.2f and %.2f\n",
                      scenes[s], (double)split / (double)least, (unsigned)least,
                      (double)depth / (double)least, (double)rect / (double)least,
                      (double)spheres / (double)least, (double)sphere_rects / (double)least);
        assert_true(least > 5000 && split >= least);
        assert_true((double)split <= 1.3 * (double)least);
        assert_true(rect < sphere_rects);
        tl_prepared_clear(&prepared);
        tl_light_set_clear(&lights);
        tl_image_destroy(cones);
        tl_image_destroy(points);
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lists_are_short)};
    return cmocka_run_group_tests(tests, open_device, close_device);
}
