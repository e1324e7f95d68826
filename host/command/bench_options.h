/* The options of `tilelight bench`. */
#ifndef TL_BENCH_OPTIONS_H
#define TL_BENCH_OPTIONS_H

#include "bench_case.h"
#include "sampling.h"

#include <argp.h>
#include <stdbool.h>

typedef struct bench_options {
    tl_bench_lists lists; /* of the axes that were given */
    bool lists_given;
    const char *sets; /* "scenes,tiles"; NULL: none named */
    tl_sampling_rule rule;
    bool list;
    const char *csv, *json; /* where to; NULL: nowhere */
} bench_options;

/* Of the table of axes and the rest; usage errors end the program with status 2. */
void bench_parse(int argc, char **argv, bench_options *options);

#endif
