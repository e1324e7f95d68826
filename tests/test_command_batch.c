/* Does a batch light what `light` lights, frame by frame, once each, and go on past frames that fail? */
#define _GNU_SOURCE
#include "program.h"

#include <jansson.h>
#include <unistd.h>

/* Four frames of a small scene, under lights of their own, and pictures of them by `light`. On the CPU, where
 * nothing is compiled, but for what asks for a device. */
#define CAPTURE                                                                        \
    "$T capture $D/nine-lights.gltf --size 48x32 -o g.1.exr && for i in 2 3 4; do cp " \
    "g.1.exr g.$i.exr; done && for i in 1 2 3 4; do $T scatter g.1.exr --count $i -o " \
    "l.$i.json; done"
#define TWIN " --precision twin"

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-batch");
    expect_run(CAPTURE " && mkdir lit", 0, "", "");
    return 0;
}

/* Of what --json reports; the caller releases it. */
static json_t *report_of(const char *command, int exit_status)
{
    json_error_t where;
    const program_run *run = expect_run(command, exit_status, "{", "");
    json_t *report = json_loads(run->out, JSON_REJECT_DUPLICATES, &where);
    if (!report)
        fail_msg("%s: %s\n%s", command, where.text, run->out);
    return report;
}

static void expect_counts(
    const char *command, int exit_status, int done, int up_to_date, int failed)
{
    json_t *report = report_of(command, exit_status);
    const int found[] = {(int)json_integer_value(json_object_get(report, "done")),
                         (int)json_integer_value(json_object_get(report, "up_to_date")),
                         (int)json_integer_value(json_object_get(report, "failed"))};
    if (found[0] != done || found[1] != up_to_date || found[2] != failed)
        fail_msg("%s: %d done, %d up to date, %d failed; not %d, %d, %d", command, found[0],
                 found[1], found[2], done, up_to_date, failed);
    json_decref(report);
}

/* Devices' programs, buffers and stages are kept from frame to frame, of another size and other lights. */
static void frames_are_those_of_light(void **state)
{
    static const char *const ways[] = {"", TWIN, " --in-flight 1", " --in-flight 8"};
    static const char options[] = " --exposure auto --bloom 0.5 --aov groups --tone agx";
    char command[1024];
    (void)state;
    expect_run("$T capture $D/nine-lights.gltf --size 37x61 -o g.3.exr", 0, "", "");
    snprintf(command, sizeof command,
             "for i in 1 2 3 4; do $T light g.$i.exr --lights l.$i.json -o one.$i.exr -o "
             "one.$i.png%s || exit 9; done",
             options);
    expect_run(command, 0, "", "");
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        snprintf(command, sizeof command,
                 "rm -f lit/*; $T batch g.#.exr --lights l.#.json -o lit/f.#.exr -o "
                 "'lit/{name}.png'%s%s && for i in 1 2 3 4; do $T compare one.$i.exr "
                 "lit/f.$i.exr --tolerance 0 && $T compare one.$i.png lit/g.$i.png "
                 "--tolerance 0 || exit 9; done",
                 options, ways[i]);
        expect_run(command, 0, "differing                 0", "4 of 4 frames were lit");
    }
}

/* A frame that is damaged, one that is not there, one whose lights are not. */
static void bad_frames_are_told_and_skipped(void **state)
{
    json_t *report, *failures;
    (void)state;
    expect_run("echo junk >g.2.exr && rm l.4.json", 0, "", "");
    report = report_of(
        "$T batch g.#.exr --frames 1-5 --lights l.#.json -o lit/#.png --json" TWIN, 1);
    failures = json_object_get(report, "failures");
    assert_int_equal(json_integer_value(json_object_get(report, "done")), 2);
    assert_int_equal(json_array_size(failures), 3);
    for (size_t i = 0; i < 3; i++) {
        static const char *const words[] = {"g.2.exr: is no capture",
                                            "l.4.json: ", "g.5.exr: "};
        json_t *failure = json_array_get(failures, i);
        assert_int_equal(json_integer_value(json_object_get(failure, "exit_status")), 3);
        assert_non_null(
            strstr(json_string_value(json_object_get(failure, "sentence")), words[i]));
    }
    json_decref(report);
    expect_run("$T batch g.#.exr --frames 1-5 --lights l.#.json -o lit/#.png" TWIN, 1, "",
               "0 of 5 frames were lit, 2 were up to date, 3 failed");
    expect_run("ls lit", 0, "1.png\n3.png\n", "");
}

static void what_is_up_to_date_is_left(void **state)
{
    static const char batch[] =
        "$T batch g.#.exr --lights l.#.json -o lit/#.png -o lit/#.exr --json" TWIN;
    static const struct {
        const char *change, *more;
        int done;
    } turns[] = {
        {"true", "", 4},
        {"true", "", 0},
        {"rm lit/3.exr", "", 1},
        {"truncate -s -1 lit/2.png", "", 1},
        {"cp l.1.json l.2.json", "", 1},
        {"touch g.1.exr l.1.json", "", 0},
        {"true", " --exposure 1", 4},
        {"true", " --exp=1 --cull none --device none --memory 9 --in-flight 2", 0},
        {"true", " --force --exposure 1", 4},
        {"$T light g.4.exr -o lit/4.png" TWIN, " --exposure 1", 1},
        {"true", " --sky none --exposure 1", 4},
        {"$T capture $D/nine-lights.gltf --size 9x9 -o g.4.exr", " --exposure 1 --sky none", 1},
    };
    char command[1024];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(turns); i++) {
        snprintf(command, sizeof command, "%s && %s%s", turns[i].change, batch, turns[i].more);
        expect_counts(command, 0, turns[i].done, 4 - turns[i].done, 0);
    }
}

/* Contents of every file that is named count, what they are called does not; by glob, without a number. */
static void what_frames_are_made_from_counts(void **state)
{
    static const char batch[] = "$T batch 'g.[12].exr' -o 'lit/{name}.exr' --lights l.1.json "
                                "--sky sky.png --kernel k.cl "
                                "--entry k --json";
    static const struct {
        const char *change;
        int done;
    } turns[] = {
        {"true", 2},
        {"mv l.1.json m.json && ln -s m.json l.1.json && touch k.cl", 0},
        {"cp g.1.exr lit/g.2.exr", 1},
        {"$T light g.2.exr -o sky.png --exposure 3" TWIN, 2},
        {"echo '/* */' >>k.cl", 2},
    };
    static const char prepare[] =
        "$T light g.1.exr -o sky.png" TWIN " && cp $D/../docs/kernels/plain.cl k.cl && "
        "sed -i 's/__kernel void [a-z_]*/__kernel void k/' k.cl";
    char command[1024];
    (void)state;
    expect_run(prepare, 0, "", "");
    for (size_t i = 0; i < COUNT_OF(turns); i++) {
        snprintf(command, sizeof command, "%s && %s", turns[i].change, batch);
        expect_counts(command, 0, turns[i].done, 2 - turns[i].done, 0);
    }
}

static void a_dry_run_says_why(void **state)
{
    static const char batch[] = "$T batch g.#.exr -o lit/#.png" TWIN;
    char command[1024];
    (void)state;
    snprintf(command, sizeof command, "%s --dry-run && ! ls lit | grep .", batch);
    expect_run(command, 0, "lit/2.png is not there\n", "");
    expect_run(batch, 0, "", "4 of 4");
    snprintf(command, sizeof command,
             "cp g.1.exr lit/1.png && $T light g.2.exr -o lit/2.png" TWIN
             " && %s --dry-run --frames 1-5",
             batch);
    expect_run(command, 1,
               "lit/2.png does not say what it was made from\nlit/3.png is up to date",
               "g.5.exr: cannot be opened");
    snprintf(command, sizeof command, "%s --dry-run --force --json", batch);
    expect_run(command, 0, "\"would_be_made\": 4", "");
}

static void usage_is_checked_before_anything_is_read(void **state)
{
    static const struct {
        const char *arguments, *says;
    } cases[] = {
        {"-o lit/#.png", "inputs are missing"},
        {"g.#.exr", "-o is missing"},
        {"g.#.exr -o -", ".exr or .png"},
        {"g.#.exr -o lit/#.pfm", ".exr or .png"},
        {"g.#.exr -o lit/one.png", "####"},
        {"g.#.exr -o lit/#.png --lights -", "from a file"},
        {"g.#.exr -o lit/#.png --shard 0/4", "the I-th of N"},
        {"g.#.exr -o lit/#.png --shard 5/4", "the I-th of N"},
        {"g.#.exr -o lit/#.png --in-flight 0", "from 1 to 64"},
        {"g.#.exr -o lit/#.png --progress loud", "no such way"},
        {"g.#.exr -o lit/#.png --json --progress openjd", "standard output"},
        {"h.#.exr -o lit/#.png", "h.#.exr"},
        {"g.#.exr --frames 1-x -o lit/#.png", "1-x"},
        {"g.#.exr -o lit/#.png --sky-light 2 --lights l.1.json", "--sky-light is for nothing"},
    };
    char command[512];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snprintf(command, sizeof command, "$T batch %s", cases[i].arguments);
        expect_run(command, 2, "", cases[i].says);
    }
    expect_run("OCL_ICD_VENDORS=/nonexistent $T batch g.#.exr -o lit/#.png", 4, "", "device");
    expect_run("echo '{}' >l.json; $T batch g.#.exr -o lit/#.png --lights l.json", 3, "",
               "l.json");
    expect_run("ls -A lit", 0, "", "");
}

/* Nothing that the next frame could be written to. */
static void what_stops_every_frame_stops_the_batch(void **state)
{
    (void)state;
    expect_run("for i in 5 6 7 8 9; do cp g.1.exr g.$i.exr; done;"
               "$T batch g.#.exr -o none/#.png --in-flight 1 --json" TWIN,
               5, "\"left\": 4", "5 frames in a row failed alike");
    expect_run("$T batch g.#.exr -o none/#.png --frames 1-3" TWIN, 1, "",
               "create its folder first");
}

static void progress_is_told(void **state)
{
    (void)state;
    const program_run *run =
        expect_run("$T batch g.#.exr -o lit/#.png --progress openjd" TWIN, 0,
                   "openjd_progress: 100.0\nopenjd_status: 4 of 4 frames", "");
    assert_null(strstr(run->out, "openjd_fail"));
    expect_run("$T batch g.#.exr --frames 1-5 -o lit/#.png --progress openjd" TWIN, 1,
               "openjd_fail: 0 of 5 frames were lit, 4 were up to date, 1 failed", "g.5.exr");
    run = expect_run("$T batch g.#.exr -o lit/#.png --force -q" TWIN, 0, "", "");
    assert_string_equal(run->err, "");
}

/* Notices that say the same are told once, with how many frames they are of. */
static void notices_are_told_once(void **state)
{
    (void)state;
    const program_run *run =
        expect_run("$T batch g.#.exr --lights l.#.json -o lit/#.png --exposure -30" TWIN, 0, "",
                   "of 4 frames, first: the picture is very dark at -30.0 stops");
    const char *first = strstr(run->err, "very dark");
    assert_non_null(first);
    const char *second = strstr(first + 1, "very dark");
    assert_non_null(second);
    assert_null(strstr(second + 1, "very dark"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(frames_are_those_of_light, enter),
        cmocka_unit_test_setup(bad_frames_are_told_and_skipped, enter),
        cmocka_unit_test_setup(what_is_up_to_date_is_left, enter),
        cmocka_unit_test_setup(what_frames_are_made_from_counts, enter),
        cmocka_unit_test_setup(a_dry_run_says_why, enter),
        cmocka_unit_test_setup(usage_is_checked_before_anything_is_read, enter),
        cmocka_unit_test_setup(what_stops_every_frame_stops_the_batch, enter),
        cmocka_unit_test_setup(progress_is_told, enter),
        cmocka_unit_test_setup(notices_are_told_once, enter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
