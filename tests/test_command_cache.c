/* Are compiled kernels kept and found again, by many processes at once, and does all that can be
 * wrong with the places for them cost no more than time? */
#define _GNU_SOURCE
#include "program.h"

#include "tilelight/report.h"

#include <unistd.h>

/* As users run it, who leave PoCL's folder to the program. Without culling there is one pass of
 * kernels, so that a cold start is short. Every picture has to be the one of a process that keeps
 * nothing. */
#define CACHE(folder) "export TILELIGHT_CACHE=" folder "; "
#define LIGHT "$T light hall.exr --timings -o "
#define LIGHT_ONE_PASS "$T light hall.exr --cull none --timings -o "
#define LIGHT_BY_PIXEL "$T light --cull none --path gpu --timings "
#define AND_SEE " && cmp want.exr 1.exr; "

/* PoCL gives leave to execute to the kernels that it compiled, and not to those it unpacked. */
#define COMPILED " -name '*.so' -perm -u+x | wc -l; "

static int prepare(void **state)
{
    (void)state;
    enter_empty_folder("cache-command");
    unsetenv("POCL_CACHE_DIR");
    expect_run("$T capture $D/hall.gltf -o hall.exr --size 160x90", 0, "", "");
    expect_run("export POCL_CACHE_DIR=$PWD/warm; " CACHE("") LIGHT_ONE_PASS
               "want.exr && find warm " COMPILED,
               0, "1\n", "compile");
    return 0;
}

/* Runs a command in which every picture is right; it says whether it kept kernels. */
static void expect_kept(const char *command, int kept)
{
    const program_run *run = expect_run(command, 0, "", "first kernel");
    if ((strstr(run->err, "\nkeep ") != NULL) != kept)
        fail_msg("%s\n%s kernels:\n%s", command, kept ? "did not keep" : "kept", run->err);
}

/* One compiles, all make one picture, and one entry remains. On a machine so busy that it takes as
 * long as others are willing to wait, some compile too. */
static void many_cold_starts(void **state)
{
    enum { PATIENCE_S = 20 };
    const double start = tl_seconds();
    (void)state;
    const program_run *run = expect_run(
        CACHE("cache") "for i in 1 2 3 4 5; do { " LIGHT_ONE_PASS
                       "many$i.exr && cmp want.exr many$i.exr || echo wrong; } & done; wait; "
                       "rm many*.exr; ls -A cache",
        0, ".program\n", "");
    assert_null(strstr(run->out, "wrong"));
    assert_int_equal(strlen(run->out), strlen("0123456789abcdef0123456789abcdef.program\n"));
    const char *keep = strstr(run->err, "\nkeep ");
    assert_non_null(keep);
    if (tl_seconds() - start < PATIENCE_S)
        assert_null(strstr(keep + 1, "\nkeep "));
}

static void expect_nothing_compiled(const char *light)
{
    char command[1024];
    snprintf(command, sizeof command,
             "export POCL_CACHE_DIR=$PWD/driver; mkdir driver; " CACHE(
                 "cache") "%s 1.exr" AND_SEE "find driver" COMPILED "rm -r driver",
             light);
    assert_string_equal(expect_run(command, 0, "", "first kernel")->out, "0\n");
}

static void warm_start(void **state)
{
    (void)state;
    expect_nothing_compiled(LIGHT_ONE_PASS);
}

/* Culling has an entry of its own, and leaves that of shading as it is. */
static void culling_joins(void **state)
{
    (void)state;
    expect_run("cp cache/*.program good", 0, "", "");
    expect_kept(CACHE("cache") LIGHT "1.exr" AND_SEE, 1);
    expect_kept(CACHE("cache") LIGHT "1.exr" AND_SEE, 0);
    expect_nothing_compiled(LIGHT);
    expect_nothing_compiled(LIGHT_ONE_PASS);
    expect_run("ls -A cache | wc -l", 0, "2\n", "");
    expect_run("for entry in cache/*; do cmp -s good $entry && echo same || rm $entry; done", 0,
               "same\n", "");
}

/* Larger frames have launches that drivers compile for anew: they join the entry, and displace nothing. */
static void entry_grows(void **state)
{
    (void)state;
    expect_run("$T capture $D/hall.gltf -o large.exr --size 512x288", 0, "", "");
    expect_kept(CACHE("grown") LIGHT_BY_PIXEL "hall.exr -o 1.exr" AND_SEE, 1);
    expect_kept(CACHE("grown") LIGHT_BY_PIXEL "large.exr -o 2.exr; ", 1);
    expect_kept(CACHE("grown") LIGHT_BY_PIXEL "large.exr -o 2.exr; ", 0);
    expect_kept(CACHE("grown") LIGHT_BY_PIXEL "hall.exr -o 1.exr" AND_SEE, 0);
    expect_run("ls -A grown | wc -l; rm -r grown", 0, "1\n", "");
}

static void damaged_entry_is_made_anew(void **state)
{
    (void)state;
    expect_run("printf damage | dd of=$(ls cache/*.program) bs=1 "
               "seek=60000 conv=notrunc 2>&-; ! cmp -s cache/*.program good",
               0, "", "");
    expect_kept(CACHE("cache") LIGHT_ONE_PASS "1.exr" AND_SEE, 1);
    expect_kept(CACHE("cache") LIGHT_ONE_PASS "1.exr" AND_SEE, 0);
    expect_run("rm good; ls -A cache | wc -l", 0, "1\n", "");
}

static void nowhere_to_keep(void **state)
{
    static const char *const places[] = {
        "unset XDG_CACHE_HOME TILELIGHT_CACHE; export HOME=/proc/none; ",
        "unset XDG_CACHE_HOME TILELIGHT_CACHE HOME; ",
        "touch file; " CACHE("$PWD/file"),
    };
    char command[1024];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        /* The first compiles, which takes a folder for the driver; the others spare themselves
         * the time. */
        snprintf(command, sizeof command, "%s%s" LIGHT_ONE_PASS "1.exr" AND_SEE, places[i],
                 i > 0 ? "export POCL_CACHE_DIR=$PWD/warm; " : "");
        expect_run(command, 0, "", "first kernel");
    }
    remove("file");
}

/* What the driver is lent goes with the process, and with the next one if that was killed; what is
 * in use, or is just being made, stays. */
static void folders_of_the_driver(void **state)
{
    (void)state;
    expect_run("mkdir run; export XDG_RUNTIME_DIR=$PWD/run; " CACHE("cache") LIGHT_ONE_PASS
               "1.exr && ls -A run | wc -l",
               0, "0\n", "");
    expect_run("cd run; mkdir tilelight-driver-new tilelight-driver-old tilelight-driver-dead "
               "tilelight-driver-used; touch -d yesterday tilelight-driver-old; "
               "touch tilelight-driver-dead/lock; cd ..; "
               "export XDG_RUNTIME_DIR=$PWD/run T; " CACHE(
                   "cache") "flock run/tilelight-driver-used/lock sh -c '" LIGHT_ONE_PASS
                            "1.exr'; echo $(ls run); rm -r run",
               0, "tilelight-driver-new tilelight-driver-used\n", "first kernel");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_cold_starts),
        cmocka_unit_test(warm_start),
        cmocka_unit_test(culling_joins),
        cmocka_unit_test(entry_grows),
        cmocka_unit_test(damaged_entry_is_made_anew),
        cmocka_unit_test(folders_of_the_driver),
        cmocka_unit_test(nowhere_to_keep),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
