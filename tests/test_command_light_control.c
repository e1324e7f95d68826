/* Do --light, --group and --solo light as lights files do that say the same, wherever the lights are from,
 * and are they refused in a sentence? */
#define _GNU_SOURCE
#include "program.h"

#define LAMP(name, group, x, intensity)                                                      \
    "{\"type\": \"point\", \"name\": \"" name "\", \"group\": \"" group "\", \"position\": " \
    "[" x ", 2, 1], \"range\": 9, \"intensity\": " intensity "}"
#define FILE_OF(a, b, c) \
    "{\"tilelight\": 1, \"ambient\": [0.1, 0.1, 0.1], \"lights\": [" a ", " b ", " c "]}"

static void put(const char *name, const char *text)
{
    FILE *const file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-light-control");
    put("lights.json", FILE_OF(LAMP("a", "left", "-1", "8"), LAMP("b", "right", "1", "8"),
                               LAMP("c", "right", "0", "8")));
    put("half.json", FILE_OF(LAMP("a", "left", "-1", "0"), LAMP("b", "right", "1", "4"),
                             LAMP("c", "right", "0", "4")));
    put("one.json", FILE_OF(LAMP("a", "left", "-1", "0"), LAMP("b", "right", "1", "0"),
                            LAMP("c", "right", "0", "16")));
    return 0;
}

/* Without a device: which lights there are is decided before. */
#define LIT "$T light g.exr --precision reference --lights "

#define RENDERED                                                                         \
    "$T render $D/nine-lights.gltf --size 40x24 --precision reference --shadows --json " \
    "--timings "

static void lights_are_those_of_a_file_that_says_the_same(void **state)
{
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 40x24 -o g.exr --lights-out ignored.json",
               0, "", "");
    expect_run(LIT "half.json -o half.exr && " LIT "one.json -o one.exr", 0, "", "");
    expect_run(LIT "lights.json --group right=0.5 --light a=off -o r.exr && cmp r.exr half.exr",
               0, "", "");
    expect_run(LIT
               "lights.json --light '[bc]=0.5' --light 0=off -o r.exr && cmp r.exr half.exr",
               0, "", "");
    expect_run(LIT "lights.json --solo c --light '*=2' -o r.exr && cmp r.exr one.exr", 0, "",
               "");
    expect_run(LIT "lights.json -o r.exr && cmp r.exr one.exr", 1, "differ", "");
}

/* Inside a capture, of a scene that is rendered, and of the rig that stands in. */
static void lights_may_be_from_anywhere(void **state)
{
    (void)state;
    expect_run("$T render $D/nine-lights.gltf --size 40x24 --precision reference --json "
               "--light '*=off' -o x.png",
               0, "\"ranged\": 0", "");
    expect_run("$T light g.exr --precision reference --light '*=off' --json -o x.png", 0,
               "\"ranged\": 0", "");
    expect_run("$T capture $D/hall.gltf --size 40x24 -o h.exr && echo '{\"tilelight\": 1}' "
               ">no.json && "
               "$T light h.exr --precision reference --solo nobody -o x.png",
               2, "", "there is no light and no group \"nobody\"");
}

/* Of a scene's own lights; and each is scaled once, whoever scales it. */
static void lights_that_are_off_have_no_shadow_maps(void **state)
{
    (void)state;
    expect_run(RENDERED "--light 1=0.5 -o one.exr", 0, "\"shadows\":", "");
    const program_run *const dark = expect_run(RENDERED "--light '*=off' -o x.exr", 0, "{", "");
    assert_null(strstr(dark->out, "\"shadows\":"));
    expect_run("$T capture $D/nine-lights.gltf --size 40x24 --shadows -o s.exr && "
               "$T light s.exr --precision reference --light 1=0.5 -o r.exr && "
               "$T compare r.exr one.exr --tolerance 0",
               0, "", "");
    expect_run(RENDERED "--light nobody=off -o x.exr", 2, "", "there is no light \"nobody\"");
    expect_run(RENDERED "--scatter 4 --light 3=off -o x.exr", 0, "\"ranged\": 3", "");
}

static void mistakes_are_named(void **state)
{
    static const char *const cases[][3] = {
        {"--light a", "2", "--light: \"a\" must be NAME=SCALE or NAME=off"},
        {"--light =2", "2", "must be NAME=SCALE"},
        {"--light a=on", "2", "\"on\" is no number from 0 to 1e+30"},
        {"--group right=-1", "2", "--group right (a scale, or off): \"-1\" is no number"},
        {"--group rigt=2", "2", "did you mean \"right\"?"},
        {"--solo d", "2",
         "there are \"left\", \"right\", \"a\", \"b\", \"c\"; by index 0 to 2"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char command[256];
        snprintf(command, sizeof command, LIT "lights.json %s -o x.png", cases[i][0]);
        expect_run(command, cases[i][1][0] - '0', "", cases[i][2]);
    }
    expect_run("$T check --light a=2", 2, "", "go with --gbuffer");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_are_those_of_a_file_that_says_the_same),
        cmocka_unit_test(lights_may_be_from_anywhere),
        cmocka_unit_test(lights_that_are_off_have_no_shadow_maps),
        cmocka_unit_test(mistakes_are_named),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
