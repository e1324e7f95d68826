/* tilelight compare: how far two pictures are apart. */
#include "tilelight/compare.h"

#include "commands.h"
#include "compare_flip.h"
#include "console.h"
#include "json_values.h"
#include "report_options.h"
#include "try.h"
#include "values.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* Those before METRIC_FLIP are differences of values, absolute and of the mean. */
typedef enum metric {
    METRIC_MAX,
    METRIC_MEAN,
    METRIC_RMS,
    METRIC_P999,
    METRIC_FLIP,
    METRIC_COUNT
} metric;

static const char *const metric_names[METRIC_COUNT] = {"max", "mean", "rms", "p999", "flip"};
static const value_words metrics = {"metric", "metrics", metric_names, METRIC_COUNT};
static const char channel_names[] = "RGB";

typedef struct compare_command {
    const char *pictures[2];
    double tolerance; /* of the metric, relative but for FLIP; INFINITY: none */
    metric metric;
    flip_options flip;
    report_options report;
} compare_command;

enum { OPTION_TOLERANCE = 256, OPTION_METRIC };

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"A", "B"};
    compare_command *options = state->input;
    const value_arguments arguments = {names, options->pictures, 2};
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->flip;
        state->child_inputs[1] = &options->report;
        return 0;
    case OPTION_TOLERANCE:
        options->tolerance = value_number(state, "--tolerance", text, 0.0, 1e30);
        return 0;
    case OPTION_METRIC:
        options->metric = (metric)value_word(state, "--metric", text, &metrics);
        return 0;
    default: return value_argument(key, text, state, &arguments);
    }
}

static const struct argp_option options_table[] = {
    {"tolerance", OPTION_TOLERANCE, "T", 0,
     "Exit with status 1 where the metric, divided by B's mean, is above T; of flip, where its "
     "mean is",
     0},
    {"metric", OPTION_METRIC, "NAME", 0,
     "What --tolerance is held against (default max)."
     " max: the largest difference of a channel."
     " mean: the mean difference."
     " rms: the root of the mean square."
     " p999: what 99.9 % of the differences do not exceed."
     " flip: how visible they are, 0 to 1, as --flip says.",
     0},
    {0},
};

static const struct argp_child children[] = {
    {&flip_argp, 0, NULL, 0}, {&json_argp, 0, NULL, 0}, {0}};

static const struct argp argp = {
    .options = options_table,
    .parser = parse,
    .args_doc = "A B",
    .doc =
        "Compares two pictures of one size, channel by channel: OpenEXR files by their R, G, "
        "B; PFMs; PNGs by their stored values, from 0 to 1.",
    .children = children,
};

/* Of each metric: absolute and relative. */
typedef struct figure {
    double absolute, relative;
} figure;

static figure figure_of(const tl_difference *d, metric which)
{
    const figure figures[METRIC_FLIP] = {
        [METRIC_MAX] = {d->max, d->relative_max},
        [METRIC_MEAN] = {d->mean, d->relative_mean},
        [METRIC_RMS] = {d->rms, d->relative_rms},
        [METRIC_P999] = {d->p999, d->relative_p999},
    };
    return figures[which];
}

static void print_text(const tl_difference *d, uint64_t count)
{
    printf("%-12s %14s %14s\n", "", "absolute", "of B's mean");
    for (metric m = 0; m < METRIC_FLIP; m++)
        printf("%-12s %14.6g %14.6g\n", metric_names[m], figure_of(d, m).absolute,
               figure_of(d, m).relative);
    printf("%-12s %14.6g\n", "B's mean", d->mean_value);
    printf("%-12s %14.6g dB\n", "PSNR", d->psnr);
    printf("%-12s %14" PRIu64 " of %" PRIu64 " values\n", "differing", d->different_count,
           count);
    printf("%-12s %14" PRIu64 " values\n", "not finite", d->not_finite_count);
    if (d->max > 0.0)
        printf("%-12s (%u, %u) %c: %.9g and %.9g\n", "worst pixel", d->worst_x, d->worst_y,
               channel_names[d->worst_channel], (double)d->worst_a, (double)d->worst_b);
}

static json_t *report_json(const tl_difference *d, uint64_t count)
{
    const char channel[2] = {channel_names[d->worst_channel], '\0'};
    json_t *report = json_object();
    for (metric m = 0; m < METRIC_FLIP; m++)
        json_object_set_new(report, metric_names[m],
                            json_pack("{so so}", "absolute",
                                      tl_json_number(figure_of(d, m).absolute), "relative",
                                      tl_json_number(figure_of(d, m).relative)));
    json_object_set_new(report, "mean_of_b", tl_json_number(d->mean_value));
    json_object_set_new(report, "psnr_db", tl_json_number(d->psnr));
    json_object_set_new(report, "differing", json_integer((json_int_t)d->different_count));
    json_object_set_new(report, "not_finite", json_integer((json_int_t)d->not_finite_count));
    json_object_set_new(report, "values", json_integer((json_int_t)count));
    json_object_set_new(report, "worst",
                        json_pack("{s[ii] ss so so}", "pixel", (int)d->worst_x, (int)d->worst_y,
                                  "channel", channel, "a", tl_json_number((double)d->worst_a),
                                  "b", tl_json_number((double)d->worst_b)));
    return report;
}

static tl_status judge(const compare_command *options,
                       const tl_difference *d,
                       const tl_flip *flip,
                       tl_error *err)
{
    if (options->metric == METRIC_FLIP)
        return flip_judge(flip, options->tolerance, options->pictures, err);
    const double relative = figure_of(d, options->metric).relative;
    if (relative <= options->tolerance)
        return TL_OK;
    return tl_fail(err, TL_ERR_DIFFERENT,
                   "%s and %s: %s difference is %.6g of B's mean, above the tolerance of %.6g; "
                   "the worst is at pixel (%u, %u), channel %c",
                   options->pictures[0], options->pictures[1], metric_names[options->metric],
                   relative, options->tolerance, d->worst_x, d->worst_y,
                   channel_names[d->worst_channel]);
}

/* flip: NULL where it was not asked for. */
static tl_status print_report(const compare_command *options,
                              const tl_difference *d,
                              const tl_flip *flip,
                              uint64_t count,
                              tl_error *err)
{
    if (!options->report.json) {
        print_text(d, count);
        if (flip)
            flip_print(flip);
        return TL_OK;
    }
    json_t *report = report_json(d, count);
    if (flip)
        json_object_set_new(report, "flip", flip_json(flip));
    return tl_json_write("-", report, err);
}

static tl_status run(const compare_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *images[2] = {NULL, NULL};
    int is_png[2] = {0, 0};
    const bool with_flip = flip_is_asked(&options->flip) || options->metric == METRIC_FLIP;
    tl_difference d;
    tl_flip flip = {0};

    for (int i = 0; i < 2; i++)
        TRY(tl_image_read(options->pictures[i], &images[i], &is_png[i], err));
    if (is_png[0] != is_png[1])
        tl_notice(&console_notices,
                  "%s holds values encoded for a screen, %s linear radiance: "
                  "they differ by that alone",
                  options->pictures[is_png[1]], options->pictures[is_png[0]]);
    if (images[0]->width != images[1]->width || images[0]->height != images[1]->height)
        TRY(tl_fail(err, TL_ERR_DIFFERENT,
                    "%s has %u x %u pixels, %s %u x %u: nothing to compare",
                    options->pictures[0], images[0]->width, images[0]->height,
                    options->pictures[1], images[1]->width, images[1]->height));
    TRY(tl_compare(images[0], images[1], &d, err));
    if (with_flip)
        TRY(flip_run(&options->flip, options->pictures, images, is_png, &flip, err));
    TRY(print_report(options, &d, with_flip ? &flip : NULL,
                     3 * (uint64_t)images[0]->width * images[0]->height, err));
    TRY(judge(options, &d, &flip, err));
done:
    tl_image_destroy(images[1]);
    tl_image_destroy(images[0]);
    return status;
}

int command_compare(int argc, char **argv)
{
    compare_command options = {.tolerance = INFINITY, .flip = flip_options_default()};
    tl_error err;
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    return console_finish(run(&options, &err), &err);
}
