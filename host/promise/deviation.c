/* The squares of what the channels of a picture a are off from the reference b, e_p = sum_c (a - b)^2, are
 * summed over the picture. Strata that were taken whole give their part exactly. Of a stratum of N pixels of
 * which n were drawn, each stands for N/n, so the expectation of
 *
 *     S = sum over drawn p of (N/n) e_p
 *
 * is the sum over all pixels of these strata, and bound.c bounds it from S and from the largest number that a
 * pixel may add to it. That number is where something is assumed, for no sample tells it: a pixel that was
 * not drawn is taken to be off by no more than `unseen` times as much as the worst that was drawn, in
 * proportion to the light that it has and that the picture has in the mean:
 *
 *     |a - b| <= peak (|a| + mean),  peak = unseen max over drawn p of |a - b| / (|a| + mean).
 *
 * What makes it a fair one: pixels that may be off by far more than others are found by looking at all of
 * them (rims.h) and are not drawn but taken; what is left are multiples of rounding or of what an
 * approximation is off by, times the light that the pixel has, and tiles where that is most are taken whole.
 *
 * mean is that of the picture. That of the reference is no less than mean - rms, for the mean of differences
 * is no more than the root of the mean of their squares. */
#include "deviation.h"

#include "bound.h"
#include "brightness.h"

#include <math.h>
#include <stdlib.h>

static const double unseen = 4.0;

/* A picture is made of floats: no sample shows that no pixel is off by the last bit. */
static const double last_bit = 0x1p-23;

/* Of the drawn pixel i: the square of what it is off by, and that as a share of its light and the mean's. */
typedef struct off {
    double square, share;
} off;

static off off_of(const tl_sample *sample, const tl_image *image, double mean, size_t i)
{
    const tl_pixel_at at = sample->at[i];
    const double light = tl_brightness(image, at.x, at.y) + mean;
    double square = 0.0;
    for (unsigned c = 0; c < 3; c++) {
        const float got = tl_image_plane(image, c)[(size_t)at.y * image->pitch + at.x];
        const double d = (double)got - (double)sample->reference[i][c];
        square += d * d;
    }
    if (!isfinite(square))
        return (off){(double)INFINITY, (double)INFINITY};
    if (square > 0.0 && !(light > 0.0))
        return (off){square, (double)INFINITY};
    return (off){square, square > 0.0 ? sqrt(square) / light : 0.0};
}

static double weight_of(tl_stratum s)
{
    return s.drawn > 0 ? (double)s.size / s.drawn : 0.0;
}

/* Over strata that were not taken whole. peaks: of pixels beside rims, and at them. */
static double most_of(const tl_sample *sample,
                      const double *brightest,
                      double mean,
                      const double peaks[2])
{
    const uint32_t tiles = sample->stratum_count - 1;
    double most = 0.0, brightest_of_all = 0.0;
    for (uint32_t i = 0; i < tiles; i++) {
        const tl_stratum s = sample->strata[i];
        const double off_by = peaks[0] * (brightest[i] + mean);
        brightest_of_all = fmax(brightest_of_all, brightest[i]);
        if (s.drawn < s.size)
            most = fmax(most, weight_of(s) * off_by * off_by);
    }
    const tl_stratum rims = sample->strata[tiles];
    const double off_by = peaks[1] * (brightest_of_all + mean);
    return rims.drawn < rims.size ? fmax(most, weight_of(rims) * off_by * off_by) : most;
}

tl_status tl_deviation_find(const tl_sample *sample,
                            const tl_image *image,
                            tl_deviation *out,
                            tl_error *err)
{
    const uint32_t tiles = sample->stratum_count - 1;
    double *brightest = malloc(tiles * sizeof *brightest);
    double peaks[2] = {unseen * last_bit, unseen * last_bit};
    if (!brightest)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a check of %u tiles", tiles);
    *out = (tl_deviation){.mean = tl_mean_brightness(image)};
    tl_brightest_of_tiles(image, TL_RIM_TILE, brightest);
    for (size_t i = 0; i < sample->count; i++) {
        const tl_stratum s = sample->strata[sample->stratum[i]];
        double *peak = &peaks[sample->stratum[i] == tiles];
        const off o = off_of(sample, image, out->mean, i);
        if (s.drawn == s.size)
            out->exact += o.square;
        else
            out->drawn += weight_of(s) * o.square;
        *peak = fmax(*peak, unseen * o.share);
    }
    const tl_stratum rims = sample->strata[tiles];
    out->most = most_of(sample, brightest, out->mean, peaks);
    out->peak = rims.drawn < rims.size ? fmax(peaks[0], peaks[1]) : peaks[0];
    free(brightest);
    return TL_OK;
}

static double relative(double rms, double mean)
{
    if (rms == 0.0)
        return 0.0;
    return mean > 0.0 ? rms / mean : (double)INFINITY;
}

tl_estimate tl_deviation_rms(const tl_sample *sample, const tl_deviation *of, double doubt)
{
    const double values = 3.0 * (double)sample->width * sample->height;
    const double seen = sqrt((of->exact + of->drawn) / values);
    const double bound = sqrt((of->exact + tl_sum_bound(of->drawn, of->most, doubt)) / values);
    return (tl_estimate){relative(seen, of->mean), relative(bound, of->mean - bound)};
}
