/* A picture is taken in strips of rows, each with the rows beside it that filters reach, by one
 * thread: what a thread works in does not grow with the height, and each strip goes through all
 * exposures while it is at hand. */
#include "tilelight/flip.h"

#include "flip_color.h"
#include "flip_exposures.h"
#include "flip_filters.h"
#include "parallel.h"
#include "srgb.h"
#include "try.h"

#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { STRIP_ROWS = 64 };

/* What filters give of a picture. Lightness and the two colours of the opponent space come first,
 * in that order. */
enum { SEEN_Y, SEEN_X, SEEN_Z, EDGE_ACROSS, EDGE_DOWN, POINT_ACROSS, POINT_DOWN, RESULT_COUNT };

/* A filter: of which plane, along both axes, to which result it adds. */
typedef struct pass {
    int plane, result, radius;
    const flip_taps *across, *down;
} pass;

enum { PASS_COUNT = 8 };

/* Andersson et al. 2020, sections 4.1.3 and 4.2.2. */
static const float color_power = 0.7f, feature_power = 0.5f;
static const float part_of_most = 0.4f, part_of_scale = 0.95f;

/* Of one strip. */
typedef struct strip_sum {
    double sum;
    float max;
    uint32_t worst_x, worst_y;
} strip_sum;

typedef struct flip_job {
    const tl_image *pictures[2]; /* seen, reference */
    tl_flip_range range;
    flip_exposures exposures;
    flip_filters filters;
    pass passes[PASS_COUNT];
    float most; /* the largest difference of colours there is, to color_power */
    float *map;
    strip_sum *strips;
    atomic_int out_of_memory;
} flip_job;

/* What a thread works in. Rows of `opponent` reach `radius` beyond the strip on all sides. */
typedef struct strip {
    uint32_t width, rows, radius, stride; /* stride: width + 2 radius */
    float *opponent;                      /* [3][STRIP_ROWS + 2 radius][stride] */
    float *across;                        /* [STRIP_ROWS + 2 radius][width] */
    float *results[2];                    /* [RESULT_COUNT][STRIP_ROWS][width] */
    float *differences;                   /* [STRIP_ROWS][width], the largest so far */
} strip;

static size_t reach_rows(const strip *s)
{
    return STRIP_ROWS + 2 * (size_t)s->radius;
}

static size_t result_count(const strip *s)
{
    return (size_t)RESULT_COUNT * STRIP_ROWS * s->width;
}

static int strip_alloc(const flip_job *job, strip *s)
{
    const int radius = job->filters.eye_radius > job->filters.feature_radius
                           ? job->filters.eye_radius
                           : job->filters.feature_radius;
    *s = (strip){.width = job->pictures[0]->width, .radius = (uint32_t)radius};
    s->stride = s->width + 2 * s->radius;
    s->opponent = malloc(3 * reach_rows(s) * s->stride * sizeof(float));
    s->across = malloc(reach_rows(s) * s->width * sizeof(float));
    s->results[0] = malloc(result_count(s) * sizeof(float));
    s->results[1] = malloc(result_count(s) * sizeof(float));
    s->differences = malloc((size_t)STRIP_ROWS * s->width * sizeof(float));
    return s->opponent && s->across && s->results[0] && s->results[1] && s->differences;
}

static void strip_free(strip *s)
{
    free(s->differences);
    free(s->results[1]);
    free(s->results[0]);
    free(s->across);
    free(s->opponent);
}

static uint32_t clamp_index(int64_t at, uint32_t count)
{
    return at < 0 ? 0 : at >= (int64_t)count ? count - 1 : (uint32_t)at;
}

static float linear_of(const flip_job *job, float value, float scale)
{
    if (job->range == TL_FLIP_RADIANCE)
        return flip_tone(value, scale);
    return (float)tl_linear_from_srgb((double)flip_clamp(value));
}

/* A row of the picture in the opponent space, its ends repeated outwards. to: row of plane 0. */
static void fill_row(
    const flip_job *job, const tl_image *picture, uint32_t y, float scale, strip *s, float *to)
{
    const size_t plane = reach_rows(s) * s->stride;
    const float *from[3];
    for (unsigned i = 0; i < 3; i++)
        from[i] = tl_image_plane(picture, i) + (size_t)y * picture->pitch;
    for (uint32_t x = 0; x < s->width; x++) {
        flip_color rgb;
        for (int i = 0; i < 3; i++)
            rgb.of[i] = linear_of(job, from[i][x], scale);
        const flip_color c = flip_opponent(rgb);
        for (size_t i = 0; i < 3; i++)
            to[i * plane + s->radius + x] = c.of[i];
    }
    for (size_t i = 0; i < 3; i++)
        for (uint32_t x = 0; x < s->radius; x++) {
            to[i * plane + x] = to[i * plane + s->radius];
            to[i * plane + s->radius + s->width + x] = to[i * plane + s->radius + s->width - 1];
        }
}

static void fill_strip(
    const flip_job *job, const tl_image *picture, uint32_t top, float scale, strip *s)
{
    for (uint32_t i = 0; i < s->rows + 2 * s->radius; i++) {
        const uint32_t y = clamp_index((int64_t)top + i - s->radius, picture->height);
        fill_row(job, picture, y, scale, s, s->opponent + (size_t)i * s->stride);
    }
}

/* out[x] = sum of taps over row[x + i]: the sum over taps outside, that over pixels inside. */
static void filter_across(const float *row, const pass *p, uint32_t width, float *out)
{
    memset(out, 0, width * sizeof *out);
    for (int i = 0; i <= 2 * p->radius; i++) {
        const float tap = p->across->taps[i];
        for (uint32_t x = 0; x < width; x++)
            out[x] += tap * row[x + (uint32_t)i];
    }
}

static void filter_down(const float *rows, const pass *p, uint32_t width, float *out)
{
    for (int i = 0; i <= 2 * p->radius; i++) {
        const float tap = p->down->taps[i];
        for (uint32_t x = 0; x < width; x++)
            out[x] += tap * rows[(size_t)i * width + x];
    }
}

static void run_pass(const pass *p, strip *s, float *results)
{
    const uint32_t inset = s->radius - (uint32_t)p->radius;
    const float *plane =
        s->opponent + (size_t)p->plane * reach_rows(s) * s->stride + (size_t)inset * s->stride;
    float *out = results + (size_t)p->result * STRIP_ROWS * s->width;
    for (uint32_t i = 0; i < s->rows + 2 * (uint32_t)p->radius; i++)
        filter_across(plane + (size_t)i * s->stride + inset, p, s->width,
                      s->across + (size_t)i * s->width);
    for (uint32_t y = 0; y < s->rows; y++)
        filter_down(s->across + (size_t)y * s->width, p, s->width, out + (size_t)y * s->width);
}

static flip_color seen_color(const float *results, size_t plane, size_t at)
{
    const flip_color c = {
        {results[at], results[SEEN_X * plane + at], results[SEEN_Z * plane + at]}};
    flip_color rgb = flip_rgb_of_opponent(c);
    for (int i = 0; i < 3; i++)
        rgb.of[i] = flip_clamp(rgb.of[i]);
    return flip_hunt_lab(rgb);
}

/* Section 4.1.3: most differences of colours are small, so these get most of the scale. */
static float spread(float difference, float most)
{
    const float power = powf(difference, color_power), knee = part_of_most * most;
    if (power < knee)
        return part_of_scale / knee * power;
    return part_of_scale + (power - knee) / (most - knee) * (1.0f - part_of_scale);
}

/* How much of a feature there is: across and down together. */
static float strength(const float *results, size_t plane, int across, size_t at)
{
    const float a = results[(size_t)across * plane + at];
    const float d = results[((size_t)across + 1) * plane + at];
    return sqrtf(a * a + d * d);
}

static float feature_difference(float *const results[2], size_t plane, size_t at)
{
    float most = 0.0f;
    for (int across = EDGE_ACROSS; across <= POINT_ACROSS; across += 2)
        most = fmaxf(most, fabsf(strength(results[0], plane, across, at) -
                                 strength(results[1], plane, across, at)));
    /* Lightness is 116 times what features are measured of; sqrt(1/2) brings both axes to 1. */
    return powf(most / 116.0f * 0.707106781f, feature_power);
}

static void add_differences(const flip_job *job, strip *s)
{
    const size_t plane = (size_t)STRIP_ROWS * s->width;
    for (size_t at = 0; at < (size_t)s->rows * s->width; at++) {
        const float color = spread(flip_hyab(seen_color(s->results[0], plane, at),
                                             seen_color(s->results[1], plane, at)),
                                   job->most);
        const float all = powf(color, 1.0f - feature_difference(s->results, plane, at));
        s->differences[at] = fmaxf(s->differences[at], all);
    }
}

static void compare_at(const flip_job *job, uint32_t top, float scale, strip *s)
{
    for (int i = 0; i < 2; i++) {
        fill_strip(job, job->pictures[i], top, scale, s);
        memset(s->results[i], 0, result_count(s) * sizeof(float));
        for (int p = 0; p < PASS_COUNT; p++)
            run_pass(&job->passes[p], s, s->results[i]);
    }
    add_differences(job, s);
}

static strip_sum sum_strip(const flip_job *job, uint32_t top, const strip *s)
{
    strip_sum out = {.worst_y = top};
    for (uint32_t y = 0; y < s->rows; y++)
        for (uint32_t x = 0; x < s->width; x++) {
            const float d = s->differences[(size_t)y * s->width + x];
            out.sum += (double)d;
            if (d > out.max) {
                out.max = d;
                out.worst_x = x;
                out.worst_y = top + y;
            }
        }
    if (job->map)
        memcpy(job->map + (size_t)top * s->width, s->differences,
               (size_t)s->rows * s->width * sizeof(float));
    return out;
}

static void compare_strips(void *context, size_t begin, size_t end)
{
    flip_job *job = context;
    const uint32_t height = job->pictures[0]->height;
    const uint32_t shown = job->range == TL_FLIP_SCREEN ? 1 : job->exposures.count;
    const double step =
        shown > 1 ? (job->exposures.last - job->exposures.first) / (shown - 1) : 0.0;
    strip s;
    if (!strip_alloc(job, &s))
        atomic_store(&job->out_of_memory, 1);
    for (size_t i = begin; i < end && !atomic_load(&job->out_of_memory); i++) {
        const uint32_t top = (uint32_t)i * STRIP_ROWS;
        s.rows = height - top < STRIP_ROWS ? height - top : STRIP_ROWS;
        memset(s.differences, 0, (size_t)s.rows * s.width * sizeof(float));
        for (uint32_t e = 0; e < shown; e++)
            compare_at(job, top, (float)exp2(job->exposures.first + e * step), &s);
        job->strips[i] = sum_strip(job, top, &s);
    }
    strip_free(&s);
}

/* By the job's filters, into which they point. */
static void list_passes(flip_job *job)
{
    const flip_filters *f = &job->filters;
    const int eye = f->eye_radius, feature = f->feature_radius;
    const pass passes[PASS_COUNT] = {
        {0, SEEN_Y, eye, &f->across_eye[FLIP_LIGHTNESS], &f->down_eye[FLIP_LIGHTNESS]},
        {1, SEEN_X, eye, &f->across_eye[FLIP_RED_GREEN], &f->down_eye[FLIP_RED_GREEN]},
        {2, SEEN_Z, eye, &f->across_eye[FLIP_BLUE_YELLOW], &f->down_eye[FLIP_BLUE_YELLOW]},
        {2, SEEN_Z, eye, &f->across_eye[FLIP_BLUE_YELLOW_NARROW],
         &f->down_eye[FLIP_BLUE_YELLOW_NARROW]},
        {0, EDGE_ACROSS, feature, &f->edge, &f->smooth},
        {0, EDGE_DOWN, feature, &f->smooth, &f->edge},
        {0, POINT_ACROSS, feature, &f->point, &f->smooth},
        {0, POINT_DOWN, feature, &f->smooth, &f->point},
    };
    memcpy(job->passes, passes, sizeof passes);
}

static void prepare(flip_job *job, double pixels_per_degree)
{
    static const flip_color green = {{0.0f, 1.0f, 0.0f}}, blue = {{0.0f, 0.0f, 1.0f}};
    flip_filters_make(pixels_per_degree, &job->filters);
    list_passes(job);
    job->most = powf(flip_hyab(flip_hunt_lab(green), flip_hunt_lab(blue)), color_power);
}

static tl_flip summarise(const flip_job *job, uint32_t strip_count)
{
    const double pixels = (double)job->pictures[0]->width * job->pictures[0]->height;
    tl_flip out = {.first_exposure = job->exposures.first,
                   .last_exposure = job->exposures.last,
                   .exposure_count = job->exposures.count};
    for (uint32_t i = 0; i < strip_count; i++) {
        out.mean += job->strips[i].sum;
        if ((double)job->strips[i].max > out.max) {
            out.max = (double)job->strips[i].max;
            out.worst_x = job->strips[i].worst_x;
            out.worst_y = job->strips[i].worst_y;
        }
    }
    out.mean /= pixels;
    return out;
}

tl_status tl_flip_compare(const tl_image *seen,
                          const tl_image *reference,
                          tl_flip_range range,
                          double pixels_per_degree,
                          float *map,
                          tl_flip *out,
                          tl_error *err)
{
    assert(pixels_per_degree >= 1.0 && pixels_per_degree <= 1000.0);
    tl_status status = TL_OK;
    flip_job job = {.pictures = {seen, reference}, .range = range, .map = map};
    const uint32_t strip_count = (seen->height + STRIP_ROWS - 1) / STRIP_ROWS;

    if (seen->width != reference->width || seen->height != reference->height)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "pictures of %u x %u and %u x %u pixels cannot be compared", seen->width,
                    seen->height, reference->width, reference->height));
    if (range == TL_FLIP_RADIANCE)
        TRY(flip_exposures_find(reference, &job.exposures, err));
    prepare(&job, pixels_per_degree);
    job.strips = calloc(strip_count, sizeof *job.strips);
    if (job.strips)
        tl_parallel(strip_count, 1, compare_strips, &job);
    if (!job.strips || atomic_load(&job.out_of_memory))
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for comparing pictures"));
    *out = summarise(&job, strip_count);
done:
    free(job.strips);
    return status;
}
