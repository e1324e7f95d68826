/* Are sets of frames what Fileseq's grammar says, each frame once and in its order, and names of files what
 * their patterns say? */
#include "frame_set.h"
#include "pattern.h"

#include "testing.h"

static void assert_frames(const char *text, const int32_t *want, size_t count)
{
    tl_frames got = {NULL, 0};
    tl_error err;
    ASSERT_OK(tl_frames_parse(text, &got, &err), err);
    if (got.count != count || memcmp(got.of, want, count * sizeof *want) != 0)
        fail_msg("\"%s\" is %zu frames, the first %d", text, got.count, (int)got.of[0]);
    tl_frames_clear(&got);
}

#define ASSERT_FRAMES(text, ...)                        \
    assert_frames(text, (const int32_t[]){__VA_ARGS__}, \
                  sizeof((const int32_t[]){__VA_ARGS__}) / sizeof(int32_t))

static void the_grammar_is_read(void **state)
{
    (void)state;
    ASSERT_FRAMES("7", 7);
    ASSERT_FRAMES("-7", -7);
    ASSERT_FRAMES("3,5-10", 3, 5, 6, 7, 8, 9, 10);
    ASSERT_FRAMES("1-10x4", 1, 5, 9);
    ASSERT_FRAMES("10-1x-3", 10, 7, 4, 1);
    ASSERT_FRAMES("-3-2", -3, -2, -1, 0, 1, 2);
    ASSERT_FRAMES("-3--1", -3, -2, -1);
    ASSERT_FRAMES("4-1", 4, 3, 2, 1);
    ASSERT_FRAMES("9-1x-4", 9, 5, 1);
    ASSERT_FRAMES("9-1x4", 9, 5, 1);
    ASSERT_FRAMES("1-9y3", 2, 3, 5, 6, 8, 9);
    ASSERT_FRAMES("1-8:3", 1, 4, 7, 3, 5, 2, 6, 8);
    ASSERT_FRAMES(" 1 - 3 , 10 ", 1, 2, 3, 10);
    ASSERT_FRAMES("5,1-6,5", 5, 1, 2, 3, 4, 6);
}

/* One that is large enough to be slow where it is done badly. */
static void coarse_first_in_any_steps(void **state)
{
    (void)state;
    tl_frames got = {NULL, 0};
    tl_error err;
    ASSERT_FRAMES("1-5:999999999", 1, 5, 4, 3, 2);
    ASSERT_FRAMES("5-1:2", 5, 3, 1, 4, 2);
    ASSERT_FRAMES("7-7:3", 7);
    ASSERT_OK(tl_frames_parse("1-2000000:2000000", &got, &err), err);
    assert_int_equal(got.count, 2000000);
    assert_int_equal(got.of[0], 1);
    assert_int_equal(got.of[1], 2000000);
    tl_frames_clear(&got);
}

static void what_is_no_set(void **state)
{
    static const char *const texts[] = {
        "",
        ",",
        "1,",
        ",1",
        "a",
        "1-",
        "1-a",
        "1-5x",
        "1-5x0",
        "1-5x-1",
        "5-1y-2",
        "1-5:-2",
        "1-5z2",
        "1 2",
        "1--",
        "- 1 -",
        "1-5x2x2",
        "1.5",
        "0x10",
        "1;2",
        "1000000000",
        "-1000000000",
        "1-5-9",
        "1-20000000",
        "1-20000000:3",
        "1-20000003y2",
        "1-10000001",
        "1-1y3",
        "-999999999-999999999y1", /* at once */
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(texts); i++) {
        tl_frames got = {NULL, 0};
        tl_error err;
        if (tl_frames_parse(texts[i], &got, &err) != TL_ERR_ARGUMENT)
            fail_msg("\"%s\" is %zu frames", texts[i], got.count);
        assert_null(got.of);
    }
    tl_error err;
    tl_frames got = {NULL, 0};
    assert_int_equal(tl_frames_parse("1-3,4 to 5,7", &got, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "\"4 to 5\""));
    assert_int_equal(tl_frames_parse("1-10000001", &got, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "10000001 frames: 10000000 at most"));
}

/* What is written is short, and the same set in the same order. */
static void sets_are_written(void **state)
{
    static const struct {
        const char *text, *want;
    } cases[] = {
        {"1,2,3,4", "1-4"},
        {"7", "7"},
        {"4,3", "4-3"},
        {"1,3", "1,3"},
        {"1,3,5,7", "1-7x2"},
        {"9,6,3,0,-3", "9--3x3"},
        {"-3--1,5", "-3--1,5"},
        {"1-9y3", "2-3,5-6,8-9"},
        {"1-3,10-30x10", "1-3,10-30x10"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_frames first = {NULL, 0}, again = {NULL, 0};
        char *text = NULL;
        ASSERT_OK(tl_frames_parse(cases[i].text, &first, &err), err);
        ASSERT_OK(tl_frames_format(&first, &text, &err), err);
        assert_string_equal(text, cases[i].want);
        ASSERT_OK(tl_frames_parse(text, &again, &err), err);
        assert_int_equal(first.count, again.count);
        assert_memory_equal(first.of, again.of, first.count * sizeof *first.of);
        free(text);
        tl_frames_clear(&first);
        tl_frames_clear(&again);
    }
}

static void patterns_are_filled(void **state)
{
    static const struct {
        const char *pattern;
        int32_t frame;
        const char *name, *want;
    } cases[] = {
        {"f.####.exr", 7, NULL, "f.0007.exr"},
        {"f.####.exr", 12345, NULL, "f.12345.exr"},
        {"f.####.exr", -7, NULL, "f.-007.exr"},
        {"f.#.exr", -7, NULL, "f.-7.exr"},
        {"f.@@@.exr", 7, NULL, "f.007.exr"},
        {"f.%04d.exr", 7, NULL, "f.0007.exr"},
        {"f.%d.exr", 7, NULL, "f.7.exr"},
        {"f.%0d.exr", 7, NULL, "f.7.exr"},
        {"%d", 7, NULL, "7"},
        {"##/f.exr", 7, NULL, "07/f.exr"},
        {"shot#2/f.##.exr", 7, NULL, "shot#2/f.07.exr"},
        {"%d/##", 7, NULL, "%d/07"},
        {"##/%d", 7, NULL, "##/7"},
        {"f.exr", 7, NULL, "f.exr"},
        {"100%.exr", 7, NULL, "100%.exr"},
        {"%4d.%s.%05", 7, NULL, "%4d.%s.%05"},
        {"{name}.png", 7, "a", "a.png"},
        {"{name}/##.{name}", 7, "a", "a/07.a"},
        {"{name}.##", 7, NULL, "{name}.07"},
        {"{nam}{name", 7, "a", "{nam}{name"},
        {"{name}.##", 7, "{name}#", "{name}#.07"},
        {"", 7, "a", ""},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err;
        tl_pattern pattern;
        char *text = NULL;
        ASSERT_OK(tl_pattern_read(cases[i].pattern, &pattern, &err), err);
        ASSERT_OK(tl_pattern_fill(&pattern, cases[i].frame, cases[i].name, &text, &err), err);
        assert_string_equal(text, cases[i].want);
        assert_int_equal(tl_pattern_has_name(&pattern),
                         strstr(cases[i].pattern, "{name}") != NULL);
        free(text);
    }
}

static void numbers_that_are_too_long(void **state)
{
    (void)state;
    tl_error err;
    tl_pattern pattern;
    ASSERT_OK(tl_pattern_read("####################", &pattern, &err), err);
    assert_int_equal(tl_pattern_read("#####################", &pattern, &err), TL_ERR_ARGUMENT);
    assert_int_equal(tl_pattern_read("%021d", &pattern, &err), TL_ERR_ARGUMENT);
    assert_int_equal(tl_pattern_read("%099999999999999999999999d", &pattern, &err),
                     TL_ERR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grammar_is_read), cmocka_unit_test(coarse_first_in_any_steps),
        cmocka_unit_test(what_is_no_set),      cmocka_unit_test(sets_are_written),
        cmocka_unit_test(patterns_are_filled), cmocka_unit_test(numbers_that_are_too_long),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
