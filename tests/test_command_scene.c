/* Does `info' say of a scene what `capture' and `render' can choose, as text and as JSON, and take nothing
 * else for a scene? */
#define _GNU_SOURCE
#include "program.h"

#include "gltf_scene.h"

#include <jansson.h>

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-scene");
    return 0;
}

static json_t *report_of(const char *command)
{
    json_error_t where;
    const program_run *const run = expect_run(command, 0, "{", "");
    json_t *const report = json_loads(run->out, JSON_REJECT_DUPLICATES, &where);
    if (!report)
        fail_msg("%s: line %d: %s\n%s", command, where.line, where.text, run->out);
    return report;
}

/* The words of one line of the text. */
static void text_says_what_can_be_chosen(void **state)
{
    static const char *const cases[][2] = {
        {"hall.gltf", "camera 1    \"aisle\", at node 490 \"aisle\": perspective, 65 degrees"},
        {"hall.gltf", "(default)\ncamera 1"},
        {"hall.gltf", "extension   KHR_lights_punctual, supported: point,"},
        {"fair.glb", "animation 0 \"round\": 4 s, 8 curves\n"},
        {"fair.glb", "morphing    2 targets, of 1 mesh\n"},
        {"fair.glb", "skins       1 skin, 5 joints\n"},
        {"fair.glb", "bounds      (-8, 0, -8) to (8, 2.5, 8) m, at rest\n"},
        {"hard-cases.glb", "orthographic, 6.75 m high, near 0.5 m, far 9 m\n"},
        {"hard-cases.glb", "far inf m"},
        {"hard-cases.glb", "1 masked, 3 double-sided, 1 emissive, 2 normal-mapped\n"},
        {"nine-lights.gltf", "spot        6, intensity 20 to 20"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char command[256];
        snprintf(command, sizeof command, "$T info $D/%s", cases[i][0]);
        expect_run(command, 0, cases[i][1], "");
    }
}

/* The text says nothing that JSON lacks; each name that it lists is taken by `capture'. */
static void json_lists_what_capture_takes(void **state)
{
    json_t *const report = report_of("$T info --json $D/fair.glb");
    const char *kind, *animation;
    double seconds;
    size_t index;
    json_t *camera;
    (void)state;
    assert_int_equal(json_unpack(report, "{s:s, s:[{s:s, s:F}]}", "kind", &kind, "animations",
                                 "name", &animation, "seconds", &seconds),
                     0);
    assert_string_equal(kind, "scene");
    assert_int_equal(json_array_size(json_object_get(report, "cameras")), 2);
    json_array_foreach(json_object_get(report, "cameras"), index, camera)
    {
        char command[512];
        snprintf(command, sizeof command,
                 "$T capture $D/fair.glb --size 16x9 -o g.exr --camera '%s' --animation '%s' "
                 "--time %g",
                 json_string_value(json_object_get(camera, "name")), animation, seconds);
        const program_run *const run = expect_run(command, 0, "", "");
        assert_string_equal(run->err, "");
    }
    json_decref(report);
}

static void names_are_shown_as_they_are(void **state)
{
    char *text = edited(square_scene(&square), "\"wide\"", "\"w\\\"\\u001b[2J\\u00fc\\\\\"");
    json_t *report;
    const char *name;
    (void)state;
    text =
        edited(text, "\"scene\":0,", "\"extensionsUsed\":[\"ACME_\\u001b[2J\"],\"scene\":0,");
    write_file("named.gltf", text, strlen(text));
    free(text);
    report = report_of("$T info --json named.gltf");
    assert_int_equal(json_unpack(report, "{s:[{s:s}]}", "cameras", "name", &name), 0);
    assert_string_equal(name, "w\"\x1b[2J\xc3\xbc\\");
    json_decref(report);
    /* A terminal would obey the escape sequence. */
    expect_run("$T info named.gltf", 0, "extension   ACME_?[2J, left out",
               "extension ACME_?[2J is left out");
    expect_run("$T info named.gltf", 0, "\"w\"?[2J\xc3\xbc\\\"", "");
}

/* By content where the name does not say it; lights stay lights. */
static void scenes_and_lights_are_told_apart(void **state)
{
    (void)state;
    expect_run("cp $D/nine-lights.gltf scene.json && $T info scene.json", 0, "meshes      9",
               "");
    expect_run("cp $D/fair.glb fair && $T info fair", 0, "meshes      12", "");
    expect_run("$T info $D/nine-lights.lights.json", 0, "lights      9", "");
    expect_run("echo '{}' >x.json; $T info x.json", 3, "", "is no lights file");
    expect_run("echo '{}' >x.GLTF; $T info x.GLTF", 3, "", "is not valid glTF");
}

/* Each group once, by name, of lights files and of captures that hold them. */
static void groups_are_counted(void **state)
{
    static const char grouped[] =
        "{\"tilelight\": 1, \"lights\": ["
        "{\"type\": \"point\", \"position\": [0, 1, 0], \"group\": \"rim\"},"
        "{\"type\": \"point\", \"position\": [0, 2, 0], \"group\": \"key\"},"
        "{\"type\": \"point\", \"position\": [0, 3, 0]},"
        "{\"type\": \"point\", \"position\": [0, 4, 0], \"group\": \"rim\"}]}";
    (void)state;
    write_file("grouped.json", grouped, sizeof grouped - 1);
    expect_run("$T info grouped.json", 0,
               "group       \"key\", 1 light\n"
               "group       \"rim\", 2 lights\n",
               "");
    json_t *const report = report_of("$T info --json grouped.json");
    const char *first, *second;
    json_int_t ones, twos;
    json_t *const groups = json_object_get(json_object_get(report, "lights"), "groups");
    assert_int_equal(json_unpack(groups, "[{s:s, s:I}, {s:s, s:I}!]", "name", &first, "lights",
                                 &ones, "name", &second, "lights", &twos),
                     0);
    assert_string_equal(first, "key");
    assert_string_equal(second, "rim");
    assert_true(ones == 1 && twos == 2);
    json_decref(report);
    expect_run("$T capture $D/hall.gltf --size 16x9 -o g.exr && "
               "$T info g.exr | grep -c ^group",
               1, "0", "");
}

static void damage_is_said_as_capture_says_it(void **state)
{
    static const char *const makes[] = {
        "head -c 3000 $D/nine-lights.gltf >bad.gltf",
        "head -c 30000 $D/fair.glb >bad.gltf",
        "sed 's/\"mesh\": *1/\"mesh\":99/' $D/hall.gltf >bad.gltf",
        "printf 'glTF' >bad.gltf",
        ": >bad.gltf",
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(makes); i++) {
        char command[512];
        snprintf(command, sizeof command, "%s; $T info bad.gltf", makes[i]);
        const program_run *run = expect_run(command, 3, "", "bad.gltf");
        static char said[sizeof run->err];
        assert_string_equal(run->out, "");
        memcpy(said, run->err, sizeof said);
        run = expect_run("$T capture bad.gltf -o g.exr", 3, "", "bad.gltf");
        assert_string_equal(run->err, said);
    }
    expect_run("$T info none.gltf", 3, "", "none.gltf: cannot be opened");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(text_says_what_can_be_chosen, enter),
        cmocka_unit_test_setup(json_lists_what_capture_takes, enter),
        cmocka_unit_test_setup(names_are_shown_as_they_are, enter),
        cmocka_unit_test_setup(scenes_and_lights_are_told_apart, enter),
        cmocka_unit_test_setup(groups_are_counted, enter),
        cmocka_unit_test_setup(damage_is_said_as_capture_says_it, enter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
