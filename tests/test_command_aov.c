/* Does the program write the layers of light that are asked for, under the names that compositors expect, and
 * are words, outputs and scenes that cannot be refused or told of? */
#define _GNU_SOURCE
#include "program.h"

static const char lights[] =
    "{ \"tilelight\": 1, \"ambient\": [0.1, 0.1, 0.1], \"sky\": {\"type\": \"constant\", "
    "\"color\": [0.1, 0.2, 0.4]}, \"lights\": ["
    "{\"type\": \"point\", \"position\": [0, 2, 4], \"intensity\": 20, \"group\": \"key\"},"
    "{\"type\": \"point\", \"position\": [3, 2, 4], \"intensity\": 9, \"group\": "
    "\"fill.left\"},"
    "{\"type\": \"point\", \"position\": [-3, 2, 4], \"intensity\": 9}]}";

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-aov");
    FILE *file = fopen("l.json", "w");
    assert_non_null(file);
    fputs(lights, file);
    assert_int_equal(fclose(file), 0);
    return 0;
}

#define RENDER "$T render $D/nine-lights.gltf --size 64x36 --precision twin --lights l.json "

static void layers_are_written(void **state)
{
    (void)state;
    expect_run(RENDER "--aov all -o all.exr --json", 0,
               "\"aovs\": [\n"
               "    \"diffuse\",\n    \"specular\",\n    \"ambient\",\n    \"sky-diffuse\",\n"
               "    \"sky-specular\",\n    \"emissive\",\n    \"background\",\n    "
               "\"light_fill_left\",\n    \"light_key\",\n"
               "    \"rest\"\n  ]",
               "");
    expect_run("$T info all.exr", 0, "light_fill_left.R", "");
    expect_run(RENDER "-o plain.exr && $T compare all.exr plain.exr --tolerance 0", 0, "", "");
    expect_run(
        RENDER "--aov specular,groups --aov diffuse -o some.exr --json", 0,
        "\"aovs\": [\n"
        "    \"diffuse\",\n    \"specular\",\n    \"light_fill_left\",\n    \"light_key\",\n"
        "    \"rest\"\n  ]",
        "");
    expect_run(RENDER "--aov all --exr half --samples 4 -o half.exr && $T info half.exr", 0,
               "background.B", "");
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    expect_run(
        RENDER "--aov diffuse,glow -o x.exr", 2, "",
        "--aov: no such layer \"glow\"; layers: diffuse, specular, ambient, sky-diffuse, "
        "sky-specular, emissive, background, groups, all");
    expect_run(RENDER "--aov '' -o x.exr", 2, "", "--aov: no such layer \"\"");
    expect_run(RENDER "--aov diffuse, -o x.exr", 2, "", "--aov: no such layer \"\"");
    expect_run(RENDER "--aov diffuse -o x.png", 2, "",
               "--aov: layers go into an EXR, of which no output is one; add -o FILE.exr");
    expect_run(
        "$T render $D/nine-lights.gltf --aov groups --max-error 0.1 -o x.exr", 2, "",
        "--max-error is kept by the picture, and --aov writes others: leave one of them out");
    expect_run(
        "sed s/fill.left/fill_left/ l.json | sed 's/key/fill.left/' >two.json; $T render "
        "$D/nine-lights.gltf --size 64x36 --precision twin --lights two.json --aov groups -o "
        "x.exr",
        2, "", "two groups of lights would be the layer \"light_fill_left\"");
}

static void without_groups_it_is_said(void **state)
{
    (void)state;
    expect_run(
        "$T render $D/nine-lights.gltf --size 64x36 --precision twin --aov groups -o g.exr", 0,
        "", "no light is in a group: the layer `rest' is the whole picture");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layers_are_written),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(without_groups_it_is_said),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
