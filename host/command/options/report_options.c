#include "report_options.h"

#include "console.h"

enum { OPTION_TIMINGS = 256, OPTION_JSON };

static error_t parse(int key, char *text, struct argp_state *state)
{
    report_options *options = state->input;
    (void)text;
    switch (key) {
    case OPTION_TIMINGS: options->timings = true; return 0;
    case OPTION_JSON: options->json = true; return 0;
    case 'q': console_quiet(true); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

#define JSON_OPTION                                                                     \
    {                                                                                   \
        "json", OPTION_JSON, NULL, 0, "Report as one JSON object on standard output", 0 \
    }

static const struct argp_option json_options[] = {JSON_OPTION, {0}};

static const struct argp_option all_options[] = {
    {"timings", OPTION_TIMINGS, NULL, 0,
     "Say how many milliseconds each stage took, on standard error or in --json", 0},
    JSON_OPTION,
    {"quiet", 'q', NULL, 0, "No notices and no progress; errors are still said", 0},
    {0},
};

const struct argp report_argp = {.options = all_options, .parser = parse};
const struct argp json_argp = {.options = json_options, .parser = parse};
