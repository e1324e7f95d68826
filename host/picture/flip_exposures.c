#include "flip_exposures.h"

#include "try.h"

#include <math.h>
#include <stdlib.h>

/* The fit of K. Narkowicz ("ACES Filmic Tone Mapping Curve", 2016) as the paper takes it, behind an
 * exposure of 0.6: (k0 x^2 + k1 x)/(k3 x^2 + k4 x + k5). */
static const double k0 = 0.36 * 2.51, k1 = 0.6 * 0.03, k3 = 0.36 * 2.43, k4 = 0.6 * 0.59,
                    k5 = 0.14;
static const double shown_as = 0.85;

float flip_tone(float radiance, float scale)
{
    /* The curve is 1 from 12.07 on. */
    const float x = fminf(radiance > 0.0f ? radiance * scale : 0.0f, 16.0f);
    const float y =
        x * ((float)k0 * x + (float)k1) / (x * ((float)k3 * x + (float)k4) + (float)k5);
    return y < 1.0f ? y : 1.0f;
}

/* What the curve takes to 0.85: the larger root of a square. */
static double shown_radiance(void)
{
    const double a = k0 - shown_as * k3, b = k1 - shown_as * k4, c = -shown_as * k5;
    const double half = -0.5 * b / a;
    return half + sqrt(half * half - c / a);
}

static int ascending(const void *a, const void *b)
{
    const float left = *(const float *)a, right = *(const float *)b;
    return (left > right) - (left < right);
}

/* As far as weighted sums stay finite. */
static float positive(float v)
{
    return v > 0.0f ? fminf(v, 3e38f) : 0.0f;
}

/* Luminances above 0; returns how many. out: [width * height]. */
static size_t collect(const tl_image *image, float *out)
{
    size_t count = 0;
    for (size_t y = 0; y < image->height; y++) {
        const float *r = tl_image_plane(image, 0) + y * image->pitch;
        const float *g = tl_image_plane(image, 1) + y * image->pitch;
        const float *b = tl_image_plane(image, 2) + y * image->pitch;
        for (size_t x = 0; x < image->width; x++) {
            const float luminance =
                0.2126f * positive(r[x]) + 0.7152f * positive(g[x]) + 0.0722f * positive(b[x]);
            out[count] = luminance;
            count += luminance > 0.0f;
        }
    }
    return count;
}

tl_status flip_exposures_find(const tl_image *reference, flip_exposures *out, tl_error *err)
{
    tl_status status = TL_OK;
    const size_t pixels = (size_t)reference->width * reference->height;
    float *luminances = malloc(pixels * sizeof *luminances);
    flip_exposures found = {0};
    if (!luminances)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the exposures of a comparison"));
    const size_t count = collect(reference, luminances);
    if (count > 0) {
        qsort(luminances, count, sizeof *luminances, ascending);
        const double median =
            0.5 * ((double)luminances[(count - 1) / 2] + (double)luminances[count / 2]);
        found.first = log2(shown_radiance() / (double)luminances[count - 1]);
        found.last = log2(shown_radiance() / median);
        found.count = (uint32_t)fmax(2.0, ceil(found.last - found.first));
    }
    *out = found;
done:
    free(luminances);
    return status;
}
