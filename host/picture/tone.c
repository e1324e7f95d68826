/* From radiance to 8 bits: exposure, tone curve, curve of the codes, rounding.
 *
 * All four are monotone, so the whole way is 255 thresholds: the least radiance that comes out as
 * 1, as 2, ... as 255. They are found once per picture, by bisecting over floats with the formulas
 * in double; a pixel then only counts the thresholds it reaches. That is exact, in the sense that
 * every float gets the 8-bit value that the formulas in double are rounded to, and no curve is
 * evaluated per pixel. */
#include "parallel.h"
#include "srgb.h"
#include "tilelight/camera.h"
#include "tilelight/image.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    CODES = 256,
    BUCKET_SHIFT = 16,                          /* exponent and 7 bits of mantissa are left */
    BUCKETS = (0x7f800000 >> BUCKET_SHIFT) + 1, /* of 0 to infinity */
    ROWS_PER_SUM = 16,
    MOST_SUMS = TL_MAX_EXTENT / ROWS_PER_SUM
};

/* 2^300 times the largest float and its square are still far inside double. */
static const double most_exposure = 300.0;

/* K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016: x (2.51 x + 0.03) / (x (2.43 x + 0.59) +
 * 0.14). It passes 1 at x = 7.24 and is cut there; cutting x first keeps x^2 finite. */
static double tone_aces(double x)
{
    const double cut = fmin(x, 8.0);
    const double y = cut * (2.51 * cut + 0.03) / (cut * (2.43 * cut + 0.59) + 0.14);
    return fmin(y, 1.0);
}

/* E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002,
 * equation 3. */
static double tone_reinhard(double x)
{
    return x / (1.0 + x);
}

static double tone_none(double x)
{
    return fmin(x, 1.0);
}

/* Rising on [0, infinity). */
static double (*const tones[TL_TONE_COUNT])(double) = {
    [TL_TONE_ACES] = tone_aces,
    [TL_TONE_REINHARD] = tone_reinhard,
    [TL_TONE_NONE] = tone_none,
};

/* A display whose light is the 2.2th power of the signal. */
static double linear_from_gamma_22(double encoded)
{
    return pow(encoded, 2.2);
}

/* Rising on [0, 1]. */
static double (*const linear_from[TL_CURVE_COUNT])(double) = {
    [TL_CURVE_SRGB] = tl_linear_from_srgb,
    [TL_CURVE_GAMMA_22] = linear_from_gamma_22,
};

/* The same the other way. */
static double gamma_22_from_linear(double linear)
{
    return pow(linear, 1.0 / 2.2);
}

static double (*const from_linear[TL_CURVE_COUNT])(double) = {
    [TL_CURVE_SRGB] = tl_srgb_from_linear,
    [TL_CURVE_GAMMA_22] = gamma_22_from_linear,
};

static const double roundings[TL_CURVE_COUNT] = {
#define CURVE_ROUNDING(name, word, rounding, source) [name] = rounding,
    TL_CURVES(CURVE_ROUNDING)
#undef CURVE_ROUNDING
};

static float float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bits_of_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The way from radiance to a code. */
typedef struct encoder {
    float thresholds[CODES + 1]; /* [code]: the least radiance of that code; [256] is reached by
                                  * nothing: NaN */
    uint8_t first[BUCKETS];      /* the code of the least float of each bucket */
} encoder;

/* The least float from `least` on that comes out as `code` or above; infinity if none does.
 * Non-negative floats are ordered as their bits are. */
static float find_threshold(unsigned code, double scale, tl_look look, float least)
{
    const double wanted =
        linear_from[look.curve](((double)code - roundings[look.curve]) / 255.0);
    uint32_t low = bits_of_float(least), high = bits_of_float(INFINITY);
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (tones[look.tone]((double)float_of_bits(middle) * scale) >= wanted)
            high = middle;
        else
            low = middle + 1;
    }
    return float_of_bits(low);
}

static unsigned count_from(const encoder *e, unsigned code, float radiance)
{
    while (radiance >= e->thresholds[code + 1])
        code++;
    return code;
}

static double scale_of(float exposure)
{
    return exp2(fmax(-most_exposure, fmin(most_exposure, (double)exposure)));
}

static void encoder_prepare(encoder *e, float exposure, tl_look look)
{
    const double scale = scale_of(exposure);
    unsigned code = 0;
    e->thresholds[0] = 0.0f;
    for (unsigned i = 1; i < CODES; i++)
        e->thresholds[i] = find_threshold(i, scale, look, e->thresholds[i - 1]);
    e->thresholds[CODES] = NAN;
    for (uint32_t bucket = 0; bucket < BUCKETS; bucket++) {
        code = count_from(e, code, float_of_bits(bucket << BUCKET_SHIFT));
        e->first[bucket] = (uint8_t)code;
    }
}

/* Black for what is not above 0, NaN included; white for infinity. */
static uint8_t encode(const encoder *e, float radiance)
{
    const uint32_t bits = radiance > 0.0f ? bits_of_float(radiance) : 0;
    return (uint8_t)count_from(e, e->first[bits >> BUCKET_SHIFT], radiance);
}

typedef struct encode_job {
    const tl_image *image;
    const encoder *encoder;
    uint8_t *rgb;
} encode_job;

static void encode_rows(void *context, size_t begin, size_t end)
{
    const encode_job *job = context;
    const tl_image *image = job->image;
    for (size_t y = begin; y < end; y++) {
        uint8_t *out = job->rgb + 3 * y * image->width;
        for (unsigned channel = 0; channel < 3; channel++) {
            const float *row = tl_image_plane(image, channel) + y * image->pitch;
            for (size_t x = 0; x < image->width; x++)
                out[3 * x + channel] = encode(job->encoder, row[x]);
        }
    }
}

void tl_image_to_rgb8(const tl_image *image, float exposure, tl_look look, uint8_t *rgb)
{
    encoder e;
    encode_job job = {image, &e, rgb};
    encoder_prepare(&e, exposure, look);
    tl_parallel(image->height, ROWS_PER_SUM, encode_rows, &job);
}

/* What a value is shown as, 0 to 1. */
static double shown(float radiance, double scale, tl_look look)
{
    const double exposed = radiance > 0.0f ? fmin((double)radiance * scale, DBL_MAX) : 0.0;
    return from_linear[look.curve](tones[look.tone](exposed));
}

typedef struct screen_job {
    tl_image *image;
    double scale;
    tl_look look;
} screen_job;

static void show_rows(void *context, size_t begin, size_t end)
{
    const screen_job *job = context;
    const tl_image *image = job->image;
    for (size_t i = 3 * begin; i < 3 * end; i++) {
        float *row = image->planes + (i / 3 + i % 3 * image->rows) * image->pitch;
        for (size_t x = 0; x < image->width; x++)
            row[x] = (float)shown(row[x], job->scale, job->look);
    }
}

void tl_image_to_screen(tl_image *image, float exposure, tl_look look)
{
    screen_job job = {image, scale_of(exposure), look};
    tl_parallel(image->height, ROWS_PER_SUM, show_rows, &job);
}

typedef struct deep_job {
    const tl_image *image;
    double scale;
    tl_look look;
    uint16_t *rgb;
} deep_job;

static void encode_deep_rows(void *context, size_t begin, size_t end)
{
    const deep_job *job = context;
    const tl_image *image = job->image;
    const double rounding = roundings[job->look.curve];
    for (size_t i = 3 * begin; i < 3 * end; i++) {
        const float *row = tl_image_plane(image, (unsigned)(i % 3)) + i / 3 * image->pitch;
        uint16_t *out = job->rgb + i / 3 * image->width * 3 + i % 3;
        for (size_t x = 0; x < image->width; x++)
            out[3 * x] = (uint16_t)(65535.0 * shown(row[x], job->scale, job->look) + rounding);
    }
}

void tl_image_to_rgb16(const tl_image *image, float exposure, tl_look look, uint16_t *rgb)
{
    deep_job job = {image, scale_of(exposure), look, rgb};
    tl_parallel(image->height, ROWS_PER_SUM, encode_deep_rows, &job);
}

/* Each entry of sums is one thread's at a time, and they are added in order: the result does not
 * depend on how many threads there are. */
typedef struct luminance_job {
    const tl_image *image;
    struct {
        double log2_sum;
        uint64_t count;
    } sums[MOST_SUMS];
} luminance_job;

static void sum_luminance(void *context, size_t begin, size_t end)
{
    luminance_job *job = context;
    const tl_image *image = job->image;
    for (size_t block = begin; block < end; block++) {
        const size_t first = block * ROWS_PER_SUM;
        double sum = 0.0;
        uint64_t count = 0;
        for (size_t y = first; y < first + ROWS_PER_SUM && y < image->height; y++) {
            const float *r = tl_image_plane(image, 0) + y * image->pitch;
            const float *g = tl_image_plane(image, 1) + y * image->pitch;
            const float *b = tl_image_plane(image, 2) + y * image->pitch;
            for (size_t x = 0; x < image->width; x++) {
                /* Rec. 709's weights of luminance. */
                const double luminance =
                    0.2126 * (double)r[x] + 0.7152 * (double)g[x] + 0.0722 * (double)b[x];
                if (luminance > 0.0 && isfinite(luminance)) {
                    sum += log2(luminance);
                    count++;
                }
            }
        }
        job->sums[block].log2_sum = sum;
        job->sums[block].count = count;
    }
}

float tl_image_auto_exposure(const tl_image *image)
{
    const size_t blocks = (image->height + ROWS_PER_SUM - 1) / ROWS_PER_SUM;
    luminance_job job = {.image = image};
    double sum = 0.0;
    uint64_t count = 0;
    tl_parallel(blocks, 1, sum_luminance, &job);
    for (size_t block = 0; block < blocks; block++) {
        sum += job.sums[block].log2_sum;
        count += job.sums[block].count;
    }
    return count ? (float)(log2(0.18) - sum / (double)count) : 0.0f;
}
