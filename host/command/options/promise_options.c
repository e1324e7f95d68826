#include "promise_options.h"

#include "tilelight/occlusion.h"
#include "values.h"

#include <string.h>

enum { OPTION_MAX_ERROR = 768, OPTION_MAX_FLIP, OPTION_MAX_TIME };

static const char eight_bits[] = "8bit";

/* A second one that differs from the first would leave open which of them counts. */
static void set_goal(promise_choice *promise,
                     const char *option,
                     tl_goal_kind kind,
                     double limit,
                     struct argp_state *state)
{
    if (promise->option && strcmp(promise->option, option) != 0)
        argp_error(state, "%s and %s exclude each other", promise->option, option);
    promise->option = option;
    promise->goal.kind = kind;
    promise->goal.limit = limit;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    promise_choice *promise = state->input;
    switch (key) {
    case OPTION_MAX_ERROR:
        if (strcmp(text, eight_bits) == 0)
            set_goal(promise, "--max-error", TL_GOAL_CODES, 1.0, state);
        else
            set_goal(promise, "--max-error", TL_GOAL_RMS,
                     value_number(state, "--max-error (or 8bit)", text, 1e-9, 1.0), state);
        return 0;
    case OPTION_MAX_FLIP:
        set_goal(promise, "--max-flip", TL_GOAL_FLIP,
                 value_number(state, "--max-flip", text, 1e-6, 1.0), state);
        return 0;
    case OPTION_MAX_TIME:
        set_goal(promise, "--max-time", TL_GOAL_TIME,
                 value_number(state, "--max-time", text, 1e-3, 1e7), state);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"max-error", OPTION_MAX_ERROR, "E|8bit", 0,
     "Light in the fastest way whose picture is off from the reference by no more than E: RMS, "
     "of the mean radiance, 1e-9 to 1. 8bit: no channel is off by more than 1 of 255 once it "
     "is "
     "shown as PNGs are. The picture is checked on a sample, and lit in the next way where it "
     "does not hold. The first frame of a kind takes longer: what lights it how fast is found, "
     "and remembered in the folder of compiled kernels",
     0},
    {"max-flip", OPTION_MAX_FLIP, "F", 0,
     "The same for the mean FLIP of what PNGs show, 1e-6 to 1 (`tilelight compare --flip')", 0},
    {"max-time", OPTION_MAX_TIME, "MS", 0,
     "Light in the most accurate way that is expected to take no more than so many "
     "milliseconds, files left out",
     0},
    {0},
};

const struct argp promise_argp = {.options = options_table, .parser = parse};

void promise_check_together(const promise_choice *promise,
                            const lighting_choice *lighting,
                            const picture_options *pictures,
                            struct argp_state *state)
{
    if (!promise->option)
        return;
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        if (lighting->options.approximations.of[knob] != 0)
            argp_error(state, "%s chooses --%s itself: leave one of them out", promise->option,
                       tl_knobs[knob].word);
    if (lighting->chosen)
        argp_error(state, "%s chooses %s itself: leave one of them out", promise->option,
                   lighting->chosen);
    if (lighting->options.split || lighting->groups)
        argp_error(state,
                   "%s is kept by the picture, and --aov writes others: leave one of them out",
                   promise->option);
    if (lighting->options.occlusion_samples)
        argp_error(state,
                   "%s is kept against ambient occlusion of %d samples: leave "
                   "--occlusion-samples out",
                   promise->option, TL_DEFAULT_OCCLUSION_SAMPLES);
    if (promise->goal.kind == TL_GOAL_CODES && !tl_look_is_of_channels(pictures->look))
        argp_error(state,
                   "--max-error 8bit is kept by tones that take each channel by itself: leave "
                   "--tone %s out",
                   picture_tone_word(pictures->look.tone));
    if (pictures->look.dither != TL_DITHER_NONE &&
        (promise->goal.kind == TL_GOAL_CODES || promise->goal.kind == TL_GOAL_FLIP))
        argp_error(state, "%s is kept by pictures without grain: leave --dither out",
                   promise->option);
    if (pictures->width > 0 && promise->goal.kind != TL_GOAL_TIME)
        argp_error(state, "%s is kept by pictures as they are lit: leave --output-size out",
                   promise->option);
    if (pictures->exr.half && promise->goal.kind != TL_GOAL_TIME)
        argp_error(state, "%s is kept by pictures in float: leave --exr half out",
                   promise->option);
}

const tl_goal *promise_goal(const promise_choice *promise,
                            const picture_options *pictures,
                            const tl_look *look,
                            tl_goal *goal)
{
    if (!promise->option)
        return NULL;
    *goal = promise->goal;
    goal->look = picture_look(pictures, look);
    goal->exposure = pictures->exposure;
    goal->is_automatic = pictures->automatic;
    return goal;
}
