#include "oracle/cone.h"

#include <math.h>

wide tl_oracle_half_angle(float half_angle)
{
    return half_angle == (float)M_PI_2q ? M_PI_2q
           : half_angle == (float)M_PIq ? M_PIq
                                        : half_angle;
}

static wide product(const wide a[3], const wide b[3])
{
    return wide_sum3(a[0] * b[0], a[1] * b[1], a[2] * b[2]);
}

wide tl_oracle_above_edge(const wide axis[3], wide half_angle, const wide way[3])
{
    return product(axis, way) / sqrtq(product(axis, axis) * product(way, way)) -
           cosq(half_angle);
}

/* Where l.a - cosine |l| is largest along one axis of space, the rest of the way having a length. */
static double best_along(double a, double cosine, double rest, double low, double high)
{
    if (fabs(a) >= cosine)
        return a > 0.0 ? high : low;
    return fmin(fmax(a * rest / sqrt(cosine * cosine - a * a), low), high);
}

void tl_oracle_deepest_way(const double axis[3],
                           double cosine,
                           const double low[3],
                           const double high[3],
                           int steps,
                           double way[3])
{
    for (int i = 0; i < 3; i++)
        way[i] =
            cosine < 0.0 ? (axis[i] > 0.0 ? high[i] : low[i]) : 0.5 * low[i] + 0.5 * high[i];
    for (int step = 0; step < steps && cosine >= 0.0; step++) {
        const int i = step % 3;
        const double rest = hypot(way[(i + 1) % 3], way[(i + 2) % 3]);
        way[i] = best_along(axis[i], cosine, rest, low[i], high[i]);
    }
}
