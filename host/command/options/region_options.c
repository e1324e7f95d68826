#include "region_options.h"

#include <ctype.h>
#include <stdlib.h>

enum { OPTION_REGION = 256, NUMBERS = 4 };

/* Four whole numbers with commas between. */
static int parse_numbers(const char *text, uint32_t out[NUMBERS])
{
    for (int i = 0; i < NUMBERS; i++) {
        char *end = NULL;
        if (!isdigit((unsigned char)*text))
            return 0;
        const unsigned long long number = strtoull(text, &end, 10);
        if (number > TL_MAX_EXTENT || *end != (i + 1 < NUMBERS ? ',' : '\0'))
            return 0;
        out[i] = (uint32_t)number;
        text = end + 1;
    }
    return out[2] > 0 && out[3] > 0;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    tl_region *const region = state->input;
    uint32_t numbers[NUMBERS] = {0};
    if (key != OPTION_REGION)
        return ARGP_ERR_UNKNOWN;
    if (!parse_numbers(text, numbers))
        argp_error(state,
                   "--region: \"%s\" is no region; write X,Y,WIDTH,HEIGHT in pixels from the "
                   "upper left, WIDTH and HEIGHT from 1",
                   text);
    *region = (tl_region){numbers[0], numbers[1], numbers[2], numbers[3]};
    return 0;
}

static const struct argp_option options_table[] = {
    {"region", OPTION_REGION, "X,Y,WIDTH,HEIGHT", 0,
     "Light and write these pixels alone, from the upper left, with the bits of the whole "
     "picture; an EXR says where in it they lie",
     0},
    {0},
};

const struct argp region_argp = {.options = options_table, .parser = parse};
