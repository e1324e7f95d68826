/* Does the fit of growth find the prices that times were made from, and never one below 0? */
#include "testing.h"

#include "fit.h"

enum { COUNT = 8 };

static tl_growth_point point(double pixels, double pairs, double lights, double tiles)
{
    return (tl_growth_point){.amounts = {pixels, pairs, lights, tiles}};
}

/* Amounts as frames have them; tiles are of two sizes, so that they are no multiple of pixels. */
static void make_points(tl_growth_point points[COUNT])
{
    points[0] = point(230400, 1e6, 64, 920);
    points[1] = point(230400, 6e6, 1024, 920);
    points[2] = point(2073600, 5e7, 1024, 8160);
    points[3] = point(2073600, 6e7, 1024, 2040);
    points[4] = point(2073600, 2e8, 65536, 8160);
    points[5] = point(8294400, 2e8, 4096, 32400);
    points[6] = point(33177600, 9e8, 64, 129600);
    points[7] = point(33177600, 1e7, 65536, 32400);
}

static void price_them(tl_growth_point points[COUNT], const double prices[TL_TERM_COUNT])
{
    for (int i = 0; i < COUNT; i++) {
        points[i].ns = 0.0;
        for (int k = 0; k < TL_TERM_COUNT; k++)
            points[i].ns += prices[k] * points[i].amounts[k];
    }
}

static void prices_are_found(void **state)
{
    static const double prices[TL_TERM_COUNT] = {2.5, 0.6, 150.0, 90.0};
    tl_growth_point points[COUNT];
    (void)state;
    make_points(points);
    price_them(points, prices);
    const tl_growth_fit fit = tl_growth_fit_make(points, COUNT);
    for (int k = 0; k < TL_TERM_COUNT; k++)
        if (fabs(fit.prices[k] / prices[k] - 1.0) > 1e-6)
            fail_msg("%s: %g, want %g", tl_term_words[k], fit.prices[k], prices[k]);
    assert_true(fit.worst_residual < 1e-6);
    assert_true(fabs(fit.least_pair_price - 1.0) < 1e-6);
    assert_true(fabs(fit.most_pair_price - 1.0) < 1e-6);
}

/* Times that the free optimum would explain by a light that costs less than nothing. */
static void no_price_is_negative(void **state)
{
    static const double prices[TL_TERM_COUNT] = {2.5, 0.6, -20.0, 90.0};
    tl_growth_point points[COUNT];
    (void)state;
    make_points(points);
    price_them(points, prices);
    const tl_growth_fit fit = tl_growth_fit_make(points, COUNT);
    for (int k = 0; k < TL_TERM_COUNT; k++)
        assert_true(fit.prices[k] >= 0.0);
    assert_true(fit.prices[TL_TERM_LIGHTS] == 0.0);
    assert_true(fit.worst_residual > 1e-4);
}

/* One size of tile: the fit cannot tell a tile from its pixels, and has to do without. */
static void proportional_amounts_do_no_harm(void **state)
{
    static const double prices[TL_TERM_COUNT] = {2.5, 0.6, 150.0, 90.0};
    tl_growth_point points[COUNT];
    (void)state;
    make_points(points);
    for (int i = 0; i < COUNT; i++)
        points[i].amounts[TL_TERM_TILES] = points[i].amounts[TL_TERM_PIXELS] / 256.0;
    price_them(points, prices);
    const tl_growth_fit fit = tl_growth_fit_make(points, COUNT);
    assert_true(fit.worst_residual < 1e-6);
    assert_true(fabs(fit.prices[TL_TERM_PIXELS] + fit.prices[TL_TERM_TILES] / 256.0 -
                     (2.5 + 90.0 / 256.0)) < 1e-6);
}

/* One point 30 % off: seen as such, and in the price of its pairs. */
static void an_outlier_is_seen(void **state)
{
    static const double prices[TL_TERM_COUNT] = {2.5, 0.6, 150.0, 90.0};
    tl_growth_point points[COUNT];
    (void)state;
    make_points(points);
    price_them(points, prices);
    points[4].ns *= 1.3;
    const tl_growth_fit fit = tl_growth_fit_make(points, COUNT);
    double worst = 0.0;
    for (int i = 0; i < COUNT; i++)
        worst = fmax(worst, fabs(tl_growth_residual(&fit, &points[i])));
    assert_true(fit.worst_residual == worst);
    assert_true(worst > 0.05 && worst < 0.3);
    assert_true(fit.most_pair_price > 1.02);
    /* What is left of the time once all but pairs is paid, per pair. */
    const double others = fit.prices[0] * points[4].amounts[0] +
                          fit.prices[2] * points[4].amounts[2] +
                          fit.prices[3] * points[4].amounts[3];
    assert_true(fabs(tl_growth_pair_price(&fit, &points[4]) / ((points[4].ns - others) / 2e8) -
                     1.0) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prices_are_found),
        cmocka_unit_test(no_price_is_negative),
        cmocka_unit_test(proportional_amounts_do_no_harm),
        cmocka_unit_test(an_outlier_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
