/* Do layers go from a scene to its picture by the program: captured, counted, listed, lit, and are numbers of
 * them that are none refused? */
#define _GNU_SOURCE
#include "program.h"

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-layers");
    return 0;
}

#define CAPTURE "$T capture $D/panes.gltf --size 64x36 "
#define TWIN " --precision twin "

static void captured_listed_and_lit(void **state)
{
    (void)state;
    expect_run(CAPTURE "-o all.exr --json", 0, "\"left_share\": 0.0", "");
    expect_run("$T info all.exr", 0, "layer       0    55.", "");
    expect_run("$T info all.exr --json", 0, "\"layers\": {", "");
    expect_run("$T light all.exr" TWIN "-o a.exr --json", 0, "\"lit_layers\": 5", "");
    expect_run("$T render $D/panes.gltf --size 64x36" TWIN "-o b.exr; cmp a.exr b.exr", 0, "",
               "");
    expect_run("$T light all.exr" TWIN "-o c.exr --explain 2>&1 | grep 'translucency *on '", 0,
               "blended surface in a layer", "");
}

/* What fewer leave is told, kept, and another picture. */
static void fewer_are_told(void **state)
{
    (void)state;
    expect_run(CAPTURE "--layers 2 -o two.exr", 0, "",
               " % of the picture has more surfaces that blend than the nearest 2");
    expect_run("$T info two.exr", 0, "more would change 1", "");
    expect_run("$T light all.exr --layers 2" TWIN "-o d.exr; $T light two.exr" TWIN
               "-o e.exr; cmp d.exr e.exr",
               0, "", "");
    expect_run("cmp -s a.exr d.exr", 1, "", "");
    expect_run("$T light all.exr --layers 0" TWIN
               "-o f.exr --explain 2>&1 | grep 'translucency *off '",
               0, "no blended surface in a layer", "");
}

static void without_them_it_is_said(void **state)
{
    (void)state;
    expect_run(
        CAPTURE "--layers 0 -o none.exr", 0, "",
        "blending is shown as opaque where alpha is at least 0.5: material 8 (\"pane 6\")");
    expect_run("$T light none.exr --layers 3" TWIN "-o g.exr", 0, "",
               "--layers 3 is for nothing: the capture has no layers of surfaces that blend");
}

static void numbers_that_are_none(void **state)
{
    static const char *const words[] = {"-1", "65", "1000", "abc", "2.5"};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(words); i++) {
        char command[256], sentence[96];
        snprintf(sentence, sizeof sentence, "--layers: \"%s\" is no whole number from 0 to 64",
                 words[i]);
        snprintf(command, sizeof command, CAPTURE "--layers %s -o x.exr", words[i]);
        expect_run(command, 2, "", sentence);
        snprintf(command, sizeof command, "$T light all.exr --layers %s -o x.exr", words[i]);
        expect_run(command, 2, "", sentence);
    }
    expect_run("$T light all.exr --max-error 0.01 -o x.exr", 3, "",
               "nothing is promised of pictures through layers of surfaces that blend");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(captured_listed_and_lit),
        cmocka_unit_test(fewer_are_told),
        cmocka_unit_test(without_them_it_is_said),
        cmocka_unit_test(numbers_that_are_none),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
