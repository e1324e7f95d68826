/* Do batches end in order, however they are ended, and leave nothing behind? */
#define _GNU_SOURCE
#include "program.h"

#include <ctype.h>
#include <jansson.h>
#include <unistd.h>

/* tests/preload/device_objects.c, beside this test. */
static void name_preload(void)
{
    char path[4096] = "";
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    assert_true(length > 0);
    char *slash = strrchr(path, '/');
    assert_non_null(slash);
    strcpy(slash, "/device_objects.so");
    assert_int_equal(access(path, R_OK), 0);
    assert_int_equal(setenv("P", path, 1), 0);
}

/* A small capture under many names. */
static int enter(void **state)
{
    (void)state;
    name_preload();
    enter_empty_folder("command-batch-runs");
    expect_run("$T capture $D/nine-lights.gltf --size 48x32 -o g.exr && mkdir in lit &&"
               "for i in $(seq 1 400); do ln -s ../g.exr in/g.$i.exr; done",
               0, "", "");
    return 0;
}

/* Of every kind as many as were made, also where frames fail, and stages and groups come and go. */
static void device_objects_are_released(void **state)
{
    static const char *const commands[] = {
        "batch in/g.#.exr --frames 1-9 -o lit/#.exr -o lit/#.png --bloom 0.5 --aov groups "
        "--tone agx --antialias",
        "light g.exr -o lit/one.png",
        "render $D/nine-lights.gltf --size 48x32 --samples 4 -o lit/render.exr --aov all",
    };
    char command[1024], kind[32];
    (void)state;
    expect_run("echo junk >junk && ln -sf ../junk in/g.4.exr", 0, "", "");
    for (size_t i = 0; i < COUNT_OF(commands); i++) {
        unsigned long made, released, all = 0;
        snprintf(command, sizeof command,
                 "DEVICE_OBJECTS=objects LD_PRELOAD=$P $T %s || test $? = 1", commands[i]);
        expect_run(command, 0, "", "");
        FILE *file = fopen("objects", "r");
        assert_non_null(file);
        while (fscanf(file, "%31s %lu %lu", kind, &made, &released) == 3) {
            if (made != released)
                fail_msg("%s: %lu of kind %s were made, and %lu released", commands[i], made,
                         kind, released);
            all += made;
        }
        assert_true(all > 10);
        fclose(file);
    }
    expect_run("ln -sf ../g.exr in/g.4.exr", 0, "", "");
}

/* Then frames are lit in bands, with the same bits; one whose row of tiles does not fit fails, and says why. */
static void a_full_device_lights_in_bands(void **state)
{
    (void)state;
    expect_run(
        "$T capture $D/nine-lights.gltf --size 320x400 -o large.exr && $T scatter large.exr "
        "--count 400 -o l.json && $T light large.exr --lights l.json -o whole.exr",
        0, "", "");
    expect_run(
        "DEVICE_ROOM=200000 LD_PRELOAD=$P $T light large.exr --lights l.json -o bands.exr "
        "&& $T compare whole.exr bands.exr --tolerance 0",
        0, "differing                 0",
        "the device ran out of memory: the frame was lit "
        "in bands");
    expect_run(
        "cp large.exr more.exr; DEVICE_ROOM=200000 LD_PRELOAD=$P $T batch large.exr more.exr "
        "g.exr --lights l.json -o 'lit/{name}.exr' && $T compare whole.exr lit/more.exr "
        "--tolerance 0",
        0, "differing                 0", "3 of 3 frames were lit");
    expect_run("DEVICE_ROOM=2000 LD_PRELOAD=$P $T light large.exr --lights l.json -o no.exr", 4,
               "", "the device is out of memory");
    expect_run(
        "DEVICE_ROOM=2000 LD_PRELOAD=$P $T batch in/g.#.exr --frames 1-20 --lights l.json "
        "-o lit/no.#.exr --json",
        4, "\"left\": 1", "5 frames in a row failed alike");
}

static json_int_t resident_bytes(const char *frames)
{
    char command[1024];
    json_error_t where;
    snprintf(command, sizeof command,
             "ulimit -n 48 && mkdir -p cache && TILELIGHT_CACHE=$PWD/cache $T batch in/g.#.exr "
             "--frames %s -o lit/#.png --force --json",
             frames);
    const program_run *run = expect_run(command, 0, "{", "");
    json_t *report = json_loads(run->out, 0, &where);
    assert_non_null(report);
    const json_int_t bytes = json_integer_value(json_object_get(report, "most_resident_bytes"));
    assert_true(bytes > 0);
    json_decref(report);
    return bytes;
}

/* Memory, descriptors, of which there are few, and files of the cache. A frame's planes are 100 kB. */
static void long_runs_do_not_grow(void **state)
{
    enum { FRAMES_MORE = 300, MOST_BYTES_A_FRAME = 10000 };
    (void)state;
    resident_bytes("1-2");
    const json_int_t few = resident_bytes("1-100");
    expect_run("ls -A cache | wc -l >before", 0, "", "");
    const json_int_t many = resident_bytes("1-400");
    expect_run("ls -A cache | wc -l | cmp - before && ! ls -A lit | grep tilelight-", 0, "",
               "");
    if (many - few > FRAMES_MORE * MOST_BYTES_A_FRAME)
        fail_msg("%d more frames took %lld bytes more", FRAMES_MORE, (long long)(many - few));
}

/* The frames under way are finished, and the next run does those that are left. */
static void a_signal_ends_a_batch_in_order(void **state)
{
    static const struct {
        const char *name;
        int exit_status;
    } signals[] = {{"INT", 130}, {"TERM", 143}};
    char command[1024];
    (void)state;
    expect_run(
        "$T capture $D/nine-lights.gltf --size 480x270 -o slow.exr && for i in $(seq 1 60); "
        "do ln -s ../slow.exr in/s.$i.exr; done",
        0, "", "");
    for (size_t i = 0; i < COUNT_OF(signals); i++) {
        snprintf(
            command, sizeof command,
            "rm -f lit/*; $T batch in/s.#.exr -o lit/s.#.png --precision reference --json & "
            "p=$!; until [ -e lit/s.1.png ]; do sleep 0.05; done; kill -%s $p; wait $p",
            signals[i].name);
        const program_run *run = expect_run(command, signals[i].exit_status, "\"failed\": 0",
                                            "interrupted: the frames under way are finished");
        assert_null(strstr(run->out, "\"left\": 0,"));
        expect_run("! ls -A lit | grep -v '^s[.][0-9]*[.]png$'", 0, "", "");
    }
    /* A second one does not wait; what it leaves does not keep the next run from being right. */
    expect_run("rm -f lit/*; $T batch in/s.#.exr -o lit/s.#.png --precision reference & p=$!; "
               "until [ -e lit/s.1.png ]; do sleep 0.05; done; kill -INT $p; sleep 0.05; "
               "kill -TERM $p; wait $p",
               143, "", "");
    expect_run(
        "$T batch in/s.#.exr -o lit/s.#.png --precision reference --frames 1-6 && $T light "
        "slow.exr -o one.png --precision reference && for i in 1 2 3 4 5 6; do $T compare "
        "one.png lit/s.$i.png --tolerance 0 || exit 9; done",
        0, "", "of 6 frames were lit");
}

/* A file system of a test's own, where that is allowed, which is full, then read-only, then neither. */
static void a_full_disk_stops_a_batch(void **state)
{
#define BATCH                                                                                \
    "$T batch in/g.#.exr --frames 1-60 -o lit/#.png -o lit/#.exr --in-flight 2 --precision " \
    "twin"
#define APART "unshare -rm sh -c \"mount -t tmpfs -o size=96k tmpfs lit && { "
    (void)state;
    if (run_shell(APART "true; }\"")->exit_status != 0)
        skip();
    const program_run *run = expect_run(
        APART BATCH "; echo full \\$?; mount -o remount,ro lit; " BATCH
                    "; echo locked \\$?; mount -o remount,rw,size=4m lit; " BATCH
                    "; echo free \\$?; ls -A lit | wc -l; }\"",
        0, "full 5\nlocked 5\nfree 0\n120\n", "No space left on device; free some space");
    assert_non_null(strstr(run->err, "5 frames in a row failed alike"));
    assert_non_null(strstr(run->err, "Read-only file system"));
    /* How many fit depends on which were under way as it filled; the last run has to leave those alone. */
    const char *sum = strstr(run->err, " of 60 frames were lit");
    assert_non_null(sum);
    while (sum > run->err && isdigit((unsigned char)sum[-1]))
        sum--;
    const int lit = atoi(sum);
    char left_alone[64];
    snprintf(left_alone, sizeof left_alone, "%d of 60 frames were lit, %d were up to date",
             60 - lit, lit);
    if (lit < 1 || !strstr(run->err, left_alone))
        fail_msg("what was written before the disk was full was made again:\n%s", run->err);
}

/* Each frame is lit by one of them, and both end when all are. */
static void processes_share_a_batch(void **state)
{
    enum { PROCESSES = 3, FRAMES = 60 };
    int done = 0, up_to_date = 0;
    (void)state;
    expect_run("for i in 1 2 3; do $T batch in/g.#.exr --frames 1-60 -o lit/#.png -o lit/#.exr "
               "--precision "
               "reference --json >sum.$i & done; wait",
               0, "", "");
    for (int i = 1; i <= PROCESSES; i++) {
        char path[16];
        snprintf(path, sizeof path, "sum.%d", i);
        json_t *report = json_load_file(path, 0, NULL);
        assert_non_null(report);
        done += (int)json_integer_value(json_object_get(report, "done"));
        up_to_date += (int)json_integer_value(json_object_get(report, "up_to_date"));
        json_decref(report);
    }
    assert_int_equal(done, FRAMES);
    assert_int_equal(up_to_date, (PROCESSES - 1) * FRAMES);
    expect_run("ls -A lit | wc -l", 0, "120\n", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(device_objects_are_released, enter),
        cmocka_unit_test_setup(a_full_device_lights_in_bands, enter),
        cmocka_unit_test_setup(long_runs_do_not_grow, enter),
        cmocka_unit_test_setup(a_signal_ends_a_batch_in_order, enter),
        cmocka_unit_test_setup(a_full_disk_stops_a_batch, enter),
        cmocka_unit_test_setup(processes_share_a_batch, enter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
