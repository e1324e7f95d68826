/* Do causes add up to the error, is culling none of them, and is nothing measured twice? */
#define _DEFAULT_SOURCE /* mkdtemp */
#include "frames.h"
#include "testing.h"

#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIDE = 64 };

static tl_device *device; /* for all tests: kernels are built once */

static tl_study new_study(void)
{
    return (tl_study){.machine = tl_machine_ask(), .device = tl_device_describe(device)};
}

static tl_study_frame make_frame(const char *name, uint32_t light_count)
{
    tl_study_frame frame = {0};
    tl_error err;
    for (int i = 0; i < tl_study_built_in_count; i++)
        if (strcmp(tl_study_built_ins[i].name, name) == 0) {
            tl_study_built_in row = tl_study_built_ins[i];
            row.light_count = light_count;
            row.lights_per_tile = light_count / 2.0;
            ASSERT_OK(tl_study_built_in_make(&row, SIDE, SIDE, &frame, &err), err);
        }
    assert_non_null(frame.gbuffer);
    return frame;
}

/* In C, so that only the default configuration needs kernels. */
static void add(tl_study_plan *plan,
                const char *layout,
                const char *compression,
                const char *cutoff,
                const char *cull,
                const char *output)
{
    const tl_study_lists lists = {{[TL_STUDY_KNOB_LAYOUT] = layout,
                                   [TL_STUDY_KNOB_COMPRESSION] = compression,
                                   [TL_STUDY_KNOB_PRECISION] = "twin",
                                   [TL_STUDY_KNOB_CUTOFF] = cutoff,
                                   [TL_STUDY_KNOB_CULL] = cull,
                                   [TL_STUDY_KNOB_OUTPUT] = output}};
    tl_error err;
    ASSERT_OK(tl_study_plan_add(plan, &lists, &err), err);
}

static tl_study_options fast(const char *folder)
{
    tl_study_options options = tl_study_options_default();
    options.folder = folder;
    options.seconds = 0.001;
    return options;
}

static size_t run(tl_study *study,
                  const tl_study_frame *frame,
                  const tl_study_plan *plan,
                  const tl_study_options *options,
                  int *was_stopped)
{
    size_t measured = 0;
    int stopped = 0;
    tl_error err;
    ASSERT_OK(tl_study_run(study, device, frame, plan, options, &measured, &stopped, &err),
              err);
    if (was_stopped)
        *was_stopped = stopped;
    return measured;
}

static const tl_study_record *find(const tl_study *study, const char *title)
{
    char own[1024];
    for (size_t i = 0; i < study->results[0].count; i++) {
        tl_study_config_title(&study->results[0].records[i].config, own, sizeof own);
        if (strcmp(own, title) == 0)
            return &study->results[0].records[i];
    }
    fail_msg("no record of %s", title);
    return NULL;
}

/* By the triangle's inequality, which holds for root mean squares and for maxima, and value by value as a
 * sum: exactly, for differences of floats of like size are exact in double and add up so. */
static void assert_adds_up(const tl_study_record *r)
{
    const double *v = r->values, slack = 1.0 + 1e-9;
    double rms = 0.0, most = 0.0, worst = 0.0;
    char title[1024];
    tl_study_config_title(&r->config, title, sizeof title);
    for (int cause = 0; cause < TL_STUDY_CAUSE_COUNT; cause++) {
        assert_true(v[TL_VALUE_RMS_STORAGE + cause] >= 0.0);
        rms += v[TL_VALUE_RMS_STORAGE + cause];
        most += v[TL_VALUE_MOST_STORAGE + cause];
        worst += v[TL_VALUE_WORST_STORAGE + cause];
    }
    if (!(v[TL_VALUE_ERROR_RMS] <= rms * slack) || !(v[TL_VALUE_ERROR_MAX] <= most * slack))
        fail_msg("%s: RMS %g, by causes %g; most %g, by causes %g", title,
                 v[TL_VALUE_ERROR_RMS], rms, v[TL_VALUE_ERROR_MAX], most);
    if (fabs(worst - (v[TL_VALUE_WORST_GOT] - v[TL_VALUE_WORST_EXPECTED])) >
        1e-12 * fabs(v[TL_VALUE_WORST_EXPECTED]))
        fail_msg("%s: the worst pixel's causes come to %g, its error to %g", title, worst,
                 v[TL_VALUE_WORST_GOT] - v[TL_VALUE_WORST_EXPECTED]);
    assert_true(v[TL_VALUE_CULLING_DIFFERING] == 0.0);
    assert_true(v[TL_VALUE_RMS_CULLING] == 0.0);
}

/* Which causes a configuration has. */
static void causes_are_told_apart(void **state)
{
    static const struct {
        const char *title;
        unsigned causes;          /* bits 1 << cause */
        const char *worst_detail; /* NULL: any */
    } rows[] = {
        {"default", 1u << TL_STUDY_ARITHMETIC, "precision=float"},
        {"precision=twin", 1u << TL_STUDY_ARITHMETIC, NULL},
        {"precision=twin cull=depth", 1u << TL_STUDY_ARITHMETIC, NULL},
        {"layout=float-forward precision=twin",
         1u << TL_STUDY_STORAGE | 1u << TL_STUDY_ARITHMETIC, "depth"},
        {"layout=compact-12 precision=twin", 1u << TL_STUDY_STORAGE | 1u << TL_STUDY_ARITHMETIC,
         NULL},
        {"layout=compact-12 precision=twin output=half",
         1u << TL_STUDY_STORAGE | 1u << TL_STUDY_ARITHMETIC | 1u << TL_STUDY_OUTPUT, NULL},
        {"layout=compact-12 precision=twin output=png",
         1u << TL_STUDY_STORAGE | 1u << TL_STUDY_ARITHMETIC | 1u << TL_STUDY_OUTPUT, NULL},
        {"compression=zip precision=twin", 1u << TL_STUDY_ARITHMETIC, NULL},
        {"compression=pxr24 precision=twin", 1u << TL_STUDY_STORAGE | 1u << TL_STUDY_ARITHMETIC,
         NULL},
    };
    tl_study_frame frame = make_frame("spheres", 16);
    tl_study study = new_study();
    tl_study_plan plan = {0};
    const tl_study_options options = fast(*state);
    add(&plan, "float", "none,zip,pxr24", NULL, NULL, NULL);
    add(&plan, "float", NULL, NULL, "depth", NULL);
    add(&plan, "float-forward", NULL, NULL, NULL, NULL);
    add(&plan, "compact-12", NULL, NULL, NULL, "float,half,png");
    assert_int_equal(run(&study, &frame, &plan, &options, NULL), COUNT_OF(rows));
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const tl_study_record *r = find(&study, rows[i].title);
        assert_adds_up(r);
        for (int cause = 0; cause < TL_STUDY_CAUSE_COUNT; cause++)
            if ((r->values[TL_VALUE_RMS_STORAGE + cause] > 0.0) !=
                (rows[i].causes >> cause & 1))
                fail_msg("%s: %s comes to %g", rows[i].title, tl_study_cause_words[cause],
                         r->values[TL_VALUE_RMS_STORAGE + cause]);
        if (rows[i].worst_detail)
            assert_string_equal(r->worst_detail, rows[i].worst_detail);
        assert_true(r->times[TL_TIME_LIGHT].median > 0.0);
        assert_true(r->times[TL_TIME_READ].median > 0.0);
        assert_true(r->times[TL_TIME_JOB].median > r->times[TL_TIME_READ].median);
    }
    /* Fewer bytes are stored, moved and in the file. */
    const tl_study_record *large = find(&study, "precision=twin"),
                          *small = find(&study, "layout=compact-12 precision=twin"),
                          *zipped = find(&study, "compression=zip precision=twin");
    assert_true(large->values[TL_VALUE_STORED] == 44.0 &&
                small->values[TL_VALUE_STORED] == 12.0);
    assert_true(small->values[TL_VALUE_MOVED] < large->values[TL_VALUE_MOVED]);
    assert_true(small->values[TL_VALUE_FILE] < large->values[TL_VALUE_FILE]);
    assert_true(zipped->values[TL_VALUE_FILE] < large->values[TL_VALUE_FILE]);
    tl_study_plan_clear(&plan);
    tl_study_clear(&study);
    tl_study_frame_clear(&frame);
}

/* Lights without a range that end early: less of them is left out the fainter they must be. */
static void cutoffs_are_approximations(void **state)
{
    static const char *const titles[] = {"precision=twin", "precision=twin cutoff=1",
                                         "precision=twin cutoff=30"};
    tl_study_frame frame = make_frame("foliage", 4);
    tl_study study = new_study();
    tl_study_plan plan = {0};
    tl_study_options options = fast(NULL);
    double before = -1.0;
    (void)state;
    add(&plan, NULL, NULL, "0,1,30", NULL, NULL);
    run(&study, &frame, &plan, &options, NULL);
    for (size_t i = 0; i < COUNT_OF(titles); i++) {
        const tl_study_record *r = find(&study, titles[i]);
        assert_adds_up(r);
        if (!(r->values[TL_VALUE_RMS_APPROXIMATION] > before))
            fail_msg("%s leaves out %g, the one before %g", titles[i],
                     r->values[TL_VALUE_RMS_APPROXIMATION], before);
        before = r->values[TL_VALUE_RMS_APPROXIMATION];
    }
    assert_true(find(&study, titles[0])->values[TL_VALUE_RMS_APPROXIMATION] == 0.0);
    tl_study_plan_clear(&plan);
    tl_study_clear(&study);
    tl_study_frame_clear(&frame);
}

/* Counts down. */
static int stop_at(void *context)
{
    int *calls = context;
    return --*calls == 0;
}

static void check_step(void *context, const tl_study_step *step)
{
    (void)context;
    assert_true(step->index < step->count);
    assert_true(step->round >= 0 && step->round < TL_STUDY_BLOCK_COUNT);
}

static void check_blocks(const tl_study *study, int of_lit, int after)
{
    for (size_t i = 0; i < study->results[0].count; i++) {
        const tl_study_record *r = &study->results[0].records[i];
        const int is_known =
            r->config.output == TL_STUDY_HALF && tl_study_config_is_usual(&r->config, 0);
        const int expected = is_known ? 0 : i < (size_t)after ? of_lit : of_lit - 1;
        char title[1024];
        tl_study_config_title(&r->config, title, sizeof title);
        if (r->lit.count != expected)
            fail_msg("%s has %d blocks, not %d", title, r->lit.count, expected);
        if (!is_known && (r->times[TL_TIME_LIGHT_RATIO].samples < 2 * (size_t)expected ||
                          r->times[TL_TIME_LIGHT_RATIO].samples != r->lit.samples))
            fail_msg("%s has %zu samples", title, r->lit.samples);
        assert_true(r->times[TL_TIME_JOB].median > 0.0);
    }
}

/* Ended after two of five, gone on from the file, ended in the third round, gone on; then nothing is left,
 * until something else is asked. */
static void studies_go_on_where_they_ended(void **state)
{
    tl_study_frame frame = make_frame("spheres", 16);
    tl_study study = new_study(), between = new_study(), again = new_study();
    tl_study_plan plan = {0};
    tl_study_options options = fast(*state);
    int calls = 0, was_stopped = 0;
    char path[4200];
    tl_error err;
    snprintf(path, sizeof path, "%s/study.json", options.folder);
    unlink(path);
    add(&plan, "float,float-forward", NULL, NULL, NULL, "float,half");
    options.watch = (tl_study_watch){check_step, stop_at, &calls};
    calls = 2;
    assert_int_equal(run(&study, &frame, &plan, &options, &was_stopped), 2);
    assert_true(was_stopped);
    check_blocks(&study, 1, 2);

    calls = 3 + 5 + 2; /* the first two have been in the first round */
    ASSERT_OK(tl_study_resume(&between, options.folder, &err), err);
    assert_int_equal(run(&between, &frame, &plan, &options, &was_stopped), 5);
    assert_true(was_stopped);
    check_blocks(&between, 3, 2);

    options.watch = (tl_study_watch){0};
    ASSERT_OK(tl_study_resume(&again, options.folder, &err), err);
    assert_int_equal(again.results[0].count, 5);
    assert_int_equal(run(&again, &frame, &plan, &options, &was_stopped), 5);
    assert_false(was_stopped);
    check_blocks(&again, TL_STUDY_BLOCK_COUNT, 5);
    assert_int_equal(again.results[0].count, 5);
    assert_int_equal(run(&again, &frame, &plan, &options, NULL), 0);

    options.seconds *= 2.0; /* timed more closely: all again, in place of what was */
    assert_int_equal(run(&again, &frame, &plan, &options, NULL), 5);
    assert_int_equal(again.results[0].count, 5);
    frame.lights.lights[0].intensity *= 2.0f; /* another frame of that name */
    assert_int_equal(run(&again, &frame, &plan, &options, NULL), 5);
    assert_int_equal(again.count, 1);
    tl_study_plan_clear(&plan);
    tl_study_clear(&study);
    tl_study_clear(&between);
    tl_study_clear(&again);
    tl_study_frame_clear(&frame);
}

/* A first run that cannot be right is told from one that cannot be wrong; nothing else of it changes. */
static void second_runs_are_held_against_the_first(void **state)
{
    tl_study_frame frame = make_frame("spheres", 16);
    tl_study study = new_study();
    tl_study_plan plan = {0};
    tl_study_options options = fast(*state);
    size_t twice, stay;
    tl_error err;
    add(&plan, "float,float-forward", NULL, NULL, NULL, NULL);
    add(&plan, "float", "zip", NULL, NULL, NULL);
    assert_int_equal(run(&study, &frame, &plan, &options, NULL), 4);
    for (size_t i = 0; i < 4; i++) {
        tl_study_record *r = &study.results[0].records[i];
        tl_study_time *stated = &r->times[tl_study_judged(r)];
        stated->low = i < 2 ? 0.0 : 1e8;
        stated->high = 1e9;
        stated->is_unstable = 0;
    }
    const tl_study_record before = *find(&study, "precision=twin");
    tl_study_count_again(&study, &twice, &stay);
    assert_int_equal(twice, 0);

    options.again = 1;
    assert_int_equal(run(&study, &frame, &plan, &options, NULL), 4);
    tl_study_count_again(&study, &twice, &stay);
    assert_int_equal(twice, 4);
    assert_int_equal(stay, 2);
    for (size_t i = 0; i < 4; i++) {
        const tl_study_record *r = &study.results[0].records[i];
        assert_int_equal(r->times[tl_study_judged(r)].is_unstable, i >= 2);
    }
    const tl_study_record *after = find(&study, "precision=twin");
    assert_memory_equal(after->values, before.values, sizeof before.values);
    assert_true(after->times[TL_TIME_LIGHT].median == before.times[TL_TIME_LIGHT].median);
    assert_string_equal(after->map, before.map);

    size_t measured;
    int was_stopped;
    options.seconds *= 2.0;
    assert_int_equal(
        tl_study_run(&study, device, &frame, &plan, &options, &measured, &was_stopped, &err),
        TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "nothing is measured yet, or not for"));
    frame.lights.lights[0].intensity *= 2.0f;
    assert_int_equal(
        tl_study_run(&study, device, &frame, &plan, &options, &measured, &was_stopped, &err),
        TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "it was another frame"));
    tl_study_plan_clear(&plan);
    tl_study_clear(&study);
    tl_study_frame_clear(&frame);
}

/* Of the file that an earlier test left. */
static void other_machines_are_refused(void **state)
{
    tl_study other = new_study();
    tl_error err;
    snprintf(other.machine.processor, sizeof other.machine.processor, "another processor");
    assert_int_equal(tl_study_resume(&other, *state, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "another machine"));
    tl_study_clear(&other);
}

static int enter(void **state)
{
    static char folder[4096];
    void *opened = NULL;
    open_device(&opened);
    device = opened;
    scratch_path(folder, sizeof folder, "study-XXXXXX");
    *state = mkdtemp(folder);
    return *state ? 0 : -1;
}

static int leave(void **state)
{
    (void)state;
    tl_device_close(device);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(causes_are_told_apart),
        cmocka_unit_test(cutoffs_are_approximations),
        cmocka_unit_test(studies_go_on_where_they_ended),
        cmocka_unit_test(second_runs_are_held_against_the_first),
        cmocka_unit_test(other_machines_are_refused),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
