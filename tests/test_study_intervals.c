/* Does a second run come out inside the interval of the first as often as that says, and is what left it, or
 * drifted, marked? */
#include "testing.h"

#include "values.h"

#include <math.h>

enum { BLOCKS = TL_STUDY_BLOCK_COUNT, ALL = 2 * BLOCKS };

static unsigned ones_in(unsigned mask)
{
    unsigned count = 0;
    for (; mask; mask &= mask - 1)
        count++;
    return count;
}

static tl_study_record record_of(const double blocks[BLOCKS])
{
    const tl_study_config config = tl_study_config_default();
    tl_study_record record = tl_study_record_empty(&config, 1.0);
    record.times[TL_TIME_LIGHT_RATIO] = tl_study_time_of(blocks, BLOCKS, BLOCKS);
    return record;
}

static void note_again(tl_study_record *record, double median)
{
    tl_study_time times[TL_STUDY_TIME_COUNT];
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++)
        times[i] = tl_study_time_known((double)NAN);
    times[tl_study_judged(record)] = tl_study_time_known(median);
    tl_study_note_again(record, times);
}

/* All ways in which two runs' blocks may lie among each other: exactly the share that is stated. The interval
 * that knows this run's median at 95 % is narrower, and would promise too much. */
static void intervals_hold_as_often_as_they_say(void **state)
{
    unsigned long ways = 0, outside = 0, outside_of_median = 0;
    (void)state;
    for (unsigned mask = 0; mask < 1u << ALL; mask++) {
        double first[BLOCKS], second[BLOCKS];
        int firsts = 0, seconds = 0;
        if (ones_in(mask) != BLOCKS)
            continue;
        for (unsigned rank = 0; rank < ALL; rank++) {
            if (mask >> rank & 1)
                first[firsts++] = rank;
            else
                second[seconds++] = rank;
        }
        tl_study_record record = record_of(first);
        note_again(&record, tl_study_time_of(second, BLOCKS, BLOCKS).median);
        const tl_interval known = tl_summarize(first, BLOCKS).interval;
        ways++;
        outside += tl_study_stays(&record) == 0;
        outside_of_median +=
            record.again.median < known.low || record.again.median > known.high;
    }
    assert_int_equal(ways, 705432);
    assert_int_equal(outside, 2 * 4368);
    assert_true(fabs((double)outside / (double)ways - (1.0 - tl_study_interval_coverage())) <
                1e-12);
    assert_true((double)outside_of_median / (double)ways > 0.05);
}

/* Whatever is in the middle, the others in all ways before and behind it. */
static void drift_is_rare_by_chance(void **state)
{
    unsigned ways = 0, unstable = 0;
    (void)state;
    for (int middle = 0; middle < BLOCKS; middle++)
        for (unsigned mask = 0; mask < 1u << (BLOCKS - 1); mask++) {
            double blocks[BLOCKS];
            int before = 0, behind = BLOCKS / 2 + 1;
            if (ones_in(mask) != BLOCKS / 2)
                continue;
            for (int i = 0; i < BLOCKS - 1; i++)
                blocks[mask >> i & 1 ? before++ : behind++] = i < middle ? i : i + 1;
            blocks[BLOCKS / 2] = middle;
            ways++;
            unstable += (unsigned)tl_study_time_of(blocks, BLOCKS, BLOCKS).is_unstable;
        }
    assert_int_equal(ways, BLOCKS * 252);
    assert_int_equal(unstable, BLOCKS * 2);
}

/* In no order; the median is the sixth. */
static const double some_blocks[BLOCKS] = {1.9, 2.4, 2.0, 2.2, 2.1, 1.8,
                                           2.3, 2.6, 1.7, 2.5, 1.6};

static void blocks_make_a_time(void **state)
{
    const tl_study_time t = tl_study_time_of(some_blocks, BLOCKS, 33);
    (void)state;
    assert_true(t.median == 2.1 && t.low == 1.6 && t.high == 2.6 && t.samples == 33);
    assert_false(t.is_unstable);
}

/* A study that is not done states what it has, and does not say yet what drifts. */
static void some_blocks_make_a_time(void **state)
{
    static const double falling[BLOCKS] = {3.0, 2.0, 1.0, 0.5, 0.25}; /* and zeros */
    const tl_study_time one = tl_study_time_of(falling, 1, 2),
                        four = tl_study_time_of(falling, 4, 8);
    (void)state;
    assert_true(one.median == 3.0 && one.low == 3.0 && one.high == 3.0 && one.samples == 2);
    assert_true(four.median == 1.5 && four.low == 0.5 && four.high == 3.0);
    assert_false(one.is_unstable || four.is_unstable);
}

static void second_runs_are_judged(void **state)
{
    static const struct {
        double again;
        int stays;
    } rows[] = {{2.1, 1}, {1.6, 1}, {2.6, 1}, {1.5999, 0}, {2.6001, 0}, {0.0, 0}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        tl_study_record record = record_of(some_blocks);
        assert_int_equal(tl_study_stays(&record), -1);
        note_again(&record, rows[i].again);
        assert_int_equal(tl_study_stays(&record), rows[i].stays);
        assert_int_equal(record.times[TL_TIME_LIGHT_RATIO].is_unstable, !rows[i].stays);
        assert_true(record.times[TL_TIME_LIGHT_RATIO].median == 2.1);
    }
}

/* Lighting that is the default's is not measured: the job is what says something. */
static void jobs_are_judged_where_lighting_is_known(void **state)
{
    tl_study_record record = record_of(some_blocks);
    (void)state;
    record.times[TL_TIME_LIGHT_RATIO] = tl_study_time_known(1.0);
    record.times[TL_TIME_JOB_RATIO] = tl_study_time_of(some_blocks, BLOCKS, BLOCKS);
    assert_int_equal(tl_study_judged(&record), TL_TIME_JOB_RATIO);
    note_again(&record, 2.7);
    assert_int_equal(tl_study_stays(&record), 0);
    assert_true(record.times[TL_TIME_JOB_RATIO].is_unstable);
    assert_false(record.times[TL_TIME_LIGHT_RATIO].is_unstable);
}

/* What drifted in the first run stays marked, wherever the second comes out. */
static void drift_stays_marked(void **state)
{
    static const double rising[BLOCKS] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    tl_study_record record = record_of(rising);
    (void)state;
    assert_true(record.times[TL_TIME_LIGHT_RATIO].is_unstable);
    note_again(&record, 6.0);
    assert_int_equal(tl_study_stays(&record), 1);
    assert_true(record.times[TL_TIME_LIGHT_RATIO].is_unstable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_hold_as_often_as_they_say),
        cmocka_unit_test(drift_is_rare_by_chance),
        cmocka_unit_test(blocks_make_a_time),
        cmocka_unit_test(some_blocks_make_a_time),
        cmocka_unit_test(second_runs_are_judged),
        cmocka_unit_test(jobs_are_judged_where_lighting_is_known),
        cmocka_unit_test(drift_stays_marked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
