/* Do scripts and templates for schedulers, run, start each chunk's worker in its folder with exactly the
 * words that were meant, whatever is in them? */
#define _POSIX_C_SOURCE 200809L
#include "farm_schedulers.h"

#include <unistd.h>

#include "program.h"

/* In folders and files, everything that some shell, template or scheduler reads as something else. */
static const char folder_name[] = "night \"shift\" 'two' $HOME {{x}} #1";
static const char *const words[] = {"in put/a.####.exr",
                                    "it's.exr",
                                    "\"quoted\".exr",
                                    "-o",
                                    "{name} {}.exr",
                                    "",
                                    "{1} {#} {/.}.png",
                                    "a\\b",
                                    "$(touch bad)",
                                    "`touch bad`",
                                    "*",
                                    "~",
                                    "--lights=l;touch bad",
                                    "{{Param.Folder}}",
                                    "a{{b",
                                    "c}}d",
                                    "{= $_ =}",
                                    "\xC3\xA9!",
                                    "&|<>()",
                                    "%d %A_%a",
                                    "#SBATCH"};

static const tl_farm_scheduler *scheduler_of(const char *name)
{
    for (size_t i = 0; i < TL_FARM_SCHEDULER_COUNT; i++)
        if (strcmp(tl_farm_schedulers[i].name, name) == 0)
            return &tl_farm_schedulers[i];
    fail_msg("there is no %s", name);
    return NULL;
}

/* A program that notes its folder and its words, each with a NUL behind, in one write. */
static void make_program(void)
{
    FILE *file = fopen("program's", "w");
    assert_non_null(file);
    fputs("#!/bin/bash\n{ printf '%s\\0' \"$PWD\" \"$@\"; } >>\"$NOTES\"\n", file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod("program's", 0777), 0);
}

typedef struct odd_plan {
    tl_farm_plan plan;
    char folder[4300], program[4300];
} odd_plan;

static void make_plan(odd_plan *odd, const char *frames, size_t chunk)
{
    char here[4096];
    tl_frames set = {NULL, 0};
    tl_error err;
    enter_empty_folder("farm-schedulers");
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(mkdir(folder_name, 0777), 0);
    make_program();
    snprintf(odd->folder, sizeof odd->folder, "%s/%s", here, folder_name);
    snprintf(odd->program, sizeof odd->program, "%s/program's", here);
    odd->plan = (tl_farm_plan){.folder = odd->folder,
                               .program = odd->program,
                               .arguments = words,
                               .argument_count = COUNT_OF(words),
                               .chunk_at = COUNT_OF(words) - 2};
    ASSERT_OK(tl_frames_parse(frames, &set, &err), err);
    ASSERT_OK(tl_farm_cut_frames(&odd->plan, &set, chunk, &err), err);
    tl_frames_clear(&set);
}

static void print_to(const char *path, const char *name, const tl_farm_plan *plan)
{
    tl_error err;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    ASSERT_OK(scheduler_of(name)->print(plan, file, &err), err);
    assert_int_equal(fclose(file), 0);
}

/* The notes of all workers in their order, the gather last. */
static size_t want_notes(char *notes, const tl_farm_plan *plan, const char *const *more)
{
    char *end = notes;
    for (size_t i = 0; i <= plan->chunk_count; i++) {
        const char *chunk = i < plan->chunk_count ? plan->chunks[i] : plan->gather;
        end = stpcpy(end, plan->folder) + 1;
        end = stpcpy(end, "batch") + 1;
        for (size_t j = 0; more && more[j]; j++)
            end = stpcpy(end, more[j]) + 1;
        for (size_t j = 0; j <= plan->argument_count; j++) {
            if (j == plan->chunk_at)
                end = stpcpy(end, chunk) + 1;
            if (j < plan->argument_count)
                end = stpcpy(end, plan->arguments[j]) + 1;
        }
    }
    return (size_t)(end - notes);
}

static void expect_notes(const tl_farm_plan *plan, const char *const *more)
{
    static char want[65536], got[65536];
    const size_t size = want_notes(want, plan, more);
    FILE *file = fopen("notes", "rb");
    assert_non_null(file);
    const size_t got_size = fread(got, 1, sizeof got, file);
    fclose(file);
    for (size_t i = 0, j = 0; i < size && j < got_size;
         i += strlen(want + i) + 1, j += strlen(got + j) + 1)
        assert_string_equal(got + j, want + i);
    assert_int_equal(got_size, size);
    assert_int_not_equal(access("bad", F_OK), 0);
    remove("notes");
}

static const char notes_here[] = "export NOTES=\"$PWD/notes\"; ";

static void run_with_notes(const char *command)
{
    char line[512];
    snprintf(line, sizeof line, "%s%s", notes_here, command);
    const program_run *run = run_shell(line);
    if (run->exit_status != 0)
        fail_msg("%s: %s", command, run->err);
}

static void slurm_tasks_run_their_chunks(void **state)
{
    (void)state;
    odd_plan odd;
    make_plan(&odd, "-3-20", 10);
    assert_int_equal(odd.plan.chunk_count, 3);
    assert_string_equal(odd.plan.chunks[0], "--frames=-3-6");
    assert_string_equal(odd.plan.chunks[2], "--frames=17-20");
    assert_string_equal(odd.plan.gather, "--frames=-3-20");
    print_to("script", "slurm", &odd.plan);
    run_with_notes("for task in 0 1 2 3; do SLURM_ARRAY_TASK_ID=$task bash script; done");
    expect_notes(&odd.plan, NULL);
    tl_farm_plan_release(&odd.plan);
}

static void parallel_runs_its_chunks(void **state)
{
    (void)state;
    odd_plan odd;
    if (run_shell("command -v parallel")->exit_status != 0) {
        print_message("without GNU parallel\n");
        skip();
    }
    make_plan(&odd, "-3-20", 10);
    print_to("script", "parallel", &odd.plan);
    run_with_notes("bash script");
    expect_notes(&odd.plan, NULL);
    tl_farm_plan_release(&odd.plan);
}

static void the_template_is_one_and_runs(void **state)
{
    (void)state;
    static const char *const progress[] = {"--progress", "openjd", NULL};
    odd_plan odd;
    make_plan(&odd, "1-23x2,100", 5);
    odd.plan.needs = (tl_farm_needs){.processors = 4, .memory_mib = 2048, .seconds = 600};
    print_to("template", "openjd", &odd.plan);
    run_with_notes(
        "python3 -B \"$TILELIGHT_SOURCE/tests/farm/check_job_template.py\" --run template");
    expect_notes(&odd.plan, progress);
    run_with_notes(
        "python3 -B \"$TILELIGHT_SOURCE/tests/farm/check_job_template.py\" --plant template");
    tl_farm_plan_release(&odd.plan);
}

/* A worker that fails fails its task, and the task says so. */
static void status_of_workers_arrives(void **state)
{
    (void)state;
    odd_plan odd;
    make_plan(&odd, "1-4", 2);
    odd.plan.program = "/bin/false";
    print_to("script", "slurm", &odd.plan);
    expect_run("SLURM_ARRAY_TASK_ID=0 bash script", 1, "", "");
    odd.plan.folder = "/nowhere";
    odd.plan.program = "/bin/true";
    print_to("script", "slurm", &odd.plan);
    expect_run("SLURM_ARRAY_TASK_ID=0 bash script", 1, "", "/nowhere");
    print_to("template", "openjd", &odd.plan);
    expect_run(
        "python3 -B \"$TILELIGHT_SOURCE/tests/farm/check_job_template.py\" --run template", 2,
        "", "/nowhere");
    tl_farm_plan_release(&odd.plan);
}

static void expect_no_template(const tl_farm_plan *plan, const char *word)
{
    tl_error err;
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(scheduler_of("openjd")->print(plan, file, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, word));
    assert_int_equal(ftell(file), 0);
    fclose(file);
}

static void what_a_template_cannot_hold_is_refused(void **state)
{
    (void)state;
    static const char *const lines[] = {"a\nb"}, *const latin[] = {"\xE9"},
                             *const next[] = {"\xC2\x85"};
    static char longer[1100] = "{{";
    static const char *const too_long[] = {longer};
    odd_plan odd;
    tl_error err;
    memset(longer + 2, 'a', sizeof longer - 3);
    make_plan(&odd, "1-2000", 1);
    expect_no_template(&odd.plan, "--chunk 2");
    tl_farm_plan_release(&odd.plan);

    ASSERT_OK(tl_farm_cut_shards(&odd.plan, 7, 2, &err), err);
    assert_string_equal(odd.plan.chunks[3], "--shard=4/4");
    assert_string_equal(odd.plan.gather, "--shard=1/1");
    odd.plan.argument_count = odd.plan.chunk_at = 1;
    const char *const *const refused[] = {lines, latin, next, too_long};
    static const char *const said[] = {"control", "UTF-8", "control", "1024"};
    for (size_t i = 0; i < COUNT_OF(refused); i++) {
        odd.plan.arguments = refused[i];
        expect_no_template(&odd.plan, said[i]);
    }
    tl_farm_plan_release(&odd.plan);
}

static void needs_reach_the_scheduler(void **state)
{
    (void)state;
    char text[8192];
    odd_plan odd;
    make_plan(&odd, "1-100", 25);
    odd.plan.needs = (tl_farm_needs){3, 1536, 90, "short"};
    print_to("script", "slurm", &odd.plan);
    read_text("script", text, sizeof text);
    static const char *const slurm[] = {
        "\n#SBATCH --array=0-3\n", "\n#SBATCH --cpus-per-task=3\n", "\n#SBATCH --mem=1536M\n",
        "\n#SBATCH --time=1:30\n", "\n#SBATCH --partition=short\n", "# 100 frames in 4 chunks"};
    for (size_t i = 0; i < COUNT_OF(slurm); i++)
        assert_non_null(strstr(text, slurm[i]));
    print_to("script", "parallel", &odd.plan);
    read_text("script", text, sizeof text);
    assert_non_null(strstr(text, " --memfree 1536M --timeout 90 "));
    tl_farm_plan_release(&odd.plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slurm_tasks_run_their_chunks),
        cmocka_unit_test(parallel_runs_its_chunks),
        cmocka_unit_test(the_template_is_one_and_runs),
        cmocka_unit_test(status_of_workers_arrives),
        cmocka_unit_test(what_a_template_cannot_hold_is_refused),
        cmocka_unit_test(needs_reach_the_scheduler),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
