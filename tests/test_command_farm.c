/* Does `farm` hand to workers what was meant for `batch`, refuse what could not work there, and submit? */
#define _GNU_SOURCE
#include "program.h"

#include <unistd.h>

/* Workers note their words, a line each with spaces around; sbatch keeps its script and notes how it was
 * called. */
static void make_programs(void)
{
    FILE *worker = fopen("worker", "w"), *sbatch = fopen("sbatch", "w");
    assert_non_null(worker);
    assert_non_null(sbatch);
    fputs("#!/bin/sh\n{ printf ' %s' \"$@\"; echo ' '; } >>notes\n", worker);
    fputs("#!/bin/sh\necho \"$@\" >>calls\n[ -z \"$REFUSE\" ] || [ $(wc -l <calls) -lt $REFUSE "
          "] || exit 1\n"
          "cat >script.$(wc -l <calls)\necho \"$((41 + $(wc -l <calls)));cluster\"\n",
          sbatch);
    assert_int_equal(fclose(worker) | fclose(sbatch), 0);
    assert_int_equal(chmod("worker", 0777) | chmod("sbatch", 0777), 0);
}

static void workers_get_what_is_batchs(void **state)
{
    (void)state;
    static const struct {
        const char *options, *words; /* of the second of three workers */
    } cases[] = {{"--chunk 2 --program ./worker a.#.exr --frames 1-6 -o b.#.exr",
                  " batch a.#.exr -o b.#.exr --frames=3-4 "},
                 {"a.#.exr --frames=6-1 --chunk=2 -ob.#.exr --program=./worker",
                  " batch a.#.exr -ob.#.exr --frames=4-3 "},
                 {"--mem 1G --program ./worker --exposure 1 --fra 9,1-5 --time 10 -o b.#.exr "
                  "--chu 2 -- -a.#.exr",
                  " batch --exposure 1 -o b.#.exr --frames=2-3 -- -a.#.exr "},
                 {"--frames 1-2 --chunk 2 --program ./worker a.#.exr --frames 1-6 -o b.#.exr",
                  " batch --frames 1-2 a.#.exr -o b.#.exr --frames=3-4 "},
                 {"--chunk 2 -o 'out/{name}.exr' 'x*.exr' --program ./worker",
                  " batch -o out/{name}.exr x*.exr --shard=2/3 "},
                 {"--chunk 2 -o b.#.exr --manifest m.json --program ./worker",
                  " batch -o b.#.exr --manifest m.json --shard=2/3 "}};
    char command[512], notes[4096];
    enter_empty_folder("command-farm");
    make_programs();
    expect_run(
        "touch x1.exr x2.exr x3.exr x4.exr x5.exr\n"
        "for i in 1 2 3 4 5; do echo '{\"input\": \"a\", \"frame\": '$i'}'; done >m.json",
        0, "", "");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snprintf(command, sizeof command,
                 "rm -f notes; $T farm slurm %s >script && SLURM_ARRAY_TASK_ID=1 bash script",
                 cases[i].options);
        expect_run(command, 0, "", "");
        read_text("notes", notes, sizeof notes);
        notes[strcspn(notes, "\n")] = '\0';
        assert_string_equal(notes, cases[i].words);
    }
}

static void what_cannot_work_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *options;
        int status;
        const char *says;
    } cases[] = {
        {"", 2, "the scheduler is missing"},
        {"slurmm a.#.exr --frames 1 -o b.#.exr", 2, "did you mean \"slurm\"?"},
        {"slurm -o b.#.exr", 2, "inputs are missing"},
        {"slurm a.#.exr --frames 1", 2, "-o"},
        {"slurm a.#.exr --frames 1-x -o b.#.exr", 2, "1-x"},
        {"slurm a.#.exr --frames 1 -o b.#.exr --exposur x", 2, "--exposure"},
        {"slurm a.#.exr --frames 1 -o b.#.exr --chunk 0", 2, "--chunk"},
        {"slurm a.#.exr --frames 1 -o b.#.exr --mem 4GB", 2, "--mem: \"4GB\""},
        {"slurm a.#.exr --frames 1 -o b.#.exr --time tomorrow", 2, "--time: \"tomorrow\""},
        {"slurm a.#.exr --frames 1 -o b.#.exr --partition 'a b'", 2, "--partition: \"a b\""},
        {"openjd a.#.exr --frames 1 -o b.#.exr --partition a", 2,
         "--partition cannot be told to openjd"},
        {"parallel a.#.exr --frames 1 -o b.#.exr --cpus-per-task 2", 2,
         "--cpus-per-task cannot be told to parallel"},
        {"openjd a.#.exr --frames 1 -o b.#.exr --submit", 2, "--submit"},
        {"openjd a.#.exr --frames 1 -o b.#.exr --json", 2, "--json"},
        {"slurm a.#.exr --frames 1-9 -o b.#.exr --shard 1/2", 2, "--shard"},
        {"slurm a.#.exr --frames 1-9 -o b.#.exr --force", 2, "--force"},
        {"slurm a.#.exr --frames 1-9 -o b.#.exr --dry-run", 2, "--dry-run"},
        {"slurm --manifest - -o b.#.exr", 2, "--manifest -"},
        {"slurm a.exr --frames 1-9 -o b.exr", 2, "there is no number"},
        {"openjd a.#.exr --frames 1-2000 --chunk 1 -o b.#.exr", 2, "--chunk 2"},
    };
    char command[512];
    enter_empty_folder("command-farm-refused");
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        snprintf(command, sizeof command, "$T farm %s", cases[i].options);
        const program_run *run = expect_run(command, cases[i].status, "", cases[i].says);
        assert_string_equal(run->out, "");
    }
}

static void jobs_are_submitted(void **state)
{
    (void)state;
    static const char submit[] =
        "PATH=.:$PATH $T farm slurm --chunk 2 a.#.exr --frames 1-6 -o b.#.exr --submit";
    char text[4096];
    enter_empty_folder("command-farm-submitted");
    make_programs();
    expect_run(submit, 0, "job 42: 3 chunks of 6 frames; gather: job 43\n", "");
    read_text("calls", text, sizeof text);
    assert_string_equal(text, "--parsable\n--parsable --array=3 --dependency=afterany:42\n");
    expect_run("$T farm slurm --chunk 2 a.#.exr --frames 1-6 -o b.#.exr >printed\n"
               "sed 's/ --submit//' script.1 | cmp - printed && cmp script.1 script.2",
               0, "", "");

    snprintf(text, sizeof text, "rm calls; REFUSE=1 %s", submit);
    expect_run(text, 5, "", "sbatch refused the job");
    snprintf(text, sizeof text, "rm calls; REFUSE=2 %s", submit);
    expect_run(text, 5, "", "sbatch refused the job: job 42 runs without a gather behind it");
    snprintf(text, sizeof text, "PATH=/nowhere %s", submit + strlen("PATH=.:$PATH "));
    expect_run(text, 3, "", "without --submit the script is printed");
    expect_run("$T farm slurm a.#.exr --frames 1 -o b.#.exr >/dev/full", 5, "",
               "standard output");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(workers_get_what_is_batchs),
                                       cmocka_unit_test(what_cannot_work_is_refused),
                                       cmocka_unit_test(jobs_are_submitted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
