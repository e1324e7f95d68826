/* tilelight scatter: lights on the visible surfaces of a G-buffer. */
#include "tilelight/scatter.h"

#include "commands.h"
#include "console.h"
#include "import_options.h"
#include "job.h"
#include "light_words.h"
#include "output.h"
#include "try.h"
#include "values.h"

#include <string.h>

typedef struct scatter_command {
    const char *gbuffer, *output;
    tl_scatter_options scatter;
    tl_import_options import;
    report_options report;
} scatter_command;

enum {
    OPTION_COUNT = 256,
    OPTION_SEED,
    OPTION_OVERLAP,
    OPTION_RANGE,
    OPTION_FALLOFF,
    OPTION_INTENSITY
};

static const value_words falloffs = {"falloff", "falloffs", tl_falloff_words,
                                     TL_FALLOFF_TABLE}; /* which would need a table */

static void check_together(const scatter_command *options, struct argp_state *state)
{
    if (!options->output)
        argp_error(state, "-o is missing: where the lights go");
    if (strcmp(options->output, "-") == 0 && options->report.json)
        argp_error(state, "-o - and --json both want standard output");
}

static error_t parse_common(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"G.exr"};
    scatter_command *options = state->input;
    const value_arguments arguments = {names, &options->gbuffer, 1};
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->import;
        state->child_inputs[1] = &options->report;
        return 0;
    case 'o':
        output_kind(state, "-o", text, OUTPUT_JSON | OUTPUT_STANDARD);
        options->output = text;
        return 0;
    case ARGP_KEY_SUCCESS: check_together(options, state); return 0;
    default: return import_argument(key, text, state, &arguments, &options->import);
    }
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    tl_scatter_options *options = &((scatter_command *)state->input)->scatter;
    switch (key) {
    case OPTION_COUNT:
        options->count = value_integer(state, "--count", text, 1, TL_MAX_SCATTERED);
        return 0;
    case OPTION_SEED:
        options->seed = value_integer(state, "--seed", text, 0, UINT32_MAX);
        return 0;
    case OPTION_OVERLAP:
        options->overlap = (float)value_number(state, "--overlap", text, 0.001, 1e6);
        return 0;
    case OPTION_RANGE:
        options->range = (float)value_number(state, "--range", text, 1e-6, 1e12);
        return 0;
    case OPTION_FALLOFF:
        options->falloff = (tl_falloff)value_word(state, "--falloff", text, &falloffs);
        return 0;
    case OPTION_INTENSITY:
        options->intensity = (float)value_number(state, "--intensity", text, 1e-12, 1e12);
        return 0;
    default: return parse_common(key, text, state);
    }
}

static const struct argp_option options_table[] = {
    {"output", 'o', "L.json", 0, "The lights file (- is standard output)", 0},
    {"count", OPTION_COUNT, "N", 0, "How many, 1 to 1000000 (default 1024)", 0},
    {"seed", OPTION_SEED, "S", 0, "Another seed, other places (default 1)", 0},
    {"overlap", OPTION_OVERLAP, "X", 0,
     "How many lights reach a visible pixel on average; sets the range (default 12)", 0},
    {"range", OPTION_RANGE, "METRES", 0, "Of each light, in place of --overlap", 0},
    {"falloff", OPTION_FALLOFF, "NAME", 0, "inverse-square or linear (default linear)", 0},
    {"intensity", OPTION_INTENSITY, "CANDELA", 0,
     "Of each light (default: what adds up to a well-lit picture)", 0},
    {0},
};

static const struct argp_child children[] = {
    {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 1},
    {&report_argp, 0, "Reports:", 2},
    {0},
};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "[G.exr]",
    .doc = "Scatters coloured point lights over the visible surfaces of a G-buffer: the same "
           "ones for the same seed on every machine.",
    .children = children,
};

static tl_status run(job *j, const scatter_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(output_check(options->output, options->gbuffer, err));
    TRY(job_begin(j, &options->report, err));
    TRY(job_read(j, options->gbuffer, &options->import, false, err));
    j->lights.count = 0; /* ambient light and sky of the file stay */

    double clock = tl_seconds();
    TRY(tl_scatter(j->gbuffer, &options->scatter, &j->lights, err));
    clock = tl_timings_end(&j->timings, "scatter", clock);
    TRY(tl_lights_write(options->output, &j->lights, err));
    tl_timings_end(&j->timings, "write", clock);

    const tl_light *first = &j->lights.lights[0];
    job_report(j, "output", json_string(options->output));
    job_report(j, "light_count", json_integer((json_int_t)j->lights.count));
    job_report(j, "range", json_real((double)first->range));
    job_report(j, "intensity", json_real((double)first->intensity));
    TRY(job_finish(j, &options->report, err));
done:
    return status;
}

int command_scatter(int argc, char **argv)
{
    scatter_command options = {.scatter = tl_scatter_options_default()};
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&j, &options, &err);
    job_release(&j);
    return console_finish(status, &err);
}
