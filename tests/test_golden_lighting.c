/* Does a committed G-buffer light to the committed picture, bit for bit? */
#include "frames.h"
#include "golden_scenes.h"

#include "tilelight/gbuffer_file.h"

static void pictures_are_the_golden_ones(void **state)
{
    for (size_t i = 0; i < COUNT_OF(golden_scenes); i++) {
        const tl_lighting_options options = tl_lighting_options_default();
        char path[4096];
        tl_gbuffer *g = NULL;
        tl_image *want = NULL;
        tl_light_set lights = {0};
        bool has_lights = false;
        tl_error err;

        source_path(path, sizeof path, "tests/golden", golden_scenes[i].name, ".gbuffer.exr");
        ASSERT_OK(tl_gbuffer_read(path, &g, &lights, &has_lights, &err), err);
        ASSERT_OK(tl_gbuffer_repair(g, path, false, NULL, &err), err);
        assert_true(has_lights);
        source_path(path, sizeof path, "tests/golden", golden_scenes[i].name, ".lit.exr");
        ASSERT_OK(tl_image_read(path, &want, NULL, &err), err);
        tl_image *got = image_like(g);
        light_frame(*state, &options, g, &lights, got);
        assert_same_image(got, want, golden_scenes[i].name);

        tl_image_destroy(got);
        tl_image_destroy(want);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pictures_are_the_golden_ones)};
    return cmocka_run_group_tests(tests, open_device, close_device);
}
