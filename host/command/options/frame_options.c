#include "frame_options.h"

#include "aov_options.h"
#include "import_options.h"
#include "layers_options.h"
#include "region_options.h"

frame_options frame_options_default(void)
{
    return (frame_options){.lighting = lighting_choice_default(),
                           .post = post_choice_default()};
}

void frame_options_release(frame_options *options)
{
    kernel_choice_release(&options->kernel);
    *options = frame_options_default();
}

static void check_together(const frame_options *options, struct argp_state *state)
{
    aov_check_together(&options->lighting, &options->pictures, state);
    const tl_precision precision = options->lighting.options.precision;
    if (options->kernel.file && precision != TL_PRECISION_FLOAT &&
        precision != TL_PRECISION_DOUBLE)
        argp_error(state, "--kernel runs on a device: with --precision float or double");
    if (options->kernel.file && options->promise.option)
        argp_error(state, "%s is kept by tilelight's own kernels: leave --kernel out",
                   options->promise.option);
    if (options->region.width > 0 && options->pictures.width > 0)
        argp_error(state,
                   "--region and --output-size exclude each other: a part is not scaled");
    promise_check_together(&options->promise, &options->lighting, &options->pictures, state);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    frame_options *options = state->input;
    (void)text;
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = &options->pictures;
        state->child_inputs[1] = &options->lighting;
        state->child_inputs[2] = &options->import;
        state->child_inputs[3] = &options->promise;
        state->child_inputs[4] = &options->lighting.options;
        state->child_inputs[5] = &options->post;
        state->child_inputs[6] = &options->lighting;
        state->child_inputs[7] = &options->kernel;
        state->child_inputs[8] = &options->region;
        return 0;
    }
    if (key == ARGP_KEY_SUCCESS)
        check_together(options, state);
    return key == ARGP_KEY_SUCCESS ? 0 : ARGP_ERR_UNKNOWN;
}

static const struct argp_child children[] = {
    {&picture_argp, 0, "Output:", 1},
    {&lighting_argp, 0, "Lighting:", 2},
    {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 3},
    {&promise_argp, 0, "What the picture keeps (docs/promise.md):", 6},
    {&layers_argp, 0, NULL, 2},
    {&post_argp, 0, "After lighting (docs/post-processing.md):", 3},
    {&aov_argp, 0, NULL, 1},
    {&kernel_argp, 0, "Kernel (docs/your-kernel.md):", 2},
    {&region_argp, 0, NULL, 1},
    {0},
};

const struct argp frame_argp = {.parser = parse, .children = children};
