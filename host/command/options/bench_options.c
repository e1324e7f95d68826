#define _GNU_SOURCE /* asprintf */
#include "bench_options.h"

#include "console.h"
#include "output.h"
#include "values.h"

#include <stdlib.h>
#include <string.h>

enum {
    OPTION_AXES = 256, /* and as many more as there are axes */
    OPTION_CASE = OPTION_AXES + TL_AXIS_COUNT,
    OPTION_SAMPLES,
    OPTION_DEVIATION,
    OPTION_SECONDS,
    OPTION_BASELINES,
    OPTION_CAPTURE,
    OPTION_QUICK,
    OPTION_GROWTH,
    OPTION_STARTUP,
    OPTION_BATCH,
    OPTION_EFFECTS,
    OPTION_SKY,
    OPTION_LIST,
    OPTION_CSV,
    OPTION_JSON,
    OPTION_COMPARE,
    OPTION_THRESHOLD,
    OPTION_FAIL
};

enum { MOST_OPTIONS = TL_AXIS_COUNT + 32 };

bench_options bench_options_default(void)
{
    return (bench_options){.rule = tl_sampling_rule_default(), .threshold = 0.05};
}

static void check_together(const bench_options *options, struct argp_state *state)
{
    if (options->csv && options->json && strcmp(options->csv, "-") == 0 &&
        strcmp(options->json, "-") == 0)
        argp_error(state, "--csv - and --json - both want standard output");
    if (options->quick && options->mode != BENCH_BASELINES)
        argp_error(state, "--quick is for --baselines");
    if (options->capture && options->mode != BENCH_BASELINES)
        argp_error(state, "--capture is for --baselines");
    for (int axis = TL_AXIS_SCENE; axis <= TL_AXIS_RANGE && options->capture; axis++)
        if (options->lists.of[axis])
            argp_error(state, "--capture brings the frame; leave out --%s",
                       tl_bench_axes[axis].name);
    if (options->mode != BENCH_CASES && (options->csv || options->sets || options->compare))
        argp_error(state, "--csv, --case and --compare are for cases");
    if (options->mode != BENCH_CASES && options->mode != BENCH_LIST &&
        (options->lists.of[TL_AXIS_LAYOUT] || options->lists.of[TL_AXIS_AGAINST]))
        argp_error(state, "--layout and --against are for cases: all else lights full float");
    if (options->kernel.file && options->mode != BENCH_KERNEL && options->mode != BENCH_LIST)
        argp_error(state,
                   "--kernel excludes --baselines, --batch, --effects, --growth, --sky and "
                   "--startup");
    if (options->mode == BENCH_SKY &&
        (options->lists_given || options->lists.of[TL_AXIS_DEVICE]))
        argp_error(state, "--sky has rows of its own, and no device; it takes no axis");
    if (options->mode == BENCH_GROWTH && options->lists_given)
        argp_error(state,
                   "--growth has points of its own; of the axes it takes --device alone");
    for (int axis = TL_AXIS_SCENE; axis <= TL_AXIS_RANGE && options->mode == BENCH_EFFECTS;
         axis++)
        if (options->lists.of[axis] && axis != TL_AXIS_SIZE)
            argp_error(state, "--effects has frames of its own; leave out --%s",
                       tl_bench_axes[axis].name);
    if (options->fail_if_slower && !options->compare)
        argp_error(state, "--fail-if-slower is for --compare");
}

static error_t choose_mode(bench_options *options, bench_mode mode, struct argp_state *state)
{
    if (options->mode != BENCH_CASES && options->mode != mode)
        argp_error(state, "--baselines, --batch, --effects, --growth, --sky, --startup and "
                          "--list exclude one another");
    options->mode = mode;
    return 0;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const value_arguments none = {NULL, NULL, 0};
    bench_options *options = state->input;
    if (key >= OPTION_AXES && key < OPTION_AXES + TL_AXIS_COUNT) {
        options->lists.of[key - OPTION_AXES] = text;
        options->lists_given = options->lists_given || key != OPTION_AXES + TL_AXIS_DEVICE;
        return 0;
    }
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &options->kernel; return 0;
    case OPTION_CASE: options->sets = text; return 0;
    case OPTION_SAMPLES:
        options->rule.least_samples = value_integer(state, "--samples", text, 1, 1000);
        options->samples_given = true;
        return 0;
    case OPTION_DEVIATION:
        options->rule.deviation = 0.01 * value_number(state, "--deviation", text, 0.0, 100.0);
        return 0;
    case OPTION_SECONDS:
        options->rule.seconds = value_number(state, "--seconds", text, 0.0, 86400.0);
        options->seconds_given = true;
        return 0;
    case OPTION_BASELINES: return choose_mode(options, BENCH_BASELINES, state);
    case OPTION_CAPTURE: options->capture = text; return 0;
    case OPTION_STARTUP: return choose_mode(options, BENCH_STARTUP, state);
    case OPTION_BATCH: return choose_mode(options, BENCH_BATCH, state);
    case OPTION_EFFECTS: return choose_mode(options, BENCH_EFFECTS, state);
    case OPTION_SKY: return choose_mode(options, BENCH_SKY, state);
    case OPTION_GROWTH: return choose_mode(options, BENCH_GROWTH, state);
    case OPTION_QUICK: options->quick = true; return 0;
    case OPTION_LIST: return choose_mode(options, BENCH_LIST, state);
    case OPTION_CSV: options->csv = text; return 0;
    case OPTION_JSON: options->json = text; return 0;
    case OPTION_COMPARE: options->compare = text; return 0;
    case OPTION_THRESHOLD:
        options->threshold = 0.01 * value_number(state, "--threshold", text, 0.1, 1000.0);
        return 0;
    case OPTION_FAIL: options->fail_if_slower = true; return 0;
    case 'q':
        options->quiet = true;
        console_quiet(true);
        return 0;
    case ARGP_KEY_SUCCESS:
        if (options->kernel.file && options->mode == BENCH_CASES)
            options->mode = BENCH_KERNEL;
        check_together(options, state);
        return 0;
    default: return value_argument(key, text, state, &none);
    }
}

static const struct argp_option fixed_options[] = {
    {"case", OPTION_CASE, "SET,...", 0,
     "Sets of cases that have names, each over the axes that it varies (default, where no axis "
     "is given either: all)",
     1},
    {"baselines", OPTION_BASELINES, NULL, 0,
     "Light one frame by turns with the kernels and with every other way that `--list' names: "
     "our time over theirs",
     1},
    {"capture", OPTION_CAPTURE, "FILE", 0,
     "With --baselines: a capture with point lights inside, in place of a scene. Times are "
     "also told per pair of a pixel and a light that plain tiles of 16 px compute (their "
     "frustum, and their nearest and farthest depth)",
     1},
    {"quick", OPTION_QUICK, NULL, 0,
     "With --baselines: in less than 45 s where kernels are compiled; what takes more than a "
     "second a frame is sampled once, and then has no interval",
     1},
    {"effects", OPTION_EFFECTS, NULL, 0,
     "Light five frames, from the plainest to the richest, with the effects that they call for "
     "and with all of them; and frames with an effect that no tile uses, and without it. "
     "Pictures are compared bit for bit",
     1},
    {"growth", OPTION_GROWTH, NULL, 0,
     "From 64 to 65536 lights and from 640x360 to 7680x4320 pixels: what a frame's time and "
     "memory grow with, as prices of a pixel, a pair, a light and a tile",
     1},
    {"sky", OPTION_SKY, NULL, 0,
     "Prepare skies as what lights surfaces: maps of several sizes, and a gradient", 1},
    {"startup", OPTION_STARTUP, NULL, 0,
     "Start the program on a small frame, with nothing compiled and with all compiled: how "
     "long until its first kernel begins",
     1},
    {"batch", OPTION_BATCH, NULL, 0,
     "Light a frame as a batch of many, one after another and several under way at a time: "
     "what a frame "
     "takes over its processor time",
     1},
    {NULL, 0, NULL, 0, "Sampling:", 3},
    {"samples", OPTION_SAMPLES, "N", 0,
     "At least so many frames a case, after one that warms up (default 10; with --growth 5, "
     "--effects 30)",
     3},
    {"deviation", OPTION_DEVIATION, "PERCENT", 0,
     "Enough when half the median's 95 % interval is below this (default 1)", 3},
    {"seconds", OPTION_SECONDS, "S", 0,
     "Or when this long a time has passed (default 2; with --baselines 8, --quick 1.5, "
     "--growth 3, --effects 4)",
     3},
    {NULL, 0, NULL, 0, "Results:", 4},
    {"json", OPTION_JSON, "FILE", 0, "All there is, as one JSON object (- is standard output)",
     4},
    {"csv", OPTION_CSV, "FILE", 0, "A line a case (- is standard output)", 4},
    {"compare", OPTION_COMPARE, "FILE", 0,
     "Say of each case whether it is faster, slower or the same as in a report that --json "
     "wrote, or undecided. The intervals of both medians make one of their ratio: faster or "
     "slower where all of it is beyond the threshold, the same where all of it is within",
     4},
    {"threshold", OPTION_THRESHOLD, "PERCENT", 0, "Of --compare (default 5)", 4},
    {"fail-if-slower", OPTION_FAIL, NULL, 0, "Exit with status 1 where a case is slower", 4},
    {"list", OPTION_LIST, NULL, 0,
     "Describe axes, sets of cases, scenes and baselines; measure nothing", 5},
    {"quiet", 'q', NULL, 0, "No table and no progress; errors are still said", 5},
};

/* "Words": the meaning, and the usual word behind it. */
static char *axis_help(const tl_bench_axis *axis)
{
    char *text = NULL;
    return asprintf(&text, "%s (default %s)", axis->meaning, axis->usual) < 0 ? NULL : text;
}

void bench_parse(int argc, char **argv, bench_options *options)
{
    struct argp_option table[MOST_OPTIONS] = {
        {NULL, 0, NULL, 0, "Axes; the cases are the product of their lists:", 2}};
    static const struct argp_child children[] = {
        {&kernel_argp, 0, "Your kernel, by turns with ours:", 3}, {0}};
    const struct argp argp = {
        .options = table,
        .parser = parse,
        .children = children,
        .doc = "Measures how fast scenes of its own are lit: wall time, kernel time, and how "
               "near to what the device can do at most.",
    };
    size_t count = 1;
    char *helps[TL_AXIS_COUNT];
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++) {
        const tl_bench_axis *a = &tl_bench_axes[axis];
        helps[axis] = axis_help(a);
        table[count++] =
            (struct argp_option){a->name, OPTION_AXES + axis, a->values, 0, helps[axis], 2};
    }
    for (size_t i = 0; i < sizeof fixed_options / sizeof fixed_options[0]; i++)
        table[count++] = fixed_options[i];
    argp_parse(&argp, argc, argv, 0, NULL, options);
    for (int axis = 0; axis < TL_AXIS_COUNT; axis++)
        free(helps[axis]);
}
