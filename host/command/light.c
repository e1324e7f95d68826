/* tilelight light: one G-buffer file to pictures. */
#include "aov_options.h"
#include "commands.h"
#include "console.h"
#include "import_options.h"
#include "job_light.h"
#include "job_pictures.h"
#include "job_post.h"
#include "job_region.h"
#include "kernel_options.h"
#include "layers_options.h"
#include "promise_options.h"
#include "region_options.h"
#include "try.h"
#include "values.h"

typedef struct light_options {
    const char *gbuffer;
    lighting_choice lighting;
    promise_choice promise;
    post_choice post;
    kernel_choice kernel;
    tl_import_options import;
    picture_options pictures;
    tl_region region; /* empty: the whole picture */
    explain_options explain;
    report_options report;
} light_options;

static void check_together(const light_options *options, struct argp_state *state)
{
    if (options->report.json && picture_on_standard_output(&options->pictures))
        argp_error(state, "-o - and --json both want standard output");
    aov_check_together(&options->lighting, &options->pictures, state);
    const tl_precision precision = options->lighting.options.precision;
    if (options->kernel.file && precision != TL_PRECISION_FLOAT &&
        precision != TL_PRECISION_DOUBLE)
        argp_error(state, "--kernel runs on a device: with --precision float or double");
    if (options->kernel.file && options->promise.option)
        argp_error(state, "%s is kept by tilelight's own kernels: leave --kernel out",
                   options->promise.option);
    if (options->region.width > 0 && options->pictures.width > 0)
        argp_error(state, "--region and --output-size exclude each other: a part is not scaled");
    promise_check_together(&options->promise, &options->lighting, &options->pictures, state);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"G.exr"};
    light_options *options = state->input;
    const value_arguments arguments = {names, &options->gbuffer, 1};
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = &options->pictures;
        state->child_inputs[1] = &options->lighting;
        state->child_inputs[2] = &options->import;
        state->child_inputs[3] = &options->report;
        state->child_inputs[4] = &options->explain;
        state->child_inputs[5] = &options->promise;
        state->child_inputs[6] = &options->lighting.options;
        state->child_inputs[7] = &options->post;
        state->child_inputs[8] = &options->lighting;
        state->child_inputs[9] = &options->kernel;
        state->child_inputs[10] = &options->region;
        return 0;
    }
    if (key == ARGP_KEY_SUCCESS)
        check_together(options, state);
    return import_argument(key, text, state, &arguments, &options->import);
}

static const struct argp_child children[] = {
    {&picture_argp, 0, "Output:", 1},
    {&lighting_argp, 0, "Lighting:", 2},
    {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 3},
    {&report_argp, 0, "Reports:", 4},
    {&explain_argp, 0, "What the frame called for:", 5},
    {&promise_argp, 0, "What the picture keeps (docs/promise.md):", 6},
    {&layers_argp, 0, NULL, 2},
    {&post_argp, 0, "After lighting (docs/post-processing.md):", 3},
    {&aov_argp, 0, NULL, 1},
    {&kernel_argp, 0, "Kernel (docs/your-kernel.md):", 2},
    {&region_argp, 0, NULL, 1},
    {0},
};

static const struct argp argp = {
    .parser = parse,
    .args_doc = "[G.exr]",
    .doc = "Lights a captured G-buffer, of tilelight or of another program, with the lights of "
           "--lights, else those inside the file, else a default rig.",
    .children = children,
};

static tl_status run(job *j, light_options *options, tl_device **device, tl_error *err)
{
    tl_status status = TL_OK;
    tl_goal goal;
    explained told = {.asked = &options->explain};
    TRY(picture_check(&options->pictures, options->gbuffer, err));
    TRY(explain_check(&options->explain, options->gbuffer, err));
    TRY(kernel_choice_read(&options->kernel, &options->lighting.options.kernel, err));
    TRY(job_begin(j, &options->report, err));
    TRY(job_prepare_light(j, &options->lighting, device, err));
    TRY(job_read(j, options->gbuffer, &options->import, options->lighting.strict, err));
    TRY(job_cut_region(j, &options->region, &options->lighting, &options->post, *device, err));
    TRY(job_light(j, &options->lighting,
                  promise_goal(&options->promise, &options->pictures,
                               j->has_look ? &j->look : NULL, &goal),
                  *device, explain_wanted(&options->explain) ? &told : NULL, err));
    TRY(job_post(j, &options->post, &options->pictures, &options->lighting.options, *device,
                 err));
    TRY(job_crop_pictures(j, &options->region, err));
    TRY(job_write_pictures(j, &options->pictures, &options->lighting.options, *device, err));
    TRY(explain_tell(j, &options->explain, &told, err));
    if (options->explain.text && !j->report)
        job_post_explain(j, &options->post, &options->lighting.options);
    TRY(job_finish(j, &options->report, err));
done:
    explained_clear(&told);
    return status;
}

int command_light(int argc, char **argv)
{
    light_options options = {.lighting = lighting_choice_default(),
                             .post = post_choice_default()};
    tl_device *device = NULL;
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&j, &options, &device, &err);
    tl_device_close(device);
    kernel_choice_release(&options.kernel);
    job_release(&j);
    return console_finish(status, &err);
}
