/* tilelight farm: a batch as a job of a scheduler. */
#define _POSIX_C_SOURCE 200809L
#include "batch_options.h"
#include "commands.h"
#include "console.h"
#include "farm_needs.h"
#include "farm_schedulers.h"
#include "farm_submit.h"
#include "suggest.h"
#include "try.h"
#include "values.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct farm_command {
    const tl_farm_scheduler *scheduler;
    batch_command batch;
    tl_farm_needs needs;
    uint32_t chunk;
    bool submit;
    const char *program; /* NULL: this one */
    char **argv;         /* [argc] */
    bool *own;           /* [argc] which of them are not batch's */
    const char **kept;   /* [argc] what workers have of them */
    int argc;
} farm_command;

enum {
    OPTION_CHUNK = 256,
    OPTION_PROGRAM,
    OPTION_SUBMIT,
    OPTION_PROCESSORS,
    OPTION_MEMORY,
    OPTION_TIME,
    OPTION_PARTITION
};

/* What schedulers can be told of workers. */
static const struct {
    const char *option;
    unsigned need;
    int key;
} needs[] = {{"--cpus-per-task", TL_FARM_PROCESSORS, OPTION_PROCESSORS},
             {"--mem", TL_FARM_MEMORY, OPTION_MEMORY},
             {"--time", TL_FARM_TIME, OPTION_TIME},
             {"--partition", TL_FARM_PARTITION, OPTION_PARTITION}};

static unsigned needs_given(const tl_farm_needs *given)
{
    return (given->processors > 0 ? TL_FARM_PROCESSORS : 0u) |
           (given->memory_mib > 0 ? TL_FARM_MEMORY : 0u) |
           (given->seconds > 0 ? TL_FARM_TIME : 0u) |
           (given->partition ? TL_FARM_PARTITION : 0u);
}

static void check_together(const farm_command *command, struct argp_state *state)
{
    const tl_farm_scheduler *scheduler = command->scheduler;
    const tl_batch_request *request = &command->batch.batch.request;
    for (size_t i = 0; i < sizeof needs / sizeof needs[0]; i++)
        if (needs_given(&command->needs) & ~scheduler->takes & needs[i].need)
            argp_error(state, "%s cannot be told to %s: leave it out", needs[i].option,
                       scheduler->name);
    if (command->submit && !scheduler->submits)
        argp_error(state, "--submit: nothing is submitted to %s; its file is printed",
                   scheduler->name);
    if (request->shard_count > 0)
        argp_error(state,
                   "--shard: a farm cuts the batch itself, into chunks of --chunk frames");
    if (request->manifest && strcmp(request->manifest, "-") == 0)
        argp_error(state, "--manifest -: workers cannot read this standard input; name a file");
    if (command->batch.batch.force)
        argp_error(state, "--force: the gather would light every frame once more; remove the "
                          "pictures instead");
    if (command->batch.report.json && scheduler->progress)
        argp_error(state, "--json: workers tell %s their progress on standard output",
                   scheduler->name);
    if (command->batch.batch.dry_run)
        argp_error(state, "--dry-run is for `tilelight batch': nothing is lit here");
}

static void choose_scheduler(farm_command *command, const char *name, struct argp_state *state)
{
    const char *names[TL_FARM_SCHEDULER_COUNT];
    for (size_t i = 0; i < TL_FARM_SCHEDULER_COUNT; i++) {
        names[i] = tl_farm_schedulers[i].name;
        if (strcmp(names[i], name) == 0)
            command->scheduler = &tl_farm_schedulers[i];
    }
    const char *near = tl_suggest(name, names, TL_FARM_SCHEDULER_COUNT);
    if (!command->scheduler)
        argp_error(state, "\"%s\" is no scheduler%s%s%s; slurm, openjd and parallel are", name,
                   near ? ": did you mean \"" : "", near ? near : "", near ? "\"?" : "");
}

/* Notes that an option is not batch's. `text` is its value, in an argument with it or in the next one. */
static void take(farm_command *command, const char *text)
{
    for (int i = 1; text && i < command->argc; i++) {
        const char *argument = command->argv[i];
        if (text < argument || text > argument + strlen(argument))
            continue;
        command->own[i] = true;
        if (text == argument)
            command->own[i - 1] = true;
    }
}

static error_t parse_need(int key, char *text, struct argp_state *state)
{
    farm_command *command = state->input;
    tl_farm_needs *of = &command->needs;
    switch (key) {
    case OPTION_PROCESSORS:
        of->processors = value_integer(state, "--cpus-per-task", text, 1, 65536);
        break;
    case OPTION_MEMORY:
        if (!tl_farm_memory(text, &of->memory_mib))
            argp_error(state, "--mem: \"%s\" is no memory; write MiB, or 4G, up to 1T", text);
        break;
    case OPTION_TIME:
        if (!tl_farm_time(text, &of->seconds))
            argp_error(
                state,
                "--time: \"%s\" is no time; write minutes, H:MM:SS or D-HH, up to 365 days",
                text);
        break;
    case OPTION_PARTITION:
        if (!tl_farm_partition(text))
            argp_error(state, "--partition: \"%s\" is no name of a partition", text);
        of->partition = text;
        break;
    default: return ARGP_ERR_UNKNOWN;
    }
    take(command, text);
    return 0;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    farm_command *command = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &command->batch; return 0;
    case ARGP_KEY_ARG:
        if (command->scheduler)
            return ARGP_ERR_UNKNOWN; /* batch's */
        choose_scheduler(command, text, state);
        command->own[state->next - 1] = true;
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "the scheduler is missing"); return 0;
    case ARGP_KEY_SUCCESS: check_together(command, state); return 0;
    case OPTION_CHUNK:
        command->chunk = value_integer(state, "--chunk", text, 1, TL_MOST_FRAMES);
        take(command, text);
        return 0;
    case OPTION_PROGRAM:
        command->program = text;
        take(command, text);
        return 0;
    case OPTION_SUBMIT:
        command->submit = true;
        command->own[state->next - 1] = true;
        return 0;
    default: return parse_need(key, text, state);
    }
}

static const struct argp_option options_table[] = {
    {NULL, 0, NULL, 0, "Workers:", 1},
    {"chunk", OPTION_CHUNK, "N", 0, "Frames of one worker (default 25)", 1},
    {"cpus-per-task", OPTION_PROCESSORS, "N", 0, "Processors of one (slurm, openjd)", 1},
    {"mem", OPTION_MEMORY, "SIZE", 0, "Memory of one: MiB, or with K, M, G or T", 1},
    {"time", OPTION_TIME, "TIME", 0,
     "After which one is ended: minutes, M:SS, H:MM:SS, D-HH, D-HH:MM or D-HH:MM:SS", 1},
    {"partition", OPTION_PARTITION, "NAME", 0, "Where they run (slurm)", 1},
    {"program", OPTION_PROGRAM, "FILE", 0,
     "What they run (default: this program, where it is here)", 1},
    {"submit", OPTION_SUBMIT, NULL, 0, "Hand it to sbatch, with the gather behind (slurm)", 1},
    {0},
};

static const struct argp_child children[] = {
    {&batch_argp, 0, "Of `tilelight batch':", 2},
    {0},
};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "slurm|openjd|parallel",
    .doc = "Prints a batch as a job of a scheduler: chunks of frames for workers that share "
           "the folder, and a "
           "gather that does what they left, and says what failed. slurm is a script for "
           "sbatch, openjd a job "
           "template of Open Job Description, parallel a script around GNU parallel. What else "
           "is given is "
           "what `tilelight batch' takes, and is checked as there (docs/farm.md).",
    .children = children,
};

/* Arguments that workers have: those of batch, the chunk behind them but before "--". */
static void keep_arguments(farm_command *command, tl_farm_plan *plan)
{
    take(command, command->batch.batch.request.frames);
    bool ended = false;
    for (int i = 1; i < command->argc; i++) {
        if (command->own[i])
            continue;
        if (!ended && strcmp(command->argv[i], "--") == 0) {
            plan->chunk_at = plan->argument_count;
            ended = true;
        }
        command->kept[plan->argument_count++] = command->argv[i];
    }
    if (!ended)
        plan->chunk_at = plan->argument_count;
    plan->arguments = command->kept;
}

static tl_status cut(const farm_command *command, tl_farm_plan *plan, tl_error *err)
{
    const char *set = command->batch.batch.request.frames;
    tl_frames frames = {.of = NULL};
    tl_item_list items = {.of = NULL};
    tl_status status = TL_OK;
    TRY(batch_list_items(&command->batch, &items, err));
    if (set) {
        TRY(tl_frames_parse(set, &frames, err));
        TRY(tl_farm_cut_frames(plan, &frames, command->chunk, err));
    } else
        TRY(tl_farm_cut_shards(plan, items.count, command->chunk, err));
done:
    tl_frames_clear(&frames);
    tl_items_clear(&items);
    return status;
}

/* [4096] each. */
static tl_status find_places(tl_farm_plan *plan, char *folder, char *program, tl_error *err)
{
    if (!getcwd(folder, 4096))
        return tl_fail(err, TL_ERR_READ, "the current folder cannot be named: %s",
                       strerror(errno));
    plan->folder = folder;
    if (plan->program)
        return TL_OK;
    const ssize_t length = readlink("/proc/self/exe", program, 4095);
    if (length < 0)
        return tl_fail(err, TL_ERR_READ,
                       "this program cannot be found: %s; name what workers run with --program",
                       strerror(errno));
    program[length] = '\0';
    plan->program = program;
    return TL_OK;
}

static tl_status run(farm_command *command, tl_error *err)
{
    char folder[4096], program[4096];
    tl_farm_plan plan = {.program = command->program, .needs = command->needs};
    tl_status status = TL_OK;
    TRY(find_places(&plan, folder, program, err));
    keep_arguments(command, &plan);
    TRY(cut(command, &plan, err));
    TRY(command->submit ? farm_submit(&plan, err)
                        : command->scheduler->print(&plan, stdout, err));
done:
    tl_farm_plan_release(&plan);
    return status;
}

int command_farm(int argc, char **argv)
{
    farm_command command = {
        .batch = batch_command_default(), .chunk = 25, .argv = argv, .argc = argc};
    tl_error err;
    command.own = calloc((size_t)argc + 1, sizeof *command.own);
    command.kept = calloc((size_t)argc + 1, sizeof *command.kept);
    if (!command.own || !command.kept)
        return console_finish(
            tl_fail(&err, TL_ERR_MEMORY, "out of memory for %d arguments", argc), &err);
    argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &command);
    const tl_status status = run(&command, &err);
    batch_command_release(&command.batch);
    free(command.kept);
    free(command.own);
    return console_finish(status, &err);
}
