/* How far is a frame in float from the reference, and within what the mean may be?
 *
 * The bound of single pixels is derived in test_lighting_formulas.c; here is the frame's mean, which
 * rounding errors of random sign leave far below it. */
#include "frames.h"

#include "tilelight/compare.h"

enum { WIDTH = 320, HEIGHT = 180, LIGHT_COUNT = 300 };

static void mean_error_is_two_millionths(void **state)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g =
        random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE, 3);
    tl_image *got = image_like(g), *want = image_like(g);
    tl_lighting_options options = tl_lighting_options_default();
    tl_light_set lights = {0};
    tl_difference difference;
    uint32_t seed = 11;
    tl_error err;
    for (int i = 0; i < LIGHT_COUNT; i++) {
        const tl_light light = random_light(&camera, &seed, 0.5f, 2.0f);
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    }
    light_frame(*state, &options, g, &lights, got);
    options.precision = TL_PRECISION_REFERENCE;
    light_frame(NULL, &options, g, &lights, want);
    ASSERT_OK(tl_compare(got, want, &difference, &err), err);
    print_message("relative to the mean: mean %.2g, RMS %.2g, p99.9 %.2g, max %.2g\n",
                  difference.relative_mean, difference.relative_rms, difference.relative_p999,
                  difference.relative_max);
    assert_true(difference.mean_value > 0.0);
    assert_true(difference.relative_mean <= 2e-6);
    tl_light_set_clear(&lights);
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(mean_error_is_two_millionths)};
    return cmocka_run_group_tests(tests, open_device, close_device);
}
