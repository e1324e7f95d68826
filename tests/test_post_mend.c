/* Are pixels that are NaN or infinite counted, do they become the mean of the colours around them and nothing
 * else changes, with the same bits by every path and width, in bands, and by the twin? Does a picture without
 * them, and one that nobody asks about, stay as it is?
 *
 * The oracle is the definition in double. */
#define _GNU_SOURCE
#include "post_frames.h"

enum { WIDTH = 83, HEIGHT = 41 };
static const double unit = 0x1p-24;

static const struct {
    uint32_t x, y;
    float color[3];
} spoiled[] = {
    {0, 0, {NAN, 0.0f, 0.0f}},
    {WIDTH - 1, HEIGHT - 1, {0.0f, INFINITY, 0.0f}},
    {WIDTH - 1, 0, {0.0f, 0.0f, -INFINITY}},
    {17, 15, {NAN, NAN, NAN}}, /* a hole of 3 x 3, over the edge of a vector and of a band */
    {16, 15, {NAN, 1.0f, 1.0f}},
    {15, 15, {INFINITY, 1.0f, 1.0f}},
    {17, 16, {1.0f, INFINITY, 1.0f}},
    {16, 16, {1.0f, 1.0f, NAN}},
    {15, 16, {NAN, 1.0f, 1.0f}},
    {17, 17, {NAN, 1.0f, 1.0f}},
    {16, 17, {NAN, 1.0f, 1.0f}},
    {15, 17, {NAN, 1.0f, 1.0f}},
    {40, 7, {-NAN, 1.0f, 1.0f}},
};

static tl_gbuffer *gbuffer_of(uint32_t width, uint32_t height)
{
    const tl_camera camera = camera_of(width, height, TL_PERSPECTIVE);
    return random_gbuffer(&camera, TL_GROUP_BASE, 3);
}

static tl_image *spoiled_picture(void)
{
    static const float most[3] = {3.4028234664e38f, 3.4028234664e38f, 3.4028234664e38f};
    tl_image *image = random_picture(WIDTH, HEIGHT, 9);
    for (size_t i = 0; i < COUNT_OF(spoiled); i++)
        fill_color(image, spoiled[i].x, spoiled[i].y, spoiled[i].color);
    for (uint32_t y = 0; y < 2; y++) /* its mean is the largest float */
        for (uint32_t x = WIDTH - 2; x < WIDTH; x++)
            if (x != WIDTH - 1 || y != 0)
                fill_color(image, x, y, most);
    return image;
}

static int is_finite_at(const tl_image *image, int64_t x, int64_t y)
{
    return isfinite(color_at(image, 0, x, y)) && isfinite(color_at(image, 1, x, y)) &&
           isfinite(color_at(image, 2, x, y));
}

static double expected(const tl_image *image, unsigned channel, int64_t x, int64_t y)
{
    double sum = 0.0;
    int count = 0;
    if (is_finite_at(image, x, y))
        return (double)color_at(image, channel, x, y);
    for (int64_t j = y - 1; j <= y + 1; j++)
        for (int64_t i = x - 1; i <= x + 1; i++)
            if (i >= 0 && i < image->width && j >= 0 && j < image->height &&
                is_finite_at(image, i, j)) {
                sum += (double)color_at(image, channel, i, j);
                count++;
            }
    return count ? sum / count : 0.0;
}

static void colors_become_what_is_defined(void **state)
{
    static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};
    const tl_post_options options = {.mend = 1};
    tl_gbuffer *gbuffer = gbuffer_of(WIDTH, HEIGHT);
    tl_image *from = spoiled_picture();
    tl_post_counts counts;
    (void)state;
    tl_image *got = post_image(NULL, &twin, &options, gbuffer, from, 0, &counts);
    assert_int_equal(counts.mended_count, COUNT_OF(spoiled));
    for (unsigned i = 0; i < 3; i++)
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++) {
                const double want = expected(from, i, x, y);
                const double off = fabs((double)color_at(got, i, x, y) - want);
                const double allowed = is_finite_at(from, x, y) ? 0.0 : 9.0 * unit * want;
                if (!(off <= allowed))
                    fail_msg("(%u, %u) channel %u: %.9g, not %.9g", x, y, i,
                             (double)color_at(got, i, x, y), want);
            }
    assert_true(color_at(got, 0, 16, 16) == 0.0f);
    assert_true(color_at(got, 1, WIDTH - 1, 0) == 3.4028234664e38f);
    tl_image_destroy(got);
    tl_image_destroy(from);
    tl_gbuffer_destroy(gbuffer);
}

static void every_way_has_the_same_bits(void **state)
{
    static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};
    static const uint64_t rows_of_band = 10 + 2 + 16;
    const tl_post_options options = {.mend = 1};
    tl_gbuffer *gbuffer = gbuffer_of(WIDTH, HEIGHT);
    tl_image *from = spoiled_picture();
    tl_image *want = post_image(NULL, &twin, &options, gbuffer, from, 0, NULL);
    for (size_t i = 0; i < COUNT_OF(post_ways); i++) {
        tl_post_counts counts;
        tl_image *got = post_image(*state, &post_ways[i], &options, gbuffer, from,
                                   rows_of_band * 24 * from->pitch, &counts);
        assert_same_pixels(got, want, post_ways[i].name);
        assert_int_equal(counts.mended_count, COUNT_OF(spoiled));
        assert_int_equal(counts.band_count, post_ways[i].memory ? 6 : 1);
        tl_image_destroy(got);
    }
    tl_image_destroy(want);
    tl_image_destroy(from);
    tl_gbuffer_destroy(gbuffer);
}

static void nothing_is_done_where_nothing_is_called_for(void **state)
{
    tl_gbuffer *gbuffer = gbuffer_of(WIDTH, HEIGHT);
    tl_image *clean = random_picture(WIDTH, HEIGHT, 9), *spoiled_one = spoiled_picture();
    const tl_post_options off = {.mend = 0}, on = {.mend = 1};
    tl_post_counts counts;
    tl_image *got = post_image(*state, &post_ways[0], &on, gbuffer, clean, 0, &counts);
    assert_same_pixels(got, clean, "a picture of colours");
    assert_int_equal(counts.mended_count, 0);
    tl_image_destroy(got);
    got = post_image(*state, &post_ways[0], &off, gbuffer, spoiled_one, 0, &counts);
    assert_same_pixels(got, spoiled_one, "a picture that nobody asks about");
    assert_int_equal(counts.stages, 0);
    assert_int_equal(counts.device_bytes, 0);
    tl_image_destroy(got);
    tl_image_destroy(clean);
    tl_image_destroy(spoiled_one);
    tl_gbuffer_destroy(gbuffer);
}

/* NaN in a sample would be one in its pixel. */
static void samples_are_mended_before_they_are_resolved(void **state)
{
    const tl_post_options options = {.mend = 1};
    const float no_color[3] = {NAN, NAN, NAN}, grey[3] = {0.5f, 0.5f, 0.5f};
    tl_gbuffer *gbuffer = gbuffer_of(32, 16);
    tl_image *from = NULL;
    tl_error err;
    tl_post_counts counts;
    ASSERT_OK(tl_image_create(32, 16, &from, &err), err);
    for (uint32_t i = 0; i < 32 * 16; i++)
        fill_color(from, i % 32, i / 32, i == 70 ? no_color : grey);
    gbuffer->samples = 4;
    tl_image *got = post_image(*state, &post_ways[0], &options, gbuffer, from, 0, &counts);
    assert_int_equal(got->width, 16);
    assert_int_equal(got->height, 8);
    for (uint32_t i = 0; i < 16 * 8; i++)
        assert_true(color_at(got, 1, i % 16, i / 16) == 0.5f);
    assert_int_equal(counts.stages, 1u << TL_POST_MEND | 1u << TL_POST_RESOLVE);
    tl_image_destroy(got);
    tl_image_destroy(from);
    tl_gbuffer_destroy(gbuffer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colors_become_what_is_defined),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(nothing_is_done_where_nothing_is_called_for),
        cmocka_unit_test(samples_are_mended_before_they_are_resolved),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
