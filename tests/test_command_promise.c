/* Does the command keep what --max-error, --max-flip and --max-time ask, say what it chose and found,
 * remember it, and refuse what cannot be? */
#define _GNU_SOURCE
#include "program.h"

#include <jansson.h>
#include <unistd.h>

#define MEMORY "export TILELIGHT_CACHE=$PWD/memory; "

static int enter(void **state)
{
    (void)state;
    enter_empty_folder("command-promise");
    expect_run("$T render $D/nine-lights.gltf --size 96x64 -o ref.exr --precision reference && "
               "$T capture $D/nine-lights.gltf --size 96x64 -o g.exr",
               0, "", "");
    return 0;
}

/* The promise of a report; new. */
static json_t *promise_of(const program_run *run)
{
    json_error_t where;
    json_t *report = json_loads(run->out, 0, &where);
    assert_non_null(report);
    json_t *promise = json_incref(json_object_get(report, "promise"));
    json_decref(report);
    assert_true(json_is_object(promise));
    return promise;
}

static double number(const json_t *of, const char *key)
{
    const json_t *value = json_object_get(of, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

/* The first frame of a kind has a pilot, the second none; both are as near as asked, and so says compare. */
static void remembered(void **state)
{
    (void)state;
    const program_run *run =
        expect_run(MEMORY "$T light g.exr -o 1.exr --max-error 1e-4 --json", 0,
                   "\"remembered\": false", "first frame of its kind");
    json_t *first = promise_of(run);
    assert_non_null(strstr(run->err, "lit with --precision float"));
    assert_non_null(
        strstr(run->err, "for an RMS error of at most 0.0001 of the mean radiance"));
    run = expect_run(MEMORY "$T light g.exr -o 2.exr --max-error 1e-4 --json --timings", 0,
                     "\"remembered\": true", "on all pixels");
    json_t *second = promise_of(run);
    assert_null(strstr(run->err, "first frame"));
    assert_non_null(strstr(run->out, "\"check\""));
    assert_null(strstr(run->out, "\"pilot\""));
    assert_true(number(first, "pilot_ms") > 0.0);
    assert_true(number(second, "pilot_ms") == 0.0);
    assert_true(json_is_true(json_object_get(second, "kept")));
    const json_t *attempt = json_array_get(json_object_get(second, "attempts"), 0);
    assert_true(number(attempt, "found") <= number(attempt, "at_most"));
    assert_true(number(attempt, "at_most") <= 1e-4);
    assert_true(number(second, "checked_pixels") == 96.0 * 64.0);
    json_decref(first);
    json_decref(second);
    for (int i = 1; i <= 2; i++) {
        char command[128];
        snprintf(command, sizeof command,
                 "$T compare %d.exr ref.exr --metric rms --tolerance 1e-4", i);
        expect_run(command, 0, "", "");
    }
    expect_run("ls memory", 0, ".promise.json", "");
}

/* What is remembered is damaged: a sentence, a pilot, and a good file again. */
static void damaged(void **state)
{
    (void)state;
    expect_run(MEMORY
               "$T light g.exr -o 1.exr --max-error 1e-4; f=$(ls memory/*.promise.json); "
               "head -c 99 $f >cut && cp cut $f && $T light g.exr -o 1.exr --max-error 1e-4",
               0, "", "what was remembered of such frames is not used");
    expect_run(MEMORY "$T light g.exr -o 1.exr --max-error 1e-4 --json", 0,
               "\"remembered\": true", "");
}

/* Where nothing can be kept, every frame is the first, and lit all the same. */
static void without_memory(void **state)
{
    (void)state;
    expect_run("export TILELIGHT_CACHE=; $T light g.exr -o 1.exr --max-error 8bit --json", 0,
               "\"of\": \"8bit\"", "no channel off by more than 1 of 255");
    expect_run(
        "export TILELIGHT_CACHE=/proc/none; $T light g.exr -o 1.png -q --max-flip 0.01 --json",
        0, "\"of\": \"flip\"", "");
}

static void in_time(void **state)
{
    (void)state;
    expect_run(MEMORY "$T light g.exr -o 1.exr --max-time 100000 --json", 0, "\"kept\": true",
               "for at most 100000 ms: expected");
    const program_run *run =
        expect_run(MEMORY "$T light g.exr -o 1.exr --max-time 0.001 --json", 0,
                   "\"kept\": false", "it was lit in the fastest");
    assert_null(strstr(run->err, "first frame"));
}

/* What explains a frame explains the picture that was made. */
static void explained(void **state)
{
    (void)state;
    expect_run(MEMORY "$T light g.exr -o 1.exr --max-error 1e-9 --explain", 0, "", "lit");
}

static void refusals(void **state)
{
    static const char *const cases[][2] = {
        {"--max-error x", "\"x\" is no number from 1e-09 to 1"},
        {"--max-error 0", "\"0\" is no number"},
        {"--max-error 2", "\"2\" is no number"},
        {"--max-error nan", "\"nan\" is no number"},
        {"--max-error 8bits", "--max-error (or 8bit): \"8bits\""},
        {"--max-flip 1e-9", "--max-flip: \"1e-9\" is no number"},
        {"--max-time 0", "--max-time: \"0\" is no number"},
        {"--max-error 1e-3 --max-time 5", "--max-error and --max-time exclude each other"},
        {"--max-flip 0.1 --max-error 8bit", "--max-flip and --max-error exclude each other"},
        {"--max-error 1e-3 --precision double", "--max-error chooses --precision itself"},
        {"--light-cutoff 0.1 --max-time 3", "--max-time chooses --light-cutoff itself"},
        {"--max-error 1e-3 --occlusion-samples 8", "ambient occlusion of 64 samples"},
        {"--max-flip 0.1 --power degree-3", "--max-flip chooses --power itself"},
        {"--max-error 1e-3 --exr half", "leave --exr half out"},
    };
    static const char *const commands[] = {"light g.exr", "render $D/nine-lights.gltf"};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        for (size_t k = 0; k < COUNT_OF(commands); k++) {
            char command[512];
            snprintf(command, sizeof command, "$T %s -o no.exr %s", commands[k], cases[i][0]);
            expect_run(command, 2, "", cases[i][1]);
        }
    assert_int_not_equal(access("no.exr", F_OK), 0);
    expect_run("$T light --help", 0, "--max-error=E|8bit", "");
    expect_run("$T check --max-error 1", 2, "", "unrecognized option");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(remembered),     cmocka_unit_test(damaged),
        cmocka_unit_test(without_memory), cmocka_unit_test(in_time),
        cmocka_unit_test(explained),      cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, enter, NULL);
}
