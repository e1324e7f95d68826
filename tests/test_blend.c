/* Is blending in float within three roundings of what it is exactly, exact at both ends, and finite; and does
 * what pictures are allowed follow through it? */
#define _GNU_SOURCE
#include "testing.h"

#include "allowance_blend.h"
#include "blend.h"

enum { TIMES = 200000 };
static const double unit = 0x1p-24;
static const double flushed = 0x1p-124; /* products below the normal numbers */

static uint32_t seed = 41;

static float next_share(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (float)(seed >> 8) * 0x1p-24f;
}

/* Of any size that radiance has, one in five 0 or the largest. */
static float next_radiance(void)
{
    const float kind = next_share();
    if (kind < 0.1f)
        return 0.0f;
    if (kind > 0.9f)
        return (float)TL_MOST_FLOAT;
    return ldexpf(next_share(), (int)(next_share() * 250.0f) - 125);
}

static float next_opacity(void)
{
    static const float ends[] = {0.0f, 1.0f, 0x1p-24f, 1.0f - 0x1p-24f, 0x1p-126f, 0.5f};
    const float kind = next_share();
    return kind < 0.2f ? ends[(int)(kind * 30.0f)] : next_share();
}

static void formula_is_within_its_bound(void **state)
{
    double worst = 0.0;
    (void)state;
    for (int i = 0; i < TIMES; i++) {
        const float a = next_opacity(), lit = next_radiance(), behind = next_radiance();
        const float got = blended(a, lit, behind);
        const long double exact =
            (long double)a * lit + (1.0L - (long double)a) * (long double)behind;
        const double off = (double)fabsl((long double)got - exact);
        const double allowed = 3.0 * unit * (double)exact + flushed;
        assert_true(isfinite(got));
        worst = fmax(worst, off / allowed);
        if (!(off <= allowed))
            fail_msg("%a over, lit %a, behind %a: %a, off by %g", (double)a, (double)lit,
                     (double)behind, (double)got, off);
        assert_true(same_bits(blended(0.0f, lit, behind), behind));
        assert_true(same_bits(blended(1.0f, lit, behind), lit));
    }
    print_message("%.3f of what is derived\n", worst);
    assert_true(worst > 0.5);
}

/* Three values around one, or alone. */
static void spread(float value, float by, int channel, tl_allowance *out)
{
    out->expected[channel] = (double)value;
    out->low[channel] = (double)value * (1.0 - (double)by);
    out->high[channel] = fmin((double)value * (1.0 + (double)by), (double)TL_MOST_FLOAT);
}

static float inside(double low, double high, int at_end)
{
    float v = (float)(at_end == 0 ? low : at_end == 1 ? high : 0.5 * (low + high));
    if ((double)v > high)
        v = nextafterf(v, 0.0f);
    if ((double)v < low)
        v = nextafterf(v, INFINITY);
    return v;
}

/* Whatever both may be, what is made of it is allowed, and next to nothing else is. */
static void allowances_follow(void **state)
{
    (void)state;
    for (int i = 0; i < TIMES; i++) {
        const float a = next_opacity(), by = 0.01f * next_share();
        tl_allowance lit = {.certain = 1}, behind = {.certain = i % 2};
        for (int c = 0; c < 3; c++) {
            spread(ldexpf(next_share(), c * 4), by, c, &lit);
            spread(ldexpf(next_share(), 4), by, c, &behind);
        }
        const tl_allowance seen = tl_allowance_blended(a, &lit, &behind);
        assert_int_equal(seen.certain, i % 2);
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 9; k++) {
                const float x = inside(lit.low[c], lit.high[c], k % 3),
                            y = inside(behind.low[c], behind.high[c], k / 3);
                const double got = (double)blended(a, x, y);
                if (!(got >= seen.low[c] && got <= seen.high[c]))
                    fail_msg("%g over: %.9g is outside %.9g to %.9g", (double)a, got,
                             seen.low[c], seen.high[c]);
            }
        for (int c = 0; c < 3; c++) {
            const double most = (double)a * lit.high[c] + (1.0 - (double)a) * behind.high[c];
            assert_true(seen.high[c] <= most * (1.0 + 3.01 * unit) + flushed);
            assert_true(seen.low[c] <= seen.expected[c] && seen.expected[c] <= seen.high[c]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formula_is_within_its_bound),
        cmocka_unit_test(allowances_follow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
