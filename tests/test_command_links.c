/* Do lights that are linked to objects go from a scene to its picture by the program: are ids captured where
 * lights need them or are asked for, listed, and lit by, and is the same picture made in one go? */
#define _GNU_SOURCE
#include "program.h"

static const char lights[] =
    "{ \"tilelight\": 1, \"lights\": ["
    "{\"type\": \"point\", \"position\": [0, 4, 4], \"intensity\": 40, \"name\": \"a\","
    " \"link\": {\"only\": [\"floor\", \"*sphere\"]}},"
    "{\"type\": \"point\", \"position\": [0, 4, 4], \"intensity\": 40, \"link\": {\"except\": "
    "[1]}}]}";

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-links");
    FILE *file = fopen("l.json", "w");
    assert_non_null(file);
    fputs(lights, file);
    return fclose(file);
}

#define CAPTURE "$T capture $D/nine-lights.gltf --size 64x36 "
#define TWIN " --precision twin "

static void ids_are_captured_listed_and_lit_by(void **state)
{
    (void)state;
    expect_run(CAPTURE "--ids -o ids.exr && $T info ids.exr", 0, "middle sphere", "");
    expect_run("$T info ids.exr --json", 0, "\"objects\": [", "");
    expect_run("$T light ids.exr --lights l.json" TWIN "-o a.exr", 0, "", "");
    expect_run("$T render $D/nine-lights.gltf --size 64x36 --lights l.json" TWIN
               "-o b.exr && cmp a.exr b.exr",
               0, "", "");
    expect_run("$T convert ids.exr --layout compact-16 -o packed.exr && $T light packed.exr "
               "--lights l.json" TWIN "-o c.exr",
               0, "", "");
    expect_run(CAPTURE
               "--layout ispc --ids -o ispc.exr && $T light ispc.exr --lights l.json" TWIN
               "-o d.exr",
               0, "", "");
    /* A part of the picture has the ids of its own pixels. */
    expect_run("$T light ids.exr --lights l.json" TWIN "--region 8,4,24,20 -o part.exr && "
               "$T light ids.exr --lights l.json" TWIN "--region 0,0,64,36 -o whole.exr && "
               "$T compare whole.exr a.exr --tolerance 0",
               0, "", "");
    expect_run(CAPTURE "-o none.exr && $T info none.exr --json", 0, "\"objects\": null", "");
}

static void what_is_not_there_is_told(void **state)
{
    (void)state;
    expect_run("$T light none.exr --lights l.json" TWIN "-o x.exr", 3, "",
               "light \"a\" is linked to objects, and the capture does not tell any apart: "
               "capture the "
               "scene with --ids, or with these lights");
    expect_run("sed s/floor/flor/ l.json >typo.json; $T light ids.exr --lights typo.json" TWIN
               "-o x.exr",
               3, "",
               "no such object: did you mean \"floor\"?; it has floor (1), middle sphere (2)");
    expect_run("$T light ids.exr --lights l.json --max-error 0.1 -o x.exr", 3, "",
               "nothing is promised of lights that are linked to objects");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ids_are_captured_listed_and_lit_by),
        cmocka_unit_test(what_is_not_there_is_told),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
