/* Do our kernels stay within what is derived for them, in every width, with room that is neither
 * none nor absurd? */
#include "golden_scenes.h"
#include "hard_pixels.h"
#include "rich_lights.h"

#include "check_frames.h"

#include "tilelight/check.h"
#include "tilelight/gbuffer_file.h"

/* tests/test_same_bits.c shows that they agree, so that few frames need more than the first. */
static const uint32_t widths[] = {16, 8, 4, 1};

/* Largest error over tolerance of all that was checked: by rounding alone, and where it hangs on
 * rounding whether a light adds anything. */
static double largest_rounding, largest_decided;

static void check_widths(tl_device *device,
                         const char *name,
                         const tl_gbuffer *g,
                         const tl_light_set *lights,
                         float light_cutoff,
                         size_t width_count)
{
    tl_check *check = NULL;
    tl_check_report report;
    tl_error err;
    tl_image *got = image_like(g);
    ASSERT_OK(tl_check_create(g, lights, light_cutoff, TL_COSINE_STABLE, &check, &err), err);
    for (size_t w = 0; w < width_count; w++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.vector_width = widths[w];
        options.light_cutoff = light_cutoff;
        light_frame(device, &options, g, lights, got);
        ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
        const tl_check_value *worst = &report.worst;
        if (report.failed_count > 0)
            fail_msg(
                "%s, width %u: %u pixels outside; (%u, %u) %u: got %.9g, want %.9g, allowed "
                "%.9g to %.9g",
                name, widths[w], (unsigned)report.failed_count, worst->x, worst->y,
                worst->channel, (double)worst->got, worst->expected, worst->low, worst->high);
        largest_rounding = fmax(largest_rounding, report.rounding_ratio);
        largest_decided = fmax(largest_decided, worst->ratio);
    }
    print_message("%-16s %.3f\n", name, report.rounding_ratio);
    tl_check_destroy(check);
    tl_image_destroy(got);
}

static void built_in_frames(void **state)
{
    for (int i = 0; i < tl_check_frame_count; i++) {
        tl_checked_frame frame = {0};
        tl_error err;
        ASSERT_OK(tl_check_frame_make(i, &frame, &err), err);
        check_widths(*state, tl_check_frame_name(i), frame.gbuffer, &frame.lights,
                     frame.light_cutoff,
                     strcmp(tl_check_frame_name(i), "metal") == 0 ? COUNT_OF(widths) : 1);
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
        check_widths(*state, golden_scenes[i].name, g, &lights, 0.0f, 1);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

static void pixels_at_the_limits(void **state)
{
    static const uint32_t present[] = {TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION |
                                           TL_GROUP_EMISSIVE,
                                       TL_GROUP_BASE | TL_GROUP_METAL_ROUGH};
    for (size_t p = 0; p < COUNT_OF(present); p++)
        for (int projection = 0; projection < 2; projection++) {
            tl_light_set lights = {0};
            tl_gbuffer *g = hard_frame((tl_projection)projection, present[p], &lights);
            check_widths(*state, projection ? "hard, parallel" : "hard", g, &lights, 0.0f,
                         COUNT_OF(widths));
            make_hard_spots(&lights);
            check_widths(*state, projection ? "spots, parallel" : "spots", g, &lights, 0.0f, 1);
            make_rich(&lights);
            if (p == 0)
                make_gradient_sky(&lights);
            else
                make_image_sky(&lights);
            check_widths(*state, projection ? "shapes, parallel" : "shapes", g, &lights, 0.0f, 1);
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
