#include "split_sum.h"

#include "parallel.h"
#include "sky_light.h"

#include <math.h>
#include <pthread.h>

static const double pi = 3.14159265358979323846;

/* Directions of half vectors: by how much of the distribution lies below, and around the normal. */
enum { TURNS = 32, HEIGHTS = 128 };

static double smith(double alpha2, double cosine)
{
    return sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
}

static double fifth_power(double x)
{
    return x * x * x * x * x;
}

/* From 0 to 1, flat at both ends. */
static double smooth(double t)
{
    return t * t * (3.0 - 2.0 * t);
}

static double slope(double t)
{
    return 6.0 * t * (1.0 - t);
}

/* How far h may turn, 0 to pi, before l is below the surface: n.l = 2 (v.h) n.h - n.v. */
static double turn_of(double nv, double sine, double nh, double across)
{
    const double least = nv / (2.0 * nh) - nv * nh, by = sine * across;
    return by > 0.0 ? acos(fmax(-1.0, fmin(1.0, least / by))) : least < 0.0 ? pi : 0.0;
}

/* Over half vectors h whose density is D n.h: with l = 2 (v.h) h - v, dl = 4 v.h dh, the lobe D V n.l dl is
 * 4 V n.l v.h / n.h of a sample's share. Samples are in the middle of cells, which are smaller where the
 * integrand ends: at the pole, at the equator, and where l is at the horizon. */
static void add_lobe(double nv, double alpha, tl_split_sum *out)
{
    const double alpha2 = alpha * alpha, sine = sqrt(1.0 - nv * nv);
    const double eye_shadow = smith(alpha2, nv);
    for (int i = 0; i < HEIGHTS; i++) {
        const double t = (i + 0.5) / HEIGHTS;
        const double s = smooth(t), share = smooth(s);
        const double density = slope(s) * slope(t) / HEIGHTS;
        const double nh2 = (1.0 - share) / (1.0 + (alpha2 - 1.0) * share), nh = sqrt(nh2);
        const double across = sqrt(1.0 - nh2);
        const double most = turn_of(nv, sine, nh, across);
        const double scale = 4.0 * most * density / (pi * TURNS * nh); /* of all around */
        for (int k = 0; k < TURNS; k++) {
            const double near = 1.0 - (k + 0.5) / TURNS;
            const double vh = nv * nh + sine * across * cos(most * (1.0 - near * near));
            const double nl = 2.0 * vh * nh - nv;
            if (!(nl > 0.0) || !(vh > 0.0))
                continue;
            const double shadows = nl * eye_shadow + nv * smith(alpha2, nl);
            const double reflected =
                scale * near * nl * vh / shadows; /* V is half of 1 over them */
            out->base += reflected;
            out->grazing += reflected * fifth_power(1.0 - vh);
        }
    }
}

/* n.l (1 - v.h)^5 / pi over l, with v.h = sqrt((1 + v.l)/2). */
static double lost_at(double nv)
{
    const double sine = sqrt(1.0 - nv * nv);
    double lost = 0.0;
    for (int i = 0; i < HEIGHTS; i++) {
        const double nl = sqrt((i + 0.5) / HEIGHTS), across = sqrt(1.0 - nl * nl);
        for (int k = 0; k < TURNS; k++) {
            const double vl = nv * nl + sine * across * cos(pi * (k + 0.5) / TURNS);
            lost += fifth_power(1.0 - sqrt(fmax(0.0, 0.5 + 0.5 * vl))) / (HEIGHTS * TURNS);
        }
    }
    return lost;
}

/* Of what is seen from the side the integrals have a limit, which they are as good as at here. */
static double above_zero(double n_dot_v)
{
    return fmax(n_dot_v, 1e-6);
}

tl_split_sum tl_split_sum_at(double n_dot_v, double alpha)
{
    const double nv = above_zero(n_dot_v);
    tl_split_sum out = {.lost = lost_at(nv)};
    add_lobe(nv, alpha, &out);
    return out;
}

static float table[TL_SKY_TABLE * TL_SKY_TABLE][4];

/* n.v of a column. */
static double cosine_of(int column)
{
    const double x = (double)column / (TL_SKY_TABLE - 1);
    return above_zero(x * x);
}

static void fill_rows(void *context, size_t begin, size_t end)
{
    const double *lost = context;
    for (size_t row = begin; row < end; row++)
        for (int column = 0; column < TL_SKY_TABLE; column++) {
            const double r = TL_SKY_LEAST_ROUGHNESS +
                             (1.0 - TL_SKY_LEAST_ROUGHNESS) * (double)row / (TL_SKY_TABLE - 1);
            tl_split_sum of = {.lost = lost[column]};
            add_lobe(cosine_of(column), r * r, &of);
            float *to = table[row * TL_SKY_TABLE + (size_t)column];
            to[0] = (float)of.base;
            to[1] = (float)of.grazing;
            to[2] = (float)of.lost;
        }
}

static void fill(void)
{
    double lost[TL_SKY_TABLE]; /* the same at every roughness */
    for (int column = 0; column < TL_SKY_TABLE; column++)
        lost[column] = lost_at(cosine_of(column));
    tl_parallel(TL_SKY_TABLE, 1, fill_rows, lost);
}

const float (*tl_split_sum_table(void))[4]
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill);
    return (const float(*)[4])table;
}
