/* tilelight light: one G-buffer file to pictures. */
#include "commands.h"
#include "console.h"
#include "frame_steps.h"
#include "import_options.h"
#include "job_light.h"
#include "job_pictures.h"
#include "job_post.h"
#include "try.h"
#include "values.h"

typedef struct light_options {
    const char *gbuffer;
    frame_options frame;
    explain_options explain;
    report_options report;
} light_options;

static void check_together(const light_options *options, struct argp_state *state)
{
    if (options->report.json && picture_on_standard_output(&options->frame.pictures))
        argp_error(state, "-o - and --json both want standard output");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"G.exr"};
    light_options *options = state->input;
    const value_arguments arguments = {names, &options->gbuffer, 1};
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = &options->frame;
        state->child_inputs[1] = &options->report;
        state->child_inputs[2] = &options->explain;
        return 0;
    }
    if (key == ARGP_KEY_SUCCESS)
        check_together(options, state);
    return import_argument(key, text, state, &arguments, &options->frame.import);
}

static const struct argp_child children[] = {
    {&frame_argp, 0, NULL, 0},
    {&report_argp, 0, "Reports:", 4},
    {&explain_argp, 0, "What the frame called for:", 5},
    {0},
};

static const struct argp argp = {
    .parser = parse,
    .args_doc = "[G.exr]",
    .doc = "Lights a captured G-buffer, of tilelight or of another program, with the lights of "
           "--lights, else those inside the file, else a default rig.",
    .children = children,
};

static tl_status run(job *j, light_options *options, lighter *with, tl_error *err)
{
    frame_options *frame = &options->frame;
    tl_status status = TL_OK;
    explained told = {.asked = &options->explain};
    TRY(picture_check(&frame->pictures, options->gbuffer, err));
    TRY(explain_check(&options->explain, options->gbuffer, err));
    TRY(kernel_choice_read(&frame->kernel, &frame->lighting.options.kernel, err));
    TRY(job_begin(j, &options->report, err));
    TRY(job_prepare_light(j, &frame->lighting, &with->device, err));
    TRY(frame_read(j, frame, options->gbuffer, with, err));
    TRY(frame_light(j, frame, with, explain_wanted(&options->explain) ? &told : NULL, err));
    TRY(job_write_pictures(j, &frame->pictures, err));
    TRY(explain_tell(j, &options->explain, &told, err));
    if (options->explain.text && !j->report)
        job_post_explain(j, &frame->post, &frame->lighting.options);
    TRY(job_finish(j, &options->report, err));
done:
    explained_clear(&told);
    return status;
}

int command_light(int argc, char **argv)
{
    light_options options = {.frame = frame_options_default()};
    lighter with = {0};
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&j, &options, &with, &err);
    lighter_close(&with);
    frame_options_release(&options.frame);
    job_release(&j);
    return console_finish(status, &err);
}
