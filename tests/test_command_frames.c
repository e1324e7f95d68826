/* Do the commands, one after another on real scenes, make the frames that they promise? */
#define _GNU_SOURCE
#include "program.h"

#include "tilelight/gbuffer_file.h"

#include <jansson.h>
#include <unistd.h>

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-frames");
    return 0;
}

/* Every value the same, bit for bit, as `compare` counts. */
static void expect_same(const char *a, const char *b)
{
    char command[512];
    json_error_t where;
    snprintf(command, sizeof command, "$T compare %s %s --tolerance 0 --json", a, b);
    const program_run *run = expect_run(command, 0, "\"differing\": 0", "");
    json_t *report = json_loads(run->out, 0, &where);
    assert_non_null(report);
    assert_true(json_integer_value(json_object_get(report, "values")) > 0);
    assert_true(json_real_value(json_object_get(report, "mean_of_b")) > 0.0);
    json_decref(report);
}

/* With spots, orthographic and hard cases, many lights: captured, then lit from the file. */
static void capture_then_light_is_render(void **state)
{
    static const char *const scenes[] = {"nine-lights.gltf", "hard-cases.glb", "hall.gltf"};
    char command[512];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        snprintf(command, sizeof command,
                 "$T render $D/%s --size 161x90 -o render.exr -o render.png &&"
                 "$T capture $D/%s --size 161x90 -o g.exr --lights-out l.json &&"
                 "$T light g.exr -o light.exr -o light.png && cmp render.png light.png &&"
                 "$T light g.exr -o listed.exr --lights l.json",
                 scenes[i], scenes[i]);
        expect_run(command, 0, "", "");
        expect_same("light.exr", "render.exr");
        expect_same("listed.exr", "render.exr");
        expect_run("$T info render.png", 0, "161 x 90", "");
        expect_run("$T info render.exr", 0, "161 x 90", "");
        expect_run("$T info g.exr", 0, "covered", "");
        expect_run("$T info l.json", 0, "point", "");
    }
}

static void scatter_in_one_go_or_in_steps(void **state)
{
    (void)state;
    expect_run("$T render $D/hall.gltf --size 160x90 --scatter 300 -o render.exr &&"
               "$T capture $D/hall.gltf --size 160x90 -o g.exr &&"
               "$T scatter g.exr --count 300 -o l.json && $T scatter g.exr --count 300 -o - | "
               "cmp - l.json && $T light g.exr --lights l.json -o light.exr",
               0, "", "");
    expect_same("light.exr", "render.exr");
    expect_run("$T info l.json", 0, "point       300", "");
}

/* A scene without lights is lit by a rig, which a lights file, even an empty one, replaces. */
static void a_rig_lights_what_has_no_lights(void **state)
{
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 160x90 -o g.exr &&"
               "echo '{\"tilelight\": 1}' >none.json &&"
               "$T light g.exr --lights none.json -o none.exr",
               0, "", "");
    expect_run("$T info none.exr --json", 0, "\"max\": 0.0", "");

    tl_gbuffer *gbuffer = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_read("g.exr", &gbuffer, NULL, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_write("dark.exr", gbuffer, NULL, &err), err);
    tl_gbuffer_destroy(gbuffer);
    expect_run("$T light dark.exr -o rig.exr", 0, "", "no lights anywhere");
    expect_run("$T compare rig.exr none.exr --tolerance 0", 1, "PSNR", "above the tolerance");
}

/* Whose picture is gone: they cannot be read, and need not be. */
static void lights_of_a_file_replace_those_inside(void **state)
{
    tl_gbuffer *gbuffer = NULL;
    tl_light_set lights = {0};
    tl_error err;
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 16x16 -o g.exr --lights-out l.json &&"
               "$T light g.exr -o listed.exr -o gobo.png &&"
               "echo '{\"tilelight\": 1, \"lights\": [{\"type\": \"point\", \"position\": "
               "[0, 2, 0], \"texture\": \"gobo.png\"}]}' >lamp.json",
               0, "", "");
    ASSERT_OK(tl_gbuffer_read("g.exr", &gbuffer, NULL, NULL, &err), err);
    ASSERT_OK(tl_lights_read("lamp.json", &lights, &err), err);
    ASSERT_OK(tl_gbuffer_write("lamp.exr", gbuffer, &lights, &err), err);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(gbuffer);
    expect_run("$T light lamp.exr -o lamp.png && rm gobo.png", 0, "", "");
    expect_run("$T light lamp.exr -o gone.png", 3, "", "gobo.png: cannot be opened");
    expect_run("$T light lamp.exr --lights l.json -o a.exr &&"
               "$T light lamp.exr --lights l.json --map depth=Z -o b.exr",
               0, "", "");
    expect_same("a.exr", "listed.exr");
    expect_same("b.exr", "listed.exr");
}

static void reference_and_twin_need_no_device(void **state)
{
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 160x90 -o g.exr && $T light g.exr -o "
               "device.exr && export OCL_ICD_VENDORS=/nonexistent &&"
               "$T light g.exr -o twin.exr --precision twin &&"
               "$T light g.exr -o reference.exr --precision reference",
               0, "", "");
    expect_same("twin.exr", "device.exr");
    /* Arithmetic in float against double: the bound of the lighting kernels' own tests, of the
     * mean, is 2e-6. */
    expect_run("$T compare device.exr reference.exr --metric mean --tolerance 2e-6", 0, "", "");
    expect_run("OCL_ICD_VENDORS=/nonexistent $T light g.exr -o none.exr", 4, "", "device");
}

static void pixels_that_cannot_be_lit_are_repaired_or_refused(void **state)
{
    tl_gbuffer *gbuffer = NULL;
    tl_error err;
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 16x16 -o g.exr", 0, "", "");
    ASSERT_OK(tl_gbuffer_read("g.exr", &gbuffer, NULL, NULL, &err), err);
    tl_gbuffer_plane(gbuffer, TL_DEPTH)[3] = NAN;
    tl_gbuffer_plane(gbuffer, TL_ALBEDO_R)[15 * gbuffer->pitch + 4] = INFINITY;
    ASSERT_OK(tl_gbuffer_write("bad.exr", gbuffer, NULL, &err), err);
    tl_gbuffer_destroy(gbuffer);
    expect_run("$T light bad.exr -o bad.png", 0, "", "1 of depth");
    const program_run *run = expect_run("$T light bad.exr -o quiet.png --quiet", 0, "", "");
    assert_string_equal(run->err, "");
    expect_run("$T info bad.exr", 0, "1 not finite", "");
    expect_run("$T light bad.exr -o strict.png --strict", 3, "", "bad.exr");
    assert_int_equal(access("strict.png", F_OK), -1);
}

static void reports_are_one_json_object(void **state)
{
    static const char *const commands[] = {
        "$T render $D/nine-lights.gltf --size 64x64 -o a.png -o a.exr -o a.pfm --json "
        "--timings",
        "$T capture $D/nine-lights.gltf --size 64x64 -o g.exr --lights-out l.json --json",
        "$T light g.exr -o b.png --exposure auto --json",
        "$T scatter g.exr -o s.json --json",
        "$T compare a.exr a.exr --json",
        "$T compare a.exr a.exr --flip --json",
        "$T info g.exr --json",
        "$T info a.png --json",
        "$T info a.exr --json",
        "$T info a.pfm --json",
        "$T info l.json --json",
        "$T devices --json",
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(commands); i++) {
        json_error_t where;
        const program_run *run = expect_run(commands[i], 0, "{", "");
        json_t *report = json_loads(run->out, JSON_REJECT_DUPLICATES, &where);
        if (!json_is_object(report) || json_object_size(report) < 2)
            fail_msg("%s: %s\n%s", commands[i], where.text, run->out);
        json_decref(report);
    }
    expect_run("$T render $D/nine-lights.gltf --size 64x64 -o a.png --json --timings", 0,
               "\"shade\":", "");
    expect_run("$T render $D/nine-lights.gltf --size 64x64 -o a.png --timings", 0, "",
               "shade ");
}

/* What the report says of each output, and that floats are the same in every file, through a pipe too. */
static void outputs_are_what_the_report_says(void **state)
{
    static const char *const wanted[] = {
        "{\"file\": \"a.png\", \"format\": \"PNG\", \"size\": [64, 48], \"bits\": 16, "
        "\"tone\": \"agx\", \"curve\": \"srgb\", \"dither\": \"blue-noise\"}",
        "{\"file\": \"a.exr\", \"format\": \"OpenEXR\", \"size\": [64, 48], \"numbers\": "
        "\"float\", \"compression\": \"piz\"}",
        "{\"file\": \"a.pfm\", \"format\": \"PFM\", \"size\": [64, 48], \"numbers\": "
        "\"float\"}",
    };
    (void)state;
    const program_run *run = expect_run(
        "$T render $D/nine-lights.gltf --size 64x48 -o a.png -o a.exr -o a.pfm --png "
        "16 --tone agx --dither blue-noise --exr-compression piz --json",
        0, "{", "");
    json_t *report = json_loads(run->out, JSON_REJECT_DUPLICATES, NULL);
    json_t *outputs = json_object_get(report, "outputs");
    assert_int_equal(json_array_size(outputs), COUNT_OF(wanted));
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        json_t *expected = json_loads(wanted[i], 0, NULL);
        assert_non_null(expected);
        if (!json_equal(json_array_get(outputs, i), expected))
            fail_msg("not %s:\n%s", wanted[i], run->out);
        json_decref(expected);
    }
    json_decref(report);
    expect_run("$T info a.pfm", 0, "PFM, 64 x 48 pixels", "");
    expect_run("$T info a.png", 0, "PNG, 64 x 48 pixels", "");
    expect_run(
        "$T render $D/nine-lights.gltf --size 64x48 -o pfm:- >piped.pfm && cmp piped.pfm "
        "a.pfm",
        0, "", "");
    expect_run("$T compare a.pfm a.exr --tolerance 0", 0, "PSNR", "");
}

static void options_reach_the_picture(void **state)
{
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 64x64 -o g.exr && $T light g.exr -o - "
               ">piped.png && $T light g.exr -o plain.png && cmp piped.png plain.png",
               0, "", "");
    expect_run("$T light g.exr -o full.exr && $T light g.exr -o half.exr --exr half", 0, "",
               "");
    /* Half has 11 bits; the smallest numbers have fewer. */
    expect_run("$T compare half.exr full.exr --metric rms --tolerance 1e-2 --json", 0,
               "\"not_finite\": 0", "");
    expect_run("$T compare half.exr full.exr --tolerance 0", 1, "", "the worst is at pixel");
    expect_run("$T compare half.exr full.exr --metric flip --tolerance 0.01", 0, "FLIP", "");
    expect_run("$T light g.exr -o other.png --exposure 2 && ! cmp -s other.png plain.png", 0,
               "", "");
    expect_run("$T light g.exr -o other.png --tone none && ! cmp -s other.png plain.png", 0, "",
               "");
    expect_run("$T light g.exr -o other.png --exposure -20", 0, "", "very dark");
    expect_run(
        "$T light g.exr -o short.exr --light-cutoff 1 && ! $T compare short.exr full.exr "
        "--tolerance 0",
        0, "", "");
    expect_run(
        "for o in '--cull none' '--cull rect' '--tile 64' '--width 1'; do "
        "$T light g.exr -o o.exr $o && $T compare o.exr full.exr --tolerance 0 || exit 9; "
        "done",
        0, "differing                 0", "");
    expect_run(
        "$T compare short.exr full.exr --flip-map map.png --metric flip --tolerance 1e-4 "
        "|| $T info map.png",
        0, "64 x 64", "FLIP is");
    expect_run("$T compare plain.png full.exr", 0, "", "encoded for a screen");
    expect_run("$T compare plain.png full.exr --flip", 2, "", "one is each");
    expect_run(
        "$T render $D/nine-lights.gltf --size 32x64 -o s.exr && $T compare s.exr full.exr", 1,
        "", "nothing to compare");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(capture_then_light_is_render, enter),
        cmocka_unit_test_setup(scatter_in_one_go_or_in_steps, enter),
        cmocka_unit_test_setup(a_rig_lights_what_has_no_lights, enter),
        cmocka_unit_test_setup(lights_of_a_file_replace_those_inside, enter),
        cmocka_unit_test_setup(reference_and_twin_need_no_device, enter),
        cmocka_unit_test_setup(pixels_that_cannot_be_lit_are_repaired_or_refused, enter),
        cmocka_unit_test_setup(reports_are_one_json_object, enter),
        cmocka_unit_test_setup(outputs_are_what_the_report_says, enter),
        cmocka_unit_test_setup(options_reach_the_picture, enter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
