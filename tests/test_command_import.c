/* Do the commands take captures of other programs, and say what they assume and what is missing? */
#define _GNU_SOURCE
#include "program.h"

#include "foreign_exr.h"
#include "foreign_frame.h"

#include <jansson.h>
#include <unistd.h>

static const char lights[] =
    "{\"tilelight\":1,\"ambient\":[0.1,0.1,0.1],\"lights\":[{\"type\":\"point\","
    "\"position\":[0.3,0.2,-1.5],\"intensity\":4,\"range\":5}]}";

static void write_files(void)
{
    static foreign_file file;
    static foreign_frame frame;
    const float *normals[3] = {frame.normal[0], frame.normal[1], frame.normal[2]};
    foreign_fill(&frame);
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    foreign_write(&file, "all.exr");
    file.parts[0].channel_count = 1;
    foreign_write(&file, "depth.exr");
    file.parts[0] = (foreign_part){.name = NULL};
    foreign_add_three(&file.parts[0], "", "RGB", EXR_PIXEL_FLOAT, normals);
    foreign_write(&file, "normal.exr");
    save_bytes("lights.json", lights, strlen(lights));
}

/* Imported on the way and imported before are the same bits; so are planes from one file and from
 * several. */
static void light_takes_them(void **state)
{
    (void)state;
    enter_empty_folder("command-import-light");
    write_files();
    expect_run("$T light all.exr --fov 60 --lights lights.json -o a.exr", 0, "",
               "nothing says where it stands");
    expect_run("$T convert all.exr --fov 60 -o ours.exr", 0, "", "planar");
    expect_run("$T light ours.exr --lights lights.json -o b.exr && cmp a.exr b.exr", 0, "", "");
    expect_run(
        "$T light --map depth=depth.exr --map normal=normal.exr:RGB --map "
        "albedo=all.exr:albedo --fov 60 --lights lights.json -o c.exr && cmp a.exr c.exr",
        0, "", "");
    expect_run("$T light --map depth=depth.exr --map normal=normal.exr:RGB --fov 60 -o d.png",
               0, "", "every surface is taken as grey");
    expect_run("$T light all.exr --hfov 75 --unit 2 --lights lights.json -o e.exr && "
               "! cmp -s a.exr e.exr",
               0, "", "2 m each");
}

/* Camera and lights of our own files stay; what a map names is replaced. */
static void own_files_may_be_mapped(void **state)
{
    (void)state;
    enter_empty_folder("command-import-own");
    expect_run(
        "$T capture $D/nine-lights.gltf --size 64x36 -o g.exr && $T light g.exr -o a.exr", 0,
        "", "");
    expect_run("$T light g.exr --map depth=Z -o b.exr && cmp a.exr b.exr", 0, "",
               "attributes tilelight:");
    expect_run("$T light g.exr --map albedo=N.XYZ -o c.exr && ! cmp -s a.exr c.exr", 0, "", "");
    expect_run("$T light g.exr --map depth=z -o d.exr", 3, "", "did you mean \"Z\"?");
}

static void others_take_them(void **state)
{
    (void)state;
    enter_empty_folder("command-import-others");
    write_files();
    expect_run("$T scatter all.exr --fov 60 --count 20 -o l.json && $T info l.json", 0, "20",
               "");
    expect_run("$T scatter --map depth=depth.exr --map normal=normal.exr --fov 60 -o -", 0,
               "\"lights\"", "");
    expect_run("$T check --gbuffer all.exr --fov 60 --lights lights.json", 0, "", "");
    expect_run("$T convert all.exr --fov 60 --layout compact-16 -o p.exr && $T info p.exr", 0,
               "compact-16", "");
    expect_run("$T convert all.exr --fov 60 --eye 1,2,3 --target 1,2,0 -o p.exr && $T info "
               "p.exr",
               0, "at (1, 2, 3) m", "--eye and --target");
}

/* A terminal would obey the escape sequence. */
static void names_cannot_steer_a_terminal(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    enter_empty_folder("command-import-names");
    foreign_fill(&frame);
    foreign_describe(&file, &frame, EXR_PIXEL_FLOAT);
    file.parts[0].name = "p\x1b[2J";
    foreign_add(&file.parts[0], "c\x1b[2J\n", EXR_PIXEL_UINT, frame.depth);
    foreign_write(&file, "steering.exr");
    expect_run("$T info steering.exr", 0, "part 0      \"p?[2J\", ", "");
    expect_run("$T info steering.exr", 0, "\nc?[2J?                                   uint",
               "");
    expect_run(
        "$T convert steering.exr --fov 60 --map depth=\"$(printf 'c\\033[2J')\" -o x.exr", 3,
        "", "\"c?[2J\"");
}

static void info_says_what_is_there(void **state)
{
    (void)state;
    enter_empty_folder("command-import-info");
    write_files();
    expect_run("$T info all.exr", 0, "missing     all.exr: nothing says what its camera sees",
               "");
    expect_run("$T info all.exr --fov 60", 0, "missing     nothing that lighting needs", "");
    expect_run("$T info depth.exr", 0, "holds normals", "");
    expect_run("printf 'Pf\\n1 1\\n-1\\nabcd' > d.pfm && $T info d.pfm", 0,
               "PFM of another program\n", "");
    expect_run("$T info d.pfm --json", 0, "\"size\": null", "");
    const program_run *run = expect_run("$T info all.exr --json", 0, "", "");
    json_t *report = json_loads(run->out, 0, NULL);
    assert_non_null(report);
    assert_string_equal(json_string_value(json_object_get(report, "kind")), "capture");
    assert_true(json_is_null(json_object_get(report, "camera")));
    assert_non_null(strstr(json_string_value(json_object_get(report, "missing")), "--fov"));
    size_t i, taken = 0;
    json_t *channel;
    json_array_foreach(json_object_get(report, "channels"), i, channel)
    {
        taken += json_object_get(channel, "plane") != NULL;
    }
    assert_int_equal(i, 8);
    assert_int_equal(taken, 8);
    json_decref(report);
}

static void counts_are_reported(void **state)
{
    (void)state;
    enter_empty_folder("command-import-counts");
    write_files();
    const program_run *run = expect_run(
        "$T convert all.exr --fov 60 --sky-from 2.125 --map alpha=albedo.G --json -o "
        "c.exr",
        0, "", "covered in part");
    json_t *report = json_loads(run->out, 0, NULL);
    assert_non_null(report);
    const json_t *import = json_object_get(report, "import");
    /* Depths grow by 1/8 from row to row and 1/64 from column to column: from 2.125 on they are the
     * last pixel of the first row and all of the others. The alpha of every pixel is between 0 and 1. */
    assert_int_equal(json_integer_value(json_object_get(import, "sky")), 1 + 6 * 9);
    assert_int_equal(json_integer_value(json_object_get(import, "partial")), 7 * 9);
    assert_int_equal(json_integer_value(json_object_get(import, "outside")), 0);
    json_decref(report);
    expect_run(
        "$T convert all.exr --fov 60 -o c.exr -q && $T convert c.exr --json -o d.exr | grep "
        "-q '\"import\"' && echo imported || echo own",
        0, "own", "");
}

static void wrong_use_is_refused(void **state)
{
    static const struct {
        const char *command;
        int exit_status;
        const char *says;
    } cases[] = {
        {"$T light all.exr -o x.png", 3, "--camera-file"},
        {"$T light depth.exr --fov 60 -o x.png", 3, "holds normals"},
        {"$T convert all.exr --fov 60 -o ours.exr && $T light ours.exr --fov 60 -o x.png", 2,
         "says itself"},
        {"$T light -o x.png", 2, "G.exr is missing"},
        {"$T light --map depth=depth.exr -o x.png --fov 60", 3, "no --map names normals"},
        {"$T light --map depth=Z -o x.png --fov 60", 2, "names no file"},
        {"$T light all.exr --map depht=Z -o x.png", 2, "no such plane"},
        {"$T light all.exr --fov 180 -o x.png", 2, "--fov"},
        {"$T light all.exr --fov 60 --hfov 60 -o x.png", 2, "exclude"},
        {"$T light all.exr --fov 60 --eye 1,2,3 -o x.png", 2, "go together"},
        {"$T light all.exr --fov 60 --eye 1,2 --target 0,0,0 -o x.png", 2, "X,Y,Z"},
        {"$T light all.exr --fov 60 --eye 1,2,3 --target 1,2,3 -o x.png", 2, "span no plane"},
        {"$T light all.exr --fov 60 --camera-file c.json -o x.png", 2, "--camera-file"},
        {"$T light all.exr --camera-file c.json -o x.png", 3, "c.json"},
        {"$T light all.exr --fov 60 --depth-kind deep -o x.png", 2, "planar, view-z"},
        {"$T light all.exr --fov 60 --depth-kind ndc -o x.png", 2, "--near"},
        {"$T light all.exr --fov 60 --near 2 --far 1 -o x.png", 2, "less than"},
        {"$T check --fov 60", 2, "--gbuffer"},
    };
    (void)state;
    enter_empty_folder("command-import-wrong");
    write_files();
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        expect_run(cases[i].command, cases[i].exit_status, "", cases[i].says);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_takes_them),
        cmocka_unit_test(own_files_may_be_mapped),
        cmocka_unit_test(others_take_them),
        cmocka_unit_test(info_says_what_is_there),
        cmocka_unit_test(names_cannot_steer_a_terminal),
        cmocka_unit_test(counts_are_reported),
        cmocka_unit_test(wrong_use_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
