#include "capture_options.h"

#include "values.h"

enum {
    OPTION_SIZE = 256,
    OPTION_CAMERA,
    OPTION_LAYOUT,
    OPTION_ANISOTROPY,
    OPTION_TIME,
    OPTION_ANIMATION,
    OPTION_VARIANT,
    OPTION_SAMPLES,
    OPTION_MATERIALS,
    OPTION_IDS,
    OPTION_SHADOWS,
    OPTION_SHADOW_MEMORY,
    OPTION_SHADOW_NEAR,
    OPTION_LAYERS
};

static const uint32_t anisotropies[] = {1, 2, 4, 8, TL_MAX_ANISOTROPY};

static const uint32_t sample_counts[] = {1, 4, 9, 16, 25, 36, 49, TL_MAX_SAMPLES};

static error_t parse(int key, char *text, struct argp_state *state)
{
    tl_capture_options *options = state->input;
    switch (key) {
    case OPTION_SIZE:
        value_size(state, "--size", text, &options->width, &options->height);
        return 0;
    case OPTION_CAMERA: options->camera = text; return 0;
    case OPTION_TIME:
        options->time = value_number(state, "--time", text, 0.0, 1e9);
        options->has_time = true;
        return 0;
    case OPTION_ANIMATION: options->animation = text; return 0;
    case OPTION_SAMPLES:
        options->samples = value_among(state, "--samples", text, sample_counts,
                                       sizeof sample_counts / sizeof sample_counts[0]);
        return 0;
    case OPTION_MATERIALS: options->materials = true; return 0;
    case OPTION_IDS: options->ids = true; return 0;
    case OPTION_SHADOWS: options->all_shadows = true; return 0;
    case OPTION_SHADOW_MEMORY:
        options->shadow_memory =
            (uint64_t)(value_number(state, "--shadow-memory", text, 1.0, 1e6) * 1e6);
        return 0;
    case OPTION_SHADOW_NEAR:
        options->shadow_near = value_number(state, "--shadow-near", text, 1e-6, 1e6);
        return 0;
    case OPTION_LAYERS:
        options->layers = value_integer(state, "--layers", text, 0, TL_MOST_LAYERS);
        options->without_layers = options->layers == 0;
        return 0;
    case OPTION_VARIANT: options->variant = text; return 0;
    case OPTION_LAYOUT: options->layout = value_layout(state, "--layout", text); return 0;
    case OPTION_ANISOTROPY:
        options->anisotropy = value_among(state, "--anisotropy", text, anisotropies,
                                          sizeof anisotropies / sizeof anisotropies[0]);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"size", OPTION_SIZE, "WIDTHxHEIGHT", 0, "Pixels, each 1 to 16384 (default 1280x720)", 0},
    {"samples", OPTION_SAMPLES, "N", 0,
     "Samples of each pixel, a square number: 1, 4, 9 ... 64 (default 1). Each one is lit, and "
     "the picture "
     "has their mean; all takes N times as long and N times the memory",
     0},
    {"camera", OPTION_CAMERA, "NAME|INDEX", 0,
     "A camera of the file (default: the first of its scene, else a view of the whole scene)",
     0},
    {"variant", OPTION_VARIANT, "NAME|INDEX", 0,
     "A variant of the file's materials (default: none of them)", 0},
    {"materials", OPTION_MATERIALS, NULL, 0,
     "Also the index of each pixel's material, for lights files with \"materials\", its "
     "tangent where there are any, and the materials' names",
     0},
    {"ids", OPTION_IDS, NULL, 0,
     "Also which object each pixel shows, and objects' names, for lights that are linked to "
     "some "
     "(default: where lights of --lights are)",
     0},
    {"shadows", OPTION_SHADOWS, NULL, 0,
     "Shadow maps of all lights (default: of those of a lights file that have castsShadow)", 0},
    {"shadow-memory", OPTION_SHADOW_MEMORY, "MB", 0,
     "That all shadow maps may take: beyond, the largest are made smaller (default 268)", 0},
    {"shadow-near", OPTION_SHADOW_NEAR, "METRES", 0,
     "Surfaces nearer to a light than that cast no shadow of it: more than the size of lamps "
     "that stand "
     "around their lights (default: a 100000th of the scene's extent)",
     0},
    {"layers", OPTION_LAYERS, "N", 0,
     "Layers of surfaces that blend, the nearest N of each pixel, as far as there are any: 0 "
     "to "
     "64 (default 8); with 0 they are opaque where alpha is at least 0.5",
     0},
    {"time", OPTION_TIME, "SECONDS", 0,
     "The moment of an animation, at its end if it has ended before (default: the scene as "
     "the file has it, or 0 with --animation)",
     0},
    {"animation", OPTION_ANIMATION, "NAME|INDEX", 0,
     "Which animation of the file --time is of (default: the first)", 0},
    {"layout", OPTION_LAYOUT, "NAME", 0,
     "How pixels are packed: a name of `tilelight layouts', whose render targets are drawn to "
     "(default: float, which is full float)",
     0},
    {"anisotropy", OPTION_ANISOTROPY, "N", 0,
     "Looks at a texture that is seen aslant, at most: 1, 2, 4, 8 or 16 (default 16; with 1 it "
     "blurs). For textures with mipmaps",
     0},
    {0},
};

const struct argp capture_argp = {.options = options_table, .parser = parse};
