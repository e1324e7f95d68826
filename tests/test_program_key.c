/* Does everything that a compiled program depends on change its key, and nothing else? */
#define _GNU_SOURCE /* memmem, setenv */
#include "frames.h"

#include "program_key.h"

typedef struct program {
    tl_device device;
    const char *texts[2];
    size_t text_count;
    const char *flags;
    const char *variable; /* set meanwhile, NULL: none */
} program;

static char *key_of(const program *p, size_t *size)
{
    if (p->variable)
        setenv(p->variable, "1", 1);
    char *key = tl_program_key(&p->device, p->texts, p->text_count, p->flags, size);
    if (p->variable)
        unsetenv(p->variable);
    assert_non_null(key);
    return key;
}

static int same_key(const program *a, const program *b)
{
    size_t a_size, b_size;
    char *a_key = key_of(a, &a_size), *b_key = key_of(b, &b_size);
    const int same = a_size == b_size && memcmp(a_key, b_key, a_size) == 0;
    free(a_key);
    free(b_key);
    return same;
}

/* Each case differs from the first by one thing. */
static void one_change_each(void **state)
{
    const tl_device *device = *state;
    const program first = {*device, {"ab", "c"}, 2, "-D A=1", NULL};
    enum { COUNT = 11 };
    program changed[COUNT];
    for (int i = 0; i < COUNT; i++)
        changed[i] = first;
    changed[0].texts[1] = "d";
    changed[1].texts[0] = "a"; /* the same letters, parted elsewhere */
    changed[1].texts[1] = "bc";
    changed[2].text_count = 1;
    changed[3].flags = "-D A=2";
    strcpy(changed[4].device.info.name, "another");
    strcpy(changed[5].device.info.driver, "another");
    strcpy(changed[6].device.info.platform, "another");
    changed[7].device.shares_memory = !device->shares_memory; /* no machine code */
    changed[8].variable = "POCL_WORK_GROUP_METHOD";
    changed[9].variable = "POCL_EXTRA_BUILD_FLAGS";
    changed[10].texts[0] = "ab\ntext 1\nc"; /* as if it were two */
    changed[10].text_count = 1;
    for (int i = 0; i < COUNT; i++) {
        if (same_key(&first, &changed[i]))
            fail_msg("change %d is not in the key", i);
        for (int j = 0; j < i; j++)
            if (same_key(&changed[i], &changed[j]))
                fail_msg("changes %d and %d have one key", j, i);
    }
}

static void nothing_else(void **state)
{
    const tl_device *device = *state;
    const program first = {*device, {"ab", "c"}, 2, "-D A=1", NULL};
    program same[] = {first, first, first, first, first};
    same[0].device.info.is_default = !device->info.is_default;
    same[1].device.programs = NULL;
    same[2].variable = "POCL_DEBUG";
    same[3].variable = "TILELIGHT_THREADS";
    for (size_t i = 0; i < COUNT_OF(same); i++)
        if (!same_key(&first, &same[i]))
            fail_msg("case %zu has another key", i);
}

/* A home folder may serve machines of several kinds. */
static void processor_of_a_cpu(void **state)
{
    const program p = {*(const tl_device *)*state, {"a", NULL}, 1, "", NULL};
    size_t size;
    char *key = key_of(&p, &size);
    const int named = memmem(key, size, "\nprocessor ", 11) != NULL;
    free(key);
    assert_int_equal(named, p.device.shares_memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_change_each),
                                       cmocka_unit_test(nothing_else),
                                       cmocka_unit_test(processor_of_a_cpu)};
    return cmocka_run_group_tests(tests, open_device, close_device);
}
