/* Is a case called faster, slower or the same only where both medians' intervals say so? */
#include "testing.h"

#include "bench_json.h"
#include "comparison.h"
#include "json_values.h"

/* A median of 1 known to +- `half`, times `at`. */
static tl_summary known_to(double at, double half, size_t count)
{
    return (tl_summary){
        .count = count, .median = at, .interval = {at * (1.0 - half), at * (1.0 + half), 0.95}};
}

static const struct {
    const char *name;
    double ratio, half; /* now over before; of both medians */
    size_t count;
    tl_verdict verdict;
} cases[] = {
    {"equal, well known", 1.0, 0.01, 10, TL_SAME},
    {"equal, hardly known", 1.0, 0.1, 10, TL_UNDECIDED},
    {"a little slower, within the threshold", 1.02, 0.01, 10, TL_SAME},
    {"at the threshold", 1.05, 0.01, 10, TL_UNDECIDED},
    {"beyond it, but not surely", 1.08, 0.02, 10, TL_UNDECIDED},
    {"surely slower", 1.1, 0.02, 10, TL_SLOWER},
    {"surely faster", 0.9, 0.02, 10, TL_FASTER},
    {"faster as 1/1.05 is, not as 0.95 is", 0.9519, 0.0001, 10, TL_FASTER},
    {"one sample each, twice as slow", 2.0, 0.0, 1, TL_UNDECIDED},
};

static void verdicts_follow_the_rule(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_summary before = known_to(7.0, cases[i].half, cases[i].count);
        const tl_summary now = known_to(7.0 * cases[i].ratio, cases[i].half, cases[i].count);
        const tl_comparison c = tl_compare_times(&before, &now, 0.05);
        if (c.verdict != cases[i].verdict)
            fail_msg("%s: %s, want %s (%g to %g)", cases[i].name, tl_verdict_words[c.verdict],
                     tl_verdict_words[cases[i].verdict], c.low, c.high);
    }
}

/* A record of the first combination of the lists, known to 1 %. */
static tl_bench_record record_of(const tl_bench_lists *lists, double ms)
{
    tl_bench_cases made = {0};
    tl_error err;
    ASSERT_OK(tl_bench_cases_add(&made, lists, &err), err);
    const tl_bench_record record = {.of = made.cases[0], .frame_ms = known_to(ms, 0.01, 10)};
    tl_bench_cases_clear(&made);
    return record;
}

/* Through a file, as the command does it. */
static void the_same_case_is_found(void **state)
{
    const tl_bench_lists usual = {{NULL}}, other = {.of[TL_AXIS_TILE] = "8"};
    const tl_bench_record before = record_of(&usual, 10.0), now = record_of(&usual, 20.0),
                          never = record_of(&other, 10.0);
    const tl_machine machine = {.processor = "none"};
    char path[4096];
    json_t *report = tl_bench_json_begin(&machine), *read = NULL;
    tl_comparison c;
    tl_error err;
    (void)state;
    json_object_set_new(report, "records", json_pack("[o]", tl_bench_json_record(&before)));
    scratch_path(path, sizeof path, "comparison.json");
    ASSERT_OK(tl_json_write(path, report, &err), err);
    ASSERT_OK(tl_bench_report_read(path, &read, &err), err);
    ASSERT_OK(tl_compare_record(read, path, &now, 0.05, &c, &err), err);
    assert_int_equal(c.verdict, TL_SLOWER);
    assert_true(fabs(c.ratio - 2.0) < 1e-12);
    ASSERT_OK(tl_compare_record(read, path, &never, 0.05, &c, &err), err);
    assert_int_equal(c.verdict, TL_NEW);
    json_decref(read);
}

static void what_is_no_report_is_refused(void **state)
{
    static const struct {
        const char *text, *word;
    } bad[] = {
        {"{\"tilelight_bench\": 1,", "line 1"},
        {"[]", "no JSON object"},
        {"{\"records\": []}", "no report"},
        {"{\"tilelight_bench\": 1}", "no report"},
        {"{\"tilelight_bench\": 2, \"records\": []}", "version 2"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        char path[4096];
        json_t *read = NULL;
        tl_error err;
        FILE *file = fopen(scratch_path(path, sizeof path, "no-report.json"), "w");
        assert_non_null(file);
        fputs(bad[i].text, file);
        fclose(file);
        assert_int_equal(tl_bench_report_read(path, &read, &err), TL_ERR_FORMAT);
        assert_non_null(strstr(err.message, bad[i].word));
        assert_null(read);
    }
}

static void a_record_without_times_is_refused(void **state)
{
    const tl_bench_lists usual = {{NULL}};
    const tl_bench_record now = record_of(&usual, 1.0);
    json_t *report = json_pack("{s[{s{}}]}", "records", "case");
    tl_comparison c;
    tl_error err;
    (void)state;
    assert_int_equal(tl_compare_record(report, "old.json", &now, 0.05, &c, &err),
                     TL_ERR_FORMAT);
    assert_non_null(strstr(err.message, "old.json: record 0"));
    json_decref(report);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdicts_follow_the_rule),
        cmocka_unit_test(the_same_case_is_found),
        cmocka_unit_test(what_is_no_report_is_refused),
        cmocka_unit_test(a_record_without_times_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
