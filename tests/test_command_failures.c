/* Does a command that cannot write leave things as they were: nothing half-written, no leftovers,
 * the old file still there? */
#define _GNU_SOURCE
#include "program.h"

#include <unistd.h>

static const struct {
    const char *name, *command;
    int exit_status;
    const char *err_word;
    size_t files_after; /* what the command itself made beforehand */
} cases[] = {
    {"standard output is full", "$T render $D/nine-lights.gltf --size 64x64 -o - >/dev/full", 5,
     "standard output", 0},
    {"layouts to a full standard output", "$T layouts >/dev/full", 5,
     "standard output could not be written", 0},
    {"lights to a full standard output",
     "$T capture $D/nine-lights.gltf --size 8x8 -o g.exr --lights-out - >/dev/full", 5,
     "standard output", 0},
    {"no such folder, seen before the scene is", "$T render missing.gltf -o nowhere/c.png", 5,
     "nowhere/c.png", 0},
    {"no such folder for the second output",
     "$T render $D/nine-lights.gltf --size 64x64 -o a.png -o nowhere/c.exr", 5, "nowhere/c.exr",
     0},
    {"no such folder for the lights",
     "$T capture $D/nine-lights.gltf -o g.exr --lights-out nowhere/l.json", 5, "nowhere/l.json",
     0},
    {"a place that takes no files", "$T render $D/nine-lights.gltf -o /proc/c.png", 5,
     "/proc/c.png", 0},
    {"the target is a folder", "mkdir c.png; $T render $D/nine-lights.gltf -o c.png", 5,
     "c.png", 1},
    /* A limit on the size of files stands in for a full disk. */
    {"no room for the picture",
     "trap '' XFSZ; ulimit -f 8; $T render $D/nine-lights.gltf --size 256x256 --precision "
     "reference -o c.exr",
     5, "c.exr", 0},
    {"no room for the G-buffer",
     "trap '' XFSZ; ulimit -f 8; $T capture $D/nine-lights.gltf --size 256x256 -o c.exr", 5,
     "c.exr", 0},
    {"the scene is the output",
     "cp $D/hard-cases.glb s.png; $T render s.png -o s.png; r=$?; cmp "
     "s.png $D/hard-cases.glb && exit $r",
     2, "the output is the input", 1},
    {"what fails late keeps the old picture",
     "echo old >c.png; $T render $D/nine-lights.gltf -o c.png --device nowhere; r=$?; "
     "[ $(cat c.png) = old ] && exit $r",
     4, "nowhere", 1},
    {"no room keeps the old picture",
     "echo old >c.exr; trap '' XFSZ; (ulimit -f 8; $T render $D/nine-lights.gltf --size "
     "256x256 --precision reference -o c.exr); r=$?; [ $(cat c.exr) = old ] && exit $r",
     5, "c.exr", 1},
};

static void nothing_is_left_half_done(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char line[1024];
        enter_empty_folder("command-failures");
        /* In a shell of its own: exit and limits end with it. */
        snprintf(line, sizeof line, "( %s )", cases[i].command);
        expect_run(line, cases[i].exit_status, "", cases[i].err_word);
        if (count_files() != cases[i].files_after)
            fail_msg("%s: %zu files remain, not %zu", cases[i].name, count_files(),
                     cases[i].files_after);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_is_left_half_done)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
