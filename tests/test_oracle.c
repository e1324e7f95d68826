/* Is the oracle right? Its ends of spheres are held against a third way: a ray meets the sphere if the
 * point of it that is nearest to the centre, between the planes, is no farther than the radius. */
#include "testing.h"

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

/* What cancels: 2^100 + 2^-100 - 2^100. */
static void sums_keep_what_cancels(void **state)
{
    const wide terms[] = {0x1p100Q, 1, 0x1p-20Q, -0x1p100Q, -1};
    (void)state;
    assert_true(wide_sum3(0x1p100Q, 0x1p-100Q, -0x1p100Q) == 0x1p-100Q);
    assert_true(wide_sum(terms, COUNT_OF(terms)) == 0x1p-20Q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_keep_what_cancels),
        cmocka_unit_test(ends_of_spheres_are_where_rays_begin_to_meet_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
