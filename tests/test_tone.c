/* Do pictures come out as exposure, tone curve and the curve of the codes say, rounded as that says? */
#define _POSIX_C_SOURCE 200809L
#include "testing.h"

#include "tilelight/image.h"

#include <float.h>

static const struct {
    const char *name;
    tl_look look;
    float exposure;
} settings[] = {
    {"aces", {.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 0.0f},
    {"aces, 3.7 stops", {.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 3.7f},
    {"aces, -40 stops", {.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, -40},
    {"reinhard", {.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB}, 0.0f},
    {"reinhard, -5.3", {.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB}, -5.3f},
    {"none", {.tone = TL_TONE_NONE, .curve = TL_CURVE_SRGB}, 0.0f},
    {"none, 60 stops", {.tone = TL_TONE_NONE, .curve = TL_CURVE_SRGB}, 60.0f},
    {"none, gamma 2.2", {.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}, 0.0f},
    {"none, gamma 2.2, 1.3 stops", {.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}, 1.3f},
    {"aces, gamma 2.2", {.tone = TL_TONE_ACES, .curve = TL_CURVE_GAMMA_22}, -0.7f},
};

/* From the published formulas, worked out apart; beside each the value before rounding. */
static const struct {
    tl_look look;
    float radiance, exposure;
    uint8_t expected;
} published[] = {
    {{.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 0.001f, 0.0f, 1},      /* 0.7618 */
    {{.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 0.18f, 0.0f, 141},     /* 141.1317 */
    {{.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 1.0f, 0.0f, 232},      /* 231.5988 */
    {{.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 3.0f, -2.0f, 223},     /* 222.7190 */
    {{.tone = TL_TONE_ACES, .curve = TL_CURVE_SRGB}, 16.0f, 0.0f, 255},     /* cut at 1 */
    {{.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB}, 0.001f, 0.0f, 3},  /* 3.2913 */
    {{.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB}, 0.18f, 0.0f, 109}, /* 108.8713 */
    {{.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB},
     1.0f,
     0.0f,
     188}, /* 187.5160, of 1/2 */
    {{.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB},
     0.5f,
     1.0f,
     188}, /* the same by exposure */
    {{.tone = TL_TONE_REINHARD, .curve = TL_CURVE_SRGB}, 16.0f, 0.0f, 248}, /* 248.2895 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_SRGB},
     0.001f,
     0.0f,
     3}, /* 3.2946, on the straight part of sRGB */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_SRGB}, 0.18f, 0.0f, 118}, /* 117.6458 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_SRGB}, 3.0f, -2.0f, 225}, /* 224.6104 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_SRGB}, 16.0f, 0.0f, 255}, /* cut at 1 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22},
     0.001f,
     0.0f,
     11}, /* 11.0364, cut down */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}, 0.18f, 0.0f, 116},  /* 116.9657 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}, 3.0f, -2.0f, 223},  /* 223.7428 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}, 0.999f, 0.0f, 254}, /* 254.8841 */
    {{.tone = TL_TONE_NONE, .curve = TL_CURVE_GAMMA_22}, 1.0f, 0.0f, 255},
};

/* Independent of tone.c: the curves forwards, in long double, sRGB by its encoding formula. */
static long double curve(tl_tone tone, long double x)
{
    const long double aces = x * (2.51L * x + 0.03L) / (x * (2.43L * x + 0.59L) + 0.14L);
    const long double y = tone == TL_TONE_ACES       ? aces
                          : tone == TL_TONE_REINHARD ? x / (1 + x)
                                                     : x;
    return y < 1 ? y : 1;
}

static int expected_code(tl_look look, float exposure, float radiance)
{
    const long double y =
        curve(look.tone, (long double)radiance * exp2l((long double)exposure));
    if (look.curve == TL_CURVE_GAMMA_22)
        return (int)floorl(255 * powl(y, 1 / 2.2L));
    const long double encoded =
        y <= 0.0031308L ? 12.92L * y : 1.055L * powl(y, 1 / 2.4L) - 0.055L;
    return (int)floorl(255 * encoded + 0.5L);
}

/* The radiance whose curve value is y, in closed form; a positive root of a quadratic for ACES. */
static long double inverse_curve(tl_tone tone, long double y)
{
    const long double a = 2.51L - 2.43L * y, b = 0.03L - 0.59L * y, c = -0.14L * y;
    if (tone == TL_TONE_ACES)
        return (-b + sqrtl(b * b - 4 * a * c)) / (2 * a);
    return tone == TL_TONE_REINHARD ? y / (1 - y) : y;
}

/* Codes of `count` greys, as one picture of one row. */
static void encode_all(
    const float *greys, uint32_t count, tl_look look, float exposure, uint8_t *codes)
{
    static uint8_t rgb[3 * 16384];
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(count, 1, &image, &err), err);
    for (unsigned channel = 0; channel < 3; channel++)
        memcpy(tl_image_plane(image, channel), greys, count * sizeof *greys);
    tl_image_to_rgb8(image, exposure, look, rgb);
    tl_image_destroy(image);
    for (size_t i = 0; i < count; i++) {
        codes[i] = rgb[3 * i];
        assert_int_equal(rgb[3 * i + 1], codes[i]);
        assert_int_equal(rgb[3 * i + 2], codes[i]);
    }
}

/* The display-linear value from which on the code is k + 1. */
static long double step_above(tl_curve of, int k)
{
    const long double nearest = (k + 0.5L) / 255;
    if (of == TL_CURVE_GAMMA_22)
        return powl((k + 1) / 255.0L, 2.2L);
    return nearest <= 0.04045L ? nearest / 12.92L : powl((nearest + 0.055L) / 1.055L, 2.4L);
}

static void every_threshold_is_exact(void **state)
{
    enum { AROUND = 7, COUNT = 255 * AROUND };
    static float greys[COUNT];
    static uint8_t codes[COUNT];
    (void)state;
    for (size_t s = 0; s < COUNT_OF(settings); s++) {
        const tl_look look = settings[s].look;
        for (int k = 0; k < 255; k++) {
            float grey = (float)(inverse_curve(look.tone, step_above(look.curve, k)) *
                                 exp2l(-(long double)settings[s].exposure));
            for (int i = 0; i < AROUND / 2; i++)
                grey = nextafterf(grey, 0.0f);
            for (int i = 0; i < AROUND; i++, grey = nextafterf(grey, INFINITY))
                greys[k * AROUND + i] = grey;
        }
        encode_all(greys, COUNT, look, settings[s].exposure, codes);
        for (int i = 0; i < COUNT; i++) {
            const int expected = expected_code(look, settings[s].exposure, greys[i]);
            if (codes[i] != expected)
                fail_msg("%s, around %d + 1/2: %a gives %d, not %d", settings[s].name,
                         i / AROUND, (double)greys[i], codes[i], expected);
        }
        /* The floats of a row are neighbours, so some of them lie on either side. */
        for (int k = 0; k < 255; k++)
            if (codes[k * AROUND] != k || codes[k * AROUND + AROUND - 1] != k + 1)
                fail_msg("%s: no step at %d + 1/2", settings[s].name, k);
    }
}

static void published_values_come_out(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(published); i++) {
        uint8_t code;
        encode_all(&published[i].radiance, 1, published[i].look, published[i].exposure, &code);
        if (code != published[i].expected)
            fail_msg("row %zu: %g gives %d, not %d", i, (double)published[i].radiance, code,
                     published[i].expected);
    }
}

static void brighter_is_never_darker(void **state)
{
    enum { COUNT = 16384 };
    static float greys[COUNT];
    static uint8_t codes[COUNT];
    (void)state;
    for (uint32_t i = 0; i < COUNT; i++) { /* evenly over the bits of 0 to infinity */
        const uint32_t bits = (uint32_t)((uint64_t)0x7f800000 * i / (COUNT - 1));
        memcpy(&greys[i], &bits, sizeof bits);
    }
    for (size_t s = 0; s < COUNT_OF(settings); s++) {
        encode_all(greys, COUNT, settings[s].look, settings[s].exposure, codes);
        for (size_t i = 1; i < COUNT; i++)
            if (codes[i] < codes[i - 1])
                fail_msg("%s: %a is darker than %a", settings[s].name, (double)greys[i],
                         (double)greys[i - 1]);
        assert_int_equal(codes[0], 0);
        assert_int_equal(codes[COUNT - 1], 255);
    }
}

/* What is shown before rounding is what codes are rounded from: half a code off at most, or less than a
 * whole one up to it where a curve cuts. Floats of 0 to 1 add 2^-24 of 255 codes: 1.6e-5. */
static void codes_are_rounded_from_what_is_shown(void **state)
{
    enum { SIDE = 64 };
    static const double slack = 2e-5;
    static uint8_t codes[3 * SIDE * SIDE];
    tl_image *image = NULL;
    tl_error err;
    (void)state;
    for (size_t s = 0; s < COUNT_OF(settings); s++) {
        ASSERT_OK(tl_image_create(SIDE, SIDE, &image, &err), err);
        for (uint32_t i = 0; i < SIDE * SIDE; i++) {
            const uint32_t bits = (uint32_t)((uint64_t)0x7f800000 * i / (SIDE * SIDE - 1));
            for (unsigned c = 0; c < 3; c++)
                memcpy(&tl_image_plane(image, c)[i / SIDE * image->pitch + i % SIDE], &bits,
                       sizeof bits);
        }
        tl_image_plane(image, 1)[0] = NAN;
        tl_image_plane(image, 2)[0] = -1.0f;
        tl_image_to_rgb8(image, settings[s].exposure, settings[s].look, codes);
        tl_image_to_screen(image, settings[s].exposure, settings[s].look);
        for (uint32_t i = 0; i < 3 * SIDE * SIDE; i++) {
            const uint32_t x = i / 3 % SIDE, y = i / 3 / SIDE;
            const double shown =
                255.0 * (double)tl_image_plane(image, i % 3)[y * image->pitch + x];
            const int cuts = settings[s].look.curve == TL_CURVE_GAMMA_22;
            const double above = shown - codes[i];
            if (!(above >= (cuts ? 0.0 : -0.5) - slack && above <= (cuts ? 1.0 : 0.5) + slack))
                fail_msg("%s: pixel %u, %u shows %.7f, its code is %d", settings[s].name, x, y,
                         shown, codes[i]);
        }
        tl_image_destroy(image);
    }
}

/* Codes of 16 bits are 65535 times what is shown, which is rounded to floats of 0 to 1: 0.002 of a code. */
static void deep_codes_are_rounded_from_what_is_shown(void **state)
{
    enum { SIDE = 64 };
    static const double slack = 2.5e-3;
    static uint16_t codes[3 * SIDE * SIDE];
    tl_error err;
    (void)state;
    for (size_t s = 0; s < COUNT_OF(settings); s++) {
        tl_image *image = NULL;
        ASSERT_OK(tl_image_create(SIDE, SIDE, &image, &err), err);
        for (uint32_t i = 0; i < 3 * SIDE * SIDE; i++) {
            const uint32_t bits = (uint32_t)((uint64_t)0x7f800000 * i / (3 * SIDE * SIDE - 1));
            memcpy(&tl_image_plane(image, i % 3)[i / 3 / SIDE * image->pitch + i / 3 % SIDE],
                   &bits, sizeof bits);
        }
        tl_image_to_rgb16(image, settings[s].exposure, settings[s].look, codes);
        tl_image_to_screen(image, settings[s].exposure, settings[s].look);
        for (uint32_t i = 0; i < 3 * SIDE * SIDE; i++) {
            const float value =
                tl_image_plane(image, i % 3)[i / 3 / SIDE * image->pitch + i / 3 % SIDE];
            const int cuts = settings[s].look.curve == TL_CURVE_GAMMA_22;
            const double above = 65535.0 * (double)value - codes[i];
            if (!(above >= (cuts ? 0.0 : -0.5) - slack && above <= (cuts ? 1.0 : 0.5) + slack))
                fail_msg("%s: %.9f is code %d", settings[s].name, (double)value, codes[i]);
        }
        tl_image_destroy(image);
    }
}

static void special_values_are_black_or_white(void **state)
{
    static const float specials[] = {NAN,    -NAN,      0.0f,     -0.0f,   -1.0f,
                                     1e-45f, -INFINITY, INFINITY, FLT_MAX, -FLT_MAX};
    static const uint8_t expected[] = {0, 0, 0, 0, 0, 0, 0, 255, 255, 0};
    static const float exposures[] = {0.0f, 20.0f, -20.0f};
    uint8_t codes[COUNT_OF(specials)];
    (void)state;
    for (unsigned l = 0; l < TL_TONE_COUNT * TL_CURVE_COUNT; l++) {
        const tl_look look = {.tone = (tl_tone)(l % TL_TONE_COUNT),
                              .curve = (tl_curve)(l / TL_TONE_COUNT)};
        if (!tl_look_is_of_channels(look))
            continue;
        for (size_t e = 0; e < COUNT_OF(exposures); e++) {
            encode_all(specials, COUNT_OF(specials), look, exposures[e], codes);
            for (size_t i = 0; i < COUNT_OF(specials); i++)
                if (codes[i] != expected[i])
                    fail_msg("tone %d, curve %d, %g gives %d, not %d", (int)look.tone,
                             (int)look.curve, (double)specials[i], codes[i], expected[i]);
        }
    }
    /* So dark that no finite radiance is white. */
    encode_all(specials, COUNT_OF(specials), (tl_look){.tone = TL_TONE_REINHARD}, -1000.0f,
               codes);
    assert_int_equal(codes[7], 255);
    assert_int_equal(codes[8], 0);
}

/* A picture whose padding would show if it were read. */
static tl_image *make_picture(uint32_t width, uint32_t height)
{
    tl_image *image = NULL;
    tl_error err;
    uint32_t seed = 7;
    ASSERT_OK(tl_image_create(width, height, &image, &err), err);
    for (size_t i = 0; i < 3 * (size_t)image->pitch * image->rows; i++)
        image->planes[i] = 1e6f;
    for (unsigned channel = 0; channel < 3; channel++)
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++) {
                seed = seed * 1664525u + 1013904223u;
                tl_image_plane(image, channel)[y * image->pitch + x] =
                    (float)(seed >> 8) * 0x1p-24f;
            }
    return image;
}

static void auto_exposure_brings_the_log_average_to_grey(void **state)
{
    static const struct {
        const char *name;
        float greys[4];
        double expected;
    } cases[] = {
        {"grey already", {0.18f, 0.18f, 0.18f, 0.18f}, 0.0},
        {"log-average 1/2", {0.25f, 1.0f, 0.25f, 1.0f}, -1.4739311883324124},
        {"black left out", {0.0f, 0.0f, 0.18f, -0.0f}, 0.0},
        {"not finite left out", {NAN, INFINITY, 0.36f, -1.0f}, -1.0},
        {"nothing left", {0.0f, NAN, -2.0f, INFINITY}, 0.0},
        {"denormal", {1e-45f, 1e-45f, 1e-45f, 1e-45f}, 146.52606881166758},
    };
    tl_image *image = NULL;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_image_create(4, 1, &image, &err), err);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        for (unsigned channel = 0; channel < 3; channel++)
            memcpy(tl_image_plane(image, channel), cases[i].greys, sizeof cases[i].greys);
        const double got = (double)tl_image_auto_exposure(image);
        /* 0.18 as a float is off by 2e-8 of itself, the result by an ulp of 147 at most. */
        if (!(fabs(got - cases[i].expected) <= 1e-7 + fabs(cases[i].expected) * 0x1p-24))
            fail_msg("%s: %.9g, not %.9g", cases[i].name, got, cases[i].expected);
    }
    tl_image_destroy(image);
}

static void threads_change_nothing(void **state)
{
    static const char *const threads[] = {"1", "2", "7"};
    static uint8_t rgb[COUNT_OF(threads)][61 * 173 * 3];
    float exposures[COUNT_OF(threads)];
    tl_image *image = make_picture(61, 173);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(threads); i++) {
        setenv("TILELIGHT_THREADS", threads[i], 1);
        exposures[i] = tl_image_auto_exposure(image);
        tl_image_to_rgb8(image, exposures[i], (tl_look){0}, rgb[i]);
        assert_true(same_bits(exposures[i], exposures[0]));
        assert_memory_equal(rgb[i], rgb[0], sizeof rgb[0]);
    }
    for (size_t i = 0; i < 61 * 173; i += 17) { /* pixels stand where they should */
        const float red = tl_image_plane(image, 0)[i / 61 * image->pitch + i % 61];
        assert_int_equal(rgb[0][3 * i], expected_code((tl_look){0}, exposures[0], red));
    }
    unsetenv("TILELIGHT_THREADS");
    tl_image_destroy(image);
}

static void extents_outside_the_limits_are_refused(void **state)
{
    static const uint32_t extents[][2] = {
        {0, 1}, {1, 0}, {16385, 1}, {1, 16385}, {UINT32_MAX, 1}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(extents); i++) {
        tl_image *image = NULL;
        tl_error err;
        assert_int_equal(tl_image_create(extents[i][0], extents[i][1], &image, &err),
                         TL_ERR_ARGUMENT);
        assert_null(image);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_threshold_is_exact),
        cmocka_unit_test(published_values_come_out),
        cmocka_unit_test(brighter_is_never_darker),
        cmocka_unit_test(codes_are_rounded_from_what_is_shown),
        cmocka_unit_test(deep_codes_are_rounded_from_what_is_shown),
        cmocka_unit_test(special_values_are_black_or_white),
        cmocka_unit_test(auto_exposure_brings_the_log_average_to_grey),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(extents_outside_the_limits_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
