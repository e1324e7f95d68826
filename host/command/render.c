/* tilelight render: a glTF scene to pictures, the G-buffer staying in memory. */
#include "aov_options.h"
#include "commands.h"
#include "console.h"
#include "job_capture.h"
#include "job_light.h"
#include "job_pictures.h"
#include "job_post.h"
#include "job_region.h"
#include "promise_options.h"
#include "region_options.h"
#include "tilelight/scatter.h"
#include "try.h"
#include "values.h"

typedef struct render_options {
    const char *scene;
    uint32_t scatter_count; /* 0: none */
    tl_capture_options capture;
    lighting_choice lighting;
    promise_choice promise;
    post_choice post;
    picture_options pictures;
    tl_region region; /* empty: the whole picture */
    explain_options explain;
    report_options report;
} render_options;

enum { OPTION_SCATTER = 256 };

static void check_together(const render_options *options, struct argp_state *state)
{
    if (options->scatter_count > 0 && options->lighting.lights)
        argp_error(state, "--scatter and --lights exclude each other");
    if (options->report.json && picture_on_standard_output(&options->pictures))
        argp_error(state, "-o - and --json both want standard output");
    aov_check_together(&options->lighting, &options->pictures, state);
    if (options->region.width > 0 && options->pictures.width > 0)
        argp_error(state,
                   "--region and --output-size exclude each other: a part is not scaled");
    promise_check_together(&options->promise, &options->lighting, &options->pictures, state);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"SCENE"};
    render_options *options = state->input;
    const value_arguments arguments = {names, &options->scene, 1};
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->pictures;
        state->child_inputs[1] = &options->capture;
        state->child_inputs[2] = &options->lighting;
        state->child_inputs[3] = &options->report;
        state->child_inputs[4] = &options->explain;
        state->child_inputs[5] = &options->promise;
        state->child_inputs[6] = &options->post;
        state->child_inputs[7] = &options->lighting;
        state->child_inputs[8] = &options->region;
        return 0;
    case OPTION_SCATTER:
        options->scatter_count = value_integer(state, "--scatter", text, 1, TL_MAX_SCATTERED);
        return 0;
    case ARGP_KEY_SUCCESS: check_together(options, state); return 0;
    default: return value_argument(key, text, state, &arguments);
    }
}

static const struct argp_option options_table[] = {
    {"scatter", OPTION_SCATTER, "N", 0,
     "N lights scattered over the visible surfaces in place of the scene's own: what "
     "`tilelight scatter' makes without further options",
     4},
    {0},
};

static const struct argp_child children[] = {
    {&picture_argp, 0, "Output:", 1},
    {&capture_argp, 0, "View:", 2},
    {&lighting_argp, 0, "Lighting:", 3},
    {&report_argp, 0, "Reports:", 5},
    {&explain_argp, 0, "What the frame called for:", 6},
    {&promise_argp, 0, "What the picture keeps (docs/promise.md):", 7},
    {&post_argp, 0, "After lighting (docs/post-processing.md):", 4},
    {&aov_argp, 0, NULL, 1},
    {&region_argp, 0, NULL, 1},
    {0},
};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "SCENE",
    .doc =
        "Captures a glTF scene (.gltf, .glb) and lights it with the lights of --lights, else "
        "its own, else a default rig.",
    .children = children,
};

static tl_status scatter(job *j, uint32_t count, tl_error *err)
{
    tl_status status = TL_OK;
    tl_scatter_options options = tl_scatter_options_default();
    if (count == 0)
        goto done;
    const double start = tl_seconds();
    options.count = count;
    j->lights.count = 0;
    TRY(tl_scatter(j->gbuffer, &options, &j->lights, err));
    tl_timings_end(&j->timings, "scatter", start);
done:
    return status;
}

/* context: light_controls. */
static tl_status control_lights(const void *context, tl_light_set *lights, tl_error *err)
{
    const light_controls *const controls = context;
    return tl_light_set_control(lights, controls->of, controls->count, err);
}

static tl_status run(job *j, const render_options *options, lighter *with, tl_error *err)
{
    tl_status status = TL_OK;
    tl_goal goal;
    explained told = {.asked = &options->explain};
    tl_capture_options capture = options->capture;
    TRY(picture_check(&options->pictures, options->scene, err));
    TRY(explain_check(&options->explain, options->scene, err));
    TRY(job_begin(j, &options->report, err));
    TRY(job_prepare_light(j, &options->lighting, &with->device, err));
    capture.materials |= j->lights.material_count > 0;
    if (options->scatter_count == 0) { /* else they are of the lights that are scattered */
        capture.change_lights = control_lights;
        capture.change_context = &options->lighting.controls;
    }
    TRY(job_capture(j, options->scene, &capture, options->lighting.strict, err));
    TRY(scatter(j, options->scatter_count, err));
    TRY(job_cut_region(j, &options->region, &options->lighting, &options->post, with->device,
                       err));
    TRY(job_light(j, &options->lighting,
                  promise_goal(&options->promise, &options->pictures,
                               j->has_look ? &j->look : NULL, &goal),
                  with, explain_wanted(&options->explain) ? &told : NULL, err));
    TRY(job_post(j, &options->post, &options->pictures, &options->lighting.options, with, err));
    TRY(job_crop_pictures(j, &options->region, err));
    TRY(job_show_pictures(j, &options->pictures, &options->lighting.options, with, err));
    lighter_let_go(with);
    TRY(job_write_pictures(j, &options->pictures, err));
    TRY(explain_tell(j, &options->explain, &told, err));
    if (options->explain.text && !j->report)
        job_post_explain(j, &options->post, &options->lighting.options);
    TRY(job_finish(j, &options->report, err));
done:
    explained_clear(&told);
    return status;
}

int command_render(int argc, char **argv)
{
    render_options options = {.lighting = lighting_choice_default(),
                              .post = post_choice_default()};
    lighter with = {0};
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&j, &options, &with, &err);
    lighter_close(&with);
    job_release(&j);
    return console_finish(status, &err);
}
