/* Are memory, time and partitions for a farm what sbatch takes them for? */
#include "farm_needs.h"
#include "testing.h"

/* sbatch(1): --mem, --time. 0: refused. */
static const struct {
    const char *text;
    uint64_t value;
} memories[] = {{"1", 1},     {"512", 512},    {"512M", 512},
                {"4G", 4096}, {"1T", 1048576}, {"2048K", 2},
                {"2049K", 3}, {"1K", 1},       {"0", 0},
                {"", 0},      {"G", 0},        {"4GB", 0},
                {"-4", 0},    {"4 G", 0},      {"2T", 0},
                {"0G", 0},    {"4g", 0},       {"99999999999999999999", 0},
                {"1.5G", 0},  {"4G\n#", 0}},
  times[] = {{"1", 60},
             {"90", 5400},
             {"90:30", 5430},
             {"1:30:00", 5400},
             {"0:00:01", 1},
             {"2-0", 172800},
             {"2-12", 216000},
             {"2-12:30", 217800},
             {"2-12:30:15", 217815},
             {"0", 0},
             {"", 0},
             {"1:", 0},
             {":1", 0},
             {"1:2:3:4", 0},
             {"1-", 0},
             {"-1", 0},
             {"1-1-1", 0},
             {"1 ", 0},
             {"366-0", 0},
             {"1-2:3:4:5", 0},
             {"UNLIMITED", 0}};

static void numbers_are_read(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(memories); i++) {
        uint64_t got = 0;
        const bool taken = tl_farm_memory(memories[i].text, &got);
        if (got != memories[i].value || taken != (got > 0))
            fail_msg("memory \"%s\" is %d", memories[i].text, (int)got);
    }
    for (size_t i = 0; i < COUNT_OF(times); i++) {
        uint64_t got = 0;
        const bool taken = tl_farm_time(times[i].text, &got);
        if (got != times[i].value || taken != (got > 0))
            fail_msg("time \"%s\" is %d", times[i].text, (int)got);
    }
}

static void partitions_are_words(void **state)
{
    (void)state;
    static const char *const good[] = {"main", "gpu,cpu", "a_b-2.x"};
    static const char *const bad[] = {"", "a b", "a\n#SBATCH --uid=0", "a'b", "$(a)", "a#b"};
    for (size_t i = 0; i < COUNT_OF(good); i++)
        assert_true(tl_farm_partition(good[i]));
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_false(tl_farm_partition(bad[i]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_are_read),
                                       cmocka_unit_test(partitions_are_words)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
