#include "tilelight/photometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const tl_ies_edition_words[TL_IES_EDITION_COUNT] = {
#define WORD(name, line, word) [name] = word,
    TL_IES_EDITIONS(WORD)
#undef WORD
};

const char *const tl_photometry_symmetry_words[TL_SYMMETRY_COUNT] = {
#define WORD(name, word) [name] = word,
    TL_PHOTOMETRY_SYMMETRIES(WORD)
#undef WORD
};

void tl_photometry_clear(tl_photometry *photometry)
{
    free(photometry->vertical);
    free(photometry->horizontal);
    free(photometry->candela);
    *photometry = (tl_photometry){0};
}

/* Where the plane at `c` degrees has its image among those of the file. */
static double folded(const tl_photometry *p, double c)
{
    const double half = c <= 180.0 ? c : 360.0 - c;
    switch (p->symmetry) {
    case TL_SYMMETRY_AXIAL: return 0.0;
    case TL_SYMMETRY_QUADRANT: return half <= 90.0 ? half : 180.0 - half;
    case TL_SYMMETRY_ALONG: return half;
    case TL_SYMMETRY_ACROSS: return c < 90.0 ? 180.0 - c : c > 270.0 ? 540.0 - c : c;
    default: return c;
    }
}

/* Of ascending angles the last that is not above `at`, but for the last of all. */
static size_t angle_below(const double *angles, size_t count, double at)
{
    size_t low = 0, high = count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (angles[middle] <= at)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Along one plane. */
static double at_vertical(const tl_photometry *p, size_t plane, double vertical)
{
    const double *const candela = p->candela + plane * p->vertical_count;
    const size_t i = angle_below(p->vertical, p->vertical_count, vertical);
    const double from = p->vertical[i], width = p->vertical[i + 1] - from;
    const double share = (vertical - from) / width;
    return candela[i] + share * (candela[i + 1] - candela[i]);
}

double tl_photometry_at(const tl_photometry *p, double horizontal, double vertical)
{
    const double c = folded(p, horizontal);
    const size_t last = p->horizontal_count - 1;
    if (!(vertical >= p->vertical[0] && vertical <= p->vertical[p->vertical_count - 1]))
        return 0.0;
    if (last == 0)
        return at_vertical(p, 0, vertical);
    /* Beyond the last plane of a whole circle is the first again. */
    const int is_beyond = c >= p->horizontal[last];
    const size_t i = is_beyond ? last : angle_below(p->horizontal, p->horizontal_count, c);
    const double a = at_vertical(p, i, vertical), from = p->horizontal[i];
    if (c <= from)
        return a;
    const double b = at_vertical(p, is_beyond ? 0 : i + 1, vertical);
    const double to = is_beyond ? 360.0 : p->horizontal[i + 1];
    return a + (c - from) / (to - from) * (b - a);
}

double tl_photometry_peak(const tl_photometry *p)
{
    double most = 0.0;
    for (size_t i = 0; i < p->horizontal_count * p->vertical_count; i++)
        most = fmax(most, p->candela[i]);
    return most;
}

static double radians(double degrees)
{
    return degrees * (acos(-1.0) / 180.0);
}

/* Of one plane, over the vertical angle: intensity times its sine. Linear in between, so
 * the integral of (a + k (v - from)) sin v is that of its parts. */
static double plane_integral(const tl_photometry *p, size_t plane)
{
    const double *const candela = p->candela + plane * p->vertical_count;
    double sum = 0.0;
    for (size_t i = 0; i + 1 < p->vertical_count; i++) {
        const double from = radians(p->vertical[i]), to = radians(p->vertical[i + 1]);
        const double slope = (candela[i + 1] - candela[i]) / (to - from);
        sum += candela[i] * (cos(from) - cos(to)) +
               slope * (sin(to) - sin(from) - (to - from) * cos(to));
    }
    return sum;
}

/* Linear from plane to plane, and as often as the file's planes stand for the whole circle. */
double tl_photometry_flux(const tl_photometry *p)
{
    const size_t last = p->horizontal_count - 1;
    const double span = p->horizontal[last] - p->horizontal[0];
    double sum = 0.0;
    if (last == 0)
        return radians(360.0) * plane_integral(p, 0);
    for (size_t i = 0; i < last; i++)
        sum += radians(p->horizontal[i + 1] - p->horizontal[i]) * 0.5 *
               (plane_integral(p, i) + plane_integral(p, i + 1));
    if (p->symmetry != TL_SYMMETRY_NONE)
        return sum * (360.0 / span);
    return sum + radians(360.0 - span) * 0.5 * (plane_integral(p, last) + plane_integral(p, 0));
}
