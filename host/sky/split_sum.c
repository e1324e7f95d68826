#include "split_sum.h"

#include "parallel.h"
#include "sky_light.h"

#include <math.h>
#include <pthread.h>

static const double pi = 3.14159265358979323846;

/* Directions of half vectors: by how much of the distribution lies below, and around the normal. */
enum { TURNS = 64, HEIGHTS = 128 };

static double smith(double alpha2, double cosine)
{
    return sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
}

static double fifth_power(double x)
{
    return x * x * x * x * x;
}

/* Over half vectors h whose density D n.h: with l = 2 (v.h) h - v, dl = 4 v.h dh, the lobe D V n.l dl is
 * 4 V n.l v.h / n.h of a sample's share. Cells of equal shares, a sample in the middle of each. */
static void add_lobe(double nv, double alpha, tl_split_sum *out)
{
    const double alpha2 = alpha * alpha, sine = sqrt(1.0 - nv * nv);
    for (int i = 0; i < HEIGHTS; i++) {
        const double t = (i + 0.5) / HEIGHTS;
        const double share = t * t * (3.0 - 2.0 * t), density = 6.0 * t * (1.0 - t) / HEIGHTS;
        const double nh2 = (1.0 - share) / (1.0 + (alpha2 - 1.0) * share), nh = sqrt(nh2);
        const double across = sqrt(1.0 - nh2);
        for (int k = 0; k < TURNS; k++) {
            const double vh = nv * nh + sine * across * cos(pi * (k + 0.5) / TURNS);
            const double nl = 2.0 * vh * nh - nv;
            if (!(nl > 0.0) || !(vh > 0.0))
                continue;
            const double shadowed =
                0.5 / (nl * smith(alpha2, nv) + nv * smith(alpha2, nl));
            const double reflected =
                4.0 * shadowed * nl * vh / nh * density / TURNS;
            out->base += reflected;
            out->grazing += reflected * fifth_power(1.0 - vh);
        }
    }
}

/* n.l (1 - v.h)^5 / pi over l, with v.h = sqrt((1 + v.l)/2). */
static void add_lost(double nv, tl_split_sum *out)
{
    const double sine = sqrt(1.0 - nv * nv);
    for (int i = 0; i < HEIGHTS; i++) {
        const double nl = sqrt((i + 0.5) / HEIGHTS), across = sqrt(1.0 - nl * nl);
        for (int k = 0; k < TURNS; k++) {
            const double vl = nv * nl + sine * across * cos(pi * (k + 0.5) / TURNS);
            out->lost += fifth_power(1.0 - sqrt(fmax(0.0, 0.5 + 0.5 * vl))) / (HEIGHTS * TURNS);
        }
    }
}

tl_split_sum tl_split_sum_at(double n_dot_v, double alpha)
{
    tl_split_sum out = {0.0, 0.0, 0.0};
    const double nv = fmax(n_dot_v, 1e-6);
    add_lobe(nv, alpha, &out);
    add_lost(nv, &out);
    return out;
}

static float table[TL_SKY_TABLE * TL_SKY_TABLE][4];

static void fill_rows(void *context, size_t begin, size_t end)
{
    (void)context;
    for (size_t row = begin; row < end; row++)
        for (int column = 0; column < TL_SKY_TABLE; column++) {
            const double x = (double)column / (TL_SKY_TABLE - 1);
            const double r = TL_SKY_LEAST_ROUGHNESS +
                             (1.0 - TL_SKY_LEAST_ROUGHNESS) * (double)row / (TL_SKY_TABLE - 1);
            const tl_split_sum of = tl_split_sum_at(x * x, r * r);
            float *to = table[row * TL_SKY_TABLE + (size_t)column];
            to[0] = (float)of.base;
            to[1] = (float)of.grazing;
            to[2] = (float)of.lost;
        }
}

static void fill(void)
{
    tl_parallel(TL_SKY_TABLE, 1, fill_rows, NULL);
}

const float (*tl_split_sum_table(void))[4]
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill);
    return (const float(*)[4])table;
}
