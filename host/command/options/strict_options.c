#include "strict_options.h"

#include <stdbool.h>

enum { OPTION_STRICT = 256 };

static error_t parse(int key, char *text, struct argp_state *state)
{
    bool *strict = state->input;
    (void)text;
    if (key != OPTION_STRICT)
        return ARGP_ERR_UNKNOWN;
    *strict = true;
    return 0;
}

static const struct argp_option options_table[] = {
    {"strict", OPTION_STRICT, NULL, 0,
     "Refuse a frame with pixels that are not finite or out of range, in place of repairing "
     "them",
     0},
    {0},
};

const struct argp strict_argp = {.options = options_table, .parser = parse};
