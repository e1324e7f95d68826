/* Is a pixel exactly the mean of its own samples, and of nothing else? */
#define _POSIX_C_SOURCE 200809L /* setenv */
#include "testing.h"

#include "tilelight/gbuffer.h"
#include "tilelight/image.h"

enum { WIDTH = 5, HEIGHT = 7, MOST_SIDE = 8 };

static void side_of_samples(void **state)
{
    (void)state;
    for (uint32_t n = 0; n < 300; n++) {
        uint32_t side = 0;
        for (uint32_t s = 1; s <= MOST_SIDE; s++)
            side = s * s == n ? s : side;
        assert_int_equal(tl_samples_side(n), side);
    }
    assert_int_equal(tl_samples_side(UINT32_MAX), 0);
    assert_int_equal(tl_samples_side(1u << 16), 0);
}

/* The caller destroys it. */
static tl_image *image_of(uint32_t width, uint32_t height)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    return image;
}

static tl_image *resolved(const tl_image *from, uint32_t side)
{
    tl_image *to = NULL;
    tl_error err;
    ASSERT_OK(tl_image_resolve(from, side, &to, &err), err);
    assert_int_equal(to->width * side, from->width);
    assert_int_equal(to->height * side, from->height);
    return to;
}

static float *value_at(const tl_image *image, unsigned channel, uint32_t x, uint32_t y)
{
    return tl_image_plane(image, channel) + (size_t)y * image->pitch + x;
}

/* A sum in float would lose the last bits of most of these. */
static void one_colour_stays_as_it_is(void **state)
{
    static const float colours[] = {0.1f,  1.0f / 3.0f, 1.0f, 0x1.fffffep127f, 0x1p-149f, -0.0f,
                                    -2.7f, INFINITY,    0.0f, 16777215.0f};
    (void)state;
    for (uint32_t side = 1; side <= MOST_SIDE; side++)
        for (size_t i = 0; i < COUNT_OF(colours); i++) {
            tl_image *const from = image_of(WIDTH * side, HEIGHT * side);
            for (size_t k = 0; k < 3 * (size_t)from->pitch * from->rows; k++)
                from->planes[k] = colours[i];
            tl_image *const to = resolved(from, side);
            for (unsigned c = 0; c < 3; c++)
                for (uint32_t y = 0; y < HEIGHT; y++)
                    for (uint32_t x = 0; x < WIDTH; x++)
                        /* A sum that starts at 0 has no negative zero. */
                        if (*value_at(to, c, x, y) != colours[i])
                            fail_msg("%u x %u: %a became %a", side, side, (double)colours[i],
                                     (double)*value_at(to, c, x, y));
            tl_image_destroy(to);
            tl_image_destroy(from);
        }
}

/* Samples are whole numbers of 2^-20, which integers sum exactly; samples outside a pixel would show. */
static void means_are_exact(void **state)
{
    static const char *const threads[] = {"1", "2", "7"};
    (void)state;
    for (uint32_t n = 0; n < MOST_SIDE * COUNT_OF(threads); n++) {
        const uint32_t side = n % MOST_SIDE + 1;
        uint64_t sums[3][HEIGHT][WIDTH] = {{{0}}};
        uint32_t random = 7 + n;
        tl_image *const from = image_of(WIDTH * side, HEIGHT * side);
        for (unsigned c = 0; c < 3; c++)
            for (uint32_t y = 0; y < from->height; y++)
                for (uint32_t x = 0; x < from->width; x++) {
                    random = random * 1664525u + 1013904223u;
                    sums[c][y / side][x / side] += random >> 8;
                    *value_at(from, c, x, y) = (float)(random >> 8) * 0x1p-20f;
                }
        setenv("TILELIGHT_THREADS", threads[n / MOST_SIDE], 1);
        tl_image *const to = resolved(from, side);
        for (unsigned c = 0; c < 3; c++)
            for (uint32_t y = 0; y < HEIGHT; y++)
                for (uint32_t x = 0; x < WIDTH; x++) {
                    const double sum = (double)sums[c][y][x];
                    assert_true(same_bits(*value_at(to, c, x, y),
                                          (float)(sum / (side * side) * 0x1p-20)));
                }
        tl_image_destroy(to);
        tl_image_destroy(from);
    }
    unsetenv("TILELIGHT_THREADS");
}

/* 1 is lost beside 2^60, but not once that is gone: which it is tells the order. */
static void sums_run_from_the_top_left(void **state)
{
    tl_image *const from = image_of(2, 2);
    (void)state;
    *value_at(from, 0, 0, 0) = 0x1p60f;
    *value_at(from, 0, 1, 0) = 1.0f;
    *value_at(from, 0, 0, 1) = -0x1p60f;
    *value_at(from, 0, 1, 1) = 3.0f;
    tl_image *const to = resolved(from, 2);
    assert_true(same_bits(*value_at(to, 0, 0, 0), 0.75f));
    tl_image_destroy(to);
    tl_image_destroy(from);
}

static void what_is_not_finite_stays_in_its_pixel(void **state)
{
    tl_image *const from = image_of(9, 6);
    (void)state;
    *value_at(from, 1, 4, 4) = NAN;
    *value_at(from, 2, 8, 0) = INFINITY;
    tl_image *const to = resolved(from, 3);
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < 2; y++)
            for (uint32_t x = 0; x < 3; x++) {
                const float got = *value_at(to, c, x, y);
                if (c == 1 && x == 1 && y == 1)
                    assert_true(isnan(got));
                else if (c == 2 && x == 2 && y == 0)
                    assert_true(isinf(got));
                else
                    assert_true(got == 0.0f);
            }
    tl_image_destroy(to);
    tl_image_destroy(from);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(side_of_samples),
        cmocka_unit_test(one_colour_stays_as_it_is),
        cmocka_unit_test(means_are_exact),
        cmocka_unit_test(sums_run_from_the_top_left),
        cmocka_unit_test(what_is_not_finite_stays_in_its_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
