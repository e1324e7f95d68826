#include "batch_options.h"

#include "batch_item.h"
#include "output.h"
#include "try.h"
#include "values.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    OPTION_FRAMES = 256,
    OPTION_MANIFEST,
    OPTION_SHARD,
    OPTION_FORCE,
    OPTION_DRY_RUN,
    OPTION_IN_FLIGHT,
    OPTION_PROGRESS
};

#define WORD(name, word, meaning) [name] = word,
#define WORD_AND_MEANING(name, word, meaning) " " word ": " meaning "."
static const char *const progress_words[] = {TL_BATCH_PROGRESSES(WORD)};
static const value_words progresses = {"way", "ways", progress_words, BATCH_PROGRESS_COUNT};

static void check_together(const batch_command *command, struct argp_state *state)
{
    const picture_options *pictures = &command->batch.frame.pictures;
    for (int i = 0; i < pictures->count; i++)
        if (!(pictures->kinds[i] & (OUTPUT_PNG | OUTPUT_EXR)))
            argp_error(state,
                       "-o: outputs of a batch end in .exr or .png, which hold what they were "
                       "made from");
    if (command->report.json && command->batch.progress == BATCH_PROGRESS_OPENJD)
        argp_error(state, "--json and --progress openjd both want standard output");
    if (command->input_count == 0 && !command->batch.request.manifest)
        argp_error(state, "inputs are missing: captures, or a pattern such as g.####.exr");
}

/* "I/N". */
static void parse_shard(const char *text, tl_batch_request *request, struct argp_state *state)
{
    char end = '\0';
    unsigned shard = 0, count = 0;
    if (sscanf(text, "%u/%u%c", &shard, &count, &end) != 2 || shard < 1 || shard > count)
        argp_error(state, "--shard: \"%s\" is no shard; write I/N, the I-th of N, from 1",
                   text);
    request->shard = shard;
    request->shard_count = count;
}

static void add_input(batch_command *command, const char *text, struct argp_state *state)
{
    const char **more =
        realloc(command->inputs, (command->input_count + 1) * sizeof *command->inputs);
    if (!more) {
        argp_failure(state, tl_exit_status(TL_ERR_MEMORY), 0, "out of memory for inputs");
        return;
    }
    command->inputs = more;
    command->inputs[command->input_count++] = text;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    batch_command *command = state->input;
    batch_options *options = &command->batch;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->frame;
        state->child_inputs[1] = &command->report;
        return 0;
    case ARGP_KEY_ARG: add_input(command, text, state); return 0;
    case ARGP_KEY_SUCCESS: check_together(command, state); return 0;
    case OPTION_FRAMES: options->request.frames = text; return 0;
    case OPTION_MANIFEST:
        options->request.manifest = text;
        options->frame.pictures.named_elsewhere = true;
        return 0;
    case OPTION_SHARD: parse_shard(text, &options->request, state); return 0;
    case OPTION_FORCE: options->force = true; return 0;
    case OPTION_DRY_RUN: options->dry_run = true; return 0;
    case OPTION_IN_FLIGHT:
        options->in_flight = value_integer(state, "--in-flight", text, 1, BATCH_MOST_WORKERS);
        return 0;
    case OPTION_PROGRESS:
        options->progress =
            (batch_progress_kind)value_word(state, "--progress", text, &progresses);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"frames", OPTION_FRAMES, "SET", 0,
     "Which numbers stand for the #### of the inputs: 1-100, 1-100x5, 3,5-10, -10-100 "
     "(default: "
     "those of the files that are there)",
     1},
    {"manifest", OPTION_MANIFEST, "FILE", 0,
     "Frames from a JSON file, or one of a JSON object a line, with input, outputs and lights "
     "of "
     "each (- is standard input)",
     1},
    {"shard", OPTION_SHARD, "I/N", 0, "Every Nth frame alone, from the I-th on", 1},
    {"force", OPTION_FORCE, NULL, 0, "Light frames that are up to date, too", 1},
    {"dry-run", OPTION_DRY_RUN, NULL, 0,
     "Say of each frame what would be done, and why, and do nothing", 1},
    {"in-flight", OPTION_IN_FLIGHT, "N", 0,
     "Frames under way at a time, 1 to 64: memory grows with it (default: one more than there "
     "are processors)",
     1},
    {"progress", OPTION_PROGRESS, "HOW", 0,
     "How progress is told (default auto)." TL_BATCH_PROGRESSES(WORD_AND_MEANING), 1},
    {0},
};

static const struct argp_child children[] = {
    {&frame_argp, 0, NULL, 0},
    {&report_argp, 0, "Reports:", 4},
    {0},
};

const struct argp batch_argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "IN...",
    .doc = "Lights many captures, as `tilelight light' does each: those of a pattern such as "
           "g.####.exr, of a glob, or several files. What is up to date is left as it is, so "
           "that a run that was stopped goes on where it was; a frame that fails is told and "
           "skipped (docs/batch.md).",
    .children = children,
};

/* What a batch cannot take twice, or would not find again. */
static tl_status check_files(const frame_options *frame, tl_error *err)
{
    if (frame->lighting.lights && strcmp(frame->lighting.lights, "-") == 0)
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "--lights -: outputs say which lights they were made by, so a batch takes "
            "them from a file");
    return TL_OK;
}

tl_status batch_list_items(const batch_command *command, tl_item_list *items, tl_error *err)
{
    tl_batch_request request = command->batch.request;
    tl_status status = TL_OK;
    TRY(check_files(&command->batch.frame, err));
    request.inputs = command->inputs;
    request.input_count = command->input_count;
    request.outputs = command->batch.frame.pictures.paths;
    request.output_count = (size_t)command->batch.frame.pictures.count;
    request.lights = command->batch.frame.lighting.lights;
    TRY(tl_items_list(&request, items, err));
    TRY(batch_items_check(items, err));
done:
    return status;
}

batch_command batch_command_default(void)
{
    return (batch_command){.batch.frame = frame_options_default()};
}

void batch_command_release(batch_command *command)
{
    frame_options_release(&command->batch.frame);
    free(command->inputs);
}
