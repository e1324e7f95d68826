#include "check_report.h"

#include "json_values.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char channel_names[] = "RGB";
enum { MOST_PRINTED_LIGHTS = 12 };

check_summary check_summarise(const check_result *results, size_t count)
{
    check_summary s = {.results = results, .count = count};
    for (size_t i = 0; i < count; i++) {
        const tl_check_report *r = &results[i].report;
        s.failed_frame_count += r->failed_count > 0;
        s.pixel_count += r->pixel_count;
        s.failed_count += r->failed_count;
        s.not_finite_count += r->not_finite_count;
        s.excused_count += r->excused_count;
        s.rounding_ratio = fmax(s.rounding_ratio, r->rounding_ratio);
        if (r->worst.ratio > results[s.worst].report.worst.ratio)
            s.worst = i;
    }
    return s;
}

static void print_frame(const check_result *result)
{
    char size[32];
    snprintf(size, sizeof size, "%ux%u", result->width, result->height);
    printf("%-16s %10s %8" PRIu64 " %9" PRIu64 " %12.4g %12.4g\n", result->name, size,
           result->light_count, result->report.failed_count, result->report.rounding_ratio,
           result->report.worst.ratio);
}

static void print_lights(const check_result *result)
{
    const uint32_t channel = result->report.worst.channel;
    const size_t kept = result->worst_light_count < MOST_CHECK_LIGHTS
                            ? result->worst_light_count
                            : MOST_CHECK_LIGHTS;
    const size_t shown = kept < MOST_PRINTED_LIGHTS ? kept : MOST_PRINTED_LIGHTS;
    printf("lights that reach it: %zu%s\n", result->worst_light_count,
           shown < result->worst_light_count ? ", of which the first" : "");
    if (shown > 0)
        printf("%10s %12s %10s %14s\n", "light", "distance", "n.l", "adds");
    for (size_t i = 0; i < shown; i++) {
        const tl_check_light *l = &result->lights[i].light;
        printf("%10u %10.4g m %10.4f %14.6g %s%s\n", l->index, l->distance, l->n_dot_l,
               l->high[channel], result->lights[i].name,
               l->certain ? "" : " (or nothing: rounding may decide)");
    }
}

static void print_worst(const check_result *result)
{
    const tl_check_value *w = &result->report.worst;
    printf("worst: frame %s, pixel (%u, %u), %c\n", result->name, w->x, w->y,
           channel_names[w->channel]);
    printf("  expected %.9g\n  got      %.9g\n  allowed  %.9g to %.9g\n", w->expected,
           (double)w->got, w->low, w->high);
    print_lights(result);
}

void check_print(const char *what, const check_summary *s)
{
    /* Error over tolerance: of pixels where no light hangs on rounding, and of all. Where one
     * does, the whole of that light is tolerance, and the ratio may come close to 1. */
    printf("%-16s %10s %8s %9s %12s %12s\n", "frame", "size", "lights", "outside", "rounding",
           "worst");
    for (size_t i = 0; i < s->count; i++)
        print_frame(&s->results[i]);
    putchar('\n');
    if (s->failed_count == 0) {
        printf("passed: %s: %" PRIu64
               " pixels are within tolerance; rounding takes up to %.2g of it\n",
               what, s->pixel_count, s->rounding_ratio);
        return;
    }
    printf("failed: %s: %" PRIu64 " of %" PRIu64 " pixels out of tolerance, %" PRIu64
           " not finite\n",
           what, s->failed_count, s->pixel_count, s->not_finite_count);
    if (s->not_finite_count > 0)
        puts(
            "(a picture is filled with NaN beforehand: what a kernel does not write stays so)");
    print_worst(&s->results[s->worst]);
    if (s->excused_count == s->failed_count)
        puts("Every one of them is within what pow(n.h, exponent) loses by rounding n.h: take "
             "the cosine by its sine near the peak, or allow it with --cosine textbook.");
}

static json_t *three_json(const double values[3])
{
    json_t *array = json_array();
    for (int i = 0; i < 3; i++)
        json_array_append_new(array, tl_json_number(values[i]));
    return array;
}

static json_t *lights_json(const check_result *result)
{
    json_t *array = json_array();
    for (size_t i = 0; i < result->worst_light_count && i < MOST_CHECK_LIGHTS; i++) {
        const tl_check_light *l = &result->lights[i].light;
        json_array_append_new(
            array, json_pack("{si si ss so so sb so so}", "index", (int)l->index, "source",
                             (int)l->source, "name", result->lights[i].name, "distance",
                             tl_json_number(l->distance), "n_dot_l", tl_json_number(l->n_dot_l),
                             "certain", (int)l->certain, "least", three_json(l->low), "most",
                             three_json(l->high)));
    }
    return array;
}

static json_t *worst_json(const check_result *result)
{
    const tl_check_value *w = &result->report.worst;
    const char channel[2] = {channel_names[w->channel], '\0'};
    if (!(w->ratio > 0.0))
        return json_null();
    return json_pack("{s[ii] ss so so so so so sI so}", "pixel", (int)w->x, (int)w->y,
                     "channel", channel, "expected", tl_json_number(w->expected), "got",
                     tl_json_number((double)w->got), "low", tl_json_number(w->low), "high",
                     tl_json_number(w->high), "ratio", tl_json_number(w->ratio), "light_count",
                     (json_int_t)result->worst_light_count, "lights", lights_json(result));
}

static json_t *frame_json(const check_result *result)
{
    const tl_check_report *r = &result->report;
    return json_pack("{ss s[ii] sI sI sI sI sI so so}", "name", result->name, "size",
                     (int)result->width, (int)result->height, "lights",
                     (json_int_t)result->light_count, "pixels", (json_int_t)r->pixel_count,
                     "outside", (json_int_t)r->failed_count, "not_finite",
                     (json_int_t)r->not_finite_count, "outside_by_textbook_cosine",
                     (json_int_t)r->excused_count, "rounding_ratio",
                     tl_json_number(r->rounding_ratio), "worst", worst_json(result));
}

json_t *check_json(const char *kernel,
                   const char *entry,
                   const char *device,
                   const check_summary *s)
{
    json_t *frames = json_array();
    for (size_t i = 0; i < s->count; i++)
        json_array_append_new(frames, frame_json(&s->results[i]));
    return json_pack("{sb ss? ss? ss? sI sI sI so so}", "passed", s->failed_count == 0,
                     "kernel", kernel, "entry", entry, "device", device, "pixels",
                     (json_int_t)s->pixel_count, "outside", (json_int_t)s->failed_count,
                     "not_finite", (json_int_t)s->not_finite_count, "rounding_ratio",
                     tl_json_number(s->rounding_ratio), "frames", frames);
}

tl_status check_judge(const char *what, const check_summary *s, tl_error *err)
{
    const check_result *worst = &s->results[s->worst];
    const tl_check_value *w = &worst->report.worst;
    if (s->failed_count == 0)
        return TL_OK;
    return tl_fail(err, TL_ERR_DIFFERENT,
                   "%s: %" PRIu64 " of %" PRIu64 " pixels are out of tolerance, in %" PRIu64
                   " of %zu frames; the worst is pixel (%u, %u) of frame %s, channel %c: %.9g, "
                   "not %.9g",
                   what, s->failed_count, s->pixel_count, s->failed_frame_count, s->count, w->x,
                   w->y, worst->name, channel_names[w->channel], (double)w->got, w->expected);
}

static void paint_pixel(double ratio, uint8_t rgb[3])
{
    const double inside = fmin(ratio, 1.0), decades = log10(fmax(ratio, 1.0)) / 4.0;
    const uint8_t grey = (uint8_t)(160.0 * inside);
    const uint8_t green = (uint8_t)(255.0 * fmin(decades, 1.0));
    const uint8_t within[3] = {grey, grey, grey}, beyond[3] = {255, green, 0};
    const uint8_t impossible[3] = {255, 255, 255};
    memcpy(rgb, isinf(ratio) ? impossible : ratio > 1.0 ? beyond : within, 3);
}

void check_paint(const tl_image *ratios, uint8_t *rgb)
{
    for (uint32_t y = 0; y < ratios->height; y++)
        for (uint32_t x = 0; x < ratios->width; x++) {
            double ratio = 0.0;
            for (unsigned c = 0; c < 3; c++)
                ratio = fmax(ratio,
                             (double)tl_image_plane(ratios, c)[(size_t)y * ratios->pitch + x]);
            paint_pixel(ratio, rgb + 3 * ((size_t)y * ratios->width + x));
        }
}
