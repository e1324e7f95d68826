/* Is the front the front: what is on it beaten by none, what is not by somebody? */
#include "testing.h"

#include "front.h"

#include <math.h>

static tl_study_record make(double time, double error, const char *output)
{
    tl_study_config config = tl_study_config_default();
    tl_error err;
    ASSERT_OK(tl_study_config_set(&config, TL_STUDY_KNOB_OUTPUT, output, &err), err);
    tl_study_record record = tl_study_record_empty(&config, 1.0);
    record.times[TL_TIME_LIGHT_RATIO] = tl_study_time_known(time);
    record.times[TL_TIME_JOB_RATIO] = tl_study_time_known(time);
    record.values[TL_VALUE_ERROR_RMS] = error;
    return record;
}

static void cases_come_out(void **state)
{
    static const struct {
        const char *name, *output;
        double time, error;
        int light, job;
    } rows[] = {
        {"fastest", "float", 0.5, 1e-2, 1, 1},
        {"as fast, and worse", "float", 0.5, 2e-2, 0, 0},
        {"in between", "float", 0.8, 1e-4, 1, 1},
        {"the same once more", "float", 0.8, 1e-4, 0, 0},
        {"slower, and worse", "float", 0.9, 1e-3, 0, 0},
        {"exact", "float", 2.0, 0.0, 1, 1},
        {"exact, and slower", "float", 2.5, 0.0, 0, 0},
        {"a job alone", "half", 0.6, 1e-3, 0, 1},
        {"a screen, with none to beat it", "png", 3.0, 1e-1, 0, 1},
        {"a screen that is beaten", "png", 3.5, 2e-1, 0, 0},
        {"without a time", "float", NAN, 1e-9, 0, 0},
        {"without an error", "float", 0.1, NAN, 0, 0},
    };
    tl_study_record records[COUNT_OF(rows)];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        records[i] = make(rows[i].time, rows[i].error, rows[i].output);
    tl_study_front_find(records, COUNT_OF(rows));
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        if ((int)records[i].values[TL_VALUE_FRONT_LIGHT] != rows[i].light ||
            (int)records[i].values[TL_VALUE_FRONT_JOB] != rows[i].job)
            fail_msg("%s: on the fronts %g, %g, not %d, %d", rows[i].name,
                     records[i].values[TL_VALUE_FRONT_LIGHT],
                     records[i].values[TL_VALUE_FRONT_JOB], rows[i].light, rows[i].job);
}

/* By the definition of Pareto, over random points on a coarse grid, where many are equal. */
static void random_points_agree_with_the_definition(void **state)
{
    enum { COUNT = 60, ROUNDS = 50 };
    static tl_study_record records[COUNT];
    uint32_t seed = 5;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < COUNT; i++) {
            seed = seed * 1664525u + 1013904223u;
            records[i] = make(1.0 + (seed >> 28), 1.0 + (seed >> 24 & 15u), "float");
        }
        tl_study_front_find(records, COUNT);
        for (int i = 0; i < COUNT; i++) {
            int is_beaten = 0, has_twin_before = 0;
            for (int k = 0; k < COUNT; k++) {
                const double dt = records[k].times[TL_TIME_LIGHT_RATIO].median -
                                  records[i].times[TL_TIME_LIGHT_RATIO].median;
                const double de = records[k].values[TL_VALUE_ERROR_RMS] -
                                  records[i].values[TL_VALUE_ERROR_RMS];
                is_beaten |= dt <= 0.0 && de <= 0.0 && (dt < 0.0 || de < 0.0);
                has_twin_before |= k < i && dt == 0.0 && de == 0.0;
            }
            assert_int_equal(records[i].values[TL_VALUE_FRONT_LIGHT],
                             !is_beaten && !has_twin_before);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_come_out),
        cmocka_unit_test(random_points_agree_with_the_definition),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
