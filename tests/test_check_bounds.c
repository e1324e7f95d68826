/* Do our kernels and their twin in C stay within what is derived for them, with room that is neither none nor
 * absurd? */
#include "golden_scenes.h"
#include "hard_pixels.h"
#include "rich_lights.h"

#include "check_frames.h"

#include "tilelight/check.h"
#include "tilelight/gbuffer_file.h"

/* Largest error over tolerance of all that was checked: by rounding alone, and where it hangs on
 * rounding whether a light adds anything. */
static double largest_rounding, largest_decided;

/* Fails where the picture is outside of what is derived. */
static void check_picture(const tl_check *check, const tl_image *got, const char *what)
{
    tl_check_report report;
    tl_error err;
    ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
    const tl_check_value *worst = &report.worst;
    if (report.failed_count > 0)
        fail_msg(
            "%s: %u pixels outside; (%u, %u) %u: got %.9g, want %.9g, allowed %.9g to %.9g",
            what, (unsigned)report.failed_count, worst->x, worst->y, worst->channel,
            (double)worst->got, worst->expected, worst->low, worst->high);
    largest_rounding = fmax(largest_rounding, report.rounding_ratio);
    largest_decided = fmax(largest_decided, worst->ratio);
    print_message("%-28s %.3f\n", what, report.rounding_ratio);
}

/* By the twin, which has no kernels to build, and by kernels of this width; 0: not by kernels. That they
 * agree is what tests/test_same_bits.c asks, and that culling shows in nothing,
 * tests/test_culling_exact.c. */
static void check_frame(tl_device *device,
                        const char *name,
                        const tl_gbuffer *g,
                        const tl_light_set *lights,
                        float light_cutoff,
                        uint32_t width)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_check *check = NULL;
    tl_error err;
    tl_image *got = image_like(g);
    char what[96];
    ASSERT_OK(tl_check_create(g, lights, light_cutoff, TL_COSINE_STABLE, &check, &err), err);
    options.light_cutoff = light_cutoff;
    options.cull = TL_CULL_NONE;
    options.precision = TL_PRECISION_TWIN;
    light_frame(NULL, &options, g, lights, got);
    snprintf(what, sizeof what, "%s, twin", name);
    check_picture(check, got, what);
    options.precision = TL_PRECISION_FLOAT;
    options.vector_width = width;
    snprintf(what, sizeof what, "%s, width %u", name, width);
    if (width != 0) {
        light_frame(device, &options, g, lights, got);
        check_picture(check, got, what);
    }
    tl_check_destroy(check);
    tl_image_destroy(got);
}

/* The first by kernels too, which have the bits of the twin for all. */
static void built_in_frames(void **state)
{
    for (int i = 0; i < tl_check_frame_count; i++) {
        tl_checked_frame frame = {0};
        tl_error err;
        ASSERT_OK(tl_check_frame_make(i, &frame, &err), err);
        check_frame(*state, tl_check_frame_name(i), frame.gbuffer, &frame.lights,
                    frame.light_cutoff, i == 0 ? 16 : 0);
        tl_checked_frame_clear(&frame);
    }
}

static void golden_frames(void **state)
{
    for (size_t i = 0; i < COUNT_OF(golden_scenes); i++) {
        char path[4096];
        tl_gbuffer *g = NULL;
        tl_light_set lights = {0};
        tl_error err;
        source_path(path, sizeof path, "tests/golden", golden_scenes[i].name, ".gbuffer.exr");
        ASSERT_OK(tl_gbuffer_read(path, &g, &lights, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_repair(g, path, false, NULL, &err), err);
        check_frame(*state, golden_scenes[i].name, g, &lights, 0.0f, 16);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* Every material under every projection, by lights that know of neither: of points, of spots, of shapes. By the
 * twin all of it; by kernels one case of points, of spots and of shapes. */
static void pixels_at_the_limits(void **state)
{
    static const struct {
        const char *name;
        tl_projection projection;
        uint32_t present, points, spots, shapes; /* the last three: widths */
        void (*make_sky)(tl_light_set *set);
    } cases[] = {
        {"hard", TL_PERSPECTIVE,
         TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, 0, 0, 16,
         make_gradient_sky},
        {"hard, parallel", TL_ORTHOGRAPHIC,
         TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, 1, 0, 0,
         make_gradient_sky},
        {"metal", TL_PERSPECTIVE, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH, 0, 8, 0,
         make_image_sky},
        {"metal, parallel", TL_ORTHOGRAPHIC, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH, 0, 0, 0,
         make_image_sky},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_light_set lights = {0};
        tl_gbuffer *g = hard_frame(cases[i].projection, cases[i].present, &lights);
        char name[64];
        check_frame(*state, cases[i].name, g, &lights, 0.0f, cases[i].points);
        make_hard_spots(&lights);
        snprintf(name, sizeof name, "%s, spots", cases[i].name);
        check_frame(*state, name, g, &lights, 0.0f, cases[i].spots);
        make_rich(&lights);
        cases[i].make_sky(&lights);
        snprintf(name, sizeof name, "%s, shapes", cases[i].name);
        check_frame(*state, name, g, &lights, 0.0f, cases[i].shapes);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* What a bound is worth: worst cases of all steps at once do not happen, but a tenth of them does.
 * And decisions at a threshold are met, else nothing shows that they are allowed for. */
static void bounds_have_some_room(void **state)
{
    (void)state;
    print_message("rounding takes up to %.3f of the tolerance, with decisions %.4f\n",
                  largest_rounding, largest_decided);
    assert_true(largest_rounding > 0.1);
    assert_true(largest_decided > 0.9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_in_frames),
        cmocka_unit_test(golden_frames),
        cmocka_unit_test(pixels_at_the_limits),
        cmocka_unit_test(bounds_have_some_room),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
