#include "lighting_options.h"

#include "approximation_options.h"
#include "strict_options.h"
#include "tilelight/occlusion.h"
#include "values.h"

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

enum {
    OPTION_LIGHTS = 256,
    OPTION_CULL,
    OPTION_TILE,
    OPTION_DEVICE,
    OPTION_PRECISION,
    OPTION_WIDTH,
    OPTION_CUTOFF,
    OPTION_MEMORY,
    OPTION_PATH,
    OPTION_EFFECTS,
    OPTION_FILTER,
    OPTION_OCCLUSION,
    OPTION_SAMPLES_OF_OCCLUSION
};

#define WORD(name, word, meaning) [name] = word,
#define WORD_AND_MEANING(name, word, meaning) " " word ": " meaning "."
static const char *const cull_words[] = {TL_CULLS(WORD)};
static const char *const path_words[] = {TL_PATHS(WORD)};
static const char *const precision_words[] = {TL_PRECISIONS(WORD)};
static const char *const effects_words[] = {TL_EFFECTS_MODES(WORD)};
static const value_words effects_modes = {"mode", "modes", effects_words,
                                          TL_EFFECTS_MODE_COUNT};
static const value_words culls = {"mode", "modes", cull_words, TL_CULL_COUNT};
static const value_words paths = {"path", "paths", path_words, TL_PATH_COUNT};
static const value_words precisions = {"precision", "precisions", precision_words,
                                       TL_PRECISION_COUNT};

static const uint32_t tile_sizes[] = {8, 16, 32, 64};
static const uint32_t widths[] = {1, 4, 8, 16};
#define SAMPLES(samples, slices, steps, halvings) samples,
static const uint32_t occlusion_samples[] = {TL_OCCLUSION_SAMPLES(SAMPLES)};

lighting_choice lighting_choice_default(void)
{
    return (lighting_choice){.options = tl_lighting_options_default(),
                             .occlusion_radius = -1.0,
                             .sky = sky_choice_default()};
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    lighting_choice *choice = state->input;
    tl_lighting_options *options = &choice->options;
    switch (key) {
    case OPTION_LIGHTS: choice->lights = text; return 0;
    case OPTION_DEVICE: choice->device = text; return 0;
    case OPTION_CULL:
        options->cull = (tl_cull)value_word(state, "--cull", text, &culls);
        return 0;
    case OPTION_PRECISION:
        choice->chosen = "--precision";
        options->precision = (tl_precision)value_word(state, "--precision", text, &precisions);
        return 0;
    case OPTION_PATH:
        options->path = (tl_path)value_word(state, "--path", text, &paths);
        return 0;
    case OPTION_EFFECTS:
        options->effects =
            (tl_effects_mode)value_word(state, "--effects", text, &effects_modes);
        return 0;
    case OPTION_TILE:
        options->tile_size =
            value_among(state, "--tile", text, tile_sizes, COUNT_OF(tile_sizes));
        return 0;
    case OPTION_WIDTH:
        options->vector_width = value_among(state, "--width", text, widths, COUNT_OF(widths));
        return 0;
    case OPTION_CUTOFF:
        choice->chosen = "--light-cutoff";
        options->light_cutoff = (float)value_number(state, "--light-cutoff", text, 0.0, 1e30);
        return 0;
    case OPTION_FILTER:
        options->shadow_filter =
            value_integer(state, "--shadow-filter", text, 1, TL_MOST_SHADOW_FILTER);
        return 0;
    case OPTION_OCCLUSION:
        choice->occlusion_radius = value_number(state, "--ambient-occlusion", text, 0.0, 1e18);
        return 0;
    case OPTION_SAMPLES_OF_OCCLUSION:
        options->occlusion_samples = value_among(
            state, "--occlusion-samples", text, occlusion_samples, COUNT_OF(occlusion_samples));
        return 0;
    case OPTION_MEMORY:
        options->memory_limit =
            (uint64_t)(value_number(state, "--memory", text, 0.0, 1e9) * 1e6);
        return 0;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &choice->strict;
        state->child_inputs[1] = &choice->sky;
        state->child_inputs[2] = &options->approximations;
        state->child_inputs[3] = &choice->controls;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"lights", OPTION_LIGHTS, "FILE", 0,
     "Lights from a JSON file (- is standard input) in place of the scene's own", 0},
    {"cull", OPTION_CULL, "MODE", 0,
     "Which lights a tile computes; the picture is the same bit for bit "
     "(default split)." TL_CULLS(WORD_AND_MEANING),
     0},
    {"tile", OPTION_TILE, "PIXELS", 0, "Side of a tile: 8, 16, 32 or 64 (default 16)", 0},
    {"device", OPTION_DEVICE, "INDEX|NAME|cpu|gpu", 0,
     "The OpenCL device; `tilelight devices' lists them (default: PoCL, else any CPU, else "
     "any)",
     0},
    {"precision", OPTION_PRECISION, "NAME", 0,
     "How it is computed (default float)." TL_PRECISIONS(WORD_AND_MEANING), 0},
    {"path", OPTION_PATH, "NAME", 0,
     "How a frame is cut into work-items; the picture is the same bit for bit "
     "(default auto)." TL_PATHS(WORD_AND_MEANING),
     0},
    {"effects", OPTION_EFFECTS, "MODE", 0,
     "Which effects are computed; the picture is the same bit for bit "
     "(default auto)." TL_EFFECTS_MODES(WORD_AND_MEANING),
     0},
    {"width", OPTION_WIDTH, "LANES", 0,
     "Vector lanes of the kernels: 1, 4, 8 or 16 (default: what suits the device)", 0},
    {"light-cutoff", OPTION_CUTOFF, "LUX", 0,
     "A light without a range ends where it gives this much (default 0: never)", 0},
    {"shadow-filter", OPTION_FILTER, "TEXELS", 0,
     "Width of a shadow's edge, in texels of its map: 1 to 13 (default 2); time grows with its "
     "square",
     0},
    {"ambient-occlusion", OPTION_OCCLUSION, "METRES", 0,
     "Keep ambient light from where surfaces within this radius stand around, in place of what "
     "the lights file says; 0: nowhere",
     0},
    {"occlusion-samples", OPTION_SAMPLES_OF_OCCLUSION, "COUNT", 0,
     "Looks around each pixel for that: 8, 16, 32, 64, 128 or 256 (default 64); time grows "
     "with it",
     0},
    {"memory", OPTION_MEMORY, "MB", 0,
     "Device memory that lighting may take beside the frame itself; a frame that needs more is "
     "lit in bands, with the same bits (default 0: what the device has)",
     0},
    {0},
};

static const struct argp_child children[] = {
    {&strict_argp, 0, NULL, 0},
    {&sky_argp, 0, NULL, 0},
    {&approximation_argp, 0, "Accuracy for time (docs/approximations.md):", 0},
    {&light_control_argp, 0, NULL, 0},
    {0},
};
const struct argp lighting_argp = {
    .options = options_table, .parser = parse, .children = children};
