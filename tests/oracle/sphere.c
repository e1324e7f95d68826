#include "oracle/sphere.h"

static void widen(tl_span *s, wide slope)
{
    s->low = slope < s->low ? slope : s->low;
    s->high = slope > s->high ? slope : s->high;
}

/* Where the circle crosses a plane of constant depth, both sides: the roots of
 * x^2 - 2 c x + c^2 + (depth - plane)^2 - r^2, the smaller one by the product of both. */
static void add_plane(tl_span *s, wide c, wide depth, wide r, wide plane, int orthographic)
{
    const wide half2 = wide_sum3(r, depth, -plane) * wide_sum3(r, -depth, plane);
    const wide terms[] = {c * c, depth * depth, plane * plane, -2 * depth * plane, -r * r};
    const wide scale = orthographic ? 1 : plane;
    if (half2 < 0)
        return;
    const wide larger = c + copysignq(sqrtq(half2), c);
    widen(s, larger / scale);
    widen(s, larger == 0 ? 0 : wide_sum(terms, 5) / larger / scale);
}

/* D^2 - r^2, by the difference that is exact where it is small. */
static wide tangent_length2(wide c, wide depth, wide r)
{
    const wide more = fmaxq(fabsq(c), fabsq(depth)), less = fminq(fabsq(c), fabsq(depth));
    return (more - r) * (more + r) + less * less;
}

static void add_tangents(tl_span *s, wide c, wide depth, wide r, wide near, wide far)
{
    const wide length2 = tangent_length2(c, depth, r);
    if (length2 <= 0)
        return;
    const wide length = sqrtq(length2), theta = atan2q(c, depth), phi = atan2q(r, length);
    for (int side = -1; side <= 1; side += 2) {
        const wide angle = theta + side * phi, at = length * cosq(angle);
        if (at >= near && at <= far)
            widen(s, tanq(angle));
    }
}

tl_span tl_oracle_sphere_span(wide c, wide depth, wide r, wide near, wide far, int orthographic)
{
    tl_span s = {HUGE_VALQ, -HUGE_VALQ, 0};
    s.empty =
        wide_sum3(depth, r, -near) < 0 || (!isinfq(far) && wide_sum3(depth, -r, -far) > 0);
    if (s.empty)
        return s;
    add_plane(&s, c, depth, r, near, orthographic);
    if (!isinfq(far))
        add_plane(&s, c, depth, r, far, orthographic);
    if (!orthographic)
        add_tangents(&s, c, depth, r, near, far);
    else if (depth >= near && depth <= far) {
        widen(&s, c - r);
        widen(&s, c + r);
    }
    return s;
}
