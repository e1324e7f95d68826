/* After a power cut at any moment of a batch, is every picture the old one, the new one or none, and are
 * those that a run said were made there; and does the next run complete them to the bits of a calm one? */
#define _GNU_SOURCE
#include "program.h"

#include "file_cases.h"

#include <signal.h>
#include <unistd.h>

/* On the CPU; two pictures of each of three frames, on two workers. */
#define BATCH                                                                                  \
    "$T batch g.#.exr --lights l.json -o lit/#.exr -o lit/#.png --precision twin --in-flight " \
    "2 "
#define OLD BATCH "--exposure 1 --sky none"
#define NEW BATCH "--exposure 2"

enum { FRAMES = 3, OUTPUTS = 2 * FRAMES };

/* [0]: what was there before, [1]: what is to be made. */
typedef struct picture {
    char name[32];
    unsigned char *bytes[2];
    size_t size[2];
} picture;

static picture pictures[OUTPUTS];

/* What is left of names and of contents; see tests/preload/power_cut.c. */
static const struct {
    const char *names, *contents;
} leavings[] = {
    {"keep", "lose"}, {"lose", "keep"}, {"some", "part"},
    {"keep", "part"}, {"lose", "lose"}, {"some", "keep"},
};

static void load_pictures(int which)
{
    for (int i = 0; i < OUTPUTS; i++) {
        char path[48];
        snprintf(pictures[i].name, sizeof pictures[i].name, "%d.%s", i / 2 + 1,
                 i % 2 ? "png" : "exr");
        snprintf(path, sizeof path, "lit/%.31s", pictures[i].name);
        pictures[i].bytes[which] = load_bytes(path, &pictures[i].size[which]);
    }
}

static int make_pictures(void **state)
{
    (void)state;
    enter_empty_folder("power-cut");
    expect_run("$T capture $D/nine-lights.gltf --size 24x16 -o g.1.exr && cp g.1.exr g.2.exr "
               "&& cp g.1.exr "
               "g.3.exr && $T scatter g.1.exr --count 3 -o l.json && mkdir lit",
               0, "", "");
    expect_run(NEW, 0, "", "");
    load_pictures(1);
    expect_run(OLD, 0, "", "");
    load_pictures(0);
    for (int i = 0; i < OUTPUTS; i++)
        if (pictures[i].size[0] == pictures[i].size[1] &&
            memcmp(pictures[i].bytes[0], pictures[i].bytes[1], pictures[i].size[0]) == 0)
            fail_msg("%s is old and new", pictures[i].name);
    expect_run("mv lit old", 0, "", "");
    return 0;
}

static int free_pictures(void **state)
{
    (void)state;
    for (int i = 0; i < OUTPUTS; i++) {
        free(pictures[i].bytes[0]);
        free(pictures[i].bytes[1]);
    }
    return 0;
}

static bool is_picture(const picture *of, int which, const unsigned char *bytes, size_t size)
{
    return size == of->size[which] && memcmp(bytes, of->bytes[which], size) == 0;
}

/* Each is old, new or absent, but where all have to be new. `when` is what messages say. */
static void check_pictures(const char *when, bool has_old, bool must_be_new)
{
    for (int i = 0; i < OUTPUTS; i++) {
        char path[48];
        size_t size;
        snprintf(path, sizeof path, "lit/%.31s", pictures[i].name);
        if (access(path, F_OK) != 0) {
            if (must_be_new || has_old)
                fail_msg("%s: %s is not there", when, path);
            continue;
        }
        unsigned char *bytes = load_bytes(path, &size);
        if (!is_picture(&pictures[i], 1, bytes, size) &&
            (must_be_new || !has_old || !is_picture(&pictures[i], 0, bytes, size)))
            fail_msg("%s: %s is neither whole nor what it was, %zu bytes", when, path, size);
        free(bytes);
    }
}

/* A batch with the power cut at an operation ("end": behind the last), over old pictures or none. */
static void cut(const char *at, const char *names, const char *contents, bool has_old)
{
    char command[1024], when[128];
    const bool is_end = strcmp(at, "end") == 0;
    snprintf(when, sizeof when, "cut at %s, names %s, contents %s", at, names, contents);
    snprintf(command, sizeof command,
             "rm -rf lit journal && mkdir journal && %s && { LD_PRELOAD=" POWER_CUT " "
             "POWER_FOLDER=$PWD/lit "
             "POWER_JOURNAL=$PWD/journal POWER_CUT_AT=%s POWER_NAMES=%s POWER_CONTENTS=%s " NEW
             "; }",
             has_old ? "cp -r old lit" : "mkdir lit", at, names, contents);
    const program_run *run = run_shell(command);
    if (run->exit_status != 128 + SIGKILL)
        fail_msg("%s: exit status %d: %s", when, run->exit_status, run->err);
    check_pictures(when, has_old, is_end);
    expect_run(NEW, 0, "", "");
    check_pictures(when, has_old, true);
    expect_run("rm lit/?.exr lit/?.png && ls -A lit && test -z \"$(ls -A lit)\"", 0, "", "");
}

/* Of a run without a cut. */
static unsigned count_operations(void)
{
    unsigned count = 0;
    expect_run("rm -rf lit journal && cp -r old lit && mkdir journal && LD_PRELOAD=" POWER_CUT
               " "
               "POWER_FOLDER=$PWD/lit "
               "POWER_JOURNAL=$PWD/journal POWER_COUNT=count " NEW,
               0, "", "");
    check_pictures("calm", true, true);
    FILE *file = fopen("count", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%u", &count), 1);
    fclose(file);
    return count;
}

/* How many there are, spread over the run, each with leavings in turn; POWER_CUTS asks for more. */
enum { CUTS = 20 };

static void any_operation(void **state)
{
    (void)state;
    const unsigned count = count_operations();
    const char *wanted = getenv("POWER_CUTS");
    const unsigned cuts = wanted ? (unsigned)strtoul(wanted, NULL, 10) : CUTS;
    print_message("%u operations, %u cuts\n", count, cuts);
    assert_true(count > CUTS);
    for (unsigned i = 0; i < cuts; i++) {
        char at[16];
        const unsigned of_run = (unsigned)((uint64_t)i * count / cuts);
        snprintf(at, sizeof at, "%u", of_run + 1);
        cut(at, leavings[i % COUNT_OF(leavings)].names,
            leavings[i % COUNT_OF(leavings)].contents, i % 4 != 0);
    }
}

/* What a run has said that it made is there, whatever a cut leaves. */
static void behind_the_last(void **state)
{
    (void)state;
    cut("end", "lose", "lose", true);
    cut("end", "lose", "part", false);
    cut("end", "keep", "lose", true);
}

/* Of a run with --force that a cut has ended, over pictures that were made before: none is made again. */
static void leavings_of_what_is_up_to_date(void **state)
{
    (void)state;
    expect_run("rm -rf lit && mkdir lit && " NEW "&& echo left >lit/.2.png.tilelight-part", 0,
               "", "");
    expect_run(NEW, 0, "", "3 were up to date");
    check_pictures("swept", true, true);
    expect_run("ls -A lit | wc -l", 0, "6", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(behind_the_last),
        cmocka_unit_test(any_operation),
        cmocka_unit_test(leavings_of_what_is_up_to_date),
    };
    return cmocka_run_group_tests(tests, make_pictures, free_pictures);
}
