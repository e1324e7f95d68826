/* Does a batch say what the world does to it, a disk that fills, a folder that cannot be written to, inputs
 * that vanish, and does the next run do the rest, to the bits of a calm one? Does one of two that is killed
 * cost no more than what it was at? */
#define _GNU_SOURCE
#include "program.h"

#include <jansson.h>
#include <sched.h>
#include <stdbool.h>
#include <sys/mount.h>
#include <unistd.h>

/* On the CPU. */
#define INPUTS "$T batch in/g.#.exr --lights l.json --precision twin "
#define BATCH INPUTS "-o lit/#.exr -o lit/#.png "
#define SLOW "$T batch in/g.#.exr --lights l.json --precision reference -o slow/#.exr "
enum { FRAMES = 40 };

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-batch-faults");
    expect_run(
        "$T capture $D/nine-lights.gltf --size 48x32 -o g.exr && mkdir in lit &&"
        "for i in $(seq 1 40); do cp g.exr in/g.$i.exr; done && $T scatter g.exr --count 4 "
        "-o l.json && " BATCH " && mv lit calm && mkdir lit slow calm-slow && " SLOW
        " && mv slow/* calm-slow",
        0, "", "");
    return 0;
}

/* Every picture of `folder` is that of a calm run, and nothing else is there. */
static void expect_all(const char *folder, const char *calm)
{
    char command[256];
    snprintf(command, sizeof command, "diff -rq %s %s", calm, folder);
    expect_run(command, 0, "", "");
}

/* What is in `folder` is of a calm run, whole; hidden files are none of it. */
static void expect_whole(const char *folder, const char *calm)
{
    char command[256];
    snprintf(command, sizeof command,
             "for f in $(ls -A %s); do cmp %s/$f %s/$f || exit 1; done", folder, folder, calm);
    expect_run(command, 0, "", "");
}

/* An empty disk of our own, in a mount namespace that ends with the process. */
static void mount_disk(const char *size)
{
    static bool is_apart;
    if (!is_apart && (unshare(CLONE_NEWNS) != 0 ||
                      mount("none", "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0)) {
        print_message("needs the right to mount: skipped\n");
        skip();
    }
    is_apart = true;
    mkdir("disk", 0777);
    assert_int_equal(mount("tmpfs", "disk", "tmpfs", 0, size), 0);
}

static void a_disk_that_fills(void **state)
{
    (void)state;
    mount_disk("size=128k");
    expect_run(INPUTS "-o disk/#.exr -o disk/#.png", 5, "",
               "5 frames in a row failed alike, the last: disk/");
    expect_run(INPUTS "-o disk/#.exr -o disk/#.png", 5, "",
               "No space left on device; free some space or write elsewhere");
    expect_whole("disk", "calm");
    assert_int_equal(mount("tmpfs", "disk", "tmpfs", MS_REMOUNT, "size=8m"), 0);
    expect_run(INPUTS "-o disk/#.exr -o disk/#.png", 0, "", " of 40 frames were lit, ");
    expect_all("disk", "calm");
    assert_int_equal(umount("disk"), 0);
}

/* What is up to date needs no writing. */
static void a_disk_for_reading_alone(void **state)
{
    (void)state;
    mount_disk("size=8m");
    expect_run(INPUTS "-o disk/#.exr -o disk/#.png && rm disk/7.png", 0, "", "");
    assert_int_equal(mount("tmpfs", "disk", "tmpfs", MS_REMOUNT | MS_RDONLY, ""), 0);
    expect_run(INPUTS "-o disk/#.exr -o disk/#.png", 1, "",
               "disk/7.exr: cannot be written: Read-only file system; write elsewhere");
    expect_run(INPUTS "-o disk/#.exr -o disk/#.png --force", 5, "", "failed alike");
    expect_whole("disk", "calm");
    assert_int_equal(umount("disk"), 0);
}

static void a_folder_that_is_not_there(void **state)
{
    (void)state;
    expect_run(INPUTS "-o absent/#.exr", 5, "",
               "No such file or directory; create its folder first");
}

/* Those that are done by then are whole, those that are gone are named, and come with the next run. */
static void inputs_that_vanish(void **state)
{
    json_error_t where;
    const char *name;
    size_t i;
    json_t *failure;
    (void)state;
    const program_run *run = run_shell(
        "mkdir gone; " SLOW "--json & p=$!; while [ -z \"$(ls slow)\" ]; do sleep 0.01; done; "
        "mv in/g.[13].exr in/g.3?.exr gone; wait $p");
    json_t *report = json_loads(run->out, 0, &where);
    assert_non_null(report);
    const json_t *failures = json_object_get(report, "failures");
    assert_int_equal(run->exit_status, json_array_size(failures) > 0);
    json_array_foreach(failures, i, failure)
    {
        name = json_string_value(json_object_get(failure, "sentence"));
        assert_non_null(name);
        if (!strstr(name, "in/g.3") && !strstr(name, "in/g.1.exr"))
            fail_msg("nothing was done to it: %s", name);
    }
    assert_int_equal(json_integer_value(json_object_get(report, "done")) +
                         (json_int_t)json_array_size(failures),
                     FRAMES);
    print_message("%zu of 12 had vanished in time\n", json_array_size(failures));
    json_decref(report);
    expect_whole("slow", "calm-slow");
    expect_run("mv gone/* in && rmdir gone && " SLOW, 0, "", "");
    expect_all("slow", "calm-slow");
}

/* Killed, at moments that come later from time to time, while another is at the same frames. */
static void one_of_two_is_killed(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        char command[1024];
        snprintf(command, sizeof command,
                 "rm -f slow/*; " SLOW "& p=$!; " SLOW
                 "& q=$!; sleep 0.%02d; kill -9 $q; wait $p",
                 6 * i);
        expect_run(command, 0, "", "");
        expect_all("slow", "calm-slow");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_folder_that_is_not_there), cmocka_unit_test(inputs_that_vanish),

        cmocka_unit_test(one_of_two_is_killed),       cmocka_unit_test(a_disk_that_fills),
        cmocka_unit_test(a_disk_for_reading_alone),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
