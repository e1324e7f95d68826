/* Is bloom what is over the threshold, in its own colour, blurred by the width that was asked for and added
 * once, no light lost but over the picture's edges, with the same bits by every path and width, in bands,
 * and by the twin, and float within what is derived? Is nothing blurred where nothing is bright?
 *
 * The oracle makes and blurs the small picture in double, with a margin that nothing leaves. */
#define _GNU_SOURCE
#include "post_frames.h"

#include "bloom_plan.h"

enum {
    WIDTH = 83,
    HEIGHT = 101,
    MARGIN = 220,
    SMALL_X = WIDTH + 2 * MARGIN,
    SMALL_Y = HEIGHT + 2 * MARGIN
};
static const double unit = 0x1p-24;
static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};
static const post_way reference = {"reference", TL_PRECISION_REFERENCE, TL_PATH_AUTO, 0, 0, 0};

static const tl_bloom_options blooms[] = {
    {0.5f, 1.0f, 0.5f, 6.0f, 4}, {2.0f, 0.8f, 0.0f, 3.0f, 4}, {0.25f, 0.0f, 0.0f, 20.0f, 4},
    {0.5f, 1.0f, 1.0f, 1.5f, 2}, {1.0f, 0.9f, 0.3f, 4.0f, 2}, {0.1f, 20.0f, 0.1f, 10.0f, 2},
};

/* Any G-buffer of the size: bloom does not look at it. */
static tl_gbuffer *any_gbuffer(void)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    return random_gbuffer(&camera, TL_GROUP_BASE, 3);
}

static tl_image *bloomed(tl_device *device,
                         const post_way *way,
                         const tl_bloom_options *bloom,
                         const tl_image *from,
                         tl_post_counts *counts)
{
    const tl_post_options options = {.bloom = *bloom};
    tl_gbuffer *gbuffer = any_gbuffer();
    const uint32_t reach = 3 * tl_bloom_plan_for((double)bloom->width, bloom->side).passes + 1;
    const uint32_t rows = 2 * (reach * bloom->side + 8) + 16;
    const uint32_t pitch =
        (WIDTH / bloom->side + 1 + 2 * (16 + (reach + 16) / 16 * 16) + 63) / 64 * 64;
    const uint64_t row = 24 * from->pitch + (24 * pitch + bloom->side - 1) / bloom->side;
    tl_image *got = post_image(device, way, &options, gbuffer, from, rows * row, counts);
    tl_gbuffer_destroy(gbuffer);
    return got;
}

static double over(double x, const tl_bloom_options *b)
{
    const double knee = (double)(b->knee * b->threshold),
                 low = (double)(b->threshold - b->knee * b->threshold);
    if (x >= (double)(b->threshold + b->knee * b->threshold))
        return x - (double)b->threshold;
    return x > low ? (x - low) * (x - low) / (4.0 * knee) : 0.0;
}

static double bright_at(
    const tl_image *from, unsigned channel, uint32_t x, uint32_t y, const tl_bloom_options *b)
{
    const double most =
        fmax(fmax((double)color_at(from, 0, x, y), (double)color_at(from, 1, x, y)),
             (double)color_at(from, 2, x, y));
    return most > 0.0 ? (double)color_at(from, channel, x, y) * over(most, b) / most : 0.0;
}

static double *plane(void)
{
    double *made = calloc((size_t)SMALL_X * SMALL_Y, sizeof *made);
    assert_non_null(made);
    return made;
}

static void blur_along(const double *from, double *to, const float taps[4], size_t apart)
{
    for (size_t at = 3 * apart; at < (size_t)SMALL_X * SMALL_Y - 3 * apart; at++) {
        to[at] = (double)taps[0] * from[at];
        for (size_t k = 1; k <= 3; k++)
            to[at] += (double)taps[k] * (from[at - k * apart] + from[at + k * apart]);
    }
}

/* One channel of what is added over the strength: [HEIGHT][WIDTH]; the caller frees it. */
static double *oracle(const tl_image *from, unsigned channel, const tl_bloom_options *b)
{
    const tl_bloom_plan plan = tl_bloom_plan_for((double)b->width, b->side);
    double *small = plane(), *other = plane(), *glow = calloc(WIDTH * HEIGHT, sizeof *glow);
    assert_non_null(glow);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            small[(MARGIN + y / b->side) * SMALL_X + MARGIN + x / b->side] +=
                bright_at(from, channel, x, y, b) / (b->side * b->side);
    for (uint32_t pass = 0; pass < plan.passes; pass++) {
        blur_along(small, other, plan.taps, 1);
        blur_along(other, small, plan.taps, SMALL_X);
    }
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const double u = (x + 0.5) / b->side - 0.5 + MARGIN,
                         v = (y + 0.5) / b->side - 0.5 + MARGIN;
            const double *at = small + (size_t)v * SMALL_X + (size_t)u;
            const double fx = u - floor(u), fy = v - floor(v);
            glow[y * WIDTH + x] = (1.0 - fy) * ((1.0 - fx) * at[0] + fx * at[1]) +
                                  fy * ((1.0 - fx) * at[SMALL_X] + fx * at[SMALL_X + 1]);
        }
    free(small);
    free(other);
    return glow;
}

static void glows_are_what_is_defined(void **state)
{
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    double worst = 0.0;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(blooms); i++) {
        const tl_bloom_options *b = &blooms[i];
        const double units = 6.0 + b->side * b->side + 5.0 +
                             10.0 * tl_bloom_plan_for((double)b->width, b->side).passes;
        tl_image *in_float = bloomed(NULL, &twin, b, from, NULL),
                 *in_double = bloomed(NULL, &reference, b, from, NULL);
        for (unsigned c = 0; c < 3; c++) {
            double *glow = oracle(from, c, b);
            for (uint32_t y = 0; y < HEIGHT; y++)
                for (uint32_t x = 0; x < WIDTH; x++) {
                    const double own = (double)color_at(from, c, x, y),
                                 added = (double)b->strength * glow[y * WIDTH + x];
                    const double off = fabs((double)color_at(in_float, c, x, y) - own - added),
                                 other =
                                     fabs((double)color_at(in_double, c, x, y) - own - added);
                    const double allowed = units * unit * added + unit * (own + added);
                    worst = fmax(worst, off / allowed);
                    if (!(off <= allowed && other <= allowed))
                        fail_msg("bloom %zu, (%u, %u) channel %u: off by %g and %g, allowed %g",
                                 i, x, y, c, off, other, allowed);
                }
            free(glow);
        }
        tl_image_destroy(in_float);
        tl_image_destroy(in_double);
    }
    print_message("%.3f of what is derived\n", worst);
    assert_true(worst > 0.02);
    tl_image_destroy(from);
}

/* A picture that is black but for one pixel. */
static tl_image *one_light(uint32_t x, uint32_t y, const float color[3])
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(WIDTH, HEIGHT, &image, &err), err);
    fill_color(image, x, y, color);
    return image;
}

/* What is added adds up to what is over the threshold, in its colour, and lies as wide as was asked for: the
 * mean over where in its small pixel the light stands. */
static void energy_color_and_width_are_kept(void **state)
{
    static const float color[3] = {9.0f, 3.0f, 0.0f};
    static const struct {
        float width;
        uint32_t side;
    } sizes[] = {{3.0f, 4}, {6.0f, 4}, {1.5f, 2}, {4.0f, 2}, {6.0f, 2}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        const tl_bloom_options b = {0.5f, 1.0f, 0.5f, sizes[i].width, sizes[i].side};
        double moment = 0.0;
        for (uint32_t phase = 0; phase < b.side; phase++) {
            const uint32_t at_x = 40 + phase, at_y = 28;
            tl_image *from = one_light(at_x, at_y, color),
                     *got = bloomed(NULL, &reference, &b, from, NULL);
            double sums[3] = {0.0}, spread = 0.0;
            for (uint32_t y = 0; y < HEIGHT; y++)
                for (uint32_t x = 0; x < WIDTH; x++)
                    for (unsigned c = 0; c < 3; c++) {
                        const double added =
                            (double)color_at(got, c, x, y) - (double)color_at(from, c, x, y);
                        const double away = (double)x - (double)at_x;
                        sums[c] += added;
                        spread += c == 0 ? added * away * away : 0.0;
                    }
            assert_true(fabs(sums[0] - 4.0) < 1e-5);
            assert_true(fabs(sums[1] - 4.0 / 3.0) < 1e-5);
            assert_true(sums[2] == 0.0);
            moment += spread / sums[0] / b.side;
            tl_image_destroy(from);
            tl_image_destroy(got);
        }
        if (!(fabs(sqrt(moment) - (double)b.width) < 1e-4))
            fail_msg("%g px wide at 1/%u: %.6g", (double)b.width, b.side, sqrt(moment));
    }
}

/* Wherever it is, by whole small pixels, a glow has the same bits, cut at the picture's edge. */
static void glows_are_alike_everywhere(void **state)
{
    static const float color[3] = {9.0f, 3.0f, 0.25f};
    const tl_bloom_options b = {0.5f, 1.0f, 0.5f, 6.0f, 4};
    static const uint32_t places[][2] = {{0, 0}, {4, 0}, {80, 60}, {80, 28}};
    tl_image *middle = one_light(40, 28, color), *want = bloomed(NULL, &twin, &b, middle, NULL);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        tl_image *from = one_light(places[i][0], places[i][1], color),
                 *got = bloomed(NULL, &twin, &b, from, NULL);
        const int64_t right = (int64_t)places[i][0] - 40, down = (int64_t)places[i][1] - 28;
        uint32_t compared = 0;
        for (int64_t y = 0; y < HEIGHT; y++)
            for (int64_t x = 0; x < WIDTH; x++) {
                if (x + right < 0 || x + right >= WIDTH || y + down < 0 || y + down >= HEIGHT)
                    continue;
                assert_true(
                    same_bits(color_at(got, 0, x + right, y + down), color_at(want, 0, x, y)));
                compared += color_at(want, 0, x, y) > 0.0f;
            }
        assert_true(compared > 300);
        tl_image_destroy(from);
        tl_image_destroy(got);
    }
    tl_image_destroy(middle);
    tl_image_destroy(want);
}

static void every_way_has_the_same_bits(void **state)
{
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    for (size_t b = 0; b < 5; b += 4) {
        tl_image *want = bloomed(NULL, &twin, &blooms[b], from, NULL);
        for (size_t i = 0; i < COUNT_OF(post_ways); i++) {
            tl_post_counts counts;
            tl_image *got = bloomed(*state, &post_ways[i], &blooms[b], from, &counts);
            assert_same_pixels(got, want, post_ways[i].name);
            assert_true(counts.is_bright);
            assert_int_equal(counts.band_count, post_ways[i].memory ? 7 : 1);
            tl_image_destroy(got);
        }
        tl_image_destroy(want);
    }
    tl_image_destroy(from);
}

static void nothing_bright_is_not_blurred(void **state)
{
    const tl_bloom_options b = {0.5f, 50.0f, 0.1f, 6.0f, 4};
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    tl_post_counts counts;
    for (size_t i = 0; i < COUNT_OF(post_ways); i++) {
        tl_image *got = bloomed(*state, &post_ways[i], &b, from, &counts);
        assert_same_pixels(got, from, post_ways[i].name);
        assert_false(counts.is_bright);
        tl_image_destroy(got);
    }
    tl_image *got = bloomed(NULL, &twin, &b, from, &counts);
    assert_same_pixels(got, from, "twin");
    assert_false(counts.is_bright);
    tl_image_destroy(got);
    tl_image_destroy(from);
}

static void the_largest_floats_stay_finite(void **state)
{
    static const float most[3] = {3.4028234664e38f, 3.4028234664e38f, 1.0f};
    const tl_bloom_options b = {1000.0f, 1.0f, 0.5f, 6.0f, 4};
    tl_image *from = random_picture(WIDTH, HEIGHT, 5);
    for (uint32_t i = 0; i < 40 * 40; i++)
        fill_color(from, 20 + i % 40, 10 + i / 40, most);
    tl_image *got = bloomed(*state, &post_ways[0], &b, from, NULL);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            for (unsigned c = 0; c < 3; c++)
                assert_true(isfinite(color_at(got, c, x, y)));
    tl_image_destroy(got);
    tl_image_destroy(from);
}

static void what_cannot_be_is_refused(void **state)
{
    static const struct {
        tl_bloom_options bloom;
        const char *says;
    } wrong[] = {
        {{-1.0f, 1.0f, 0.5f, 6.0f, 4}, "0 to 1000"},
        {{1.0f, NAN, 0.5f, 6.0f, 4}, "radiance of nan"},
        {{1.0f, 1.0f, 1.5f, 6.0f, 4}, "must be 0 to 1"},
        {{1.0f, 1.0f, 0.5f, 2.0f, 4}, "it must be 3 to 39"},
        {{1.0f, 1.0f, 0.5f, 20.0f, 2}, "it must be 1.5 to 19"},
        {{1.0f, 1.0f, 0.5f, 6.0f, 3}, "1/2 or 1/4"},
    };
    tl_lighting_options lighting = tl_lighting_options_default();
    (void)state;
    lighting.precision = TL_PRECISION_TWIN;
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        const tl_post_options options = {.bloom = wrong[i].bloom};
        tl_post *post = NULL;
        tl_error err;
        assert_int_equal(tl_post_create(NULL, &lighting, &options, &post, &err),
                         TL_ERR_ARGUMENT);
        if (!strstr(err.message, wrong[i].says))
            fail_msg("%s: lacks \"%s\"", err.message, wrong[i].says);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glows_are_what_is_defined),
        cmocka_unit_test(energy_color_and_width_are_kept),
        cmocka_unit_test(glows_are_alike_everywhere),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(nothing_bright_is_not_blurred),
        cmocka_unit_test(the_largest_floats_stay_finite),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
