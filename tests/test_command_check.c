/* Is each way in which a user's kernel can be no kernel told apart, by exit status and by words? */
#define _GNU_SOURCE
#include "program.h"

#include <unistd.h>

/* Arguments of a kernel, for the shell. */
#define ARGUMENTS                                                                              \
    "A='const tl_frame f, __global const float *p, __global const tl_view_light *l, __global " \
    "const uint *s, __global const uint *e, __global const uint *i, __global float *r'; "

/* k.cl is what printf makes of `text`, which names m where there is a second kernel; %s is
 * ARGUMENTS. */
static const struct {
    const char *name, *text, *options;
    int exit_status;
    const char *out_word, *err_word;
} cases[] = {
    {"nothing is written", "__kernel void k(%s) {}", "--entry k", 1, "does not write stays so",
     "k.cl: 1 of 1 pixels are out of tolerance"},
    {"as JSON", "__kernel void k(%s) {}", "--entry k --json", 1, "\"passed\": false", "k.cl"},
    {"an error on line 3", "//\\n#include \"light.h\"\\n__kernel void k(%s) { nothing; }",
     "--entry k", 3, "", "k.cl:3:"},
    {"no such kernel", "__kernel void k(%s) {}\\n__kernel void m(%s) {}", "--entry n", 3, "",
     "k.cl: has no kernel \"n\"; its kernels: k, m"},
    {"no kernel at all", "", "--entry k", 3, "", "it has none at all"},
    {"a kernel of ours", "__kernel void k(%s) {}", "--entry shade_tiles", 3, "",
     "k.cl: has no kernel \"shade_tiles\"; its kernels: k"},
    {"two arguments", "__kernel void k(const tl_frame f, __global float *r) {}", "--entry k", 3,
     "", "takes 2 arguments; a shading kernel takes 7"},
    {"a number for a frame",
     "__kernel void k(const float f, __global float *p, __global float *l, __global uint *s, "
     "__global uint *e, __global uint *i, __global float *r) {}",
     "--entry k", 3, "", "argument 1 must be `const tl_frame'"},
    {"a number for a list",
     "__kernel void k(const tl_frame f, __global float *p, __global float *l, uint s, __global "
     "uint *e, __global uint *i, __global float *r) {}",
     "--entry k", 3, "", "argument 4, uint s, must be `__global const uint *starts'"},
    {"a size of its own",
     "__kernel __attribute__((reqd_work_group_size(64, 1, 1))) void k(%s) {}", "--entry k", 2,
     "", "asks for work-groups of 64 x 1 x 1"},
    {"an include of its own", "\\n#include \"own.h\"\\n", "--entry k", 3, "",
     "k.cl:2: `#include \"own.h\"'"},
    {"a NUL byte", "a\\0b", "--entry k", 3, "", "holds a NUL byte"},
    {"no entry", "", "", 2, "", "--entry is missing"},
    {"no such items", "", "--entry k --items row", 2, "", "kinds: tile, pixel"},
    {"on the host", "", "--entry k --precision twin", 2, "", "--kernel runs on a device"},
    {"no such frame", "", "--entry k --frame x", 2, "", "frames: spheres, wall"},
    {"lights for built-in frames", "", "--entry k --lights l.json", 2, "",
     "goes with --gbuffer"},
    {"a frame and a G-buffer", "", "--entry k --gbuffer g.exr", 2, "", "exclude each other"},
    {"a picture of no kind", "", "--entry k --diff d.jpg", 2, "", "end it in .png, .exr"},
    {"a picture nowhere", "", "--entry k --diff nowhere/d.png", 5, "", "nowhere/d.png"},
};

static void skip_without_device(void)
{
    const program_run *run = run_shell("$T check --frame dot");
    if (strstr(run->err, "no OpenCL device found"))
        exit(TL_SKIPPED);
}

static void each_case_says_what_it_should(void **state)
{
    (void)state;
    enter_empty_folder("command-check");
    skip_without_device();
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char command[4096];
        snprintf(
            command, sizeof command,
            ARGUMENTS
            "printf '%s'%s >k.cl; $T check --kernel k.cl --frame dot --width 1 --cull none "
            "%s",
            cases[i].text, strstr(cases[i].text, "%s") ? " \"$A\"" : "", cases[i].options);
        print_message("%s\n", cases[i].name);
        expect_run(command, cases[i].exit_status, cases[i].out_word, cases[i].err_word);
    }
}

static void other_files(void **state)
{
    (void)state;
    expect_run("$T check --kernel missing.cl --entry k", 3, "", "missing.cl: cannot be opened");
    expect_run("$T check --kernel . --entry k", 3, "", ".: cannot be read");
    expect_run("head -c 5000000 /dev/zero >k.cl; $T check --kernel k.cl --entry k", 3, "",
               "larger than the 4 MiB");
    expect_run("$T check --entry k", 2, "", "--entry goes with --kernel");
    expect_run("$T check --list", 0, "highlights", "");
    expect_run("echo nonsense | $T check --kernel - --entry k --frame dot", 3, "",
               "standard input: does not compile");
}

/* The picture of errors: of a kernel that is right nowhere, in both kinds. */
static void errors_are_pictured(void **state)
{
    (void)state;
    expect_run(ARGUMENTS "printf '__kernel void k(%s) {}' \"$A\" >k.cl; $T check --kernel k.cl "
                         "--entry k --frame unlit --frame dot --diff d.png; $T info d.png",
               0, "33 x 17", "pixel (0, 0) of frame unlit");
    expect_run("$T check --frame wall --diff d.exr && $T info d.exr", 0, "64 x 64", "");
}

/* Bands are lit one by one, and the kernel is told where they are. */
static void bands_pass(void **state)
{
    (void)state;
    expect_run(
        "$T check --kernel \"$TILELIGHT_SOURCE/docs/kernels/plain.cl\" --entry plain --frame "
        "mixed --memory 0.02",
        0, "passed", "");
}

/* The bench takes the same options, and refuses what is no kernel alike. */
static void the_bench_measures_it(void **state)
{
    (void)state;
    expect_run(
        "$T bench --kernel \"$TILELIGHT_SOURCE/docs/kernels/plain.cl\" --entry plain --size "
        "64x64 --lights 16 --samples 2 --seconds 0 --json b.json && cat b.json",
        0, "\"yours_over_ours\"", "");
    expect_run(
        "$T bench --kernel \"$TILELIGHT_SOURCE/docs/kernels/plain.cl\" --entry other --size "
        "64x64",
        3, "", "has no kernel \"other\"; its kernels: plain");
    expect_run("$T bench --kernel missing.cl --entry plain", 3, "", "missing.cl");
    expect_run("$T bench --kernel k.cl", 2, "", "--entry is missing");
    expect_run("$T bench --kernel k.cl --entry k --baselines", 2, "", "excludes --baselines");
    expect_run("$T bench --kernel \"$TILELIGHT_SOURCE/docs/kernels/plain.cl\" --entry plain "
               "--precision twin --size 64x64",
               2, "", "runs on a device");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_case_says_what_it_should), cmocka_unit_test(other_files),
        cmocka_unit_test(errors_are_pictured),           cmocka_unit_test(bands_pass),
        cmocka_unit_test(the_bench_measures_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
