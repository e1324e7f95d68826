/* Do plans hold what they say: every knob alone, combinations, no configuration twice? */
#include "testing.h"

#include "plan.h"

#include <string.h>

static size_t count_that_fit(const tl_study_plan *plan, uint32_t present, int has_endless)
{
    const tl_study_needs needs = {.present = present,
                                  .has_endless = has_endless,
                                  .has_highlights =
                                      (present & (TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH)) != 0,
                                  .has_double = 1};
    size_t count = 0;
    for (size_t i = 0; i < plan->count; i++)
        count += (size_t)tl_study_config_fits(&plan->configs[i], &needs);
    return count;
}

static int has(const tl_study_plan *plan, const char *title)
{
    char own[1024];
    for (size_t i = 0; i < plan->count; i++) {
        tl_study_config_title(&plan->configs[i], own, sizeof own);
        if (strcmp(own, title) == 0)
            return 1;
    }
    return 0;
}

/* Enough points, of every knob. */
static void usual_plans_are_large_enough(void **state)
{
    static const struct {
        const char *frame;
        uint32_t present;
        int has_endless;
        size_t least;
    } rows[] = {
        {"phong", TL_GROUP_BASE | TL_GROUP_PHONG, 0, 40},
        {"metal-rough", TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION, 0, 30},
        {"diffuse, endless lights", TL_GROUP_BASE, 1, 40},
    };
    tl_study_plan plan = {0}, quick = {0};
    tl_error err;
    (void)state;
    ASSERT_OK(tl_study_plan_usual(&plan, 0, &err), err);
    ASSERT_OK(tl_study_plan_usual(&quick, 1, &err), err);
    assert_true(has(&plan, "default"));
    assert_true(has(&quick, "default"));
    assert_true(quick.count < plan.count);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const size_t count = count_that_fit(&plan, rows[i].present, rows[i].has_endless);
        if (count < rows[i].least)
            fail_msg("%s: %zu configurations fit, not %zu", rows[i].frame, count,
                     rows[i].least);
    }
    tl_study_plan_clear(&quick);
    tl_study_plan_clear(&plan);
}

static int is_alone(const tl_study_config *config, int knob)
{
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++)
        if ((strcmp(config->words[i], tl_study_knobs[i].usual) == 0) == (i == knob))
            return 0;
    return 1;
}

static void every_knob_is_tried_alone(void **state)
{
    tl_study_plan plan = {0};
    tl_error err;
    (void)state;
    ASSERT_OK(tl_study_plan_usual(&plan, 0, &err), err);
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++) {
        size_t alone = 0;
        for (size_t i = 0; i < plan.count; i++)
            alone += (size_t)is_alone(&plan.configs[i], knob);
        if (alone == 0)
            fail_msg("%s is not tried alone", tl_study_knobs[knob].name);
    }
    for (size_t i = 0; i < plan.count; i++)
        for (size_t k = 0; k < i; k++)
            assert_false(tl_study_config_is_same(&plan.configs[i], &plan.configs[k]));
    tl_study_plan_clear(&plan);
}

/* Every word that the table names is one that the knob takes. */
static void words_of_the_table_are_taken(void **state)
{
    (void)state;
    for (int knob = 0; knob < TL_STUDY_KNOB_COUNT; knob++) {
        const tl_study_knob *row = &tl_study_knobs[knob];
        const char *const lists[] = {row->usual, row->exact, row->alone, row->quick, row->all};
        for (size_t i = 0; i < COUNT_OF(lists); i++) {
            tl_study_plan plan = {0};
            tl_study_lists words = {{NULL}};
            tl_error err;
            words.of[knob] = lists[i];
            ASSERT_OK(tl_study_plan_add(&plan, &words, &err), err);
            tl_study_plan_clear(&plan);
        }
    }
}

static void products_are_made(void **state)
{
    tl_study_plan plan = {0};
    tl_error err;
    const tl_study_lists lists = {
        {[TL_STUDY_KNOB_LAYOUT] = "float,merlin", [TL_STUDY_KNOB_TILE] = "16,32,64"}};
    (void)state;
    ASSERT_OK(tl_study_plan_add(&plan, &lists, &err), err);
    ASSERT_OK(tl_study_plan_add(&plan, &lists, &err), err);
    assert_int_equal(plan.count, 6);
    assert_true(has(&plan, "default"));
    assert_true(has(&plan, "layout=merlin tile=64"));
    assert_int_equal(plan.configs[5].of.lighting.tile_size, 64);
    assert_int_equal(plan.configs[5].of.layout, TL_LAYOUT_MERLIN);
    tl_study_plan_clear(&plan);
}

static void wrong_words_are_refused(void **state)
{
    static const struct {
        int knob;
        const char *list, *says;
    } rows[] = {
        {TL_STUDY_KNOB_LAYOUT, "float,thick", "no layout is called \"thick\""},
        {TL_STUDY_KNOB_TILE, "9", "--knob tile: \"9\" is none of 8"},
        {TL_STUDY_KNOB_CUTOFF, "-1", "--knob cutoff: \"-1\" is no number"},
        {TL_STUDY_KNOB_OUTPUT, "jpeg", "--knob output: \"jpeg\" is none of float, half, png"},
        {TL_STUDY_KNOB_COMPRESSION, "zip,,piz", "is no list"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        tl_study_plan plan = {0};
        tl_study_lists lists = {{NULL}};
        tl_error err;
        lists.of[rows[i].knob] = rows[i].list;
        assert_int_equal(tl_study_plan_add(&plan, &lists, &err), TL_ERR_ARGUMENT);
        if (!strstr(err.message, rows[i].says))
            fail_msg("\"%s\" should say \"%s\"", err.message, rows[i].says);
        assert_int_equal(plan.count, 0);
        tl_study_plan_clear(&plan);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(usual_plans_are_large_enough),
        cmocka_unit_test(every_knob_is_tried_alone),
        cmocka_unit_test(words_of_the_table_are_taken),
        cmocka_unit_test(products_are_made),
        cmocka_unit_test(wrong_words_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
