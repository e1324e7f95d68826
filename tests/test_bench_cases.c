/* Do lists of words make the cases that they say, and "all" those layouts that keep all of a material? */
#include "testing.h"

#include "bench_case.h"
#include "tilelight/layouts.h"

#include <string.h>

static void add(tl_bench_cases *cases, const char *material, const char *layout)
{
    tl_error err;
    const tl_bench_lists lists = {
        .of = {[TL_AXIS_MATERIAL] = material, [TL_AXIS_LAYOUT] = layout}};
    ASSERT_OK(tl_bench_cases_add(cases, &lists, &err), err);
}

static int has(const tl_bench_cases *cases, const char *layout)
{
    for (size_t i = 0; i < cases->count; i++)
        if (strcmp(cases->cases[i].words[TL_AXIS_LAYOUT], layout) == 0)
            return strcmp(tl_layout_word(cases->cases[i].layout), layout) == 0;
    return 0;
}

static void all_is_what_has_a_place(void **state)
{
    static const struct {
        const char *material, *in, *out;
    } rows[] = {
        {"phong", "compact-12", "dxr"},
        {"phong", "merlin", "shaderx2-96"},
        {"full", "dxr", "merlin"},
        {"full", "float-position", "ispc"},
        {"metal-rough", "compact-16", "tutorial"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        tl_bench_cases cases = {0};
        add(&cases, rows[i].material, "all");
        if (!has(&cases, rows[i].in) || has(&cases, rows[i].out))
            fail_msg("%s: all must have %s and not %s", rows[i].material, rows[i].in,
                     rows[i].out);
        tl_bench_cases_clear(&cases);
    }
    tl_bench_cases cases = {0};
    add(&cases, "diffuse", "all");
    assert_int_equal(cases.count, TL_LAYOUT_COUNT);
    tl_bench_cases_clear(&cases);
}

/* A layout that is named is a case, whatever it drops; a case that is there is not added again. */
static void what_is_named_is_there(void **state)
{
    tl_bench_cases cases = {0};
    (void)state;
    add(&cases, "phong", "shaderx2-96,float");
    add(&cases, "phong", "float");
    assert_int_equal(cases.count, 2);
    assert_true(has(&cases, "shaderx2-96"));
    tl_bench_cases_clear(&cases);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_is_what_has_a_place),
        cmocka_unit_test(what_is_named_is_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
