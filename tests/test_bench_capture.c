/* Are the yardsticks of a capture's bench right: the pairs that plain tiles leave, and what the relaxed
 * hand-written code makes of the capture's model? */
#define _GNU_SOURCE
#include "assets.h"
#include "frames.h"
#include "ispc_captures.h"

#include "baselines.h"
#include "capture_read.h"
#include "classic_pairs.h"
#include "tilelight/compare.h"
#include "tilelight/layouts.h"

#include <unistd.h>

/* Repaired, in full float; lights inside. The caller clears *lights. */
static tl_gbuffer *unpacked_capture(const char *path, tl_light_set *lights)
{
    const tl_capture_request request = {.path = path};
    tl_captured read = {0};
    tl_gbuffer *unpacked = NULL;
    tl_error err;
    ASSERT_OK(tl_capture_read(&request, &read, &err), err);
    ASSERT_OK(tl_gbuffer_repair(read.gbuffer, path, false, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_unpack(read.gbuffer, &unpacked, &err), err);
    ASSERT_OK(tl_gbuffer_repair(unpacked, path, false, NULL, &err), err);
    *lights = read.lights;
    read.lights = (tl_light_set){0};
    tl_captured_clear(&read);
    return unpacked;
}

static tl_gbuffer *example(int32_t width, int32_t height, tl_light_set *lights)
{
    static unsigned char bytes[ISPC_MOST];
    const ispc_capture c = ispc_example(width, height, 1);
    char path[512];
    scratch_path(path, sizeof path, "capture-to-measure.bin");
    save_bytes(path, bytes, ispc_bytes(&c, bytes));
    tl_gbuffer *g = unpacked_capture(path, lights);
    remove(path);
    return g;
}

/* x/depth or y/depth of the edge between pixels. */
static double edge(float from, float to, uint32_t at, uint32_t count)
{
    return (double)from + ((double)to - (double)from) * at / count;
}

/* Signed distance of (across, depth) from the line through the eye along (tangent, 1), above 0 on the side
 * of larger across: by the angle between the two. */
static double beside(double tangent, double across, double depth)
{
    return hypot(across, depth) * sin(atan2(across, depth) - atan2(tangent, 1.0));
}

/* Tiles and lights one by one, sides by angles. */
static uint64_t count_by_angles(const tl_gbuffer *g, const tl_light_set *lights)
{
    const tl_camera *c = &g->camera;
    uint64_t sum = 0;
    for (uint32_t y0 = 0; y0 < c->height; y0 += 16)
        for (uint32_t x0 = 0; x0 < c->width; x0 += 16) {
            const uint32_t x1 = x0 + 16, y1 = y0 + 16;
            double near = 1e30, far = 0.0;
            uint64_t pixels = 0;
            for (uint32_t y = y0; y < y1 && y < c->height; y++)
                for (uint32_t x = x0; x < x1 && x < c->width; x++, pixels++) {
                    const double d =
                        (double)tl_gbuffer_plane(g, TL_DEPTH)[(size_t)y * g->pitch + x];
                    near = fmin(near, d);
                    far = isinf(d) ? far : fmax(far, d);
                }
            for (size_t i = 0; i < lights->count; i++) {
                const float *p = lights->lights[i].position; /* world space is view space */
                const double x = (double)p[0], y = (double)p[1], depth = -(double)p[2];
                const double r = (double)lights->lights[i].range;
                const int meets =
                    beside(edge(c->left, c->right, x0, c->width), x, depth) >= -r &&
                    beside(edge(c->left, c->right, x1, c->width), x, depth) <= r &&
                    beside(edge(c->top, c->bottom, y0, c->height), y, depth) <= r &&
                    beside(edge(c->top, c->bottom, y1, c->height), y, depth) >= -r &&
                    depth + r >= near && depth - r <= far;
                sum += meets ? pixels : 0;
            }
        }
    return sum;
}

static void pairs_are_those_of_plain_tiles(void **state)
{
    static const int32_t sizes[][2] = {{64, 64}, {37, 21}, {5, 50}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        tl_light_set lights = {0};
        tl_gbuffer *g = example(sizes[i][0], sizes[i][1], &lights);
        const uint64_t got = tl_classic_pairs(g, &lights), want = count_by_angles(g, &lights);
        assert_int_equal(got, want);
        assert_in_range(got, 1, (uint64_t)(sizes[i][0] * sizes[i][1]) * lights.count - 1);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* The example's own culling leaves 25.3 lights per pixel of it. */
static void so_many_are_told_of_the_capture(void **state)
{
    char *const path = asset_path("ispc/mid1280x720.bin");
    tl_light_set lights = {0};
    (void)state;
    if (access(path, R_OK) == 0) {
        tl_gbuffer *g = unpacked_capture(path, &lights);
        const double per_pixel =
            (double)tl_classic_pairs(g, &lights) / ((double)g->camera.width * g->camera.height);
        print_message("%.3f lights per pixel\n", per_pixel);
        assert_true(fabs(per_pixel - 25.3) < 0.05);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
    free(path);
}

static void relaxed_code_is_within_its_tolerance(void **state)
{
    static const char *const sets[] = {"avx512", "avx2", "portable"};
    const tl_lighting_options exact = {.precision = TL_PRECISION_REFERENCE, .tile_size = 16};
    const tl_baseline *relaxed = tl_baseline_find("hand_relaxed");
    tl_light_set lights = {0};
    tl_gbuffer *g = example(64, 48, &lights);
    tl_image *want = image_like(g), *got = image_like(g);
    const tl_baseline_input input = {NULL, g, &lights};
    (void)state;
    light_frame(NULL, &exact, g, &lights, want);
    for (size_t i = 0; i < COUNT_OF(sets); i++) {
        void *run = NULL;
        tl_difference difference;
        tl_error err;
        setenv("TILELIGHT_HAND", sets[i], 1);
        ASSERT_OK(relaxed->create(&input, &run, &err), err);
        ASSERT_OK(relaxed->run(run, got, NULL, &err), err);
        ASSERT_OK(tl_compare(got, want, &difference, &err), err);
        print_message("%s: RMS %.2g, at most %.2g\n", tl_hand_instruction_set(),
                      difference.relative_rms, difference.relative_max);
        assert_true(difference.relative_rms <= relaxed->rms_tolerance);
        assert_true(difference.relative_max <= relaxed->max_tolerance);
        relaxed->destroy(run);
    }
    unsetenv("TILELIGHT_HAND");
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

/* What it cannot add at once, and what others cannot light, is said. */
static void others_refuse_the_model(void **state)
{
    tl_light_set lights = {0};
    tl_gbuffer *g = example(16, 16, &lights);
    const tl_baseline_input input = {NULL, g, &lights};
    void *run = NULL;
    tl_error err;
    (void)state;
    assert_int_equal(tl_baseline_find("hand")->create(&input, &run, &err), TL_ERR_UNSUPPORTED);
    assert_non_null(strstr(err.message, "phong"));
    tl_light *one = &lights.lights[3];
    const tl_light was = *one;
    one->type = TL_LIGHT_SPOT;
    one->direction[2] = -1.0f;
    one->outer_cone = 0.5f;
    assert_int_equal(tl_baseline_find("hand_relaxed")->create(&input, &run, &err),
                     TL_ERR_UNSUPPORTED);
    assert_non_null(strstr(err.message, "spot"));
    *one = was;
    one->specular = 0.5f; /* another colour */
    assert_int_equal(tl_baseline_find("hand_relaxed")->create(&input, &run, &err),
                     TL_ERR_UNSUPPORTED);
    assert_null(run);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_those_of_plain_tiles),
        cmocka_unit_test(so_many_are_told_of_the_capture),
        cmocka_unit_test(relaxed_code_is_within_its_tolerance),
        cmocka_unit_test(others_refuse_the_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
