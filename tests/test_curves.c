/* Is what lies between the keys of an animation what glTF 2.0 says? Against other formulas in 60 digits
 * (tests/tools/make_curve_cases.py), and at the times that matter. */
#include "curve_cases.h"
#include "testing.h"

#include <float.h>

/* The steps that round: a share of the interval 2; the weights of a spline 6 and of a turn, by way of the
 * angle, 12; products and sum 4; length 1 again 4. Each is half an epsilon of what adds up. */
static const double roundings = 22.0;

static tl_curve curve_of(size_t i)
{
    return (tl_curve){.interpolation = curve_cases[i].interpolation,
                      .rotates = curve_cases[i].rotates,
                      .key_count = curve_cases[i].key_count,
                      .width = curve_cases[i].width,
                      .times = curve_cases[i].times,
                      .values = curve_cases[i].values};
}

/* q and -q are one rotation. */
static double sign_of(size_t i, const double *value)
{
    double dot = 0.0;
    for (size_t c = 0; c < curve_cases[i].width; c++)
        dot += value[c] * curve_cases[i].expected[c];
    return curve_cases[i].rotates && dot < 0.0 ? -1.0 : 1.0;
}

static void values_are_expected(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(curve_cases); i++) {
        const tl_curve curve = curve_of(i);
        double value[4];
        tl_curve_sample(&curve, curve_cases[i].time, value);
        const double sign = sign_of(i, value);
        for (size_t c = 0; c < curve.width; c++) {
            const double off = fabs(sign * value[c] - curve_cases[i].expected[c]);
            if (!(off <= roundings * 0.5 * DBL_EPSILON * curve_cases[i].sizes[c]))
                fail_msg("%s, at %g s: component %zu is %.17g, want %.17g", curve_cases[i].name,
                         curve_cases[i].time, c, sign * value[c], curve_cases[i].expected[c]);
        }
    }
}

/* The angle of the specification's own text is not a number where rounding takes a product of unit
 * quaternions beyond 1; that there are such keys, and that ours are none the worse for them. */
static void survives_what_an_arc_cosine_does_not(void **state)
{
    size_t lost = 0;
    (void)state;
    for (int i = 1; i < 1000; i++) {
        const float q[4] = {0.01f * (float)i, 0.3f, -0.7f, 0.2f};
        const float times[2] = {0.0f, 1.0f};
        float values[8];
        double unit[4], dot = 0.0, value[4], length2 = 0.0;
        for (int c = 0; c < 8; c++)
            values[c] = q[c % 4];
        for (int c = 0; c < 4; c++)
            length2 += (double)q[c] * (double)q[c];
        for (int c = 0; c < 4; c++) {
            unit[c] = (double)q[c] / sqrt(length2);
            dot += unit[c] * unit[c];
        }
        lost += isnan(acos(dot)) != 0;
        const tl_curve curve = {TL_LINEAR, true, 2, 4, times, values};
        tl_curve_sample(&curve, 0.3, value);
        for (int c = 0; c < 4; c++)
            assert_true(fabs(value[c] - unit[c]) <= roundings * 0.5 * DBL_EPSILON);
    }
    assert_in_range(lost, 1, 999);
}

/* Angles as small as floats can have them: the middle is half the angle, to all digits. */
static void halves_every_small_angle(void **state)
{
    (void)state;
    for (int power = -126; power <= -1; power++) {
        const float times[2] = {0.0f, 1.0f};
        const float values[8] = {0, 0, 0, 1, ldexpf(1.0f, power), 0, 0, 1};
        const double half = 0.5 * atan(ldexp(1.0, power));
        const tl_curve curve = {TL_LINEAR, true, 2, 4, times, values};
        double value[4];
        tl_curve_sample(&curve, 0.5, value);
        assert_true(fabs(value[0] - sin(half)) <= roundings * 0.5 * DBL_EPSILON * sin(half));
        assert_true(fabs(value[3] - cos(half)) <= roundings * 0.5 * DBL_EPSILON);
    }
}

/* Every key of a long curve, and the moments right before and after it. */
static void finds_every_key(void **state)
{
    enum { COUNT = 1000 };
    float times[COUNT], values[COUNT];
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        times[i] = 0.1f * (float)i * (float)i;
        values[i] = (float)i;
    }
    const tl_curve curve = {TL_STEP, false, COUNT, 1, times, values};
    for (int i = 0; i < COUNT; i++) {
        double value;
        tl_curve_sample(&curve, (double)times[i], &value);
        assert_true(value == (double)i);
        tl_curve_sample(&curve, nextafter((double)times[i], -1.0), &value);
        assert_true(value == (double)(i ? i - 1 : 0));
        tl_curve_sample(&curve, nextafter((double)times[i], 1e9), &value);
        assert_true(value == (double)i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_expected),
        cmocka_unit_test(survives_what_an_arc_cosine_does_not),
        cmocka_unit_test(halves_every_small_angle),
        cmocka_unit_test(finds_every_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
