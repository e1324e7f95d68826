#include "curves.h"

#include <math.h>

enum { QUATERNION = 4 };

/* --- quaternions ------------------------------------------------------------------------------- */

/* To length 1; left alone where it is 0. hypot, as squares of small components would vanish. */
static void to_unit(double q[QUATERNION])
{
    const double length = hypot(hypot(q[0], q[1]), hypot(q[2], q[3]));
    for (int i = 0; i < QUATERNION && length > 0.0; i++)
        q[i] /= length;
}

/* Spherical interpolation the short way: q and -q are one rotation, so the second is taken with
 * the sign that makes the angle a between them at most a right one. Its sine is then 0 only
 * where both are the same. The specification has a = acos|q0.q1|, which is not a number where
 * rounding takes the product beyond 1; a = 2 atan2(|q1 - q0|, |q1 + q0|) always is: W. Kahan,
 * "How Futile are Mindless Assessments of Roundoff in Floating-Point Computation?" (2006),
 * section 12. */
static void slerp(const double from[QUATERNION],
                  const double to[QUATERNION],
                  double t,
                  double out[QUATERNION])
{
    double dot = 0.0, apart = 0.0, together = 0.0;
    for (int i = 0; i < QUATERNION; i++)
        dot += from[i] * to[i];
    const double sign = dot < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < QUATERNION; i++) {
        apart = hypot(apart, sign * to[i] - from[i]);
        together = hypot(together, sign * to[i] + from[i]);
    }
    const double angle = 2.0 * atan2(apart, together), sine = sin(angle);
    const double first = sine > 0.0 ? sin(angle * (1.0 - t)) / sine : 1.0 - t;
    const double second = sine > 0.0 ? sin(angle * t) / sine : t;
    for (int i = 0; i < QUATERNION; i++)
        out[i] = first * from[i] + second * sign * to[i];
}

/* --- one stretch between two keys -------------------------------------------------------------- */

/* The part `part` of key `key`: 0, or of a spline 0 to 2. */
static const float *element(const tl_curve *curve, size_t key, size_t part)
{
    const size_t parts = curve->interpolation == TL_CUBIC ? 3 : 1;
    return curve->values + (parts * key + part) * curve->width;
}

static const float *value_of(const tl_curve *curve, size_t key)
{
    return element(curve, key, curve->interpolation == TL_CUBIC ? 1 : 0);
}

static void at_key(const tl_curve *curve, size_t key, double *out)
{
    for (size_t i = 0; i < curve->width; i++)
        out[i] = (double)value_of(curve, key)[i];
}

static void between_linear(const tl_curve *curve, size_t key, double t, double *out)
{
    for (size_t i = 0; i < curve->width; i++)
        out[i] = (1.0 - t) * (double)value_of(curve, key)[i] +
                 t * (double)value_of(curve, key + 1)[i];
}

static void between_rotations(const tl_curve *curve, size_t key, double t, double *out)
{
    double from[QUATERNION], to[QUATERNION];
    at_key(curve, key, from);
    at_key(curve, key + 1, to);
    to_unit(from);
    to_unit(to);
    slerp(from, to, t, out);
}

/* Hermite's cubic; tangents are per second, so the interval's length scales them. */
static void between_cubic(const tl_curve *curve, size_t key, double t, double *out)
{
    const double interval = (double)curve->times[key + 1] - (double)curve->times[key];
    const double t2 = t * t, t3 = t2 * t;
    const float *leaving = element(curve, key, 2), *arriving = element(curve, key + 1, 0);
    for (size_t i = 0; i < curve->width; i++)
        out[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * (double)value_of(curve, key)[i] +
                 interval * (t3 - 2.0 * t2 + t) * (double)leaving[i] +
                 (3.0 * t2 - 2.0 * t3) * (double)value_of(curve, key + 1)[i] +
                 interval * (t3 - t2) * (double)arriving[i];
}

static void between(const tl_curve *curve, size_t key, double t, double *out)
{
    switch (curve->interpolation) {
    case TL_CUBIC: between_cubic(curve, key, t, out); return;
    case TL_LINEAR:
        (curve->rotates ? between_rotations : between_linear)(curve, key, t, out);
        return;
    default: at_key(curve, key, out); return;
    }
}

/* The last key that is not after `time`, which the first one is not. */
static size_t key_before(const tl_curve *curve, double time)
{
    size_t low = 0, high = curve->key_count; /* times[low] <= time < times[high] */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if ((double)curve->times[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void tl_curve_sample(const tl_curve *curve, double time, double *out)
{
    const size_t last = curve->key_count - 1;
    if (time < (double)curve->times[0]) {
        at_key(curve, 0, out);
    } else {
        const size_t key = key_before(curve, time);
        const double start = (double)curve->times[key];
        if (key == last)
            at_key(curve, last, out);
        else
            between(curve, key, (time - start) / ((double)curve->times[key + 1] - start), out);
    }
    if (curve->rotates)
        to_unit(out);
}
