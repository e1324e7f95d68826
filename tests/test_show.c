/* Do codes of every tone curve and dither come out as published formulas say, finite for whatever comes in,
 * rising and gray in gray, and in the mean what the value is? */
#include "testing.h"

#include "blue_noise.h"
#include "show.h"

#include <float.h>

extern tl_show_rows_twin tl_show_portable;

#define ROW(name, word, mixes, function, source) {name, word},
static const struct {
    tl_tone tone;
    const char *word;
} rows[] = {TL_TONE_CURVES(ROW)};

typedef struct color {
    long double c[3];
} color;

static long double unit(long double x)
{
    return x > 0 ? x < 1 ? x : 1 : 0;
}

static color times(const long double m[3][3], color v)
{
    color out;
    for (int i = 0; i < 3; i++)
        out.c[i] = m[i][0] * v.c[0] + m[i][1] * v.c[1] + m[i][2] * v.c[2];
    return out;
}

/* The published forms, worked out apart from kernels/tone.h. */
static long double hable(long double x)
{
    const long double A = 0.15L, B = 0.50L, C = 0.10L, D = 0.20L, E = 0.02L, F = 0.30L;
    return (x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F) - E / F;
}

static color hill(color v)
{
    static const long double in[3][3] = {{0.59719L, 0.35458L, 0.04823L},
                                         {0.07600L, 0.90834L, 0.01566L},
                                         {0.02840L, 0.13383L, 0.83777L}};
    static const long double out[3][3] = {{1.60475L, -0.53108L, -0.07367L},
                                          {-0.10208L, 1.10813L, -0.00605L},
                                          {-0.00327L, -0.07276L, 1.07602L}};
    v = times(in, v);
    for (int i = 0; i < 3; i++) {
        const long double x = v.c[i];
        v.c[i] = (x * (x + 0.0245786L) - 0.000090537L) /
                 (x * (0.983729L * x + 0.4329510L) + 0.238081L);
    }
    return times(out, v);
}

static color agx(color v)
{
    static const long double in[3][3] = {
        {0.842479062253094L, 0.0784335999999992L, 0.0792237451477643L},
        {0.0423282422610123L, 0.878468636469772L, 0.0791661274605434L},
        {0.0423756549057051L, 0.0784336L, 0.879142973793104L}};
    static const long double out[3][3] = {
        {1.19687900512017L, -0.0980208811401368L, -0.0990297440797205L},
        {-0.0528968517574562L, 1.15190312990417L, -0.0989611768448433L},
        {-0.0529716355144438L, -0.0980434501171241L, 1.15107367264116L}};
    v = times(in, v);
    for (int i = 0; i < 3; i++) {
        const long double x =
            unit((log2l(fmaxl(v.c[i], 1e-30L)) + 12.47393L) / (4.026069L + 12.47393L));
        v.c[i] = 15.5L * powl(x, 6) - 40.14L * powl(x, 5) + 31.96L * powl(x, 4) -
                 6.868L * powl(x, 3) + 0.4298L * x * x + 0.1191L * x - 0.00232L;
    }
    v = times(out, v);
    for (int i = 0; i < 3; i++)
        v.c[i] = powl(unit(v.c[i]), 2.2L);
    return v;
}

static color neutral(color v)
{
    const long double low = fminl(v.c[0], fminl(v.c[1], v.c[2]));
    const long double offset = low < 0.08L ? low - 6.25L * low * low : 0.04L;
    for (int i = 0; i < 3; i++)
        v.c[i] -= offset;
    const long double peak = fmaxl(v.c[0], fmaxl(v.c[1], v.c[2])), start = 0.8L - 0.04L;
    if (peak < start)
        return v;
    const long double d = 1 - start, squeezed = 1 - d * d / (peak + d - start);
    const long double g = 1 - 1 / (0.15L * (peak - squeezed) + 1);
    for (int i = 0; i < 3; i++)
        v.c[i] = (1 - g) * v.c[i] * squeezed / peak + g * squeezed;
    return v;
}

static color each(color v, long double (*curve)(long double x))
{
    for (int i = 0; i < 3; i++)
        v.c[i] = curve(v.c[i]);
    return v;
}

static long double none(long double x)
{
    return x;
}

static long double aces(long double x)
{
    return x * (2.51L * x + 0.03L) / (x * (2.43L * x + 0.59L) + 0.14L);
}

static long double reinhard(long double x)
{
    return x / (1 + x);
}

static long double reinhard_white_4(long double x)
{
    return x * (1 + x / 16) / (1 + x);
}

static long double hable_white(long double x)
{
    return hable(2 * x) / hable(11.2L);
}

static color published(tl_tone tone, color v)
{
    switch (tone) {
    case TL_TONE_NONE: return each(v, none);
    case TL_TONE_ACES: return each(v, aces);
    case TL_TONE_REINHARD: return each(v, reinhard);
    case TL_TONE_REINHARD_EXTENDED: return each(v, reinhard_white_4);
    case TL_TONE_HABLE: return each(v, hable_white);
    case TL_TONE_ACES_HILL: return hill(v);
    case TL_TONE_AGX: return agx(v);
    case TL_TONE_NEUTRAL: return neutral(v);
    default: fail_msg("tone %d has no published form here", (int)tone); return v;
    }
}

/* 0 to 255. */
static color signal_of_screen(color v, tl_curve curve)
{
    for (int i = 0; i < 3; i++) {
        const long double y = unit(v.c[i]);
        v.c[i] = 255 * (curve == TL_CURVE_GAMMA_22 ? powl(y, 1 / 2.2L)
                        : y <= 0.0031308L          ? 12.92L * y
                                                   : 1.055L * powl(y, 1 / 2.4L) - 0.055L);
    }
    return v;
}

/* What codes may be off by before they are rounded: kernels/tone.h for curves of single channels. Of those
 * that mix them, u = 2^-24, times the slope of the signal, 12.92 at most, and 255: Hill's 36u, of 15u of a
 * fraction that two rows spread to 2.3 times; neutral's 4u; AgX in the signal itself: 110u of the polynomial,
 * 1.4 times that behind the outset, and a slope of 2.2. All are below 120000u. */
static double slack_of(tl_tone tone)
{
    return tl_look_is_of_channels((tl_look){.tone = tone}) ? 0x1p-10 : 120000.0 * 0x1p-24;
}

enum { SIDE = 64, PIXELS = SIDE * SIDE };

static tl_image *make_image(void)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(SIDE, SIDE, &image, &err), err);
    return image;
}

static float *value_at(const tl_image *image, unsigned c, uint32_t i)
{
    return &tl_image_plane(image, c)[(size_t)(i / SIDE) * image->pitch + i % SIDE];
}

/* 2^-20 to 2^12, colours of all kinds. */
static tl_image *make_colors(uint32_t seed)
{
    tl_image *image = make_image();
    for (uint32_t i = 0; i < 3 * PIXELS; i++) {
        seed = seed * 1664525u + 1013904223u;
        *value_at(image, i % 3, i / 3) =
            ldexpf(1.0f + (float)(seed >> 9) * 0x1p-23f, (int)(seed >> 3 & 31) - 20);
    }
    return image;
}

static void codes_are_as_published(void **state)
{
    static uint8_t codes[3 * PIXELS];
    tl_image *image = make_colors(1);
    (void)state;
    for (size_t t = 0; t < COUNT_OF(rows); t++)
        for (int curve = 0; curve < TL_CURVE_COUNT; curve++) {
            const tl_look look = {.tone = rows[t].tone, .curve = (tl_curve)curve};
            const double slack = slack_of(look.tone), rounding = curve ? 1.0 : 0.5;
            tl_image_to_rgb8(image, 0.5f, look, codes);
            for (uint32_t i = 0; i < PIXELS; i++) {
                color v;
                for (unsigned c = 0; c < 3; c++)
                    v.c[c] = (long double)*value_at(image, c, i) * sqrtl(2);
                v = signal_of_screen(published(look.tone, v), look.curve);
                for (unsigned c = 0; c < 3; c++) {
                    const double above = (double)(v.c[c] - codes[3 * i + c]);
                    if (!(above >= rounding - 1.0 - slack && above <= rounding + slack))
                        fail_msg("%s, curve %d: pixel %u, channel %u is code %d, not %.5f",
                                 rows[t].word, curve, i, c, codes[3 * i + c], (double)v.c[c]);
                }
            }
        }
    tl_image_destroy(image);
}

/* Of every float that a picture may hold: the signal is one, from 0 to 1, and black and white end the
 * range. */
static void whatever_comes_in_is_shown(void **state)
{
    static const float values[] = {0.0f,      -0.0f,    1e-45f,  1e-10f, 0.18f,
                                   1.0f,      65504.0f, FLT_MAX, -1.0f,  -FLT_MAX,
                                   -INFINITY, INFINITY, NAN,     1e20f};
    enum { VALUES = COUNT_OF(values) };
    static uint8_t codes[3 * PIXELS];
    static const float exposures[] = {0.0f, 64.0f, -64.0f};
    (void)state;
    for (size_t t = 0; t < COUNT_OF(rows); t++)
        for (size_t e = 0; e < COUNT_OF(exposures); e++) {
            const tl_look look = {.tone = rows[t].tone, .dither = TL_DITHER_BLUE_NOISE};
            tl_image *image = make_image();
            for (uint32_t i = 0; i < VALUES * VALUES * VALUES; i++)
                for (unsigned c = 0; c < 3; c++)
                    *value_at(image, c, i) = values[(c == 0   ? i
                                                     : c == 1 ? i / VALUES
                                                              : i / VALUES / VALUES) %
                                                    VALUES];
            tl_image_to_rgb8(image, exposures[e], look, codes);
            tl_image_to_screen(image, exposures[e], look);
            for (uint32_t i = 0; i < PIXELS; i++)
                for (unsigned c = 0; c < 3; c++) {
                    const double shown = 255.0 * (double)*value_at(image, c, i);
                    if (!(shown >= 0.0 && shown <= 255.0) ||
                        !(fabs(shown - codes[3 * i + c]) <= 1.0 + slack_of(look.tone)))
                        fail_msg("%s, %g stops: pixel %u, channel %u shows %g, code %d",
                                 rows[t].word, (double)exposures[e], i, c, shown,
                                 codes[3 * i + c]);
                }
            tl_image_destroy(image);
        }
}

/* Gray in: codes never fall where radiance rises, and red, green and blue stay within 4e-4 of each other, a
 * tenth of a code: rows of the matrices of Hill and AgX add up to 1 within 1e-5 and 1.8e-4. */
static void gray_rises_and_stays_gray(void **state)
{
    static const double apart = 4e-4;
    static uint8_t codes[3 * PIXELS];
    (void)state;
    for (size_t t = 0; t < COUNT_OF(rows); t++) {
        tl_image *image = make_image();
        for (uint32_t i = 0; i < PIXELS; i++)
            for (unsigned c = 0; c < 3; c++)
                *value_at(image, c, i) = exp2f(-18.0f + 36.0f * (float)i / (PIXELS - 1));
        tl_image_to_rgb8(image, 0.0f, (tl_look){.tone = rows[t].tone}, codes);
        tl_image_to_screen(image, 0.0f, (tl_look){.tone = rows[t].tone});
        for (uint32_t i = 0; i < PIXELS; i++)
            for (unsigned c = 0; c < 3; c++) {
                const double shown = (double)*value_at(image, c, i);
                const double before = i ? (double)*value_at(image, c, i - 1) : 0.0;
                if (shown < before || (i && codes[3 * i + c] < codes[3 * i - 3 + c]))
                    fail_msg("%s: channel %u falls at pixel %u", rows[t].word, c, i);
                if (!(fabs(shown - (double)*value_at(image, 0, i)) <= apart))
                    fail_msg("%s: gray has a colour at pixel %u", rows[t].word, i);
            }
        assert_int_equal(codes[0], 0);
        if (codes[3 * PIXELS - 1] < 254) /* AgX's polynomial ends at 0.9986 */
            fail_msg("%s: the brightest is %d", rows[t].word, codes[3 * PIXELS - 1]);
        tl_image_destroy(image);
    }
}

/* The kernel's text with thresholds gives every float the code of the thresholds alone, around all of them
 * and elsewhere. */
static void thresholds_decide(void **state)
{
    static const float exposures[] = {0.0f, 3.7f, -5.3f, 40.0f};
    static uint8_t expected[3 * PIXELS], got[3 * PIXELS];
    static tl_show show;
    (void)state;
    for (size_t t = 0; t < COUNT_OF(rows); t++)
        for (size_t e = 0; e < 2 * COUNT_OF(exposures); e++) {
            const float exposure = exposures[e / 2];
            const tl_look look = {.tone = rows[t].tone, .curve = (tl_curve)(e % 2)};
            tl_image *image = make_colors((uint32_t)e);
            if (!tl_look_is_of_channels(look)) {
                tl_image_destroy(image);
                continue;
            }
            tl_show_prepare(&show, exposure, look);
            for (uint32_t i = 1; i < 256 * 7; i++) {
                float value = show.numbers[TL_SHOW_THRESHOLDS + i / 7];
                for (uint32_t k = 0; k < i % 7; k++)
                    value = nextafterf(value, i % 2 ? 0.0f : INFINITY);
                *value_at(image, i % 3, i) = value;
            }
            tl_show_job job = {
                &show,
                {tl_image_plane(image, 0), tl_image_plane(image, 1), tl_image_plane(image, 2)},
                image->pitch,
                SIDE,
                got};
            tl_image_to_rgb8(image, exposure, look, expected);
            tl_show_portable(&job, 0, SIDE);
            for (uint32_t i = 0; i < 3 * PIXELS; i++)
                if (got[i] != expected[i])
                    fail_msg("%s, %g stops: %a is %d, not %d", rows[t].word, (double)exposure,
                             (double)*value_at(image, i % 3, i / 3), got[i], expected[i]);
            tl_image_destroy(image);
        }
}

/* Over a tile the mean of codes is the value, to half a rank and what the value itself is off by; gray stays
 * gray; black and white have no grain. */
static void dithered_codes_mean_the_value(void **state)
{
    static const double ranks[TL_DITHER_COUNT] = {
        [TL_DITHER_ORDERED] = 64.0, [TL_DITHER_BLUE_NOISE] = PIXELS};
    static uint8_t codes[3 * PIXELS];
    (void)state;
    for (int d = TL_DITHER_NONE + 1; d < TL_DITHER_COUNT; d++)
        for (int step = 0; step <= 200; step++) {
            const tl_look look = {.tone = TL_TONE_NONE, .dither = (tl_dither)d};
            tl_image *image = make_image();
            double sum = 0.0;
            for (uint32_t i = 0; i < PIXELS; i++)
                for (unsigned c = 0; c < 3; c++)
                    *value_at(image, c, i) = (float)step / 200.0f;
            tl_image_to_rgb8(image, 0.0f, look, codes);
            tl_image_to_screen(image, 0.0f, look);
            const double value = 255.0 * (double)*value_at(image, 0, 0);
            for (uint32_t i = 0; i < PIXELS; i++) {
                sum += codes[3 * i];
                assert_true(codes[3 * i] == codes[3 * i + 1] &&
                            codes[3 * i] == codes[3 * i + 2]);
                assert_true(fabs(codes[3 * i] - value) < 1.0);
            }
            const double off = fabs(sum / PIXELS - value);
            if (!(off <= 0.5 / ranks[d] + 0x1p-10) || ((step % 200 == 0) && off > 0.0))
                fail_msg("dither %d: the mean of %.5f is %.5f", d, value, sum / PIXELS);
            tl_image_destroy(image);
        }
}

/* Each rank once; and of what frequencies below 6 periods a tile have, at most a tenth of what white noise
 * would. */
static void noise_is_blue(void **state)
{
    static int seen[PIXELS];
    enum { LOW = 6 };
    double low = 0.0, all = 0.0;
    int count = 0;
    (void)state;
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(seen[blue_noise[i]]++, 0);
        all += pow(blue_noise[i] - 0.5 * (PIXELS - 1), 2.0);
    }
    for (int v = -LOW; v <= LOW; v++)
        for (int u = -LOW; u <= LOW; u++) {
            double re = 0.0, im = 0.0;
            if ((u == 0 && v == 0) || u * u + v * v > LOW * LOW)
                continue;
            for (int i = 0; i < PIXELS; i++) {
                const double angle =
                    2.0 * 3.14159265358979323846 * (u * (i % SIDE) + v * (i / SIDE)) / SIDE;
                re += blue_noise[i] * cos(angle);
                im += blue_noise[i] * sin(angle);
            }
            low += re * re + im * im;
            count++;
        }
    const double share = low / count / all; /* of white noise: 1 */
    if (!(share < 0.1))
        fail_msg("low frequencies have %.3f of what white noise has", share);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_are_as_published),
        cmocka_unit_test(whatever_comes_in_is_shown),
        cmocka_unit_test(gray_rises_and_stays_gray),
        cmocka_unit_test(thresholds_decide),
        cmocka_unit_test(dithered_codes_mean_the_value),
        cmocka_unit_test(noise_is_blue),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
