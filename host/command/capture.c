/* tilelight capture: a glTF scene to a G-buffer file. */
#include "commands.h"
#include "console.h"
#include "job_capture.h"
#include "output.h"
#include "strict_options.h"
#include "tilelight/gbuffer_file.h"
#include "try.h"
#include "values.h"

#include <string.h>

typedef struct capture_command {
    const char *scene, *output, *lights, *lights_out;
    tl_capture_options capture;
    bool strict;
    report_options report;
} capture_command;

enum { OPTION_LIGHTS_OUT = 256, OPTION_LIGHTS };

static void check_together(const capture_command *options, struct argp_state *state)
{
    if (!options->output)
        argp_error(state, "-o is missing: where the G-buffer goes");
    if (options->lights_out && strcmp(options->lights_out, "-") == 0 && options->report.json)
        argp_error(state, "--lights-out - and --json both want standard output");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"SCENE"};
    capture_command *options = state->input;
    const value_arguments arguments = {names, &options->scene, 1};
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->capture;
        state->child_inputs[1] = &options->strict;
        state->child_inputs[2] = &options->report;
        return 0;
    case 'o':
        output_kind(state, "-o", text, OUTPUT_EXR);
        options->output = text;
        return 0;
    case OPTION_LIGHTS: options->lights = text; return 0;
    case OPTION_LIGHTS_OUT:
        output_kind(state, "--lights-out", text, OUTPUT_JSON | OUTPUT_STANDARD);
        options->lights_out = text;
        return 0;
    case ARGP_KEY_SUCCESS: check_together(options, state); return 0;
    default: return value_argument(key, text, state, &arguments);
    }
}

static const struct argp_option options_table[] = {
    {"output", 'o', "G.exr", 0, "The G-buffer; the scene's lights stand inside it too", 1},
    {"lights", OPTION_LIGHTS, "L.json", 0,
     "Lights from a file (- is standard input) in place of the scene's own: they go along, and "
     "those that cast shadows get maps",
     1},
    {"lights-out", OPTION_LIGHTS_OUT, "L.json", 0,
     "The scene's lights as a lights file (- is standard output)", 1},
    {0},
};

static const struct argp_child children[] = {
    {&capture_argp, 0, "View:", 2},
    {&strict_argp, 0, NULL, 3},
    {&report_argp, 0, "Reports:", 4},
    {0},
};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "SCENE",
    .doc = "Renders the geometry of a glTF scene (.gltf, .glb) into a G-buffer.",
    .children = children,
};

static tl_status write_files(job *j, const capture_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    const double start = tl_seconds();
    console_stage("writing");
    if (options->lights_out)
        TRY(tl_lights_write(options->lights_out, &j->lights, err));
    TRY(tl_gbuffer_write(options->output, j->gbuffer, job_has_lights(j) ? &j->lights : NULL,
                         err));
    tl_timings_end(&j->timings, "write", start);
    job_report(j, "output", json_string(options->output));
    job_report(j, "light_count", json_integer((json_int_t)j->lights.count));
done:
    return status;
}

static tl_status run(job *j, const capture_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(output_check(options->output, options->scene, err));
    if (options->lights_out)
        TRY(output_check(options->lights_out, options->scene, err));
    TRY(job_begin(j, &options->report, err));
    TRY(job_read_lights(j, options->lights, err));
    TRY(job_capture(j, options->scene, &options->capture, options->strict, err));
    TRY(write_files(j, options, err));
    TRY(job_finish(j, &options->report, err));
done:
    return status;
}

int command_capture(int argc, char **argv)
{
    capture_command options = {0};
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&j, &options, &err);
    job_release(&j);
    return console_finish(status, &err);
}
