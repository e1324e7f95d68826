/* What pictures become as they leave: cases 35 and 36. */
#include "hard_case.h"

#include "post_frames.h"

#include <float.h>

static const post_way twin = {"twin", TL_PRECISION_TWIN, TL_PATH_AUTO, 0, 0, 0};

enum { FROM = 48, ROWS = 8 };

/* A column shows its own place, px from the left edge. */
static tl_image *ruler(void)
{
    tl_image *image = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(FROM, ROWS, &image, &err), err);
    for (uint32_t i = 0; i < FROM * ROWS; i++) {
        const float at = (float)(i % FROM) + 0.5f, color[3] = {at, at, at};
        fill_color(image, i % FROM, i / FROM, color);
    }
    return image;
}

/* Lookups at i times the ratio, which is where the left edge of pixel i is, between pixels' numbers. */
static double place_by_corners(uint32_t i, double step)
{
    return fmin((double)i * step, FROM - 1.0) + 0.5;
}

void hard_half_pixel(hard_bench *bench)
{
    static const uint32_t widths[] = {24, 61, 96, 150};
    static const tl_filter filters[] = {TL_FILTER_TENT, TL_FILTER_MITCHELL,
                                        TL_FILTER_CATMULL_ROM, TL_FILTER_LANCZOS3};
    static const double within = 0.02; /* px: what Lanczos's window makes of a ramp */
    const tl_camera camera = camera_of(FROM, ROWS, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 3);
    tl_image *from = ruler();
    for (size_t f = 0; f < COUNT_OF(filters); f++)
        for (size_t w = 0; w < COUNT_OF(widths); w++) {
            const double step = (double)FROM / widths[w], reach = 3.0 * fmax(1.0, step) + 1.0;
            const tl_post_options options = {
                .width = widths[w], .height = ROWS, .filter = filters[f]};
            tl_image *want = post_image(NULL, &twin, &options, g, from, 0, NULL);
            tl_image *got =
                post_image(bench->device, &post_ways[0], &options, g, from, 0, NULL);
            bench->result.pixels += (uint64_t)widths[w] * ROWS;
            bench->result.lost += hard_different_pixels(got, want);
            for (uint32_t i = 0; i < widths[w]; i++) {
                const double place = (i + 0.5) * step;
                if (place > reach && place < FROM - reach)
                    hard_count(bench, fabs((double)color_at(want, 1, i, 4) - place) <= within,
                               fabs(place_by_corners(i, step) - place) <= within);
            }
            tl_image_destroy(got);
            tl_image_destroy(want);
        }
    tl_image_destroy(from);
    tl_gbuffer_destroy(g);
}

/* Narkowicz's fraction as it is usually written, in float. */
static int is_shown_by_fraction(float x)
{
    const float y = x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
    return isfinite(y);
}

void hard_bright_tone(hard_bench *bench)
{
    static const float values[] = {0.0f,  1e-30f, 0.18f,   1.0f,     65504.0f, 1e18f, 3e19f,
                                   1e38f, 2e38f,  FLT_MAX, INFINITY, NAN,      -1.0f, -1e38f};
    enum { COUNT = COUNT_OF(values) };
    static uint8_t want[3 * COUNT], got[3 * COUNT];
    const tl_post_options nothing = {.mend = 0};
    tl_lighting_options lighting = tl_lighting_options_default();
    tl_image *image = NULL;
    tl_post *post = NULL;
    tl_error err;
    ASSERT_OK(tl_image_create(COUNT, 1, &image, &err), err);
    ASSERT_OK(tl_post_create(bench->device, &lighting, &nothing, &post, &err), err);
    for (uint32_t i = 0; i < COUNT; i++)
        fill_color(image, i, 0, (const float[3]){values[i], values[i], values[i]});
    for (int tone = 0; tone < TL_TONE_COUNT; tone++) {
        const tl_look look = {.tone = (tl_tone)tone};
        tl_image_to_rgb8(image, 0.0f, look, want);
        ASSERT_OK(tl_post_codes(post, image, 0.0f, look, got, NULL, NULL, &err), err);
        bench->result.pixels += COUNT;
        for (uint32_t i = 0; i < COUNT; i++) {
            const int is_white = values[i] > 1e4f, is_black = !(values[i] > 1e-6f);
            bench->result.lost += memcmp(&got[3 * i], &want[3 * i], 3) != 0;
            hard_count(bench,
                       is_white   ? want[3 * i] >= 254
                       : is_black ? want[3 * i] == 0
                                  : want[3 * i] > 0,
                       is_shown_by_fraction(values[i]));
        }
    }
    tl_post_destroy(post);
    tl_image_destroy(image);
}
