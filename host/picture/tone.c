/* From radiance to 8 bits: exposure, tone curve, curve of the codes, rounding; the formulas are those of
 * kernels/tone.h, in double.
 *
 * Where a tone takes each channel by itself all four are monotone, so the whole way is 255 thresholds: the
 * least radiance that comes out as 1, as 2, ... as 255. They are found once per picture, by bisecting over
 * floats with the formulas in double; a pixel then only counts the thresholds it reaches. That is exact, in
 * the sense that every float gets the 8-bit value that the formulas in double are rounded to, and no curve is
 * evaluated per pixel. Other looks are computed pixel by pixel, by the twin of the kernel (show_rows.c). */
#include "dither.h"
#include "parallel.h"
#include "twins.h"
#include "show.h"
#include "srgb.h"
#include "tilelight/camera.h"
#include "tilelight/image.h"

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

static const int mixes[TL_TONE_COUNT] = {
#define TONE_MIXES(name, word, mixes, function, source) [name] = mixes,
    TL_TONE_CURVES(TONE_MIXES)
#undef TONE_MIXES
};

int tl_look_is_of_channels(tl_look look)
{
    return !mixes[look.tone];
}

/* 1/white^2. */
static double per_white2(tl_look look)
{
    const double white = (double)(look.white > 0.0f ? look.white : TL_DEFAULT_WHITE);
    return 1.0 / (white * white);
}

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
    const double white = per_white2(look);
    const double wanted =
        linear_from[look.curve](((double)code - roundings[look.curve]) / 255.0);
    uint32_t low = bits_of_float(least), high = bits_of_float(INFINITY);
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const double x = exposed((double)float_of_bits(middle), scale);
        if (toned((vec3){x, x, x}, look.tone, white).x >= wanted)
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

TL_DECLARE_TWIN(tl_show_rows_twin, tl_show);

int tl_look_has_thresholds(tl_look look)
{
    return look.dither == TL_DITHER_NONE && tl_look_is_of_channels(look);
}

int tl_show_fits(float exposure)
{
    return fabsf(exposure) <= 100.0f;
}

void tl_show_prepare(tl_show *show, float exposure, tl_look look)
{
    encoder e;
    const double stops = fmax(-126.0, fmin(126.0, (double)exposure));
    show->look = (tl_view_look){.scale = (float)exp2(stops),
                                .per_white2 = (float)per_white2(look),
                                .tone = look.tone,
                                .curve = look.curve,
                                .is_exact = (tl_u32)tl_look_has_thresholds(look)};
    tl_dither_fill(look.dither, roundings[look.curve], show->numbers + TL_SHOW_TILE);
    for (unsigned i = 0; i <= CODES; i++)
        show->numbers[TL_SHOW_THRESHOLDS + i] = NAN;
    if (!tl_look_has_thresholds(look))
        return;
    encoder_prepare(&e, exposure, look);
    memcpy(show->numbers + TL_SHOW_THRESHOLDS, e.thresholds, sizeof e.thresholds);
}

static void show_image(const tl_image *image, float exposure, tl_look look, uint8_t *rgb)
{
    tl_show show;
    tl_show_prepare(&show, exposure, look);
    tl_dither_shift(image->x, image->y, show.numbers + TL_SHOW_TILE);
    tl_show_job job = {
        &show,
        {tl_image_plane(image, 0), tl_image_plane(image, 1), tl_image_plane(image, 2)},
        image->pitch,
        image->width,
        rgb};
    tl_parallel(image->height, ROWS_PER_SUM, TL_TWIN_OF(tl_show), &job);
}

static void encode_image(const tl_image *image, float exposure, tl_look look, uint8_t *rgb)
{
    encoder e;
    encode_job job = {image, &e, rgb};
    encoder_prepare(&e, exposure, look);
    tl_parallel(image->height, ROWS_PER_SUM, encode_rows, &job);
}

void tl_image_to_rgb8(const tl_image *image, float exposure, tl_look look, uint8_t *rgb)
{
    if (tl_look_has_thresholds(look))
        encode_image(image, exposure, look, rgb);
    else
        show_image(image, exposure, look, rgb);
}

typedef struct screen_job {
    tl_image *image;
    double scale;
    tl_look look;
} screen_job;

/* What a pixel is shown as, 0 to 1. */
static vec3 shown_at(const screen_job *job, size_t x, size_t y)
{
    const size_t at = y * job->image->pitch + x;
    const vec3 c = {exposed((double)tl_image_plane(job->image, 0)[at], job->scale),
                    exposed((double)tl_image_plane(job->image, 1)[at], job->scale),
                    exposed((double)tl_image_plane(job->image, 2)[at], job->scale)};
    const vec3 linear = toned(c, job->look.tone, per_white2(job->look));
    double (*const encoded)(double) = from_linear[job->look.curve];
    return (vec3){encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

static void show_rows(void *context, size_t begin, size_t end)
{
    const screen_job *job = context;
    tl_image *image = job->image;
    for (size_t y = begin; y < end; y++)
        for (size_t x = 0; x < image->width; x++) {
            const vec3 shown = shown_at(job, x, y);
            const size_t at = y * image->pitch + x;
            tl_image_plane(image, 0)[at] = (float)shown.x;
            tl_image_plane(image, 1)[at] = (float)shown.y;
            tl_image_plane(image, 2)[at] = (float)shown.z;
        }
}

void tl_image_to_screen(tl_image *image, float exposure, tl_look look)
{
    screen_job job = {image, scale_of(exposure), look};
    tl_parallel(image->height, ROWS_PER_SUM, show_rows, &job);
}

typedef struct deep_job {
    screen_job screen;
    float tile[TL_DITHER_SIDE * TL_DITHER_SIDE];
    uint16_t *rgb;
} deep_job;

static uint16_t deep_code(double shown, double added)
{
    return (uint16_t)(65535.0 * shown + added);
}

static void encode_deep_rows(void *context, size_t begin, size_t end)
{
    const deep_job *job = context;
    const size_t width = job->screen.image->width;
    for (size_t y = begin; y < end; y++)
        for (size_t x = 0; x < width; x++) {
            const vec3 shown = shown_at(&job->screen, x, y);
            const double added =
                (double)job->tile[y % TL_DITHER_SIDE * TL_DITHER_SIDE + x % TL_DITHER_SIDE];
            uint16_t *out = job->rgb + 3 * (y * width + x);
            out[0] = deep_code(shown.x, added);
            out[1] = deep_code(shown.y, added);
            out[2] = deep_code(shown.z, added);
        }
}

void tl_image_to_rgb16(const tl_image *image, float exposure, tl_look look, uint16_t *rgb)
{
    tl_image same = *image; /* read alone */
    deep_job job = {.screen = {&same, scale_of(exposure), look}, .rgb = rgb};
    tl_dither_fill(look.dither, roundings[look.curve], job.tile);
    tl_dither_shift(image->x, image->y, job.tile);
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
