/* Is a picture of several samples a pixel the mean of the picture that its samples are, whatever the way
 * there? */
#define _GNU_SOURCE
#include "program.h"

#include "tilelight/image.h"

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-samples");
    return 0;
}

static void expect_same(const char *a, const char *b)
{
    char command[512];
    snprintf(command, sizeof command, "$T compare %s %s --tolerance 0", a, b);
    expect_run(command, 0, "differing                 0 of", "");
}

/* In double, from the top left, row by row: the order counts where a dark sample breaks a tie. */
static void expect_mean(const char *pixels, const char *samples, uint32_t side)
{
    tl_image *got = NULL, *from = NULL;
    tl_error err;
    double sum_of_all = 0.0;
    ASSERT_OK(tl_image_read(pixels, &got, NULL, &err), err);
    ASSERT_OK(tl_image_read(samples, &from, NULL, &err), err);
    assert_int_equal(from->width, got->width * side);
    assert_int_equal(from->height, got->height * side);
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < got->height; y++)
            for (uint32_t x = 0; x < got->width; x++) {
                double sum = 0.0;
                for (uint32_t k = 0; k < side * side; k++)
                    sum += (double)tl_image_plane(
                        from,
                        c)[(size_t)(y * side + k / side) * from->pitch + x * side + k % side];
                const float want = (float)(sum / (side * side));
                const float has = tl_image_plane(got, c)[(size_t)y * got->pitch + x];
                sum_of_all += (double)want;
                if (!same_bits(has, want))
                    fail_msg("%s, channel %u, pixel %u, %u: %a, not %a", pixels, c, x, y,
                             (double)has, (double)want);
            }
    assert_true(sum_of_all > 0.0);
    tl_image_destroy(got);
    tl_image_destroy(from);
}

/* Perspective, orthographic, framed; with sky and without. */
static const struct {
    const char *scene;
    uint32_t samples, side;
} cases[] = {
    {"hall.gltf", 4, 2},
    {"nine-lights.gltf", 9, 3},
    {"nine-lights.gltf", 16, 4},
    {"hard-cases.glb --camera above", 4, 2},
    {"hard-cases.glb --camera endless", 64, 8},
};

static void pixels_are_means_of_their_samples(void **state)
{
    char command[512];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const uint32_t side = cases[i].side;
        snprintf(command, sizeof command,
                 "$T render $D/%s --size 36x20 --samples %u -o pixels.exr --quiet && "
                 "$T render $D/%s --size %ux%u -o samples.exr --quiet",
                 cases[i].scene, cases[i].samples, cases[i].scene, 36 * side, 20 * side);
        expect_run(command, 0, "", "");
        expect_mean("pixels.exr", "samples.exr", side);
    }
}

static void one_sample_is_the_pixel(void **state)
{
    (void)state;
    expect_run("$T render $D/hard-cases.glb --size 36x20 --samples 1 -o one.exr && "
               "$T render $D/hard-cases.glb --size 36x20 -o none.exr && $T capture "
               "$D/hard-cases.glb --size 36x20 --samples 1 -o one.g.exr && $T capture "
               "$D/hard-cases.glb --size 36x20 -o none.g.exr && cmp one.exr none.exr && cmp "
               "one.g.exr none.g.exr",
               0, "", "");
}

static void captured_then_lit_is_rendered(void **state)
{
    (void)state;
    expect_run("$T render $D/hall.gltf --size 36x20 --samples 4 -o render.exr -o render.png && "
               "$T capture $D/hall.gltf --size 36x20 --samples 4 -o g.exr && "
               "$T light g.exr -o light.exr -o light.png && cmp render.png light.png",
               0, "", "");
    expect_same("light.exr", "render.exr");
    expect_run("$T info light.png", 0, "36 x 20", "");
    expect_run("$T info g.exr", 0, "2 x 2 for each pixel of a picture of 36 x 20", "");
    expect_run("$T info g.exr --json", 0, "\"samples\": 4", "");
    expect_run(
        "$T light g.exr -o twin.exr --precision twin && $T light g.exr -o tiles.exr --tile 64 "
        "--cull none",
        0, "", "");
    expect_same("twin.exr", "render.exr");
    expect_same("tiles.exr", "render.exr");
}

static void the_reference_takes_means_too(void **state)
{
    (void)state;
    expect_run(
        "$T render $D/nine-lights.gltf --size 36x20 --samples 9 -o pixels.exr --precision "
        "reference --quiet && $T render $D/nine-lights.gltf --size 108x60 -o samples.exr "
        "--precision reference --quiet",
        0, "", "");
    expect_mean("pixels.exr", "samples.exr", 3);
}

/* Captured in the layout, or converted to it and back: the samples go along. */
static void layouts_carry_samples(void **state)
{
    static const char *const layouts[] = {"compact-16", "ispc"};
    char command[1024];
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 36x20 --samples 4 -o g.exr", 0, "", "");
    for (size_t i = 0; i < COUNT_OF(layouts); i++) {
        snprintf(
            command, sizeof command,
            "$T convert g.exr -o h.exr --layout %s && $T info h.exr && $T light h.exr -o "
            "pixels.exr && $T convert h.exr -o back.exr --layout float && $T info back.exr && "
            "$T render $D/nine-lights.gltf --size 72x40 --layout %s -o samples.exr && $T "
            "render $D/nine-lights.gltf --size 36x20 --samples 4 --layout %s -o rendered.exr",
            layouts[i], layouts[i], layouts[i]);
        const program_run *run = expect_run(command, 0, "2 x 2 for each pixel", "");
        const char *first = strstr(run->out, "2 x 2 for each pixel");
        assert_non_null(strstr(first + 1, "2 x 2 for each pixel"));
        expect_mean("rendered.exr", "samples.exr", 2);
        expect_run("$T info pixels.exr", 0, "36 x 20", "");
    }
}

static void other_commands_take_samples_as_pixels(void **state)
{
    (void)state;
    expect_run(
        "$T capture $D/hard-cases.glb --size 18x10 --samples 4 -o g.exr && $T scatter g.exr "
        "--count 20 -o l.json && $T light g.exr --lights l.json -o lit.exr && $T render "
        "$D/hard-cases.glb --size 18x10 --samples 4 --scatter 20 -o render.exr && $T check "
        "--gbuffer g.exr",
        0, "", "");
    expect_same("lit.exr", "render.exr");
}

/* Lights off and a sky: the mean of one colour is that colour. */
static void sky_counts_as_its_colour(void **state)
{
    tl_image *image = NULL;
    tl_error err;
    (void)state;
    expect_run(
        "echo '{\"tilelight\": 1, \"sky\": {\"type\": \"constant\", \"color\": [0.1, 0.7, "
        "3.3]}}' >sky.json && $T render $D/hard-cases.glb --size 36x20 "
        "--samples 25 "
        "--lights sky.json -o sky.exr",
        0, "", "");
    ASSERT_OK(tl_image_read("sky.exr", &image, NULL, &err), err);
    int whole = 0, part = 0;
    for (uint32_t y = 0; y < image->height; y++)
        for (uint32_t x = 0; x < image->width; x++) {
            const float red = tl_image_plane(image, 0)[(size_t)y * image->pitch + x];
            whole += same_bits(red, 0.1f);
            part += red > 0.0f && red < 0.1f;
        }
    assert_true(whole > 10);
    assert_true(part > 10);
    tl_image_destroy(image);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    expect_run("$T render $D/hall.gltf --samples 5 -o a.png", 2, "",
               "\"5\" is none of 1, 4, 9, 16");
    expect_run("$T capture $D/hall.gltf --samples 0 -o a.exr", 2, "", "--samples");
    expect_run("$T capture $D/hall.gltf --samples 81 -o a.exr", 2, "", "64");
    expect_run(
        "$T capture $D/hall.gltf --size 16384x2 --samples 4 -o a.exr", 2, "",
        "16384 x 2 pixels of 4 samples: they are a grid of 32768 x 4, and 16384 per side");
    expect_run("$T capture $D/hall.gltf --size 2x16384 --samples 4 -o a.exr", 2, "",
               "4 x 32768");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_means_of_their_samples),
        cmocka_unit_test(one_sample_is_the_pixel),
        cmocka_unit_test(captured_then_lit_is_rendered),
        cmocka_unit_test(the_reference_takes_means_too),
        cmocka_unit_test(layouts_carry_samples),
        cmocka_unit_test(other_commands_take_samples_as_pixels),
        cmocka_unit_test(sky_counts_as_its_colour),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
