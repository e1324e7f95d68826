#include "tilelight/compare.h"

#include "parallel.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The 99.9th percentile is selected by digits, the highest first: a pass over the picture counts
 * how many differences have each value of a digit among those that share the digits before it.
 * Non-negative doubles are ordered as their bits are. Exact, in constant memory. */
enum { DIGIT_BITS = 16, DIGITS = 64 / DIGIT_BITS, DIGIT_VALUES = 1 << DIGIT_BITS };

/* Of one row; added in the order of rows, so that no sum depends on the threads. */
typedef struct row_sums {
    double sum, squares, value_sum; /* of |a - b|, its square, b */
    double max, peak;               /* of |a - b|, b */
    uint64_t different_count, not_finite_count, finite_count;
    uint32_t worst_x, worst_channel;
} row_sums;

typedef struct compare_job {
    const tl_image *a, *b;
    row_sums *rows; /* [height] */
} compare_job;

static double difference(float a, float b)
{
    if (!isfinite(a) || !isfinite(b))
        return INFINITY;
    return fabs((double)a - (double)b);
}

static void add_value(row_sums *row, float a, float b, uint32_t x, uint32_t channel)
{
    const double d = difference(a, b);
    row->sum += d;
    row->squares += d * d;
    row->different_count += memcmp(&a, &b, sizeof a) != 0;
    row->not_finite_count += isinf(d) != 0;
    if (isfinite(b)) {
        row->value_sum += (double)b;
        row->peak = fmax(row->peak, (double)b);
        row->finite_count++;
    }
    if (d > row->max) {
        row->max = d;
        row->worst_x = x;
        row->worst_channel = channel;
    }
}

static const float *row_of(const tl_image *image, uint32_t channel, size_t y)
{
    return tl_image_plane(image, channel) + y * image->pitch;
}

static void compare_rows(void *context, size_t begin, size_t end)
{
    const compare_job *job = context;
    for (size_t y = begin; y < end; y++) {
        row_sums row = {0};
        for (uint32_t channel = 0; channel < 3; channel++) {
            const float *a = row_of(job->a, channel, y), *b = row_of(job->b, channel, y);
            for (uint32_t x = 0; x < job->a->width; x++)
                add_value(&row, a[x], b[x], x, channel);
        }
        job->rows[y] = row;
    }
}

static void add_row(row_sums *total, const row_sums *row)
{
    total->sum += row->sum;
    total->squares += row->squares;
    total->value_sum += row->value_sum;
    total->peak = fmax(total->peak, row->peak);
    total->different_count += row->different_count;
    total->not_finite_count += row->not_finite_count;
    total->finite_count += row->finite_count;
}

/* The difference that `rank` values, counted from 1, are not above. digits: [DIGIT_VALUES]. */
static double select_rank(const tl_image *a, const tl_image *b, uint64_t rank, uint64_t *digits)
{
    uint64_t prefix = 0;
    for (int digit = DIGITS - 1; digit >= 0; digit--) {
        const int shift = digit * DIGIT_BITS;
        uint32_t chosen = 0;
        memset(digits, 0, DIGIT_VALUES * sizeof *digits);
        for (size_t y = 0; y < 3 * (size_t)a->height; y++) {
            const float *row_a = row_of(a, (uint32_t)(y / a->height), y % a->height);
            const float *row_b = row_of(b, (uint32_t)(y / a->height), y % a->height);
            for (uint32_t x = 0; x < a->width; x++) {
                const double d = difference(row_a[x], row_b[x]);
                uint64_t bits;
                memcpy(&bits, &d, sizeof bits);
                if (digit == DIGITS - 1 || bits >> (shift + DIGIT_BITS) == prefix)
                    digits[bits >> shift & (DIGIT_VALUES - 1)]++;
            }
        }
        while (rank > digits[chosen])
            rank -= digits[chosen++];
        prefix = prefix << DIGIT_BITS | chosen;
    }
    double selected;
    memcpy(&selected, &prefix, sizeof selected);
    return selected;
}

static double relative(double error, double mean)
{
    return error == 0.0 ? 0.0 : error / fabs(mean);
}

static double decibels(double rms, double peak)
{
    return rms == 0.0 ? (double)INFINITY : 20.0 * log10(peak / rms);
}

static tl_difference summarise(const compare_job *job, uint64_t *digits)
{
    const tl_image *a = job->a, *b = job->b;
    const uint64_t count = 3 * (uint64_t)a->width * a->height;
    tl_difference out = {0};
    row_sums total = {0};
    for (uint32_t y = 0; y < a->height; y++) {
        add_row(&total, &job->rows[y]);
        if (job->rows[y].max > out.max) {
            out.max = job->rows[y].max;
            out.worst_x = job->rows[y].worst_x;
            out.worst_y = y;
            out.worst_channel = job->rows[y].worst_channel;
        }
    }
    out.worst_a = row_of(a, out.worst_channel, out.worst_y)[out.worst_x];
    out.worst_b = row_of(b, out.worst_channel, out.worst_y)[out.worst_x];
    out.mean_value = total.finite_count ? total.value_sum / (double)total.finite_count : 0.0;
    out.mean = total.sum / (double)count;
    out.rms = sqrt(total.squares / (double)count);
    out.p999 = out.max > 0.0 ? select_rank(a, b, count - count / 1000, digits) : 0.0;
    out.relative_max = relative(out.max, out.mean_value);
    out.relative_mean = relative(out.mean, out.mean_value);
    out.relative_rms = relative(out.rms, out.mean_value);
    out.relative_p999 = relative(out.p999, out.mean_value);
    out.psnr = decibels(out.rms, total.peak);
    out.different_count = total.different_count;
    out.not_finite_count = total.not_finite_count;
    return out;
}

tl_status tl_compare(const tl_image *a, const tl_image *b, tl_difference *out, tl_error *err)
{
    tl_status status = TL_OK;
    compare_job job = {a, b, NULL};
    uint64_t *digits = NULL;

    if (a->width != b->width || a->height != b->height)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "pictures of %u x %u and %u x %u pixels cannot be compared", a->width,
                    a->height, b->width, b->height));
    job.rows = calloc(a->height, sizeof *job.rows);
    digits = malloc(DIGIT_VALUES * sizeof *digits);
    if (!job.rows || !digits)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for comparing pictures"));
    tl_parallel(a->height, 16, compare_rows, &job);
    *out = summarise(&job, digits);
done:
    free(digits);
    free(job.rows);
    return status;
}
