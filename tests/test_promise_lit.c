/* Does a picture keep what was asked of it, whatever was expected: is it checked, lit in the next way where
 * it does not hold, and is what was found expected from then on?
 *
 * What is expected is planted, so that no pilot is lit: that is for tests/test_command_promise.c. */
#include "promise_frames.h"

#include "promise.h"

#include <unistd.h>

#define NEVER ((double)INFINITY)

enum { FLOAT_EXACT = 0, FLOAT_ROUGHEST = 4 };

static char folder[4096];

static int begin(void **state)
{
    char command[8300];
    (void)state;
    scratch_path(folder, sizeof folder, "promise-lit");
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

/* A frame of phong, and the kind that memory knows it by. */
typedef struct promised_frame {
    promise_frame frame;
    tl_asked asked;
    json_t *kind;
} promised_frame;

static promised_frame frame_for(tl_device *device, tl_goal_kind goal, double limit)
{
    promised_frame f = {.frame = bench_frame("spheres", 96, 64, 24)};
    const tl_device_info info = tl_device_describe(device);
    tl_prepared prepared = {0};
    tl_error err;
    f.asked = (tl_asked){.device = device,
                         .base = tl_lighting_options_default(),
                         .goal = {.kind = goal, .limit = limit},
                         .gbuffer = f.frame.gbuffer};
    ASSERT_OK(tl_prepare(f.frame.gbuffer, &f.frame.lights,
                         &(tl_prepare_options){.tile_size = 16}, NULL, &prepared, &err),
              err);
    f.kind = tl_memory_kind(&info, &f.asked.base, &f.asked.goal, f.frame.gbuffer, &prepared);
    tl_prepared_clear(&prepared);
    return f;
}

static void promised_frame_clear(promised_frame *f)
{
    json_decref(f->kind);
    promise_frame_clear(&f->frame);
}

/* All that is expected: these two, and nothing of the others. */
static void plant_expected(const promised_frame *f,
                           tl_expectation exact,
                           tl_expectation roughest)
{
    tl_expectation of[TL_MOST_CANDIDATES];
    for (uint32_t i = 0; i < tl_candidate_count; i++)
        of[i] = (tl_expectation){NEVER, NEVER};
    of[FLOAT_EXACT] = exact;
    of[FLOAT_ROUGHEST] = roughest;
    of[tl_candidate_count - 1].error = 0.0;
    assert_true(tl_memory_write(folder, f->kind, of));
}

static tl_kept light_promised(promised_frame *f)
{
    tl_lighting *lighting = NULL;
    tl_kept kept;
    tl_error err;
    f->asked.lights = &f->frame.lights;
    ASSERT_OK(tl_promise_light(&f->asked, folder, f->frame.picture, NULL, NULL, NULL, &lighting,
                               &kept, &err),
              err);
    tl_lighting_destroy(lighting);
    assert_true(kept.was_remembered);
    return kept;
}

static uint32_t maker_of(const tl_kept *kept)
{
    return kept->attempts[kept->attempt_count - 1].candidate;
}

/* The fastest is expected to keep it and does: one attempt, and the picture is as near as it says. */
static void the_fastest_that_holds(void **state)
{
    promised_frame f = frame_for(*state, TL_GOAL_RMS, 0.1);
    plant_expected(&f, (tl_expectation){10, 1e-6}, (tl_expectation){1, 1e-3});
    const tl_kept kept = light_promised(&f);
    const double truth = true_rms(f.frame.picture, f.frame.reference);
    assert_int_equal(kept.attempt_count, 1);
    assert_int_equal(maker_of(&kept), FLOAT_ROUGHEST);
    assert_true(kept.checked == kept.of);
    assert_true(truth <= kept.attempts[0].off.bound && truth <= 0.1 && truth > 1e-5);
    promised_frame_clear(&f);
}

/* It is expected to be far nearer than it is: the check sees that, the next one lights the frame, and the one
 * after that does not ask the first again. */
static void too_much_was_expected(void **state)
{
    promised_frame f = frame_for(*state, TL_GOAL_RMS, 1e-5);
    tl_expectation now[TL_MOST_CANDIDATES];
    plant_expected(&f, (tl_expectation){10, 1e-6}, (tl_expectation){1, 1e-9});
    const tl_kept kept = light_promised(&f);
    assert_int_equal(kept.attempt_count, 2);
    assert_int_equal(kept.attempts[0].candidate, FLOAT_ROUGHEST);
    assert_true(kept.attempts[0].off.bound > 1e-5);
    assert_int_equal(maker_of(&kept), FLOAT_EXACT);
    assert_true(true_rms(f.frame.picture, f.frame.reference) <= 1e-5);
    assert_true(tl_memory_read(folder, f.kind, now, NULL));
    assert_true(now[FLOAT_ROUGHEST].error > 1e-5);
    const tl_kept again = light_promised(&f);
    assert_int_equal(again.attempt_count, 1);
    assert_int_equal(maker_of(&again), FLOAT_EXACT);
    promised_frame_clear(&f);
}

/* Nothing holds: it is the reference's picture, bit for bit. */
static void in_the_end_the_reference(void **state)
{
    promised_frame f = frame_for(*state, TL_GOAL_RMS, 1e-9);
    plant_expected(&f, (tl_expectation){10, 1e-12}, (tl_expectation){1, 1e-12});
    const tl_kept kept = light_promised(&f);
    assert_int_equal(kept.attempt_count, 3);
    assert_int_equal(maker_of(&kept), tl_candidate_count - 1);
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < f.frame.picture->height; y++)
            for (uint32_t x = 0; x < f.frame.picture->width; x++) {
                const size_t at = (size_t)y * f.frame.picture->pitch + x;
                assert_true(same_bits(tl_image_plane(f.frame.picture, c)[at],
                                      tl_image_plane(f.frame.reference, c)[at]));
            }
    promised_frame_clear(&f);
}

/* No channel off by more than one code, no more FLIP than that. */
static void what_a_screen_shows(void **state)
{
    static const struct {
        tl_goal_kind kind;
        double limit;
        uint32_t attempts;
    } goals[] = {{TL_GOAL_CODES, 1, 1}, {TL_GOAL_FLIP, 0.2, 1}, {TL_GOAL_FLIP, 2e-5, 2}};
    for (size_t i = 0; i < COUNT_OF(goals); i++) {
        promised_frame f = frame_for(*state, goals[i].kind, goals[i].limit);
        plant_expected(&f, (tl_expectation){10, 0}, (tl_expectation){1, 0});
        const tl_kept kept = light_promised(&f);
        const tl_estimate off = kept.attempts[kept.attempt_count - 1].off;
        assert_true(off.bound <= goals[i].limit && off.seen <= off.bound);
        if (goals[i].kind == TL_GOAL_FLIP)
            assert_int_equal(kept.attempt_count, goals[i].attempts);
        promised_frame_clear(&f);
    }
}

/* The most accurate in time; the fastest where none is, and that is said. */
static void within_a_time(void **state)
{
    static const struct {
        double limit;
        uint32_t maker;
        int keeps;
    } times[] = {{100, FLOAT_EXACT, 1}, {5, FLOAT_ROUGHEST, 1}, {0.5, FLOAT_ROUGHEST, 0}};
    for (size_t i = 0; i < COUNT_OF(times); i++) {
        promised_frame f = frame_for(*state, TL_GOAL_TIME, times[i].limit);
        plant_expected(&f, (tl_expectation){10, 1e-6}, (tl_expectation){1, 1e-3});
        const tl_kept kept = light_promised(&f);
        assert_int_equal(maker_of(&kept), times[i].maker);
        assert_int_equal(kept.keeps, times[i].keeps);
        assert_true(kept.ms > 0.0);
        promised_frame_clear(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fastest_that_holds),
        cmocka_unit_test(too_much_was_expected),
        cmocka_unit_test(in_the_end_the_reference),
        cmocka_unit_test(what_a_screen_shows),
        cmocka_unit_test(within_a_time),
    };
    if (begin(NULL) != 0)
        return 1;
    return cmocka_run_group_tests(tests, open_device, close_device);
}
