/* Is a picture of another size what the filter's formula makes of it, without a shift or a change of what is
 * constant, and are its bits, and the codes of a screen, those of the host on every way through the
 * device? */
#include "post_frames.h"

#include <float.h>

static const long double pi_l = 3.14159265358979323846264338327950288L;
static const double unit = 0x1p-24;

#define ROW(name, word, radius, rings, source) {name, word, radius, rings},
static const struct {
    tl_filter filter;
    const char *word;
    double radius;
    int rings;
} filters[] = {TL_FILTERS(ROW)};

/* From and to, px. */
static const uint32_t sizes[][4] = {
    {64, 36, 32, 18}, {37, 23, 20, 31}, {12, 9, 61, 40}, {1, 1, 5, 3},
    {50, 40, 1, 1},   {33, 17, 33, 9},  {100, 80, 7, 3}, {2, 3, 3, 2},
};

/* The published filters, apart from host/post/filters.c. */
static long double cubic(long double x, long double b, long double c)
{
    const long double x2 = x * x, x3 = x2 * x;
    if (x < 1)
        return (1 - b / 3) + (-3 + 2 * b + c) * x2 + (2 - 1.5L * b - c) * x3;
    return x < 2 ? (4 * b / 3 + 4 * c) + (-2 * b - 8 * c) * x + (b + 5 * c) * x2 +
                       (-b / 6 - c) * x3
                 : 0;
}

static long double sinc(long double x)
{
    return x > 0 ? sinl(pi_l * x) / (pi_l * x) : 1;
}

static long double filter_at(tl_filter filter, long double x)
{
    switch (filter) {
    case TL_FILTER_TENT: return x < 1 ? 1 - x : 0;
    case TL_FILTER_CATMULL_ROM: return cubic(x, 0, 0.5L);
    case TL_FILTER_MITCHELL: return cubic(x, 1 / 3.0L, 1 / 3.0L);
    case TL_FILTER_LANCZOS3: return x < 3 ? sinc(x) * sinc(x / 3) : 0;
    default: fail_msg("filter %d has no formula here", (int)filter); return 0;
    }
}

/* Of old pixel j for new pixel i, not divided by their sum. */
static long double weight(tl_filter filter, uint32_t from, uint32_t to, uint32_t i, uint32_t j)
{
    const long double step = (long double)from / to, middle = (i + 0.5L) * step;
    if (filter == TL_FILTER_BOX) {
        const long double begin = fmaxl(i * step, j), end = fminl((i + 1) * step, j + 1.0L);
        return end > begin ? end - begin : 0;
    }
    return filter_at(filter, fabsl(j + 0.5L - middle) / (step > 1 ? step : 1));
}

/* Weights of all old pixels for new pixel i: [from], that add up to 1; returns how many are not 0. */
static uint32_t weigh(
    tl_filter filter, uint32_t from, uint32_t to, uint32_t i, long double *weights)
{
    long double sum = 0;
    uint32_t count = 0;
    for (uint32_t j = 0; j < from; j++)
        sum += weights[j] = weight(filter, from, to, i, j);
    for (uint32_t j = 0; j < from; j++)
        count += (weights[j] /= sum) != 0;
    return count;
}

static tl_image *scaled(tl_device *device,
                        const post_way *way,
                        const tl_image *from,
                        tl_filter filter,
                        uint32_t width,
                        uint32_t height,
                        uint64_t memory,
                        tl_post_counts *counts)
{
    const tl_post_options options = {.width = width, .height = height, .filter = filter};
    const tl_camera camera = camera_of(from->width, from->height, TL_PERSPECTIVE);
    tl_gbuffer *gbuffer = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &gbuffer, &err), err);
    tl_image *got = post_image(device, way, &options, gbuffer, from, memory, counts);
    assert_int_equal(got->width, width);
    assert_int_equal(got->height, height);
    tl_gbuffer_destroy(gbuffer);
    return got;
}

static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};

/* In each direction n taps and the weights' own rounding leave (n + 4) u of sum |w| |x - c|; sums of |w| are
 * below 1.75, |x - c| below twice the largest, and the second direction has the first's errors 1.75 times:
 * 6.2 times the largest for each. */
static void pixels_are_the_filter_s_sums(void **state)
{
    static long double across[128], down[128];
    (void)state;
    for (size_t f = 0; f < COUNT_OF(filters); f++)
        for (size_t s = 0; s < COUNT_OF(sizes); s++) {
            const uint32_t *size = sizes[s];
            tl_image *from = random_picture(size[0], size[1], (uint32_t)(7 + s));
            tl_image *got =
                scaled(NULL, &twin, from, filters[f].filter, size[2], size[3], 0, NULL);
            for (uint32_t i = 0; i < 3 * size[2] * size[3]; i++) {
                const uint32_t c = i % 3, x = i / 3 % size[2], y = i / 3 / size[2];
                const uint32_t taps = weigh(filters[f].filter, size[0], size[2], x, across) +
                                      weigh(filters[f].filter, size[1], size[3], y, down);
                long double sum = 0, most = 0;
                for (uint32_t v = 0; v < size[1]; v++)
                    for (uint32_t u = 0; u < size[0]; u++) {
                        const long double value = (long double)color_at(from, c, u, v);
                        sum += down[v] * across[u] * value;
                        if (down[v] * across[u] != 0)
                            most = fmaxl(most, value);
                    }
                const double off = fabs((double)(color_at(got, c, x, y) - sum));
                if (!(off <= 6.2 * (taps + 8) * unit * (double)most))
                    fail_msg("%s, size %zu: (%u, %u) channel %u is %.9g, not %.9g",
                             filters[f].word, s, x, y, c, (double)color_at(got, c, x, y),
                             (double)sum);
            }
            tl_image_destroy(got);
            tl_image_destroy(from);
        }
}

/* Bit for bit, whatever the value: also at the edges, and where weights are far from binary fractions. */
static void what_is_constant_stays(void **state)
{
    static const float values[] = {1.0f, 0.1f, 3e-39f, 65504.0f, 8e37f, 0.0f, -0.7f};
    (void)state;
    for (size_t f = 0; f < COUNT_OF(filters); f++)
        for (size_t s = 0; s < COUNT_OF(sizes); s++)
            for (size_t v = 0; v < COUNT_OF(values); v++) {
                const uint32_t *size = sizes[s];
                const float color[3] = {values[v], values[v] * 0.3f, 1.0f};
                tl_image *from = random_picture(size[0], size[1], 1);
                for (uint32_t i = 0; i < size[0] * size[1]; i++)
                    fill_color(from, i % size[0], i / size[0], color);
                tl_image *got =
                    scaled(NULL, &twin, from, filters[f].filter, size[2], size[3], 0, NULL);
                for (uint32_t i = 0; i < 3 * size[2] * size[3]; i++)
                    if (!(color_at(got, i % 3, i / 3 % size[2], i / 3 / size[2]) ==
                          color[i % 3]))
                        fail_msg(
                            "%s, size %zu: %g becomes %g", filters[f].word, s,
                            (double)color[i % 3],
                            (double)color_at(got, i % 3, i / 3 % size[2], i / 3 / size[2]));
                tl_image_destroy(got);
                tl_image_destroy(from);
            }
}

/* A ramp stays on its line away from the edges, where filters are whole: no filter shifts by a part of a
 * pixel. Lanczos's does not keep ramps between pixels: 1 % of a pixel. Box takes the nearest pixel, or
 * two. */
static void nothing_is_shifted(void **state)
{
    static const uint32_t widths[] = {24, 48, 96, 61, 150};
    (void)state;
    for (size_t f = 0; f < COUNT_OF(filters); f++)
        for (size_t w = 0; w < COUNT_OF(widths); w++) {
            const uint32_t from_width = 48, to = widths[w];
            const double step = (double)from_width / to;
            const double reach = filters[f].radius * fmax(1.0, step) + 1.0;
            const double allowed = filters[f].filter == TL_FILTER_BOX        ? 0.5
                                   : filters[f].filter == TL_FILTER_LANCZOS3 ? 0.02
                                   : to > from_width                         ? 1e-4
                                                                             : 0.01;
            tl_image *from = random_picture(from_width, 4, 1);
            for (uint32_t i = 0; i < from_width * 4; i++) {
                const float at = (float)(i % from_width) + 0.5f, color[3] = {at, at, at};
                fill_color(from, i % from_width, i / from_width, color);
            }
            tl_image *got = scaled(NULL, &twin, from, filters[f].filter, to, 4, 0, NULL);
            double mean = 0.0;
            for (uint32_t x = 0; x < to; x++) {
                const double place = (x + 0.5) * step;
                mean += (double)color_at(got, 0, x, 1) / to;
                if (place < reach || place > from_width - reach)
                    continue;
                const double off = fabs((double)color_at(got, 0, x, 1) - place);
                if (!(off <= allowed))
                    fail_msg("%s to %u: pixel %u shows place %.4f, not %.4f", filters[f].word,
                             to, x, (double)color_at(got, 0, x, 1), place);
            }
            if (!(fabs(mean - from_width / 2.0) <= 1e-4))
                fail_msg("%s to %u: the middle moves to %.5f", filters[f].word, to, mean);
            tl_image_destroy(got);
            tl_image_destroy(from);
        }
}

/* No light is lost: the mean over the picture stays, of the filter that is a mean of areas; up to 4 roundings
 * of a sum of 20 taps. */
static void areas_keep_the_mean(void **state)
{
    (void)state;
    for (size_t s = 0; s < COUNT_OF(sizes); s++) {
        const uint32_t *size = sizes[s];
        tl_image *from = random_picture(size[0], size[1], 3);
        tl_image *got = scaled(NULL, &twin, from, TL_FILTER_BOX, size[2], size[3], 0, NULL);
        double before = 0.0, after = 0.0;
        for (uint32_t i = 0; i < size[0] * size[1]; i++)
            before += (double)color_at(from, 1, i % size[0], i / size[0]);
        for (uint32_t i = 0; i < size[2] * size[3]; i++)
            after += (double)color_at(got, 1, i % size[2], i / size[2]);
        before /= size[0] * size[1];
        after /= size[2] * size[3];
        if (!(fabs(after - before) <= 80.0 * unit * 40.0))
            fail_msg("size %zu: the mean is %.9g, not %.9g", s, after, before);
        tl_image_destroy(got);
        tl_image_destroy(from);
    }
}

/* Filters that ring go below 0 beside a lamp, others do not; and numbers at the end of floats stay
 * numbers. */
static void what_is_bright_does_no_harm(void **state)
{
    static const float lamps[] = {1e4f, 1e38f, FLT_MAX};
    (void)state;
    for (size_t f = 0; f < COUNT_OF(filters); f++)
        for (size_t l = 0; l < COUNT_OF(lamps); l++) {
            const float lamp[3] = {lamps[l], lamps[l], lamps[l]}, dark[3] = {0, 0, 0};
            tl_image *from = random_picture(40, 40, 1);
            float least = 0.0f;
            for (uint32_t i = 0; i < 40 * 40; i++)
                fill_color(from, i % 40, i / 40, (i % 40 / 6 + i / 40 / 6) % 2 ? lamp : dark);
            tl_image *got = scaled(NULL, &twin, from, filters[f].filter, 27, 61, 0, NULL);
            for (uint32_t i = 0; i < 27 * 61; i++) {
                const float value = color_at(got, 2, i % 27, i / 27);
                if (!isfinite(value))
                    fail_msg("%s of %g: %g", filters[f].word, (double)lamps[l], (double)value);
                least = fminf(least, value);
            }
            assert_int_equal(least < 0.0f, filters[f].rings);
            tl_image_destroy(got);
            tl_image_destroy(from);
        }
}

static void every_way_has_the_same_bits(void **state)
{
    static const uint32_t to[][2] = {{53, 31}, {170, 130}};
    tl_image *from = random_picture(97, 61, 5);
    for (size_t f = 0; f < COUNT_OF(filters); f += 2)
        for (size_t t = 0; t < COUNT_OF(to); t++) {
            tl_image *want =
                scaled(NULL, &twin, from, filters[f].filter, to[t][0], to[t][1], 0, NULL);
            for (size_t i = 0; i < COUNT_OF(post_ways); i++) {
                tl_post_counts counts;
                tl_image *got = scaled(*state, &post_ways[i], from, filters[f].filter, to[t][0],
                                       to[t][1], 100000, &counts);
                assert_same_pixels(got, want, post_ways[i].name);
                assert_int_equal(counts.stages, 1u << TL_POST_SCALE);
                assert_int_equal(counts.band_count > 1, post_ways[i].memory > 0);
                tl_image_destroy(got);
            }
            tl_image_destroy(want);
        }
    tl_image_destroy(from);
}

/* Of the size that it has: not computed at all. */
static void the_same_size_is_left_alone(void **state)
{
    tl_image *from = random_picture(33, 21, 5);
    tl_post_counts counts;
    tl_image *got = scaled(*state, &post_ways[0], from, TL_FILTER_LANCZOS3, 33, 21, 0, &counts);
    assert_same_pixels(got, from, "as it was");
    assert_int_equal(counts.stages, 0);
    assert_int_equal(counts.device_bytes, 0);
    tl_image_destroy(got);
    tl_image_destroy(from);
}

static void bands_that_do_not_fit_are_refused(void **state)
{
    tl_image *image = random_picture(97, 61, 5);
    const tl_camera camera = camera_of(97, 61, TL_PERSPECTIVE);
    const tl_post_options options = {.width = 10, .height = 10};
    tl_lighting_options lighting = tl_lighting_options_default();
    tl_gbuffer *gbuffer = NULL;
    tl_post *post = NULL;
    tl_error err;
    lighting.memory_limit = 100;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &gbuffer, &err), err);
    ASSERT_OK(tl_post_create(*state, &lighting, &options, &post, &err), err);
    assert_int_equal(tl_post_run(post, gbuffer, &image, NULL, NULL, NULL, &err),
                     TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "\"scale\" reads at once"));
    tl_post_destroy(post);
    tl_gbuffer_destroy(gbuffer);
    tl_image_destroy(image);
}

/* Of every look: thresholds where tones are of single channels, powers where they are not, grain. */
static void codes_are_those_of_the_host(void **state)
{
    enum { WIDTH = 75, HEIGHT = 67 };
    static const float special[3] = {NAN, INFINITY, -1.0f};
    static uint8_t want[3 * WIDTH * HEIGHT], got[3 * WIDTH * HEIGHT];
    tl_device *device = *state;
    const int shared = device->shares_memory;
    tl_image *image = random_picture(WIDTH, HEIGHT, 11);
    fill_color(image, 3, 3, special);
    for (uint32_t i = 0; i < 40 * WIDTH; i++) { /* a slope from dark to bright */
        const float value = exp2f(-16.0f + 24.0f * (float)i / (40 * WIDTH));
        const float color[3] = {value, value * 0.7f, value * 1.3f};
        fill_color(image, i % WIDTH, 20 + i / WIDTH, color);
    }
    for (size_t i = 0; i < COUNT_OF(post_ways); i++)
        for (int l = 0; l < TL_TONE_COUNT * TL_CURVE_COUNT * TL_DITHER_COUNT; l++) {
            const tl_look look = {.tone = (tl_tone)(l % TL_TONE_COUNT),
                                  .curve = (tl_curve)(l / TL_TONE_COUNT % TL_CURVE_COUNT),
                                  .dither = (tl_dither)(l / TL_TONE_COUNT / TL_CURVE_COUNT),
                                  .white = 2.5f};
            const tl_post_options nothing = {.mend = 0};
            tl_lighting_options lighting = tl_lighting_options_default();
            tl_post *post = NULL;
            tl_error err;
            lighting.path = post_ways[i].path;
            lighting.vector_width = post_ways[i].width;
            lighting.memory_limit = post_ways[i].memory ? 20000 : 0;
            device->shares_memory = shared && !post_ways[i].by_copy;
            ASSERT_OK(tl_post_create(device, &lighting, &nothing, &post, &err), err);
            ASSERT_OK(tl_post_codes(post, image, 0.75f, look, got, NULL, NULL, &err), err);
            tl_post_destroy(post);
            tl_image_to_rgb8(image, 0.75f, look, want);
            for (uint32_t k = 0; k < 3 * WIDTH * HEIGHT; k++)
                if (got[k] != want[k])
                    fail_msg("%s, look %d: pixel %u, channel %u of %a is %d, not %d",
                             post_ways[i].name, l, k / 3, k % 3,
                             (double)color_at(image, k % 3, k / 3 % WIDTH, k / 3 / WIDTH),
                             got[k], want[k]);
        }
    device->shares_memory = shared;
    tl_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_the_filter_s_sums),
        cmocka_unit_test(what_is_constant_stays),
        cmocka_unit_test(nothing_is_shifted),
        cmocka_unit_test(areas_keep_the_mean),
        cmocka_unit_test(what_is_bright_does_no_harm),
        cmocka_unit_test(every_way_has_the_same_bits),
        cmocka_unit_test(the_same_size_is_left_alone),
        cmocka_unit_test(bands_that_do_not_fit_are_refused),
        cmocka_unit_test(codes_are_those_of_the_host),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
