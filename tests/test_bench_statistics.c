/* Is the median of samples what it is, and bounded by the samples that bound it at 95 %? */
#include "testing.h"

#include "sampling.h"
#include "tilelight/report.h"

/* tests/tools/oracle_median_ranks.py */
static const struct {
    size_t count, rank;
    double coverage;
} bounds[] = {
    {1, 1, 0.000000000},     {2, 1, 0.500000000},      {5, 1, 0.937500000},
    {6, 1, 0.968750000},     {8, 1, 0.992187500},      {9, 2, 0.960937500},
    {10, 2, 0.978515625},    {11, 2, 0.988281250},     {20, 6, 0.958610535},
    {25, 8, 0.956714749},    {50, 18, 0.967160862},    {100, 40, 0.964799800},
    {999, 469, 0.950244463}, {1000, 469, 0.953708803}, {3000, 1446, 0.953433551},
};

/* The numbers 1 to count, in an order that is not theirs. */
static double *shuffled(size_t count)
{
    double *samples = calloc(count, sizeof *samples);
    assert_non_null(samples);
    for (size_t i = 0; i < count; i++)
        samples[i] = (double)(i * 7919 % count + 1); /* a prime that divides no count above */
    return samples;
}

static void intervals_are_those_of_the_binomial(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bounds); i++) {
        const size_t n = bounds[i].count;
        double *samples = shuffled(n);
        const tl_summary s = tl_summarize(samples, n);
        assert_int_equal(s.count, n);
        if (s.interval.low != (double)bounds[i].rank ||
            s.interval.high != (double)(n + 1 - bounds[i].rank) ||
            fabs(s.interval.coverage - bounds[i].coverage) > 1e-9)
            fail_msg("%zu samples: %g to %g with %.9f, want rank %zu with %.9f", n,
                     s.interval.low, s.interval.high, s.interval.coverage, bounds[i].rank,
                     bounds[i].coverage);
        assert_true(s.median == 0.5 * (double)(n + 1));
        assert_true(s.least == 1.0);
        free(samples);
    }
}

static void nine_of_ten_do_not_exceed_p90(void **state)
{
    static const struct {
        size_t count;
        double p90;
    } cases[] = {{1, 1}, {2, 2}, {9, 9}, {10, 9}, {11, 10}, {100, 90}, {101, 91}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        double *samples = shuffled(cases[i].count);
        assert_true(tl_summarize(samples, cases[i].count).p90 == cases[i].p90);
        free(samples);
    }
}

static void one_sample_says_nothing_of_itself(void **state)
{
    double one = 3.0, two[] = {3.0, 5.0};
    (void)state;
    tl_summary s = tl_summarize(&one, 1);
    assert_true(isinf(tl_relative_deviation(&s)));
    s = tl_summarize(two, 2);
    assert_true(tl_relative_deviation(&s) == 0.25);
    s = tl_summarize(NULL, 0);
    assert_int_equal(s.count, 0);
    assert_true(isinf(tl_relative_deviation(&s)));
}

static void sampling_ends_when_enough_is_known(void **state)
{
    tl_sampling_rule rule = {.least_samples = 10, .deviation = 0.01, .seconds = 1e9};
    tl_samples samples = {0};
    tl_error err;
    (void)state;
    for (int i = 0; i < 10; i++) {
        assert_false(tl_sampling_done(&rule, &samples, tl_seconds()));
        ASSERT_OK(tl_samples_add(&samples, 1.0 + 0.1 * (i % 2), &err), err);
    }
    assert_false(tl_sampling_done(&rule, &samples, tl_seconds())); /* they vary by 10 % */
    rule.deviation = 0.05;
    assert_true(tl_sampling_done(&rule, &samples, tl_seconds()));
    rule.deviation = 0.01;
    rule.seconds = 0.0; /* out of time */
    assert_true(tl_sampling_done(&rule, &samples, tl_seconds()));
    rule.least_samples = 11; /* but not with fewer than asked for */
    assert_false(tl_sampling_done(&rule, &samples, tl_seconds()));
    tl_samples_clear(&samples);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_are_those_of_the_binomial),
        cmocka_unit_test(nine_of_ten_do_not_exceed_p90),
        cmocka_unit_test(one_sample_says_nothing_of_itself),
        cmocka_unit_test(sampling_ends_when_enough_is_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
