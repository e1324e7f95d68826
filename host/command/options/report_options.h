/* Options on what a command says beside its result; the same for every command that has them. */
#ifndef TL_REPORT_OPTIONS_H
#define TL_REPORT_OPTIONS_H

#include <argp.h>
#include <stdbool.h>

typedef struct report_options {
    bool timings, json;
} report_options;

/* Their input is a report_options. --quiet acts at once. */
extern const struct argp report_argp; /* --timings, --json, --quiet */
extern const struct argp json_argp;   /* --json alone */

#endif
