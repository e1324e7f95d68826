/* Is a capture of the ISPC project's deferred example shown as its own program shows it, without an option?
 *
 * The capture and the example's own picture of it are in the folder TILELIGHT_ASSETS, or
 * ../shared/assets beside the sources; without either the test reports itself skipped. */
#define _GNU_SOURCE
#include "assets.h"
#include "program.h"

#include "tilelight/image.h"

#include <unistd.h>

/* A pixel is off where a channel differs by more than 2 of 255; the example rounds its reciprocals more
 * coarsely, and 1 in 1000 may be. */
static const float most_off = 2.0f / 255.0f + 1e-6f;
static const double most_share = 0.001;

static char *capture, *picture;

static int find_capture(void)
{
    capture = asset_path("ispc/mid1280x720.bin");
    picture = asset_path("ispc/mid1280x720-reference.png");
    return access(capture, R_OK) == 0 && access(picture, R_OK) == 0;
}

static size_t count_off(const char *a_path, const char *b_path, size_t *pixels)
{
    tl_image *a = NULL, *b = NULL;
    tl_error err;
    size_t off = 0;
    ASSERT_OK(tl_image_read(a_path, &a, NULL, &err), err);
    ASSERT_OK(tl_image_read(b_path, &b, NULL, &err), err);
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    *pixels = (size_t)a->width * a->height;
    for (size_t y = 0; y < a->height; y++)
        for (size_t x = 0; x < a->width; x++) {
            int is_off = 0;
            for (unsigned c = 0; c < 3; c++)
                is_off |= fabsf(tl_image_plane(a, c)[y * a->pitch + x] -
                                tl_image_plane(b, c)[y * b->pitch + x]) > most_off;
            off += (size_t)is_off;
        }
    tl_image_destroy(a);
    tl_image_destroy(b);
    return off;
}

/* In commands $C is the capture. */
static void the_picture_is_theirs(void **state)
{
    size_t pixels = 0;
    (void)state;
    const program_run *run = expect_run("$T light $C -o out.png", 0, "",
                                        "tone none and curve gamma-2.2; --tone aces --curve "
                                        "srgb brings ours");
    assert_non_null(strstr(run->err, "blinn-phong-normalized"));
    const size_t off = count_off("out.png", picture, &pixels);
    print_message("%zu of %zu pixels are off\n", off, pixels);
    assert_true((double)off <= most_share * (double)pixels);
}

/* The same in double: what is off above is not the kernels' precision. */
static void so_is_that_of_the_reference(void **state)
{
    size_t pixels = 0;
    (void)state;
    expect_run("$T light $C -o exact.png --precision reference", 0, "", "gamma-2.2");
    assert_true((double)count_off("exact.png", picture, &pixels) <=
                most_share * (double)pixels);
}

static void options_bring_ours(void **state)
{
    size_t pixels = 0;
    (void)state;
    const program_run *run = expect_run("$T light $C -o ours.png --tone aces --curve srgb", 0,
                                        "", "blinn-phong-normalized");
    assert_null(strstr(run->err, "gamma"));
    assert_true(count_off("ours.png", picture, &pixels) > pixels / 2);
    run = expect_run("$T light $C -o half.png --tone none", 0, "", "--curve srgb brings ours");
    assert_int_equal(count_off("half.png", "out.png", &pixels), 0);
}

static void info_says_what_is_inside(void **state)
{
    (void)state;
    const program_run *run = expect_run("$T info $C", 0, "1280 x 720", "");
    assert_non_null(strstr(run->out, "ispc-reversed, 15 bytes per pixel"));
    assert_non_null(strstr(run->out, "1024"));
    assert_non_null(strstr(run->out, "blinn-phong-normalized"));
    expect_run("$T info $C --json", 0, "\"model\": \"blinn-phong-normalized\"", "");
}

static void a_bench_counts_the_pairs_that_they_count(void **state)
{
    (void)state;
    const program_run *run = expect_run("$T bench --baselines --capture $C --quick --seconds "
                                        "0.02 --quiet --json b.json && cat b.json",
                                        0, "\"pairs\": 23295744", "");
    assert_non_null(strstr(run->out, "\"file\": \"mid1280x720.bin\""));
    assert_non_null(strstr(run->out, "\"size\": \"1280x720\""));
    assert_null(strstr(run->out, "\"case\""));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_picture_is_theirs),
        cmocka_unit_test(so_is_that_of_the_reference),
        cmocka_unit_test(options_bring_ours),
        cmocka_unit_test(info_says_what_is_inside),
        cmocka_unit_test(a_bench_counts_the_pairs_that_they_count),
    };
    if (!find_capture()) {
        fprintf(stderr, "skipped: no ispc/mid1280x720.bin (TILELIGHT_ASSETS)\n");
        return TL_SKIPPED;
    }
    setenv("C", capture, 1);
    enter_empty_folder("ispc");
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(picture);
    free(capture);
    return failed;
}
