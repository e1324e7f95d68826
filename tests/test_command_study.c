/* Does `tilelight study' measure, stop and go on, and leave data, maps and a table? */
#define _GNU_SOURCE
#include "program.h"

#include <jansson.h>
#include <unistd.h>

/* In C but for the default configuration, so that one build of kernels is enough. */
#define MANY "--knob layout=float,float-ndc,float-reversed,ispc,merlin,tutorial"
#define TINY "$T study --size 32x32 --seconds 0.01 --quick --knob precision=twin "

static json_t *read_json(const char *path)
{
    json_error_t error;
    json_t *root = json_load_file(path, 0, &error);
    if (!root)
        fail_msg("%s: line %d: %s", path, error.line, error.text);
    return root;
}

static const json_t *configurations(const json_t *root)
{
    return json_object_get(json_array_get(json_object_get(root, "frames"), 0),
                           "configurations");
}

static int exists(const char *folder, const char *file)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    return access(path, F_OK) == 0;
}

static void usage_errors_are_said(void **state)
{
    static const struct {
        const char *arguments, *says;
    } rows[] = {
        {"", "-o DIR is missing"},
        {"-o d --knob tile", "\"tile\" is no NAME=WORD"},
        {"-o d --knob speed=fast", "no such knob \"speed\"; knobs: layout"},
        {"-o d --knob tile=9", "--knob tile: \"9\" is none of 8, 16, 32, 64"},
        {"-o d --seconds 0", "--seconds: \"0\" is no number"},
        {"-o d --size 64", "--size: \"64\" is no size"},
        {"-o d --lights l.json", "--lights goes with a scene"},
        {"-o d --camera 1", "--camera is for scenes"},
        {"-o d --claims --again", "--claims are not measured a second time"},
        {"-o d --page --knob tile=8", "--page measures nothing"},
        {"-o d --page x.exr", "--page measures nothing"},
        {"-o d --anew --again", "--anew forgets what --again is to measure"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char command[512];
        snprintf(command, sizeof command, "$T study %s", rows[i].arguments);
        expect_run(command, 2, "", rows[i].says);
    }
    expect_run("$T study -o no/where", 5, "", "no/where: the folder cannot be made");
    expect_run("touch file && $T study -o file", 5, "", "file: the folder cannot be made");
    expect_run("rm file && $T study -o d missing.exr", 3, "", "missing.exr");
    assert_int_equal(count_files(), 1); /* d, which is empty */
    expect_run("$T study --list", 0, "compression", "");
    expect_run("$T study --help", 0, "--knob", "");
}

static void studies_leave_data_and_maps(void **state)
{
    (void)state;
    expect_run(TINY "-o s --knob layout=compact-12,tutorial,merlin", 0,
               "what none beats in time and error", "");
    json_t *root = read_json("s/study.json");
    const json_t *all = configurations(root);
    assert_int_equal(json_array_size(all), 4);
    for (size_t i = 0; i < 4; i++) {
        const json_t *one = json_array_get(all, i), *values = json_object_get(one, "values");
        const char *map = json_string_value(json_object_get(one, "map"));
        const int is_on_front =
            json_number_value(json_object_get(values, "front_light")) > 0.0 ||
            json_number_value(json_object_get(values, "front_job")) > 0.0;
        assert_true(json_is_number(json_object_get(values, "error_rms")));
        assert_int_equal(map[0] != '\0', is_on_front);
        assert_true(!is_on_front || exists("s", map));
    }
    assert_true(exists("s", "maps/spheres.png"));
    expect_run(
        "mv s/study.html page.html && $T study --page -o s && cmp s/study.html page.html", 0,
        "", "");
    expect_run("$T study --page -o nowhere", 3, "", "nowhere/study.json");
    assert_non_null(strstr(json_string_value(json_object_get(root, "command")), "--quick"));
    json_decref(root);
    static char text[65536];
    read_text("s/study.csv", text, sizeof text);
    size_t lines = 0, commas[5] = {0};
    for (const char *c = text; *c && lines < 5; c++) {
        commas[lines] += *c == ',';
        lines += *c == '\n';
    }
    assert_int_equal(lines, 5);
    for (size_t i = 1; i < 5; i++)
        assert_int_equal(commas[i], commas[0]);
    /* Nothing is measured again, so nothing changes. */
    expect_run("cp s/study.csv s.csv; " TINY "-o s --knob layout=compact-12,tutorial,merlin "
               "&& cmp s/study.csv s.csv",
               0, "default", "");
    /* No file that was only to be timed is left. */
    expect_run("test -z \"$(find s -name '.*' -type f)\"", 0, "", "");
}

/* Of the study that the one before left: its command stays, and both runs stand in the data. */
static void second_runs_are_told(void **state)
{
    (void)state;
    json_t *root = read_json("s/study.json");
    char *command = strdup(json_string_value(json_object_get(root, "command")));
    json_decref(root);
    expect_run(TINY "-o s --knob layout=compact-12,tutorial,merlin --again", 0,
               "of 4 stay inside their intervals", "");
    root = read_json("s/study.json");
    assert_string_equal(json_string_value(json_object_get(root, "command")), command);
    for (size_t i = 0; i < 4; i++) {
        const json_t *again = json_object_get(json_array_get(configurations(root), i), "again");
        assert_true(json_is_boolean(json_object_get(again, "stays")));
        assert_string_equal(json_string_value(json_object_get(again, "of")), "light_ratio");
    }
    json_decref(root);
    free(command);
    expect_run(TINY "-o nothing --again", 2, "", "spheres: nothing of it is measured yet");
    expect_run("$T study --size 16x16 --quick -o s --again", 2, "",
               "spheres: it was another frame that was measured under this name");
}

/* Added to the study that is there, theirs beside ours; then they are there. */
static void claims_are_told(void **state)
{
    (void)state;
    expect_run(TINY "-o s --claims", 0, "theirs  ours", "");
    json_t *root = read_json("s/study.json");
    const json_t *claims = json_object_get(root, "claims");
    assert_int_equal(json_array_size(claims), 5);
    for (size_t i = 0; i < 5; i++)
        assert_true(json_array_size(json_object_get(json_array_get(claims, i), "figures")) > 0);
    json_decref(root);
    expect_run("cp s/study.csv s.csv; " TINY "-o s --claims && cmp s/study.csv s.csv", 0,
               "scissors save about a half", "");
}

/* A capture of the user's, with lights of the user's; and two that have one name. */
static void captures_are_studied(void **state)
{
    (void)state;
    expect_run(
        "mkdir -p c && $T capture $D/nine-lights.gltf -q --size 64x36 -o c/my.frame.exr && "
        "cp c/my.frame.exr my.frame.exr && "
        "$T study c/my.frame.exr my.frame.exr --lights $D/nine-lights.lights.json -o u "
        "--seconds 0.01 --knob precision=twin",
        0, "my-frame-2: 64 x 36, ", "");
    json_t *root = read_json("u/study.json");
    assert_int_equal(json_array_size(json_object_get(root, "frames")), 2);
    assert_int_equal(json_array_size(configurations(root)), 2);
    json_decref(root);
}

static void interrupted_studies_go_on(void **state)
{
    (void)state;
    expect_run(TINY "-o i " MANY " & p=$!; "
                    "until [ -s i/study.json ]; do sleep 0.02; done; kill -INT $p; wait $p",
               1, "", "the same command goes on from there");
    json_t *root = read_json("i/study.json");
    const size_t before = json_array_size(configurations(root));
    json_decref(root);
    assert_true(before >= 1 && before < 7);
    expect_run(TINY "-o i " MANY "", 0, "configuration", "");
    root = read_json("i/study.json");
    assert_int_equal(json_array_size(configurations(root)), 7);
    json_decref(root);
}

static int enter_folder(void **state)
{
    (void)state;
    enter_empty_folder("command-study");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(usage_errors_are_said), cmocka_unit_test(studies_leave_data_and_maps),
        cmocka_unit_test(second_runs_are_told),  cmocka_unit_test(claims_are_told),
        cmocka_unit_test(captures_are_studied),  cmocka_unit_test(interrupted_studies_go_on),
    };
    return cmocka_run_group_tests(tests, enter_folder, NULL);
}
