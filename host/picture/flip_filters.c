#include "flip_filters.h"

#include <assert.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

/* Table 1: a sqrt(pi/b) exp(-pi^2 x^2/b), x in degrees. */
static const struct {
    double a, b;
} eye_terms[FLIP_EYE_COUNT] = {
    [FLIP_LIGHTNESS] = {1.0, 0.0047},
    [FLIP_RED_GREEN] = {1.0, 0.0053},
    [FLIP_BLUE_YELLOW] = {34.1, 0.04},
    [FLIP_BLUE_YELLOW_NARROW] = {13.5, 0.025},
};

static const double widest_term = 0.04;
static const double feature_width = 0.082; /* degrees: twice the deviation of the Gaussian */

static int radius_of(double deviation)
{
    const int radius = (int)ceil(3.0 * deviation);
    assert(radius <= FLIP_MOST_RADIUS);
    return radius;
}

/* Not normalised: returns the sum. */
static double gaussian(double exponent, int radius, double *taps)
{
    double sum = 0.0;
    for (int i = -radius; i <= radius; i++)
        sum += taps[i + radius] = exp(-exponent * i * i);
    return sum;
}

static void store(flip_taps *out, const double *taps, int radius, double scale)
{
    for (int i = 0; i <= 2 * radius; i++)
        out->taps[i] = (float)(taps[i] * scale);
}

/* The weights of a term over its square sum to (sum along one axis)^2 times its height; terms that
 * filter one channel are divided by what all of them sum to. */
static void make_eye(double pixels_per_degree, flip_filters *out)
{
    double taps[FLIP_EYE_COUNT][2 * FLIP_MOST_RADIUS + 1];
    double sums[FLIP_EYE_COUNT], weights[FLIP_EYE_COUNT];
    out->eye_radius = radius_of(sqrt(widest_term / (2.0 * pi * pi)) * pixels_per_degree);
    for (int i = 0; i < FLIP_EYE_COUNT; i++) {
        const double b = eye_terms[i].b;
        sums[i] = gaussian(pi * pi / (b * pixels_per_degree * pixels_per_degree),
                           out->eye_radius, taps[i]);
        weights[i] = eye_terms[i].a * sqrt(pi / b) * sums[i] * sums[i];
    }
    for (int i = 0; i < FLIP_EYE_COUNT; i++) {
        const double all = i < FLIP_BLUE_YELLOW
                               ? weights[i]
                               : weights[FLIP_BLUE_YELLOW] + weights[FLIP_BLUE_YELLOW_NARROW];
        store(&out->across_eye[i], taps[i], out->eye_radius, weights[i] / (all * sums[i]));
        store(&out->down_eye[i], taps[i], out->eye_radius, 1.0 / sums[i]);
    }
}

/* Weights above 0 sum to 1, those below to -1. */
static void balance(double *taps, int radius)
{
    double above = 0.0, below = 0.0;
    for (int i = 0; i <= 2 * radius; i++) {
        above += fmax(taps[i], 0.0);
        below -= fmin(taps[i], 0.0);
    }
    for (int i = 0; i <= 2 * radius; i++)
        taps[i] /= taps[i] > 0.0 ? above : below;
}

/* First and second derivative of a Gaussian along one axis, the Gaussian along the other. */
static void make_features(double pixels_per_degree, flip_filters *out)
{
    const double deviation = 0.5 * feature_width * pixels_per_degree;
    const int radius = radius_of(deviation);
    const double variance = deviation * deviation;
    double smooth[2 * FLIP_MOST_RADIUS + 1], edge[2 * FLIP_MOST_RADIUS + 1],
        point[2 * FLIP_MOST_RADIUS + 1];
    const double sum = gaussian(0.5 / variance, radius, smooth);
    for (int i = -radius; i <= radius; i++) {
        edge[i + radius] = -i * smooth[i + radius];
        point[i + radius] = (i * i / variance - 1.0) * smooth[i + radius];
    }
    balance(edge, radius);
    balance(point, radius);
    out->feature_radius = radius;
    store(&out->smooth, smooth, radius, 1.0 / sum);
    store(&out->edge, edge, radius, 1.0);
    store(&out->point, point, radius, 1.0);
}

void flip_filters_make(double pixels_per_degree, flip_filters *out)
{
    make_eye(pixels_per_degree, out);
    make_features(pixels_per_degree, out);
}
