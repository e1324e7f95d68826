/* Are packed frames unpacked where full float is needed: for a user's kernel, for a check, for scattered
 * lights?
 *
 * What is expected is what the unpacked frame gives. */
#include "packed_frames.h"

#include "tilelight/check.h"
#include "tilelight/scatter.h"

enum { WIDTH = 61, HEIGHT = 40, LIGHT_COUNT = 60 };

/* Of which the second stores positions, and they are moved. */
static const enum tl_layout_name layouts[] = {TL_LAYOUT_COMPACT_16, TL_LAYOUT_MERLIN_POSITION,
                                              TL_LAYOUT_ISPC};

static tl_gbuffer *packed_frame(size_t i, tl_gbuffer **unpacked, tl_light_set *lights)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = packed_gbuffer(&camera, layouts[i], 1977);
    uint32_t seed = 3;
    tl_error err;
    move_positions(g, 5);
    ASSERT_OK(tl_gbuffer_unpack(g, unpacked, &err), err);
    for (int k = 0; k < LIGHT_COUNT; k++) {
        const tl_light light = random_light(&camera, &seed, 0.5f, 2.5f);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
    return g;
}

static void clear(tl_gbuffer *packed, tl_gbuffer *unpacked, tl_light_set *lights)
{
    tl_light_set_clear(lights);
    tl_gbuffer_destroy(unpacked);
    tl_gbuffer_destroy(packed);
}

/* A kernel that shows what it is given. */
static const tl_user_kernel depths_and_albedo = {
    .text =
        "__kernel void show(const tl_frame frame, __global const float *planes,\n"
        "    __global const tl_view_light *lights, __global const uint *starts,\n"
        "    __global const uint *ends, __global const uint *list, __global float *out)\n"
        "{\n"
        "    const uint tile = get_global_id(0), size = frame.tile_size;\n"
        "    const size_t plane = (size_t)frame.rows * frame.pitch;\n"
        "    for (uint i = 0; i < size * size; i++) {\n"
        "        const uint column = tile % frame.tiles_x * size + i % size;\n"
        "        const uint row = tile / frame.tiles_x * size + i / size;\n"
        "        const size_t at = (size_t)(frame.buffer_row + row) * frame.pitch + column;\n"
        "        const float depth = planes[at];\n"
        "        out[at] = depth < INFINITY ? depth : -1.0f;\n"
        "        out[plane + at] = planes[TL_ALBEDO_R * plane + at];\n"
        "        out[2 * plane + at] = TL_LAYOUT + (TL_WIDTH > (int)size ? 100.0f : 0.0f);\n"
        "    }\n"
        "}\n",
    .entry = "show"};

/* One tl_lighting, frame after frame: what was unpacked for one must not show in the next. */
static void users_kernels_get_full_float(void **state)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_lighting *lighting = NULL;
    tl_error err;
    options.kernel = depths_and_albedo;
    options.tile_size = 8;
    options.vector_width = 16; /* which the tile then is too small for */
    ASSERT_OK(tl_lighting_create(*state, &options, &lighting, &err), err);
    for (size_t i = 0; i < 2 * COUNT_OF(layouts); i++) {
        tl_gbuffer *unpacked = NULL;
        tl_light_set lights = {0};
        tl_gbuffer *g = packed_frame(i % COUNT_OF(layouts), &unpacked, &lights);
        tl_image *got = image_like(g);
        ASSERT_OK(tl_lighting_run(lighting, g, &lights, got, NULL, NULL, NULL, &err), err);
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const size_t at = (size_t)y * g->pitch + x;
                const float depth = tl_gbuffer_plane(unpacked, TL_DEPTH)[at];
                assert_true(
                    same_bits(tl_image_plane(got, 0)[at], isinf(depth) ? -1.0f : depth));
                assert_true(same_bits(tl_image_plane(got, 1)[at],
                                      tl_gbuffer_plane(unpacked, TL_ALBEDO_R)[at]));
                assert_true(same_bits(tl_image_plane(got, 2)[at], 0.0f));
            }
        tl_image_destroy(got);
        clear(g, unpacked, &lights);
    }
    tl_lighting_destroy(lighting);
}

/* The reference of a packed frame is that of the unpacked one; a picture of that passes. */
static void checks_are_of_the_unpacked_frame(void **state)
{
    const tl_lighting_options options = tl_lighting_options_default();
    for (size_t i = 0; i < COUNT_OF(layouts); i++) {
        tl_gbuffer *unpacked = NULL;
        tl_light_set lights = {0};
        tl_gbuffer *g = packed_frame(i, &unpacked, &lights);
        tl_image *image = image_like(g);
        tl_check_report of[2];
        light_frame(*state, &options, unpacked, &lights, image);
        for (int is_packed = 0; is_packed < 2; is_packed++) {
            tl_check *check = NULL;
            tl_error err;
            ASSERT_OK(tl_check_create(is_packed ? g : unpacked, &lights, 0.0f, TL_COSINE_STABLE,
                                      &check, &err),
                      err);
            ASSERT_OK(tl_check_image(check, image, NULL, &of[is_packed], &err), err);
            tl_check_destroy(check);
        }
        assert_int_equal(of[0].pixel_count, of[1].pixel_count);
        assert_int_equal(of[1].failed_count, 0);
        assert_true(of[1].worst.ratio > 0.0);
        assert_memory_equal(&of[0].worst.expected, &of[1].worst.expected, sizeof(double));
        tl_image_destroy(image);
        clear(g, unpacked, &lights);
    }
}

static void lights_are_scattered_alike(void **state)
{
    tl_scatter_options options = tl_scatter_options_default();
    (void)state;
    options.count = 20;
    for (size_t i = 0; i < COUNT_OF(layouts); i++) {
        tl_gbuffer *unpacked = NULL;
        tl_light_set lights = {0}, got = {0}, want = {0};
        tl_gbuffer *g = packed_frame(i, &unpacked, &lights);
        tl_error err;
        ASSERT_OK(tl_scatter(g, &options, &got, &err), err);
        ASSERT_OK(tl_scatter(unpacked, &options, &want, &err), err);
        assert_int_equal(got.count, want.count);
        for (size_t k = 0; k < want.count; k++)
            for (int axis = 0; axis < 3; axis++)
                assert_true(
                    same_bits(got.lights[k].position[axis], want.lights[k].position[axis]));
        tl_light_set_clear(&got);
        tl_light_set_clear(&want);
        clear(g, unpacked, &lights);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(users_kernels_get_full_float),
        cmocka_unit_test(checks_are_of_the_unpacked_frame),
        cmocka_unit_test(lights_are_scattered_alike),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
