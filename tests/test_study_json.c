/* Does a study come back from JSON as it was written, and is what is none refused? */
#include "testing.h"

#include "study_json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Every number another one, some of them missing. */
static tl_study_record random_record(uint32_t *seed, const char *layout)
{
    tl_study_config config = tl_study_config_default();
    tl_error err;
    ASSERT_OK(tl_study_config_set(&config, TL_STUDY_KNOB_LAYOUT, layout, &err), err);
    tl_study_record r = tl_study_record_empty(&config, 0.625);
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++) {
        *seed = *seed * 1664525u + 1013904223u;
        if (*seed >> 30)
            r.times[i] = (tl_study_time){*seed * 1e-5, *seed * 1e-6, *seed * 1e-4, *seed >> 20,
                                         *seed >> 29 & 1};
    }
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++) {
        *seed = *seed * 1664525u + 1013904223u;
        if (*seed >> 30)
            r.values[i] = ldexp(*seed, (int)(*seed >> 24) - 128);
    }
    r.lit = (tl_study_blocks){.count = (int)(*seed >> 24) % (TL_STUDY_BLOCK_COUNT + 1),
                              .samples = *seed >> 20};
    for (int i = 0; i < TL_STUDY_LIT_COUNT; i++)
        for (int k = 0; k < r.lit.count; k++)
            r.lit.medians[i][k] = *seed * 1e-4 + 10 * i + k;
    if (*seed >> 31)
        tl_study_note_again(&r, r.times);
    snprintf(r.worst_cause, sizeof r.worst_cause, "storage");
    snprintf(r.worst_detail, sizeof r.worst_detail, "normal");
    snprintf(r.map, sizeof r.map, "maps/a \"b\".png");
    return r;
}

/* Of two claims; one line has no figure of theirs. */
static void make_claims(tl_study *study)
{
    for (int i = 1; i < TL_CLAIM_COUNT; i += 2) {
        tl_claim_figures *figures = &study->claims[i];
        for (int k = 0; k < TL_CLAIM_MOST_FIGURES; k++) {
            tl_claim_figure *f = tl_claim_add(figures, "% \"saved\"", k, k + 1.5, 1e-3 * k + i,
                                              "figure %d of %d", k, i);
            f->low = -1.0;
            f->high = 1e4;
        }
        figures->of[3].theirs[0] = figures->of[3].theirs[1] = (double)NAN;
    }
}

static tl_study make_study(void)
{
    static const char *const layouts[] = {"float", "merlin", "compact-12"};
    uint32_t seed = 3;
    tl_study study = {.machine = {"a processor", 2, 0.5},
                      .device = {.name = "a device", .driver = "1", .compute_units = 2},
                      .command = "tilelight study -o x"};
    make_claims(&study);
    study.count = 2;
    study.results = calloc(study.count, sizeof *study.results);
    for (size_t i = 0; i < study.count; i++) {
        tl_study_result *result = &study.results[i];
        *result = (tl_study_result){.width = 64,
                                    .height = 32,
                                    .present = TL_GROUP_BASE | TL_GROUP_PHONG,
                                    .light_count = 8,
                                    .mean = 0.25,
                                    .exposure = -1.5,
                                    .count = COUNT_OF(layouts)};
        snprintf(result->name, sizeof result->name, "frame-%zu", i);
        snprintf(result->identity, sizeof result->identity, "%032zu", i);
        snprintf(result->source, sizeof result->source, "nowhere");
        result->records = calloc(result->count, sizeof *result->records);
        for (size_t k = 0; k < result->count; k++)
            result->records[k] = random_record(&seed, layouts[k]);
    }
    return study;
}

/* 9 digits are written. */
static int is_near(double a, double b)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-8 * fabs(a);
}

static void assert_same_record(const tl_study_record *a, const tl_study_record *b)
{
    assert_true(tl_study_config_is_same(&a->config, &b->config));
    assert_true(is_near(a->seconds, b->seconds));
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++) {
        const tl_study_time *x = &a->times[i], *y = &b->times[i];
        if (!is_near(x->median, y->median) || !is_near(x->low, y->low) ||
            !is_near(x->high, y->high) || x->samples != y->samples ||
            x->is_unstable != y->is_unstable)
            fail_msg("%s: %g is %g", tl_study_time_rows[i].name, x->median, y->median);
    }
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++)
        if (!is_near(a->values[i], b->values[i]))
            fail_msg("%s: %g is %g", tl_study_value_rows[i].name, a->values[i], b->values[i]);
    assert_int_equal(a->lit.count, b->lit.count);
    assert_int_equal(a->lit.samples, b->lit.samples);
    for (int i = 0; i < TL_STUDY_LIT_COUNT; i++)
        for (int k = 0; k < a->lit.count; k++)
            assert_true(is_near(a->lit.medians[i][k], b->lit.medians[i][k]));
    assert_true(is_near(a->again.median, b->again.median));
    assert_int_equal(tl_study_stays(a), tl_study_stays(b));
    assert_string_equal(a->worst_cause, b->worst_cause);
    assert_string_equal(a->worst_detail, b->worst_detail);
    assert_string_equal(a->map, b->map);
}

static void assert_same_claims(const tl_study *a, const tl_study *b)
{
    for (int i = 0; i < TL_CLAIM_COUNT; i++) {
        assert_int_equal(a->claims[i].count, b->claims[i].count);
        for (size_t k = 0; k < a->claims[i].count; k++) {
            const tl_claim_figure *x = &a->claims[i].of[k], *y = &b->claims[i].of[k];
            assert_string_equal(x->what, y->what);
            assert_string_equal(x->unit, y->unit);
            assert_true(is_near(x->theirs[0], y->theirs[0]) &&
                        is_near(x->theirs[1], y->theirs[1]));
            assert_true(is_near(x->ours, y->ours) && is_near(x->low, y->low) &&
                        is_near(x->high, y->high));
        }
    }
}

static void studies_come_back(void **state)
{
    tl_study study = make_study(), read = {0};
    char path[4096];
    tl_error err;
    (void)state;
    scratch_path(path, sizeof path, "study-round-trip.json");
    ASSERT_OK(tl_study_json_write(&study, path, &err), err);
    ASSERT_OK(tl_study_json_read(path, &read, &err), err);
    assert_string_equal(read.machine.processor, study.machine.processor);
    assert_int_equal(read.machine.threads, study.machine.threads);
    assert_string_equal(read.device.name, study.device.name);
    assert_string_equal(read.device.driver, study.device.driver);
    assert_string_equal(read.command, study.command);
    assert_same_claims(&study, &read);
    assert_int_equal(read.count, study.count);
    for (size_t i = 0; i < study.count; i++) {
        const tl_study_result *a = &study.results[i], *b = &read.results[i];
        assert_string_equal(a->name, b->name);
        assert_string_equal(a->identity, b->identity);
        assert_string_equal(a->source, b->source);
        assert_int_equal(a->width, b->width);
        assert_int_equal(a->height, b->height);
        assert_int_equal(a->present, b->present);
        assert_int_equal(a->light_count, b->light_count);
        assert_true(is_near(a->mean, b->mean) && is_near(a->exposure, b->exposure));
        assert_int_equal(a->count, b->count);
        for (size_t k = 0; k < a->count; k++)
            assert_same_record(&a->records[k], &b->records[k]);
    }
    tl_study_clear(&read);
    tl_study_clear(&study);
}

static void what_is_no_study_is_refused(void **state)
{
    static const struct {
        const char *text, *says;
    } rows[] = {
        {"{}", "it is no study"},
        {"[1]", "no JSON object"},
        {"{\"tilelight_study\": 99, \"frames\": []}", "a study of version 99"},
        {"{\"tilelight_study\": 1, \"frames\": [{}]}", "a frame without name"},
        {"{\"tilelight_study\": 1, \"frames\": [{\"name\": \"a\", \"identity\": \"b\", "
         "\"configurations\": [{}]}]}",
         "a configuration without knobs"},
        {"{\"tilelight_study\": 1, \"frames\": [{\"name\": \"a\", \"identity\": \"b\", "
         "\"configurations\": [{\"knobs\": {\"tile\": \"9\"}, \"times\": {}, \"values\": "
         "{}}]}]}",
         "--knob tile: \"9\" is none of"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        tl_study study = {0};
        char path[4096];
        tl_error err;
        scratch_path(path, sizeof path, "study-wrong.json");
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fputs(rows[i].text, file);
        fclose(file);
        assert_int_equal(tl_study_json_read(path, &study, &err), TL_ERR_FORMAT);
        if (!strstr(err.message, rows[i].says))
            fail_msg("\"%s\" should say \"%s\"", err.message, rows[i].says);
        assert_int_equal(study.count, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(studies_come_back),
        cmocka_unit_test(what_is_no_study_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
