/* Are the figures of a comparison what their definitions give? */
#define _POSIX_C_SOURCE 200809L
#include "testing.h"

#include "tilelight/compare.h"

/* 2 x 2 pixels, channels one after another, so that every figure can be had by hand. */
enum { VALUES = 12 };

static tl_image *make_image(const float values[VALUES])
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(2, 2, &image, &err), err);
    for (size_t i = 0; i < 3 * (size_t)image->pitch * image->rows; i++)
        image->planes[i] = NAN; /* padding must not be read */
    for (size_t i = 0; i < VALUES; i++)
        tl_image_plane(image, (unsigned)i / 4)[i / 2 % 2 * image->pitch + i % 2] = values[i];
    return image;
}

static const struct {
    const char *name;
    float a[VALUES], b[VALUES];
    double mean_value, max, mean, rms, p999, psnr;
    uint64_t different, not_finite;
    uint32_t worst_x, worst_y, worst_channel;
} cases[] = {
    {"equal",
     {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3},
     {1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3},
     2,
     0,
     0,
     0,
     0,
     INFINITY,
     0,
     0,
     0,
     0,
     0},
    /* |a - b|: 3 in green at (1, 0), 4 in blue at (0, 1); squares 25; peak 4: 20 lg(4 / rms) */
    {"two differ",
     {0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 4},
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 4},
     8.0 / 12,
     4,
     7.0 / 12,
     1.4433756729740645,
     4,
     8.85361220031512,
     2,
     0,
     0,
     1,
     2},
    {"sign of zero",
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.0f},
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
     0,
     0,
     0,
     0,
     0,
     INFINITY,
     1,
     0,
     0,
     0,
     0},
    {"mean of 0",
     {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
     0,
     1,
     1.0 / 12,
     0.28867513459481287,
     1,
     -INFINITY,
     1,
     0,
     0,
     0,
     0},
    {"the same NaN in both",
     {1, 1, 1, 1, 1, 1, NAN, 1, 1, 1, 1, 1},
     {1, 1, 1, 1, 1, 1, NAN, 1, 1, 1, 1, 1},
     1,
     INFINITY,
     INFINITY,
     INFINITY,
     INFINITY,
     -INFINITY,
     0,
     1,
     0,
     1,
     1},
    {"infinite in one",
     {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},
     {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, INFINITY},
     1,
     INFINITY,
     INFINITY,
     INFINITY,
     INFINITY,
     -INFINITY,
     1,
     1,
     1,
     1,
     2},
    {"a tie goes to the first, row by row",
     {0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0},
     {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 12},
     1,
     12,
     14.0 / 12,
     3.488074922742725,
     12,
     10.731908823584373,
     3,
     0,
     1,
     1,
     2},
    {"beyond float's precision",
     {1, 16777216, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},
     {1, -1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},
     10.0 / 12,
     16777217,
     16777217.0 / 12,
     4843165.375601383,
     16777217,
     -133.70258597595407,
     1,
     0,
     1,
     0,
     0},
};

/* Sums of a few exact terms: figures up to 1e7 are off by a few ulps, so by less than 1e-8. */
static void expect_near(
    const char *name, const char *field, double got, double want, double within)
{
    if (got == want || fabs(got - want) <= within)
        return;
    fail_msg("%s: %s is %.17g, not %.17g", name, field, got, want);
}

static double over(double error, double mean)
{
    return error == 0.0 ? 0.0 : error / mean;
}

static void figures_match_those_by_hand(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_image *a = make_image(cases[i].a), *b = make_image(cases[i].b);
        const char *name = cases[i].name;
        const double mean = cases[i].mean_value;
        tl_difference got;
        tl_error err;
        ASSERT_OK(tl_compare(a, b, &got, &err), err);
        expect_near(name, "mean of b", got.mean_value, mean, 1e-9);
        expect_near(name, "max", got.max, cases[i].max, 0);
        expect_near(name, "mean", got.mean, cases[i].mean, 1e-9);
        expect_near(name, "rms", got.rms, cases[i].rms, 1e-8);
        expect_near(name, "p999", got.p999, cases[i].p999, 0);
        expect_near(name, "psnr", got.psnr, cases[i].psnr, 1e-9);
        expect_near(name, "relative max", got.relative_max, over(cases[i].max, mean), 1e-8);
        expect_near(name, "relative mean", got.relative_mean, over(cases[i].mean, mean), 1e-8);
        expect_near(name, "relative rms", got.relative_rms, over(cases[i].rms, mean), 1e-8);
        expect_near(name, "relative p999", got.relative_p999, over(cases[i].p999, mean), 1e-8);
        assert_int_equal(got.different_count, cases[i].different);
        assert_int_equal(got.not_finite_count, cases[i].not_finite);
        assert_int_equal(got.worst_x, cases[i].worst_x);
        assert_int_equal(got.worst_y, cases[i].worst_y);
        assert_int_equal(got.worst_channel, cases[i].worst_channel);
        const size_t worst =
            4 * cases[i].worst_channel + 2 * cases[i].worst_y + cases[i].worst_x;
        assert_true(same_bits(got.worst_a, cases[i].a[worst]));
        assert_true(same_bits(got.worst_b, cases[i].b[worst]));
        tl_image_destroy(b);
        tl_image_destroy(a);
    }
}

static int ascending(const void *a, const void *b)
{
    const double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

/* Against sorting, for pictures on either side of a whole thousand of values. */
static void percentile_is_that_of_the_sorted_differences(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {333, 1}, {334, 1}, {100, 10}, {67, 41}};
    uint32_t seed = 3;
    (void)state;
    for (size_t s = 0; s < COUNT_OF(sizes); s++) {
        const size_t count = 3 * (size_t)sizes[s][0] * sizes[s][1];
        double *sorted = malloc(count * sizeof *sorted);
        tl_image *a = NULL, *b = NULL;
        tl_difference got;
        tl_error err;
        size_t filled = 0;
        assert_non_null(sorted);
        ASSERT_OK(tl_image_create(sizes[s][0], sizes[s][1], &a, &err), err);
        ASSERT_OK(tl_image_create(sizes[s][0], sizes[s][1], &b, &err), err);
        for (unsigned channel = 0; channel < 3; channel++)
            for (size_t y = 0; y < sizes[s][1]; y++)
                for (size_t x = 0; x < sizes[s][0]; x++) {
                    float *value = tl_image_plane(a, channel) + y * a->pitch + x;
                    seed = seed * 1664525u + 1013904223u;
                    *value = ldexpf((float)(seed >> 8) * 0x1p-24f, (int)(seed & 63) - 32);
                    sorted[filled++] = (double)*value;
                }
        ASSERT_OK(tl_compare(a, b, &got, &err), err);
        qsort(sorted, count, sizeof *sorted, ascending);
        size_t rank = 1; /* the least with 99.9 % at or below it */
        while (1000 * rank < 999 * count)
            rank++;
        if (got.p999 != sorted[rank - 1])
            fail_msg("%zu values: %.17g, not %.17g", count, got.p999, sorted[rank - 1]);
        assert_true(got.max == sorted[count - 1]);
        tl_image_destroy(b);
        tl_image_destroy(a);
        free(sorted);
    }
}

static void threads_change_nothing(void **state)
{
    tl_image *a = NULL, *b = NULL;
    tl_difference one, many;
    tl_error err;
    uint32_t seed = 5;
    (void)state;
    ASSERT_OK(tl_image_create(97, 131, &a, &err), err);
    ASSERT_OK(tl_image_create(97, 131, &b, &err), err);
    for (size_t i = 0; i < 3 * (size_t)a->pitch * a->rows; i++) {
        seed = seed * 1664525u + 1013904223u;
        a->planes[i] = (float)seed * 0x1p-20f;
        b->planes[i] = (float)(seed >> 7) * 0x1p-10f;
    }
    memset(&one, 0, sizeof one);
    memset(&many, 0, sizeof many);
    setenv("TILELIGHT_THREADS", "1", 1);
    ASSERT_OK(tl_compare(a, b, &one, &err), err);
    setenv("TILELIGHT_THREADS", "5", 1);
    ASSERT_OK(tl_compare(a, b, &many, &err), err);
    unsetenv("TILELIGHT_THREADS");
    assert_memory_equal(&one, &many, sizeof one);
    tl_image_destroy(b);
    tl_image_destroy(a);
}

static void other_sizes_are_refused(void **state)
{
    tl_image *a = NULL, *b = NULL;
    tl_difference untouched;
    tl_error err;
    (void)state;
    memset(&untouched, 1, sizeof untouched);
    const tl_difference before = untouched;
    ASSERT_OK(tl_image_create(2, 3, &a, &err), err);
    ASSERT_OK(tl_image_create(3, 2, &b, &err), err);
    assert_int_equal(tl_compare(a, b, &untouched, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "2 x 3"));
    assert_memory_equal(&untouched, &before, sizeof before);
    tl_image_destroy(b);
    tl_image_destroy(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_match_those_by_hand),
        cmocka_unit_test(percentile_is_that_of_the_sorted_differences),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(other_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
