/* Every step is +, -, *, / or sqrt in double, rounded the same everywhere: no function of the C
 * library whose last bit could differ from machine to machine. */
#include "tilelight/scatter.h"

#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

/* How many visible pixels the range is measured at, and how many distances that may come to:
 * beyond 16384 lights fewer pixels do, so that memory stays at 64 MB. */
enum { MOST_SAMPLES = 1000, MOST_DISTANCES = 1 << 24 };

/* A light stands off its surface by this share of its range. */
static const double least_lift = 0.05, most_lift = 0.6;

/* What a light of intensity 1 and range 1 m gives a white surface, on average over the disc of
 * radius 1 m around its foot and over the lifts: the mean of fade(d) h/d with h the lift, d the
 * distance, by numeric integration of kernels/falloff.h's formulas. */
static const struct {
    double mean;
    int per_range2; /* the fade is in 1/m^2, so it shrinks with the square of the range */
} fades[] = {
    [TL_FALLOFF_INVERSE_SQUARE] = {1.150, 1},
    [TL_FALLOFF_LINEAR] = {0.122, 0},
};
static const double mean_hue_channel = 0.5; /* of a bright pure hue, over all hues */
static const double wanted_light = 0.5;     /* per channel, on a white surface */

/* SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014,
 * figure 17. */
static uint64_t random_bits(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

/* In [0, 1), all 53 bits. */
static double random_share(uint64_t *state)
{
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* In [0, count), count up to 2^32: biased by 2^-32 of a share at most. */
static uint64_t random_below(uint64_t *state, uint64_t count)
{
    return (random_bits(state) >> 32) * count >> 32;
}

typedef struct point {
    double position[3]; /* world, m */
} point;

/* Where lights can stand: the pixels that something was hit in. */
typedef struct surfaces {
    const tl_gbuffer *gbuffer;
    const float *depth;
    uint32_t *visible; /* [count], row by row: indices into a plane */
    size_t count;
    double largest; /* surface area that a pixel shows, at most; see area_of */
} surfaces;

/* As kernels see it: on the ray through the pixel's centre. */
static point surface_point(const surfaces *s, size_t pixel)
{
    const tl_camera *c = &s->gbuffer->camera;
    const double column = (double)(pixel % s->gbuffer->pitch) + 0.5;
    const double row = (double)(pixel / s->gbuffer->pitch) + 0.5;
    const double depth = (double)s->depth[pixel];
    const double spread = c->projection == TL_PERSPECTIVE ? depth : 1.0;
    const double left = (double)c->left, right = (double)c->right;
    const double bottom = (double)c->bottom, top = (double)c->top;
    const double view[3] = {(left + (right - left) * column / (double)c->width) * spread,
                            (top - (top - bottom) * row / (double)c->height) * spread, -depth};
    point p;
    tl_camera_world_point(c, view, p.position);
    return p;
}

/* Unit; 0 where the surface has none. */
static point surface_normal(const surfaces *s, size_t pixel)
{
    point n;
    double length2 = 0.0;
    for (unsigned axis = 0; axis < 3; axis++) {
        n.position[axis] = (double)tl_gbuffer_plane(s->gbuffer, TL_NORMAL_X + axis)[pixel];
        length2 += n.position[axis] * n.position[axis];
    }
    for (unsigned axis = 0; axis < 3 && length2 > 0.0; axis++)
        n.position[axis] /= sqrt(length2);
    return n;
}

/* The surface that a pixel shows, up to the frame's constant: depth^2 / |n . ray|, the ray as long as
 * its depth of 1 makes it. A surface seen edge-on counts as one at 3 degrees. */
static double area_of(const surfaces *s, size_t pixel)
{
    const tl_camera *c = &s->gbuffer->camera;
    const int parallel = c->projection == TL_ORTHOGRAPHIC;
    const double depth = parallel ? 1.0 : (double)s->depth[pixel];
    const double column = (double)(pixel % s->gbuffer->pitch) + 0.5;
    const double row = (double)(pixel / s->gbuffer->pitch) + 0.5;
    const double left = (double)c->left, right = (double)c->right;
    const double bottom = (double)c->bottom, top = (double)c->top;
    const double ray[3] = {parallel ? 0.0 : left + (right - left) * column / (double)c->width,
                           parallel ? 0.0 : top - (top - bottom) * row / (double)c->height,
                           -1.0};
    const point n = surface_normal(s, pixel);
    double world[3], cosine = 0.0, length2 = 0.0;
    tl_camera_world_direction(c, ray, world);
    for (int axis = 0; axis < 3; axis++) {
        cosine += n.position[axis] * world[axis];
        length2 += world[axis] * world[axis];
    }
    const double least = 0.05 * sqrt(length2);
    return depth * depth / (fabs(cosine) > least ? fabs(cosine) : least);
}

static size_t random_pixel(const surfaces *s, uint64_t *state)
{
    return s->visible[random_below(state, s->count)];
}

/* A pixel as likely as the surface it shows is large: lights are spread evenly over surfaces, not over
 * the picture, where near ones would get most. By rejection; a frame of which one pixel shows nearly
 * everything is not waited for. */
static size_t random_foot(const surfaces *s, uint64_t *state)
{
    enum { MOST_TRIES = 256 };
    size_t pixel = random_pixel(s, state);
    for (int i = 1; i < MOST_TRIES; i++) {
        const double area = area_of(s, pixel);
        if (area >= s->largest || random_share(state) * s->largest < area)
            break;
        pixel = random_pixel(s, state);
    }
    return pixel;
}

static tl_status find_surfaces(surfaces *s, const tl_gbuffer *gbuffer, tl_error *err)
{
    const tl_camera *camera = &gbuffer->camera;
    *s = (surfaces){.gbuffer = gbuffer, .depth = tl_gbuffer_plane(gbuffer, TL_DEPTH)};
    s->visible = malloc((size_t)camera->width * camera->height * sizeof *s->visible);
    if (!s->visible)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for scattering lights");
    for (size_t y = 0; y < camera->height; y++)
        for (size_t x = 0; x < camera->width; x++) {
            const size_t pixel = y * gbuffer->pitch + x;
            if (!isfinite(s->depth[pixel]))
                continue;
            const double area = area_of(s, pixel);
            s->largest = area > s->largest ? area : s->largest;
            s->visible[s->count++] = (uint32_t)pixel;
        }
    if (s->count > 0)
        return TL_OK;
    return tl_fail(err, TL_ERR_ARGUMENT,
                   "the frame is all sky: there is no surface to scatter lights on");
}

static double distance2(const point *a, const point *b)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double d = a->position[axis] - b->position[axis];
        sum += d * d;
    }
    return sum;
}

/* Moves the value of `rank`, counted from 0, to its place, smaller ones before it. Hoare, "Find",
 * CACM 4 (1961). */
static float select_rank(float *values, size_t count, size_t rank)
{
    size_t first = 0, last = count - 1;
    while (first < last) {
        const float pivot = values[first + (last - first) / 2];
        size_t i = first, j = last;
        for (;;) {
            while (values[i] < pivot)
                i++;
            while (pivot < values[j])
                j--;
            if (i >= j)
                break;
            const float swapped = values[i];
            values[i++] = values[j];
            values[j--] = swapped;
        }
        if (rank <= j)
            last = j;
        else
            first = j + 1;
    }
    return values[rank];
}

/* Distances from visible pixels to the lights' feet, sorted by nothing. */
typedef struct distances {
    size_t sample_count, count; /* count: samples times lights */
    float *values;              /* m */
} distances;

static tl_status measure(
    distances *out, const surfaces *s, const point *feet, uint32_t light_count, uint64_t seed)
{
    const size_t affordable = MOST_DISTANCES / light_count;
    uint64_t state = ~seed; /* not the sequence that placed the lights */
    out->sample_count = affordable < MOST_SAMPLES ? affordable + 1 : MOST_SAMPLES;
    out->count = out->sample_count * light_count;
    out->values = malloc(out->count * sizeof *out->values);
    if (!out->values)
        return TL_ERR_MEMORY;
    for (size_t sample = 0; sample < out->sample_count; sample++) {
        const point seen = surface_point(s, random_pixel(s, &state));
        for (size_t i = 0; i < light_count; i++)
            out->values[sample * light_count + i] = (float)sqrt(distance2(&seen, &feet[i]));
    }
    return TL_OK;
}

/* The range at which `overlap` feet lie within reach of a sample on average. Where so many share
 * their pixel that it would be 0, half the way to the next one; 1 m where there is but one. */
static float range_of_overlap(distances *d, float overlap)
{
    const double wanted = ceil((double)overlap * (double)d->sample_count);
    const double most = (double)d->count;
    const size_t rank = (size_t)(wanted < most ? wanted : most) - 1;
    float range = select_rank(d->values, d->count, rank);
    if (range > 0.0f)
        return range;
    range = INFINITY;
    for (size_t i = 0; i < d->count; i++)
        if (d->values[i] > 0.0f && d->values[i] < range)
            range = d->values[i];
    return isfinite(range) ? 0.5f * range : 1.0f;
}

static double overlap_of_range(const distances *d, float range)
{
    size_t within = 0;
    for (size_t i = 0; i < d->count; i++)
        within += d->values[i] <= range;
    return (double)within / (double)d->sample_count;
}

/* A pure hue, fully bright: round the edges of the colour cube from red over green to blue. */
static void hue_color(double hue, float color[3])
{
    const double sixth = 6.0 * hue;
    for (int i = 0; i < 3; i++) {
        const double around = fabs(sixth - 2.0 * i); /* from this primary, in sixths */
        const double away = around < 3.0 ? around : 6.0 - around;
        const double value = 2.0 - away;
        color[i] = (float)(value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value);
    }
}

static float default_intensity(tl_falloff falloff, float range, double overlap)
{
    const double area = fades[falloff].per_range2 ? (double)range * (double)range : 1.0;
    const double lights = overlap > 1.0 ? overlap : 1.0;
    return (float)(wanted_light * area / (lights * mean_hue_channel * fades[falloff].mean));
}

static tl_status check_options(const tl_scatter_options *options, tl_error *err)
{
    if (options->count < 1 || options->count > TL_MAX_SCATTERED)
        return tl_fail(err, TL_ERR_ARGUMENT, "%u lights cannot be scattered: 1 to %d",
                       options->count, TL_MAX_SCATTERED);
    if (!(options->overlap > 0.0f) || !isfinite(options->overlap))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "scattered lights with an overlap of %g: it must be above 0",
                       (double)options->overlap);
    if (!(options->range >= 0.0f) || !isfinite(options->range) ||
        !(options->intensity >= 0.0f) || !isfinite(options->intensity))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "scattered lights of range %g and intensity %g: both must be finite, 0 "
                       "(chosen) or above",
                       (double)options->range, (double)options->intensity);
    if (options->falloff >= TL_FALLOFF_TABLE)
        return tl_fail(err, TL_ERR_ARGUMENT, "scattered lights have no falloff table");
    return TL_OK;
}

tl_scatter_options tl_scatter_options_default(void)
{
    return (tl_scatter_options){
        .count = 1024, .seed = 1, .overlap = 12.0f, .falloff = TL_FALLOFF_LINEAR};
}

/* What all lights share: range, falloff, intensity. */
static tl_status choose_light(const tl_scatter_options *options,
                              const surfaces *s,
                              const point *feet,
                              tl_light *out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    distances d = {0};
    if (measure(&d, s, feet, options->count, options->seed) != TL_OK)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for scattering %u lights",
                    options->count));
    *out = tl_light_default();
    out->falloff = options->falloff;
    out->range =
        options->range > 0.0f ? options->range : range_of_overlap(&d, options->overlap);
    const double overlap =
        options->range > 0.0f ? overlap_of_range(&d, out->range) : (double)options->overlap;
    out->intensity = options->intensity > 0.0f
                         ? options->intensity
                         : default_intensity(out->falloff, out->range, overlap);
done:
    free(d.values);
    return status;
}

/* The feet first, then lifts and colours: the range stands between them. */
static tl_status place_lights(const tl_scatter_options *options,
                              const surfaces *s,
                              point *feet,
                              size_t *pixels,
                              tl_light_set *set,
                              tl_error *err)
{
    tl_status status = TL_OK;
    uint64_t state = options->seed;
    tl_light light;
    for (size_t i = 0; i < options->count; i++) {
        pixels[i] = random_foot(s, &state);
        feet[i] = surface_point(s, pixels[i]);
    }
    TRY(choose_light(options, s, feet, &light, err));
    for (size_t i = 0; i < options->count; i++) {
        const point normal = surface_normal(s, pixels[i]);
        const double share = least_lift + (most_lift - least_lift) * random_share(&state);
        const double lift = share * (double)light.range;
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] =
                (float)(feet[i].position[axis] + normal.position[axis] * lift);
        hue_color(random_share(&state), light.color);
        TRY(tl_light_set_add(set, &light, err));
    }
done:
    return status;
}

tl_status tl_scatter(const tl_gbuffer *gbuffer,
                     const tl_scatter_options *options,
                     tl_light_set *lights,
                     tl_error *err)
{
    tl_status status = TL_OK;
    const size_t count_before = lights->count;
    tl_gbuffer *unpacked = NULL;
    surfaces s = {0};
    point *feet = NULL;
    size_t *pixels = NULL;

    TRY(check_options(options, err));
    if (gbuffer->layout != TL_LAYOUT_FLOAT)
        TRY(tl_gbuffer_unpack(gbuffer, &unpacked, err));
    TRY(find_surfaces(&s, unpacked ? unpacked : gbuffer, err));
    feet = malloc(options->count * sizeof *feet);
    pixels = malloc(options->count * sizeof *pixels);
    if (!feet || !pixels)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for scattering %u lights",
                    options->count));
    TRY(place_lights(options, &s, feet, pixels, lights, err));
    TRY(tl_light_set_check(lights, "scattered lights", err));
done:
    if (status != TL_OK)
        lights->count = count_before;
    free(pixels);
    free(feet);
    free(s.visible);
    tl_gbuffer_destroy(unpacked);
    return status;
}
