/* Which rays may meet a sphere: the interval of x/depth (or y/depth) per axis.
 *
 * Along one axis the sphere is seen as a disc with centre (c, depth) in the plane of that axis and
 * the view axis, and the sought interval is that of x/depth over the part of the disc between near
 * and far. x/depth is monotone along every line that does not pass through the eye, so its largest
 * value lies at the tangent from the eye to the disc, if the tangent point is between near and far,
 * else where the disc's edge crosses the near or the far plane. The smallest is the largest of the
 * mirrored disc.
 *
 * Policarpo and Fonseca 2005, section 3.4.2 (after Lengyel) solve a quadratic for the tangent
 * plane's normal and divide by the light's depth, by |depth| - radius and by c^2 + depth^2. With
 * D^2 = c^2 + depth^2 and the tangent's length L = sqrt(D^2 - r^2), the slope is
 *
 *     (c L + depth r) / (depth L - c r),
 *
 * which has no such case. Where one of the two sums cancels, its conjugate takes its place:
 *     (c L + depth r)(c L - depth r) = D^2 (c - r)(c + r),
 *     (depth L - c r)(depth L + c r) = D^2 (depth - r)(depth + r).
 * D^2 - r^2 (the power of the eye with respect to the disc) and its like for the crossings cancel
 * when the eye is near the surface; they are summed with their rounding errors, from products of
 * floats that are exact in double. So every step is accurate to a few units of the last place.
 *
 * In double on both sides, scalar, whatever `real` is. Inputs are floats widened to double. */
#ifndef TL_SPHERE_BOUNDS_H
#define TL_SPHERE_BOUNDS_H

#ifdef __OPENCL_C_VERSION__
#    ifdef cl_khr_fp64
#        define TL_HAS_SPHERE_BOUNDS 1
#    endif
#else
#    include <math.h>
#    define TL_HAS_SPHERE_BOUNDS 1
#endif

#ifdef TL_HAS_SPHERE_BOUNDS

typedef struct tl_interval {
    double low, high; /* x/depth, or m for parallel rays; low > high where empty */
} tl_interval;

/* A sum with its rounding error: value + error is exact. Knuth 1969, theorem 4.2.2B. */
typedef struct two_part {
    double value, error;
} two_part;

static inline two_part two_sum(double a, double b)
{
    const double s = a + b;
    const double from_b = s - a;
    const two_part r = {s, (a - (s - from_b)) + (b - from_b)};
    return r;
}

/* The sign of the exact sum a + b + c, of values whose product of exponents fits a double. */
static inline double sign_of_sum(double a, double b, double c)
{
    const two_part ab = two_sum(a, b);
    const two_part abc = two_sum(ab.value, c);
    return abc.value + (ab.error + abc.error);
}

/* c^2 + d^2 - r^2, d in two parts. */
static inline double power_of_eye(double c, two_part d, double r)
{
    const double d2 = d.value * d.value;
    const double d2_error = fma(d.value, d.value, -d2) + 2.0 * d.value * d.error;
    const two_part sum = two_sum(c * c, d2);
    const two_part all = two_sum(sum.value, -(r * r));
    return all.value + (all.error + (sum.error + d2_error));
}

/* Where the edge of the disc crosses a plane of constant depth, on the side of larger x; `offset`
 * is the disc's depth minus the plane's, |offset| <= r. */
static inline double crossing(double c, two_part offset, double r)
{
    const double half2 = (r - offset.value - offset.error) * (r + offset.value + offset.error);
    const double half_chord = sqrt(half2 > 0.0 ? half2 : 0.0);
    if (c >= 0.0)
        return c + half_chord;
    return -power_of_eye(c, offset, r) / (half_chord - c);
}

/* The largest x/depth on the disc between near and far; the disc is known to reach in between. */
static inline double largest_slope(double c, double depth, double r, double near, double far)
{
    const two_part whole = {depth, 0.0};
    const two_part past_near = two_sum(depth, -near);
    const double power = power_of_eye(c, whole, r);
    const double length = sqrt(power > 0.0 ? power : 0.0);
    const double d2 = c * c + depth * depth;
    const double over = c * length + depth * r, over_conjugate = c * length - depth * r;
    const double under = depth * length - c * r, under_conjugate = depth * length + c * r;
    /* Of each pair one does not cancel: the terms have one sign in it. */
    const double numerator = c * depth < 0.0 ? d2 * (c - r) * (c + r) / over_conjugate : over;
    const double denominator =
        c * depth > 0.0 ? d2 * (depth - r) * (depth + r) / under_conjugate : under;
    const double tangent_depth = length * denominator / d2;

    if (!(power > 0.0) || !(tangent_depth >= near))
        return crossing(c, past_near, r) / near;
    if (tangent_depth > far)
        return crossing(c, two_sum(depth, -far), r) / far;
    return numerator / denominator;
}

/* The largest x on the disc between near and far. */
static inline double largest_x(double c, double depth, double r, double near, double far)
{
    if (depth < near)
        return crossing(c, two_sum(depth, -near), r);
    if (depth > far)
        return crossing(c, two_sum(depth, -far), r);
    return c + r;
}

/* The interval along one axis. c: the centre's coordinate; depth: its depth, of any sign; r >= 0;
 * near < far, near > 0 unless orthographic, far may be infinite. */
static inline tl_interval sphere_interval(
    double c, double depth, double r, double near, double far, int orthographic)
{
    const tl_interval none = {1.0, -1.0};
    if (sign_of_sum(depth, r, -near) < 0.0 || sign_of_sum(depth, -r, -far) > 0.0)
        return none;
    const double left = orthographic ? -largest_x(-c, depth, r, near, far)
                                     : -largest_slope(-c, depth, r, near, far);
    const double right = orthographic ? largest_x(c, depth, r, near, far)
                                      : largest_slope(c, depth, r, near, far);
    /* A point, or nearly one, may come out in the wrong order by a last place. */
    const tl_interval seen = {left < right ? left : right, left < right ? right : left};
    return seen;
}

#endif
#endif
