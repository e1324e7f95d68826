#include "layers_options.h"

#include "tilelight/lighting.h"
#include "values.h"

enum { OPTION_LAYERS = 256 };

static error_t parse(int key, char *text, struct argp_state *state)
{
    tl_lighting_options *options = state->input;
    if (key != OPTION_LAYERS)
        return ARGP_ERR_UNKNOWN;
    options->layers = value_integer(state, "--layers", text, 0, TL_MOST_LAYERS);
    return 0;
}

static const struct argp_option options_table[] = {
    {"layers", OPTION_LAYERS, "N", 0,
     "Of the capture's layers of surfaces that blend, the nearest N are lit: 0 to 64 (default "
     "all)",
     0},
    {0},
};

const struct argp layers_argp = {.options = options_table, .parser = parse};
