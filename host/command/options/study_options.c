#define _GNU_SOURCE /* asprintf */
#include "study_options.h"

#include "console.h"
#include "import_options.h"
#include "values.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    OPTION_QUICK = 256,
    OPTION_KNOB,
    OPTION_LIST,
    OPTION_CLAIMS,
    OPTION_ANEW,
    OPTION_PAGE,
    OPTION_AGAIN,
    OPTION_SECONDS,
    OPTION_LIGHTS,
    OPTION_SIZE,
    OPTION_CAMERA,
    OPTION_DEVICE
};

/* NAME=LIST. */
static void take_knob(study_command *options, const char *text, struct argp_state *state)
{
    const char *names[TL_STUDY_KNOB_COUNT], *equals = strchr(text, '=');
    const value_words words = {"knob", "knobs", names, TL_STUDY_KNOB_COUNT};
    char name[TL_BENCH_WORD_SIZE];
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++)
        names[i] = tl_study_knobs[i].name;
    if (!equals)
        argp_error(state, "--knob: \"%s\" is no NAME=WORD,...", text);
    snprintf(name, sizeof name, "%.*s", (int)(equals - text), text);
    const unsigned knob = value_word(state, "--knob", name, &words);
    free(options->words[knob]);
    options->words[knob] = strdup(equals + 1);
    options->lists.of[knob] = options->words[knob];
    options->knobs_given = true;
}

static void check_together(const study_command *options, struct argp_state *state)
{
    if (!options->folder && !options->list)
        argp_error(state, "-o DIR is missing: the folder for what is measured");
    if (options->anew && options->again)
        argp_error(state, "--anew forgets what --again is to measure a second time: give one");
    if (options->claims && options->again)
        argp_error(state, "--claims are not measured a second time: leave them out of --again");
    if (options->page && (options->scene_count > 0 || options->knobs_given || options->again ||
                          options->anew || options->claims))
        argp_error(state, "--page measures nothing: it goes with -o DIR alone");
    if (options->camera && options->scene_count == 0)
        argp_error(state, "--camera is for scenes");
    if (options->lights && options->scene_count == 0)
        argp_error(state,
                   "--lights goes with a scene or a capture: built-in frames have lights "
                   "of their own");
    if (options->import.is_given && options->scene_count == 0)
        argp_error(state, "options for captures of other programs go with a capture");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    study_command *options = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &options->import; return 0;
    case 'o': options->folder = text; return 0;
    case 'q':
        options->quiet = true;
        console_quiet(true);
        return 0;
    case OPTION_QUICK: options->quick = true; return 0;
    case OPTION_KNOB: take_knob(options, text, state); return 0;
    case OPTION_LIST: options->list = true; return 0;
    case OPTION_CLAIMS: options->claims = true; return 0;
    case OPTION_ANEW: options->anew = true; return 0;
    case OPTION_PAGE: options->page = true; return 0;
    case OPTION_AGAIN: options->again = true; return 0;
    case OPTION_SECONDS:
        options->seconds = value_number(state, "--seconds", text, 0.001, 3600.0);
        return 0;
    case OPTION_LIGHTS: options->lights = text; return 0;
    case OPTION_SIZE:
        value_size(state, "--size", text, &options->width, &options->height);
        return 0;
    case OPTION_CAMERA: options->camera = text; return 0;
    case OPTION_DEVICE: options->device = text; return 0;
    case ARGP_KEY_ARG:
        if (options->scene_count == MOST_SCENES)
            argp_error(state, "more than %d scenes and captures", MOST_SCENES);
        options->scenes[options->scene_count++] = text;
        return 0;
    case ARGP_KEY_SUCCESS: check_together(options, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {NULL, 'o', "DIR", 0,
     "Folder for what is measured, made if it is not there: study.html, study.json, study.csv, "
     "maps/. What it holds of the same machine, frame and options is not measured again",
     1},
    {"quick", OPTION_QUICK, NULL, 0,
     "Fewer configurations, fewer pixels unless --size says how many, one built-in frame, and "
     "half the time for each: less than 2 minutes on 2 cores",
     1},
    {"knob", OPTION_KNOB, "NAME=WORD,...", 0,
     "Measure these words, and their combinations where several knobs are given, in place of "
     "the usual plan; the default configuration is always measured. `tilelight study --list' "
     "describes knobs and words; all stands for every word",
     1},
    {"seconds", OPTION_SECONDS, "S", 0,
     "How long the lighting of each configuration is timed, and each kind of file (default 1, "
     "with --quick 0.5); 22 frames at least",
     1},
    {"claims", OPTION_CLAIMS, NULL, 0,
     "Measure too what the documents claim that layouts and formulas come from, on frames of "
     "its "
     "own, and tell theirs beside ours",
     1},
    {"anew", OPTION_ANEW, NULL, 0, "Measure all anew, and forget what DIR holds", 1},
    {"again", OPTION_AGAIN, NULL, 0,
     "Take the times of what DIR holds once more, and say which come out inside the intervals "
     "that the first run states; others are marked unstable. To be given with the options of "
     "the first run",
     1},
    {"list", OPTION_LIST, NULL, 0,
     "Describe knobs, causes and built-in frames; measure nothing", 1},
    {"page", OPTION_PAGE, NULL, 0,
     "Make study.html of the study.json that DIR holds, of whichever machine, complete or "
     "interrupted; measure nothing",
     1},
    {"quiet", 'q', NULL, 0, "No table and no progress; errors are still said", 1},
    {"size", OPTION_SIZE, "WIDTHxHEIGHT", 0,
     "Pixels of scenes and built-in frames (default 960x540, with --quick 640x360); captures "
     "have theirs",
     2},
    {"camera", OPTION_CAMERA, "NAME|INDEX", 0,
     "A camera of the scenes (default: the first of each, else a view of all of it)", 2},
    {"lights", OPTION_LIGHTS, "FILE", 0,
     "Lights from a JSON file in place of the scenes' and captures' own", 2},
    {"device", OPTION_DEVICE, "INDEX|NAME|cpu|gpu", 0,
     "The OpenCL device; `tilelight devices' lists them (default: PoCL, else any CPU, else "
     "any)",
     2},
    {0},
};

static const char before[] =
    "Measures what accuracy costs in time: lights frames by many configurations, each with one "
    "knob or some off its usual word, by turns with the default configuration, and holds every "
    "picture against a reference in double from full float. Without a scene (.gltf, .glb) or a "
    "capture, frames of its own.";

/* After a vertical tab, argp prints it behind the options. */
static const char after[] =
    "\v"
    "Of each configuration it tells the time of every stage with its interval and as a ratio "
    "to the default's, bytes stored and moved, and the error: RMS, mean, 99.9 % and largest "
    "relative to the mean radiance, PSNR, FLIP, the worst pixel; and which part of it comes "
    "from storage, arithmetic, approximation, culling (nothing, or it is a fault) and output. "
    "A time is the median of 11 blocks, stated with the least and the largest of them: between "
    "these another run's lies in 98.8 of 100, and --again sees whether it does. What drifts "
    "while it is measured is marked unstable. The table at the end has the configurations that "
    "none beats in time and error; study.html shows all of them, and needs neither another "
    "file nor a network.\n\n"
    "Blocks lie apart: the first round measures errors, files and a block of lighting of every "
    "configuration, ten further rounds a block each. Ctrl-C ends it after the configuration "
    "that "
    "it is at; the same command goes on from there.";

void study_parse(int argc, char **argv, study_command *options)
{
    static const struct argp_child children[] = {
        {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 3}, {0}};
    char *doc = NULL;
    if (asprintf(&doc, "%s%s", before, after) < 0)
        doc = NULL;
    const struct argp argp = {.options = options_table,
                              .parser = parse,
                              .args_doc = "[SCENE|G.exr ...]",
                              .doc = doc,
                              .children = children};
    argp_parse(&argp, argc, argv, 0, NULL, options);
    free(doc);
}

void study_command_release(study_command *options)
{
    for (int i = 0; i < TL_STUDY_KNOB_COUNT; i++)
        free(options->words[i]);
    *options = (study_command){0};
}
