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

#define ASSERT_FRAMES(text, ...)                                                         \
    assert_frames(text, (const int32_t[]){__VA_ARGS__},                                  \
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
int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_grammar_is_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
