/* Is the oracle right?
 *
 * Its ends of spheres are held against a third way: a ray meets the sphere if the point of it that is nearest
 * to the centre, between the planes, is no farther than the radius. Angles of cones are made, not measured;
 * depths go to shares and back. */
#include "testing.h"

#include "oracle/cone.h"
#include "oracle/depth.h"
#include "oracle/sphere.h"

enum { CASE_COUNT = 20000 };

static uint64_t random_state = 1931;

static double uniform(double low, double high) /* splitmix64 */
{
    uint64_t z = random_state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return low + (high - low) * (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static float signed_magnitude(double low, double high)
{
    const double m = exp2(uniform(low, high));
    return (float)(uniform(-1.0, 1.0) < 0.0 ? -m : m);
}

/* A disc between two planes. */
typedef struct disc {
    wide c, depth, r, near, far;
    int orthographic;
} disc;

static disc random_disc(void)
{
    disc d;
    d.c = signed_magnitude(-8.0, 8.0);
    d.depth = signed_magnitude(-8.0, 8.0);
    d.near = (float)exp2(uniform(-8.0, 4.0));
    d.far = uniform(0.0, 1.0) < 0.2 ? (wide)INFINITY : d.near * (float)exp2(uniform(0.1, 8.0));
    d.r = (float)(exp2(uniform(-12.0, 1.0)) * hypot((double)d.c, (double)d.depth));
    d.orthographic = uniform(0.0, 1.0) < 0.2;
    return d;
}

/* Distance^2 to the ray less radius^2, of its point nearest to the centre; below 0 where they meet. */
static wide apart(const disc *d, wide m)
{
    const wide slope = d->orthographic ? 0 : m, x = d->orthographic ? m : 0;
    const wide nearest = (slope * (d->c - x) + d->depth) / (1 + slope * slope);
    const wide t = nearest < d->near ? d->near : nearest > d->far ? d->far : nearest;
    const wide across = x + slope * t - d->c, along = t - d->depth;
    return across * across + along * along - d->r * d->r;
}

/* A little inside and a little outside of an end. */
static int is_end(const disc *d, wide end, wide width, int direction)
{
    const wide step = fminq(0x1p-40Q * (1 + end * end), width / 4);
    return apart(d, end - direction * step) <= 0 && apart(d, end + direction * step) >= 0;
}

static void ends_of_spheres_are_where_rays_begin_to_meet_them(void **state)
{
    int seen = 0;
    (void)state;
    for (int i = 0; i < CASE_COUNT; i++) {
        const disc d = random_disc();
        const tl_span s =
            tl_oracle_sphere_span(d.c, d.depth, d.r, d.near, d.far, d.orthographic);
        assert_int_equal(s.empty, d.depth + d.r < d.near || d.depth - d.r > d.far);
        if (s.empty)
            continue;
        seen++;
        if (!is_end(&d, s.low, s.high - s.low, -1) || !is_end(&d, s.high, s.high - s.low, 1))
            fail_msg("centre %a, depth %a, radius %a, planes %a and %a, %s: not [%.20g, %.20g]",
                     (double)d.c, (double)d.depth, (double)d.r, (double)d.near, (double)d.far,
                     d.orthographic ? "parallel" : "central", (double)s.low, (double)s.high);
    }
    assert_in_range(seen, CASE_COUNT / 4, CASE_COUNT);
}

/* The eye on the surface, -3 beside the centre and 4 before it, and a plane at n = 2^-99: the surface crosses
 * it at -3 + sqrt(9 + 8n - n^2), which is 4n/3 but for n/18 of it. */
static void what_cancels_at_the_plane_is_kept(void **state)
{
    const tl_span s = tl_oracle_sphere_span(-3, 4, 5, 0x1p-99Q, HUGE_VALQ, 0);
    const tl_quick_span q =
        tl_oracle_sphere_quick_span(-3.0L, 4.0L, 5.0L, 0x1p-99L, (long double)INFINITY, 0);
    (void)state;
    assert_true(fabsq(s.high - 4 / 3.0Q) < TL_SPAN_ERROR);
    assert_true(fabsq(q.high - 4 / 3.0Q) < TL_QUICK_SPAN_ERROR);
}

/* In long double, within what they state. */
static void quick_spans_are_close(void **state)
{
    (void)state;
    for (int i = 0; i < CASE_COUNT; i++) {
        const disc d = random_disc();
        const tl_span s =
            tl_oracle_sphere_span(d.c, d.depth, d.r, d.near, d.far, d.orthographic);
        const tl_quick_span q = tl_oracle_sphere_quick_span(
            (long double)d.c, (long double)d.depth, (long double)d.r, (long double)d.near,
            (long double)d.far, d.orthographic);
        assert_int_equal(s.empty, q.empty);
        if (!s.empty &&
            !(fabsq(s.low - q.low) <= TL_QUICK_SPAN_ERROR * fmaxq(1, fabsq(s.low)) &&
              fabsq(s.high - q.high) <= TL_QUICK_SPAN_ERROR * fmaxq(1, fabsq(s.high))))
            fail_msg("centre %a, depth %a, radius %a: [%.20Lg, %.20Lg] is not [%.20g, %.20g]",
                     (double)d.c, (double)d.depth, (double)d.r, q.low, q.high, (double)s.low,
                     (double)s.high);
    }
}

/* What cancels: 2^100 + 2^-100 - 2^100. */
static void sums_keep_what_cancels(void **state)
{
    const wide terms[] = {0x1p100Q, 1, 0x1p-20Q, -0x1p100Q, -1};
    (void)state;
    assert_true(wide_sum3(0x1p100Q, 0x1p-100Q, -0x1p100Q) == 0x1p-100Q);
    assert_true(wide_sum(terms, COUNT_OF(terms)) == 0x1p-20Q);
}

/* Ways that are made at an angle. */
static void angles_from_the_axis_are_found(void **state)
{
    (void)state;
    for (int i = 0; i < CASE_COUNT; i++) {
        const wide turn = uniform(0.0, 6.28), angle = uniform(0.0, 3.14),
                   half = uniform(0.0, 3.14);
        const wide length = exp2(uniform(-90.0, 90.0));
        const wide axis[3] = {0, 3 * cosq(turn), 3 * sinq(turn)};
        const wide way[3] = {length * sinq(angle), length * cosq(angle) * cosq(turn),
                             length * cosq(angle) * sinq(turn)};
        assert_true(fabsq(tl_oracle_above_edge(axis, half, way) - (cosq(angle) - cosq(half))) <
                    0x1p-108Q);
    }
    assert_true(cosq(tl_oracle_half_angle(1.57079637f)) < 0x1p-110Q);
    assert_true(cosq(tl_oracle_half_angle(3.14159274f)) == -1);
}

static double depth_in_cone(const double axis[3], double cosine, const double way[3])
{
    return axis[0] * way[0] + axis[1] * way[1] + axis[2] * way[2] -
           cosine * sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
}

/* No other way of the box is deeper. */
static void deepest_ways_are_deepest(void **state)
{
    (void)state;
    for (int i = 0; i < CASE_COUNT; i++) {
        const double turn = uniform(0.0, 6.28), tilt = uniform(0.0, 3.14),
                     cosine = uniform(0.0, 1.0);
        const double axis[3] = {cos(tilt), sin(tilt) * cos(turn), sin(tilt) * sin(turn)};
        double low[3], high[3], deepest[3], other[3];
        for (int k = 0; k < 3; k++) {
            low[k] = uniform(-1.0, 1.0);
            high[k] = low[k] + uniform(0.0, 1.0);
            other[k] = uniform(low[k], high[k]);
        }
        tl_oracle_deepest_way(axis, cosine, low, high, 300, deepest);
        for (int k = 0; k < 3; k++)
            assert_true(deepest[k] >= low[k] && deepest[k] <= high[k]);
        assert_true(depth_in_cone(axis, cosine, other) <=
                    depth_in_cone(axis, cosine, deepest) + 1e-12);
    }
}

static void depths_and_shares_are_inverse(void **state)
{
    (void)state;
    for (int i = 0; i < CASE_COUNT; i++) {
        const tl_depth_range range = {exp2(uniform(-9.0, 0.0)),
                                      i % 3 ? (wide)exp2(uniform(1.0, 9.0)) : (wide)INFINITY,
                                      i % 3 == 2};
        const wide share = uniform(0.0, 0.999);
        const wide depth = tl_oracle_depth_of_share(range, share);
        assert_true(depth >= range.near && depth <= range.far);
        assert_true(fabsq(tl_oracle_share_of_depth(range, depth) - share) < 0x1p-95Q);
    }
    assert_true(tl_oracle_ray(-1, 3, 4, 0) == -0.5Q && tl_oracle_ray(-1, 3, 4, 3) == 2.5Q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_keep_what_cancels),
        cmocka_unit_test(ends_of_spheres_are_where_rays_begin_to_meet_them),
        cmocka_unit_test(what_cancels_at_the_plane_is_kept),
        cmocka_unit_test(quick_spans_are_close),
        cmocka_unit_test(angles_from_the_axis_are_found),
        cmocka_unit_test(deepest_ways_are_deepest),
        cmocka_unit_test(depths_and_shares_are_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
