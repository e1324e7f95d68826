#include "filters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Of the distance from the middle, 0 and more, in pixels of the coarser axis. */
static double tent(double x)
{
    return x < 1.0 ? 1.0 - x : 0.0;
}

/* D. Mitchell and A. Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, equation 8. */
static double cubic(double x, double b, double c)
{
    if (x < 1.0)
        return ((12.0 - 9.0 * b - 6.0 * c) * x * x * x + (-18.0 + 12.0 * b + 6.0 * c) * x * x +
                6.0 - 2.0 * b) /
               6.0;
    if (x < 2.0)
        return ((-b - 6.0 * c) * x * x * x + (6.0 * b + 30.0 * c) * x * x +
                (-12.0 * b - 48.0 * c) * x + 8.0 * b + 24.0 * c) /
               6.0;
    return 0.0;
}

static double catmull_rom(double x)
{
    return cubic(x, 0.0, 0.5);
}

static double mitchell(double x)
{
    return cubic(x, 1.0 / 3.0, 1.0 / 3.0);
}

static double sinc(double x)
{
    return x > 0.0 ? sin(pi * x) / (pi * x) : 1.0;
}

/* C. Lanczos's window, the sinc's own middle lobe, over three lobes (Duchon 1979). */
static double lanczos3(double x)
{
    return x < 3.0 ? sinc(x) * sinc(x / 3.0) : 0.0;
}

/* radius: where it ends. NULL: the share of the new pixel's area that an old one covers. */
static const struct {
    double (*weight)(double x);
    double radius;
} filters[TL_FILTER_COUNT] = {
    [TL_FILTER_BOX] = {NULL, 0.5},
    [TL_FILTER_TENT] = {tent, 1.0},
    [TL_FILTER_CATMULL_ROM] = {catmull_rom, 2.0},
    [TL_FILTER_MITCHELL] = {mitchell, 2.0},
    [TL_FILTER_LANCZOS3] = {lanczos3, 3.0},
};

/* One axis: both extents in px, and how wide the filter is there. */
typedef struct axis {
    tl_filter filter;
    double from, to;
    double step;  /* pixels of `from` a pixel of `to` is wide */
    double reach; /* px of `from` */
} axis;

static axis axis_of(tl_filter filter, uint32_t from, uint32_t to)
{
    axis a = {.filter = filter, .from = from, .to = to};
    a.step = a.from / a.to;
    const double unit = filters[filter].weight && a.step < 1.0 ? 1.0 : a.step;
    a.reach = filters[filter].radius * unit;
    return a;
}

static double weight_of(const axis *a, double middle, double pixel)
{
    const double unit = a->step > 1.0 ? a->step : 1.0;
    if (filters[a->filter].weight)
        return filters[a->filter].weight(fabs(pixel + 0.5 - middle) / unit);
    return fmax(0.0, fmin(pixel + 1.0, middle + a->reach) - fmax(pixel, middle - a->reach));
}

/* Pixel i, of the first half: its weights, which are not 0, and where they begin; returns how many. */
static uint32_t weigh(const axis *a, uint32_t i, double *weights, uint32_t *first)
{
    const double middle = (i + 0.5) * a->step;
    const double begin = fmax(0.0, floor(middle - a->reach - 0.5)),
                 end = fmin(a->from, ceil(middle + a->reach + 0.5));
    double sum = 0.0;
    uint32_t count = 0;
    for (double pixel = begin; pixel < end; pixel += 1.0) {
        const double weight = weight_of(a, middle, pixel);
        if (count == 0 && weight == 0.0)
            continue;
        if (count == 0)
            *first = (uint32_t)pixel;
        weights[count++] = weight;
        sum += weight;
    }
    while (count > 1 && weights[count - 1] == 0.0)
        count--;
    for (uint32_t k = 0; k < count; k++)
        weights[k] /= sum;
    return count;
}

static uint32_t largest_of(const double *weights, uint32_t count)
{
    uint32_t largest = 0;
    for (uint32_t k = 1; k < count; k++)
        if (weights[k] > weights[largest])
            largest = k;
    return largest;
}

static void put_word(tl_taps *out, size_t at, uint32_t word)
{
    memcpy(&out->numbers[at], &word, sizeof word);
}

static uint32_t word_of(const tl_taps *of, size_t at)
{
    uint32_t word;
    memcpy(&word, &of->numbers[at], sizeof word);
    return word;
}

size_t tl_taps_size(const tl_taps *taps)
{
    return (size_t)taps->padded * (2 + taps->taps);
}

uint32_t tl_taps_first(const tl_taps *taps, uint32_t i)
{
    return word_of(taps, i);
}

uint32_t tl_taps_middle(const tl_taps *taps, uint32_t i)
{
    return word_of(taps, (size_t)taps->padded + i);
}

static float *weight_at(tl_taps *out, uint32_t tap, uint32_t i)
{
    return &out->numbers[(size_t)out->padded * (2 + tap) + i];
}

/* Taps of a pixel, moved so that all are in the axis, and those of its mirror image. */
static void put(tl_taps *out,
                uint32_t from,
                uint32_t i,
                const double *weights,
                uint32_t count,
                uint32_t first)
{
    const uint32_t last = from - out->taps, begin = first < last ? first : last;
    const uint32_t mirrored = out->count - 1 - i, middle = first + largest_of(weights, count);
    put_word(out, i, begin);
    put_word(out, (size_t)out->padded + i, middle);
    for (uint32_t k = 0; k < count; k++)
        *weight_at(out, first + k - begin, i) = (float)weights[k];
    if (mirrored == i)
        return;
    put_word(out, mirrored, from - begin - out->taps);
    put_word(out, (size_t)out->padded + mirrored, from - 1 - middle);
    for (uint32_t k = 0; k < count; k++)
        *weight_at(out, out->taps - 1 - (first + k - begin), mirrored) = (float)weights[k];
}

/* The most taps that a pixel has. */
static uint32_t most_taps(const axis *a, uint32_t half, double *weights)
{
    uint32_t most = 0, first = 0;
    for (uint32_t i = 0; i < half; i++) {
        const uint32_t count = weigh(a, i, weights, &first);
        most = count > most ? count : most;
    }
    return most;
}

tl_status tl_taps_make(
    tl_filter filter, uint32_t from, uint32_t to, tl_taps *out, tl_error *err)
{
    const axis a = axis_of(filter, from, to);
    const uint32_t half = (to + 1) / 2;
    double *weights = calloc((size_t)ceil(2.0 * a.reach) + 4, sizeof *weights);
    uint32_t first = 0;
    *out = (tl_taps){.count = to, .padded = (to + 63) / 64 * 64};
    if (weights) {
        out->taps = most_taps(&a, half, weights);
        out->numbers = calloc(tl_taps_size(out), sizeof *out->numbers);
    }
    for (uint32_t i = 0; out->numbers && i < half; i++) {
        const uint32_t count = weigh(&a, i, weights, &first);
        put(out, from, i, weights, count, first);
    }
    free(weights);
    return out->numbers
               ? TL_OK
               : tl_fail(err, TL_ERR_MEMORY, "out of memory for the weights of a filter");
}

void tl_taps_clear(tl_taps *taps)
{
    free(taps->numbers);
    *taps = (tl_taps){0};
}
