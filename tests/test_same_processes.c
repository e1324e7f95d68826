/* Is a picture the same file, byte by byte, in every process: again, with any number of threads of the
 * driver's and of our own, in bands, by tiles of any size, under any culling, and in C? */
#define _GNU_SOURCE
#include "program.h"

#include <unistd.h>

static const struct {
    const char *environment, *options;
} ways[] = {
    {"", ""}, /* once more */
    {"POCL_MAX_PTHREAD_COUNT=1", ""},
    {"POCL_MAX_PTHREAD_COUNT=3", ""},
    {"TILELIGHT_THREADS=1", ""},
    {"TILELIGHT_THREADS=3", ""},
    {"POCL_MAX_PTHREAD_COUNT=5 TILELIGHT_THREADS=5", "--memory 0.04 --tile 8"},
    {"POCL_MAX_PTHREAD_COUNT=1", "--memory 0.1"},
    {"", "--memory 0.1 --tile 32 --cull rect"},
    {"", "--tile 64 --cull depth"},
    {"", "--cull none"},
    {"TILELIGHT_THREADS=1", "--precision twin"},
    {"TILELIGHT_THREADS=7", "--precision twin"},
};

static void every_process_makes_one_picture(void **state)
{
    char command[512];
    (void)state;
    enter_empty_folder("same-processes");
    expect_run("$T capture $D/hall.gltf -o g.exr --size 161x90 && $T light g.exr -o want.exr",
               0, "", "");
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        snprintf(command, sizeof command,
                 "%s $T light g.exr -o got.exr %s && cmp want.exr got.exr", ways[i].environment,
                 ways[i].options);
        expect_run(command, 0, "", "");
    }
}

/* Capture draws by threads of its own, and repair and files have ours. */
static void every_process_makes_one_capture(void **state)
{
    static const char *const environments[] = {"TILELIGHT_THREADS=1 LP_NUM_THREADS=1",
                                               "TILELIGHT_THREADS=3 LP_NUM_THREADS=3"};
    char command[512];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(environments); i++) {
        snprintf(command, sizeof command,
                 "%s $T capture $D/hall.gltf -o again.exr --size 161x90 && cmp g.exr again.exr",
                 environments[i]);
        expect_run(command, 0, "", "");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_process_makes_one_picture),
        cmocka_unit_test(every_process_makes_one_capture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
