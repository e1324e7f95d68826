/* Is the image the same, bit for bit, whatever is culled, and is no light ever lost?
 *
 * The reference has neither tiles nor lists: the C twin shines every light on every pixel. */
#include "rim_lights.h"

static const struct {
    uint32_t width, height;
    tl_projection projection;
    float behind; /* m: every third surface is that much farther, so tiles are all edges */
} sizes[] = {{1, 1, TL_PERSPECTIVE, 0.0f},   {17, 9, TL_ORTHOGRAPHIC, 6.0f},
             {1, 67, TL_PERSPECTIVE, 0.0f},  {130, 1, TL_PERSPECTIVE, 0.0f},
             {64, 64, TL_PERSPECTIVE, 3.0f}, {61, 40, TL_PERSPECTIVE, 0.0f},
             {61, 40, TL_ORTHOGRAPHIC, 0.0f}};

static void push_back(tl_gbuffer *g, float behind)
{
    float *depths = tl_gbuffer_plane(g, TL_DEPTH);
    for (size_t i = 0; i < (size_t)g->camera.width * g->camera.height; i += 3)
        depths[i / g->camera.width * g->pitch + i % g->camera.width] += behind;
}

enum { MANY = TL_LIGHT_BLOCK + 1, SMALL = 400 };

static void scattered(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    uint32_t seed = 20110901;
    tl_error err;
    for (uint32_t i = 0; i < count; i++) {
        const tl_light light = random_light(&g->camera, &seed, 0.05f, 1.5f);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

static int is_surface(const tl_gbuffer *g, rim at)
{
    return isfinite(tl_gbuffer_plane(g, TL_DEPTH)[(size_t)at.y * g->pitch + at.x]);
}

/* As bright up to a pixel as anywhere, to the last bit: what is lost at the rim shows at once. The pixels are
 * at the rims of tiles; some lights are straight beside them, where the rectangle ends as well.
 * In the image of one pixel the tile's box is that pixel, and the bits of the two distances have to be the
 * same. */
static void steps(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    uint32_t seed = 20110901;
    tl_error err;
    for (uint32_t i = 0; i < count; i++) {
        const rim at = rim_of_tile(g, &seed, i);
        float offset[3];
        for (int axis = 0; axis < 3; axis++)
            offset[axis] = uniform(&seed, -1.0f, 1.0f);
        for (int axis = 0; axis < 3 && i % 5 == 0; axis++)
            offset[axis] *= axis == (int)(i / 5 % 3);
        if (!is_surface(g, at))
            continue;
        tl_light light = rim_light(g, at, offset);
        light.specular = uniform(&seed, 0.0f, 2.0f);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

/* The same ranges under a window that ends there: what it leaves at the rim is next to nothing. */
static void shells(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    steps(g, lights, count);
    for (uint32_t i = 0; i < lights->count; i++) {
        lights->lights[i].falloff = TL_FALLOFF_INVERSE_SQUARE;
        lights->lights[i].begin = 0.0f;
        lights->lights[i].intensity = 1e6f;
    }
}

static void all_over(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    scattered(g, lights, count);
    for (uint32_t i = 0; i < count; i++)
        lights->lights[i].range = 20.0f;
}

/* The eye inside, one ulp outside, and around: what the broad phase could get wrong. */
static void around_the_eye(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    uint32_t seed = 7;
    tl_error err;
    for (uint32_t i = 0; i < count; i++) {
        tl_light light = tl_light_default();
        const double view[3] = {(double)uniform(&seed, -8.0f, 8.0f),
                                (double)uniform(&seed, -8.0f, 8.0f),
                                (double)uniform(&seed, -8.0f, 8.0f)};
        double world[3];
        tl_camera_world_point(&g->camera, view, world);
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] = (float)world[axis];
        light.range = (float)sqrt(view[0] * view[0] + view[1] * view[1] + view[2] * view[2]) *
                      (i % 3 == 0   ? 0x1.fffffep-1f
                       : i % 3 == 1 ? 0x1.000002p0f
                                    : uniform(&seed, 0.5f, 1.5f));
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

static void spots(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    uint32_t seed = 1879;
    scattered(g, lights, count);
    for (uint32_t i = 0; i < count; i++) {
        lights->lights[i].range *= 3.0f;
        if (i % 5 != 0)
            aim_at_random(&lights->lights[i], &seed);
        if (i % 50 == 1) {
            lights->lights[i].range = INFINITY;
            lights->lights[i].falloff = TL_FALLOFF_INVERSE_SQUARE;
        }
    }
}

/* Each cone's edge passes a pixel, as near as an angle in float can be: hard, and bright beyond measure,
 * so that next to nothing at the edge shows. */
static void cones(const tl_gbuffer *g, tl_light_set *lights, uint32_t count)
{
    const tl_needs needs = {.orthographic = g->camera.projection == TL_ORTHOGRAPHIC};
    tl_prepared prepared = {0};
    uint32_t seed = 20110901;
    tl_error err;
    spots(g, lights, count);
    ASSERT_OK(tl_prepare(g, lights,
                         &(tl_prepare_options){.tile_size = 16, .effects = TL_EFFECTS_ALL},
                         NULL, &prepared, &err),
              err);
    for (uint32_t i = 0; i < count; i++) {
        tl_light *light = &lights->lights[prepared.sources[i]];
        const uint32_t column = (uint32_t)uniform(&seed, 0.0f, (float)g->camera.width);
        const uint32_t row = (uint32_t)uniform(&seed, 0.0f, (float)g->camera.height);
        const float depth = tl_gbuffer_plane(g, TL_DEPTH)[(size_t)row * g->pitch + column];
        if (isinf(depth) || light->type != TL_LIGHT_SPOT)
            continue;
        const vec3 p =
            view_position(prepared.frame.rays, needs, (float)column, (float)row, depth);
        const vec3 l = vector_to_light(p, prepared.lights[i]);
        const double length2 =
            (double)l.x * (double)l.x + (double)l.y * (double)l.y + (double)l.z * (double)l.z;
        const float *axis = prepared.spots[i].axis;
        const double cosine = ((double)l.x * (double)axis[0] + (double)l.y * (double)axis[1] +
                               (double)l.z * (double)axis[2]) /
                              sqrt(length2);
        const float edge = (float)acos(fmax(-1.0, fmin(1.0, cosine)));
        light->outer_cone = i % 2 ? nextafterf(edge, 0.0f) : edge;
        light->inner_cone = light->outer_cone;
        light->range = 1.5f * sqrtf((float)length2);
        light->intensity = 1e12f;
    }
    tl_prepared_clear(&prepared);
}

static const struct {
    const char *name;
    uint32_t count;
    void (*place)(const tl_gbuffer *g, tl_light_set *lights, uint32_t count);
} scenes[] = {
    {"no light", 0, scattered},
    {"scattered", 200, scattered},
    {"ranges that end at a pixel", SMALL, shells},
    {"steps that end at a pixel", SMALL, steps},
    {"around the eye", SMALL, around_the_eye},
    {"more lights on every tile than a block holds", MANY, all_over},
    {"spots among points", 200, spots},
    {"cones that end at a pixel", SMALL, cones},
    {"few lights after many", 3, scattered},
};

/* One tl_lighting lights all scenes, so that buffers grow and lists start afresh. */
static void compare(tl_device *device,
                    const tl_lighting_options *options,
                    const tl_gbuffer *g,
                    tl_light_set lights[COUNT_OF(scenes)],
                    tl_image *want[COUNT_OF(scenes)])
{
    tl_lighting *lighting = NULL;
    tl_image *got = image_like(g);
    tl_error err;
    ASSERT_OK(tl_lighting_create(device, options, &lighting, &err), err);
    for (size_t s = 0; s < COUNT_OF(scenes); s++) {
        char what[160];
        snprintf(what, sizeof what, "%s, %u x %u, tile %u, width %u, cull %d", scenes[s].name,
                 g->camera.width, g->camera.height, options->tile_size, options->vector_width,
                 options->cull);
        ASSERT_OK(tl_lighting_run(lighting, g, &lights[s], got, NULL, NULL, NULL, &err), err);
        assert_same_image(got, want[s], what);
    }
    tl_image_destroy(got);
    tl_lighting_destroy(lighting);
}

/* Under each projection two widths, by turns with the sizes of tiles: a build of all that lights may have takes
 * seconds, and every size of image has all of both. Together with
 * tests/test_layouts_lit.c, every width under both. */
static void image_never_changes(void **state)
{
    static const uint32_t tiles[] = {8, 16, 32, 64}, widths[2][2] = {{1, 16}, {8, 16}};
    const tl_lighting_options twin = {.precision = TL_PRECISION_TWIN, .tile_size = 16};
    for (size_t size = 0; size < COUNT_OF(sizes); size++) {
        const tl_camera camera =
            camera_of(sizes[size].width, sizes[size].height, sizes[size].projection);
        tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, 1977);
        push_back(g, sizes[size].behind);
        tl_light_set lights[COUNT_OF(scenes)] = {{.count = 0}};
        tl_image *want[COUNT_OF(scenes)];
        for (size_t s = 0; s < COUNT_OF(scenes); s++) {
            scenes[s].place(g, &lights[s], scenes[s].count);
            want[s] = image_like(g);
            light_frame(NULL, &twin, g, &lights[s], want[s]);
        }
        for (size_t t = 0; t < COUNT_OF(tiles); t++)
            for (int cull = 0; cull < TL_CULL_COUNT; cull++) {
                const tl_lighting_options options = {
                    .cull = (tl_cull)cull,
                    .tile_size = tiles[t],
                    .vector_width = widths[sizes[size].projection][(size + t) % 2],
                    .effects = TL_EFFECTS_ALL};
                compare(*state, &options, g, lights, want);
            }
        for (size_t s = 0; s < COUNT_OF(scenes); s++) {
            tl_light_set_clear(&lights[s]);
            tl_image_destroy(want[s]);
        }
        tl_gbuffer_destroy(g);
    }
}

/* The rims of tiles on the path for GPUs, whose groups bound tiles pixel by pixel. */
static void work_groups_keep_the_rims(void **state)
{
    static const uint32_t tiles[] = {8, 32};
    for (size_t size = 0; size < COUNT_OF(sizes); size++) {
        const tl_camera camera =
            camera_of(sizes[size].width, sizes[size].height, sizes[size].projection);
        tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, 1977);
        push_back(g, sizes[size].behind);
        tl_image *want = image_like(g), *got = image_like(g);
        tl_lighting_options options = {.precision = TL_PRECISION_TWIN, .tile_size = 16};
        tl_light_set lights = {0};
        steps(g, &lights, SMALL);
        light_frame(NULL, &options, g, &lights, want);
        for (size_t t = 0; t < COUNT_OF(tiles); t++)
            for (int cull = 0; cull < TL_CULL_COUNT; cull++) {
                options = (tl_lighting_options){.cull = (tl_cull)cull,
                                                .path = TL_PATH_GPU,
                                                .tile_size = tiles[t],
                                                .effects = TL_EFFECTS_ALL};
                light_frame(*state, &options, g, &lights, got);
                assert_same_image(got, want, "by work-groups");
            }
        tl_light_set_clear(&lights);
        tl_image_destroy(want);
        tl_image_destroy(got);
        tl_gbuffer_destroy(g);
    }
}

static void most_pairs_are_culled(void **state)
{
    const tl_camera camera = camera_of(61, 40, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 1977);
    tl_image *image = image_like(g);
    tl_light_set lights = {0};
    tl_lighting_options options = tl_lighting_options_default();
    options.tile_size = 8;
    scattered(g, &lights, 200);
    options.cull = TL_CULL_DEPTH;
    const tl_lighting_counts by_depth = light_frame(*state, &options, g, &lights, image);
    options.cull = TL_CULL_RECT;
    const tl_lighting_counts by_rect = light_frame(*state, &options, g, &lights, image);
    options.cull = TL_CULL_NONE;
    const tl_lighting_counts all = light_frame(*state, &options, g, &lights, image);

    assert_int_equal(all.list_length, 200 * 8 * 5);
    assert_in_range(by_rect.list_length, 1, all.list_length / 2);
    assert_in_range(by_depth.list_length, 1, by_rect.list_length * 9 / 10);
    tl_light_set_clear(&lights);
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

/* Between the near and the far surfaces of every tile, near none of them. */
static void lights_between_surfaces_cost_nothing(void **state)
{
    const tl_camera camera = camera_of(64, 64, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 1977);
    tl_image *image = image_like(g);
    tl_light_set lights = {0};
    tl_lighting_options options = tl_lighting_options_default();
    tl_error err;
    push_back(g, 20.0f);
    for (int i = 0; i < 100; i++) {
        const double view[3] = {0.05 * (i - 50), 0.0, -8.0 - 0.1 * i};
        tl_light light = tl_light_default();
        double world[3];
        tl_camera_world_point(&camera, view, world);
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] = (float)world[axis];
        light.range = 2.0f;
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    }
    const tl_lighting_counts by_split = light_frame(*state, &options, g, &lights, image);
    options.cull = TL_CULL_DEPTH;
    const tl_lighting_counts by_depth = light_frame(*state, &options, g, &lights, image);
    assert_int_equal(by_split.list_length, 0);
    assert_in_range(by_depth.list_length, 100, 100 * 16);
    tl_light_set_clear(&lights);
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

/* Lit in bands because the whole is not allowed the memory: same bits, and the limit kept. */
static void bands_do_not_show(void **state)
{
    static const uint64_t limits[] = {400000, 60000, 30000};
    const tl_camera camera = camera_of(130, 200, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, 1977);
    tl_image *want = image_like(g), *got = image_like(g);
    tl_light_set lights = {0};
    tl_lighting_options options = tl_lighting_options_default();
    uint32_t bands_before = 0;
    tl_lighting *lighting = NULL;
    tl_error err;
    options.tile_size = 8;
    around_the_eye(g, &lights, 200);
    light_frame(*state, &options, g, &lights, want);
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        options.memory_limit = limits[i];
        const tl_lighting_counts counts = light_frame(*state, &options, g, &lights, got);
        assert_same_image(got, want, "bands");
        assert_in_range(counts.device_bytes, 1, limits[i]);
        assert_in_range(counts.band_count, bands_before + 1, 25);
        bands_before = counts.band_count;
    }
    options.memory_limit = 3000;
    ASSERT_OK(tl_lighting_create(*state, &options, &lighting, &err), err);
    assert_int_equal(tl_lighting_run(lighting, g, &lights, got, NULL, NULL, NULL, &err),
                     TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "--memory"));
    tl_lighting_destroy(lighting);
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(image_never_changes),
        cmocka_unit_test(work_groups_keep_the_rims),
        cmocka_unit_test(most_pairs_are_culled),
        cmocka_unit_test(lights_between_surfaces_cost_nothing),
        cmocka_unit_test(bands_do_not_show),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
