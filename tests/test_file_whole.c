/* Are files read in one piece up to the limit, and not beyond? */
#include "file_cases.h"

#include "whole_file.h"

/* Around the limit, and around the 64 KiB that reading starts with. */
static const struct {
    size_t size, limit;
    tl_status status;
} cases[] = {
    {0, 0, TL_OK},         {1, 0, TL_ERR_FORMAT},         {1, 1, TL_OK},
    {10, 10, TL_OK},       {11, 10, TL_ERR_FORMAT},       {65534, 70000, TL_OK},
    {65535, 70000, TL_OK}, {65536, 70000, TL_OK},         {300000, 300000, TL_OK},
    {65536, 65536, TL_OK}, {65537, 65536, TL_ERR_FORMAT},
};

static void up_to_the_limit(void **state)
{
    static const char *const words[] = {"whole", "larger", NULL};
    (void)state;
    char path[512], name[64];
    scratch_path(path, sizeof path, "whole");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_error err = {.status = TL_OK};
        char *read = NULL;
        size_t size = 0;
        uint32_t random = 1;
        unsigned char *bytes = malloc(cases[i].size + 1);
        assert_non_null(bytes);
        for (size_t k = 0; k < cases[i].size; k++)
            bytes[k] = (unsigned char)(next_random(&random) >> 24);
        save_bytes(path, bytes, cases[i].size);
        snprintf(name, sizeof name, "%zu of %zu", cases[i].size, cases[i].limit);
        const tl_status status = tl_whole_file_read(path, cases[i].limit, &read, &size, &err);
        if (cases[i].status != TL_OK) {
            assert_refused(name, status, cases[i].status, &err, words);
            assert_null(read);
        } else {
            ASSERT_OK(status, err);
            assert_int_equal(size, cases[i].size);
            assert_memory_equal(read, bytes, size);
            assert_int_equal(read[size], 0);
        }
        free(read);
        free(bytes);
    }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(up_to_the_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
