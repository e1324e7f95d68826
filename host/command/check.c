/* tilelight check: holds a shading kernel against the reference, by a derived tolerance. */
#include "check_frames.h"
#include "check_report.h"
#include "commands.h"
#include "console.h"
#include "import_options.h"
#include "job_light.h"
#include "json_values.h"
#include "kernel_options.h"
#include "layers_options.h"
#include "output.h"
#include "tilelight/layouts.h"
#include "try.h"
#include "values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FRAMES = 64 };

typedef struct check_command {
    kernel_choice kernel;
    lighting_choice lighting;
    tl_import_options import;
    report_options report;
    const char *gbuffer; /* NULL: built-in frames */
    const char *diff;    /* NULL: no picture */
    int diff_kind;
    tl_cosine cosine;
    int frames[MOST_FRAMES]; /* [frame_count]; built-in ones, all where none is named */
    int frame_count;
} check_command;

enum { OPTION_GBUFFER = 256, OPTION_FRAME, OPTION_LIST, OPTION_COSINE, OPTION_DIFF };

#define WORD(name, word, meaning) [name] = word,
#define WORD_AND_MEANING(name, word, meaning) " " word ": " meaning "."
static const char *const cosine_words[] = {TL_COSINES(WORD)};
static const value_words cosines = {"form", "forms", cosine_words, TL_COSINE_COUNT};

static void add_frame(check_command *options, const char *name, struct argp_state *state)
{
    const char *names[MOST_FRAMES];
    for (int i = 0; i < tl_check_frame_count; i++)
        names[i] = tl_check_frame_name(i);
    const value_words words = {"frame", "frames", names, (size_t)tl_check_frame_count};
    const int index = (int)value_word(state, "--frame", name, &words);
    if (options->frame_count < MOST_FRAMES)
        options->frames[options->frame_count++] = index;
}

static void list_frames(void)
{
    for (int i = 0; i < tl_check_frame_count; i++)
        printf("%-14s %s\n", tl_check_frame_name(i), tl_check_frame_meaning(i));
}

static void check_usage(const check_command *options, struct argp_state *state)
{
    const tl_precision precision = options->lighting.options.precision;
    if (options->gbuffer && options->frame_count > 0)
        argp_error(state, "--gbuffer and --frame exclude each other");
    if (options->lighting.lights && !options->gbuffer)
        argp_error(state, "--lights goes with --gbuffer: built-in frames have lights of their "
                          "own");
    if (options->lighting.controls.count > 0 && !options->gbuffer)
        argp_error(state, "--light, --group and --solo go with --gbuffer: built-in frames have "
                          "lights of their own");
    if (options->import.is_given && !options->gbuffer)
        argp_error(state, "options for captures of other programs go with --gbuffer");
    if (options->kernel.file && precision != TL_PRECISION_FLOAT &&
        precision != TL_PRECISION_DOUBLE)
        argp_error(state, "--kernel runs on a device: with --precision float or double");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    check_command *options = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->kernel;
        state->child_inputs[1] = &options->lighting;
        state->child_inputs[2] = &options->import;
        state->child_inputs[3] = &options->report;
        state->child_inputs[4] = &options->lighting.options;
        return 0;
    case OPTION_GBUFFER: options->gbuffer = text; return 0;
    case OPTION_FRAME: add_frame(options, text, state); return 0;
    case OPTION_LIST: list_frames(); exit(console_finish(TL_OK, NULL));
    case OPTION_COSINE:
        options->cosine = (tl_cosine)value_word(state, "--cosine", text, &cosines);
        return 0;
    case OPTION_DIFF:
        options->diff_kind = output_kind(state, "--diff", text, OUTPUT_PNG | OUTPUT_EXR);
        options->diff = text;
        return 0;
    case ARGP_KEY_ARG: argp_error(state, "\"%s\" is an argument too many", text); return 0;
    case ARGP_KEY_SUCCESS: check_usage(options, state); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"gbuffer", OPTION_GBUFFER, "G.exr", 0,
     "Light this G-buffer, with the lights of --lights or its own, in place of built-in frames",
     0},
    {"frame", OPTION_FRAME, "NAME", 0,
     "Light this built-in frame alone; may be given several times", 0},
    {"list", OPTION_LIST, NULL, 0, "Print the built-in frames and what is in them", 0},
    {"cosine", OPTION_COSINE, "FORM", 0,
     "How the specular cosine may be taken (default stable)." TL_COSINES(WORD_AND_MEANING), 0},
    {"diff", OPTION_DIFF, "FILE", 0,
     "Error over tolerance of the frame with the worst pixel: .exr the numbers, .png grey up "
     "to 1, red to yellow beyond, white where nothing is allowed",
     0},
    {0},
};

static const struct argp_child children[] = {
    {&kernel_argp, 0, "Kernel:", 1},
    {&lighting_argp, 0, "Lighting:", 2},
    {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 3},
    {&report_argp, 0, "Reports:", 4},
    {&layers_argp, 0, NULL, 2},
    {0},
};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .doc =
        "Lights frames with a shading kernel, yours or tilelight's own, and holds every pixel "
        "against the reference in double. What float may give is derived for every pixel "
        "from the rounding of each step. Exit status 1 where a pixel is outside.",
    .children = children,
};

/* What is checked, in messages. */
static const char *name_of(const check_command *options)
{
    return options->kernel.file ? options->kernel.file : "tilelight's own kernels";
}

/* One frame being checked; released with frame_clear. */
typedef struct frame_check {
    tl_image *image, *ratios;
    tl_check *check;
} frame_check;

static void frame_clear(frame_check *f)
{
    tl_check_destroy(f->check);
    tl_image_destroy(f->ratios);
    tl_image_destroy(f->image);
    *f = (frame_check){0};
}

/* So that what a kernel does not write is not what an earlier frame left. */
static void forget_image(tl_image *image)
{
    for (size_t i = 0; i < 3 * (size_t)image->pitch * image->rows; i++)
        image->planes[i] = NAN;
}

static void note_lights(const frame_check *f, const tl_light_set *lights, check_result *result)
{
    tl_check_light found[MOST_CHECK_LIGHTS];
    const tl_check_value *worst = &result->report.worst;
    tl_check_lights(f->check, worst->x, worst->y, found, MOST_CHECK_LIGHTS,
                    &result->worst_light_count);
    for (size_t i = 0; i < result->worst_light_count && i < MOST_CHECK_LIGHTS; i++) {
        result->lights[i].light = found[i];
        memcpy(result->lights[i].name, lights->lights[found[i].source].name,
               sizeof result->lights[i].name);
    }
}

/* Lights a frame and checks it. *f keeps the picture of the ratios. */
static tl_status check_frame(tl_device *device,
                             const tl_lighting_options *options,
                             tl_cosine cosine,
                             const tl_checked_frame *frame,
                             frame_check *f,
                             check_result *result,
                             tl_error *err)
{
    const tl_camera *camera = &frame->gbuffer->camera;
    tl_lighting_options with_cutoff = *options;
    tl_lighting *lighting = NULL;
    tl_status status = TL_OK;
    with_cutoff.light_cutoff = frame->light_cutoff;
    TRY(tl_image_create(camera->width, camera->height, &f->image, err));
    TRY(tl_image_create(camera->width, camera->height, &f->ratios, err));
    TRY(tl_check_create(frame->gbuffer, &frame->lights, frame->light_cutoff, cosine, &f->check,
                        err));
    if (options->occlusion_samples)
        TRY(tl_check_occlusion(f->check, options->occlusion_samples, err));
    TRY(tl_check_allow(f->check, &options->approximations, err));
    tl_check_layers(f->check, options->layers);
    forget_image(f->image);
    TRY(tl_lighting_create(device, &with_cutoff, &lighting, err));
    TRY(tl_lighting_run(lighting, frame->gbuffer, &frame->lights, f->image, NULL,
                        &console_notices, NULL, err));
    TRY(tl_check_image(f->check, f->image, f->ratios, &result->report, err));
    result->width = camera->width;
    result->height = camera->height;
    result->light_count = frame->lights.count;
    note_lights(f, &frame->lights, result);
done:
    tl_lighting_destroy(lighting);
    return status;
}

static tl_status write_diff(const check_command *options, const tl_image *ratios, tl_error *err)
{
    tl_status status = TL_OK;
    uint8_t *rgb = NULL;
    if (!options->diff)
        goto done;
    if (options->diff_kind == OUTPUT_EXR) {
        TRY(tl_image_write_exr(options->diff, ratios, (tl_exr_form){0}, err));
        goto done;
    }
    rgb = malloc(3 * (size_t)ratios->width * ratios->height);
    if (!rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                    ratios->width, ratios->height));
    check_paint(ratios, rgb);
    TRY(tl_png_write(options->diff, rgb, ratios->width, ratios->height, TL_CURVE_SRGB, err));
done:
    free(rgb);
    return status;
}

/* What is checked is full float, whatever the file holds: a user's kernel gets nothing else, and the
 * reference is of it. */
static tl_status unpack(job *j, const char *name, tl_error *err)
{
    if (j->gbuffer->layout != TL_LAYOUT_FLOAT)
        tl_notice(&console_notices,
                  "%s is of layout %s: it is unpacked, and checked in full float", name,
                  tl_layout_word(j->gbuffer->layout));
    return job_unpack(j, err);
}

/* The frame at `position` of those that were asked for. The job's G-buffer moves into it. */
static tl_status take_frame(const check_command *options,
                            job *j,
                            int position,
                            tl_checked_frame *frame,
                            check_result *result,
                            tl_error *err)
{
    const char *name = options->gbuffer;
    tl_status status = TL_OK;
    if (options->gbuffer) {
        TRY(job_read(j, options->gbuffer, &options->import, options->lighting.strict, err));
        TRY(unpack(j, options->gbuffer, err));
        TRY(job_choose_lights(j, &options->lighting.sky, err));
        TRY(job_control_lights(j, &options->lighting, err));
        job_choose_occlusion(j, &options->lighting);
        *frame = (tl_checked_frame){.gbuffer = j->gbuffer,
                                    .lights = j->lights,
                                    .light_cutoff = options->lighting.options.light_cutoff};
        j->gbuffer = NULL;
        j->lights = (tl_light_set){0};
    } else {
        const int index = options->frame_count > 0 ? options->frames[position] : position;
        name = tl_check_frame_name(index);
        TRY(tl_check_frame_make(index, frame, err));
    }
    snprintf(result->name, sizeof result->name, "%s", name);
done:
    return status;
}

static int count_frames(const check_command *options)
{
    if (options->gbuffer)
        return 1;
    return options->frame_count > 0 ? options->frame_count : tl_check_frame_count;
}

/* results: [count_frames]. The picture of the worst frame is written as soon as all are known. */
static tl_status check_frames(const check_command *options,
                              tl_device *device,
                              job *j,
                              check_result *results,
                              tl_error *err)
{
    frame_check worst = {0};
    double worst_ratio = -1.0;
    tl_status status = TL_OK;
    for (int i = 0; i < count_frames(options); i++) {
        tl_checked_frame frame = {0};
        frame_check f = {0};
        status = take_frame(options, j, i, &frame, &results[i], err);
        console_stage(results[i].name);
        if (status == TL_OK)
            status = check_frame(device, &options->lighting.options, options->cosine, &frame,
                                 &f, &results[i], err);
        if (status == TL_OK && results[i].report.worst.ratio > worst_ratio) {
            const frame_check earlier = worst;
            worst_ratio = results[i].report.worst.ratio;
            worst = f;
            f = earlier;
        }
        frame_clear(&f);
        tl_checked_frame_clear(&frame);
        TRY(status);
    }
    TRY(write_diff(options, worst.ratios, err));
done:
    frame_clear(&worst);
    return status;
}

static tl_status run(check_command *options, job *j, tl_device **device, tl_error *err)
{
    tl_status status = TL_OK;
    check_result *results = calloc((size_t)count_frames(options), sizeof *results);
    if (!results)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the results"));
    if (options->diff)
        TRY(output_check(options->diff, options->gbuffer, err));
    TRY(kernel_choice_read(&options->kernel, &options->lighting.options.kernel, err));
    TRY(job_prepare_light(j, &options->lighting, device, err));
    TRY(check_frames(options, *device, j, results, err));
    console_stage(NULL);
    const check_summary summary = check_summarise(results, (size_t)count_frames(options));
    if (options->report.json) {
        const tl_device_info info =
            *device ? tl_device_describe(*device) : (tl_device_info){.name = "none"};
        TRY(tl_json_write(
            "-", check_json(options->kernel.file, options->kernel.entry, info.name, &summary),
            err));
    } else {
        check_print(name_of(options), &summary);
    }
    TRY(check_judge(name_of(options), &summary, err));
done:
    free(results);
    return status;
}

int command_check(int argc, char **argv)
{
    check_command options = {.lighting = lighting_choice_default()};
    tl_device *device = NULL;
    tl_error err;
    job j = {0};
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    const tl_status status = run(&options, &j, &device, &err);
    tl_device_close(device);
    kernel_choice_release(&options.kernel);
    job_release(&j);
    return console_finish(status, &err);
}
