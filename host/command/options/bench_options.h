/* The options of `tilelight bench`. */
#ifndef TL_BENCH_OPTIONS_H
#define TL_BENCH_OPTIONS_H

#include "bench_case.h"
#include "kernel_options.h"
#include "sampling.h"

#include <argp.h>
#include <stdbool.h>

typedef enum bench_mode {
    BENCH_CASES,
    BENCH_BASELINES,
    BENCH_GROWTH,
    BENCH_STARTUP,
    BENCH_BATCH,
    BENCH_EFFECTS,
    BENCH_SKY,
    BENCH_KERNEL,
    BENCH_LIST
} bench_mode;

typedef struct bench_options {
    bench_mode mode;
    tl_bench_lists lists; /* of the axes that were given */
    bool lists_given;     /* of any but the device's */
    const char *sets;     /* "scenes,tiles"; NULL: none named */
    kernel_choice kernel; /* set in BENCH_KERNEL */
    tl_sampling_rule rule;
    bool samples_given, seconds_given;
    const char *capture; /* baselines: a file in place of a scene; NULL: none */
    bool quick;          /* baselines: those above a second once */
    bool quiet;
    const char *csv, *json; /* where to; NULL: nowhere */
    const char *compare;    /* an earlier report; NULL: none */
    double threshold;       /* of --compare: 0.05 is 5 % */
    bool fail_if_slower;
} bench_options;

bench_options bench_options_default(void);

/* Of the table of axes and the rest; usage errors end the program with status 2. */
void bench_parse(int argc, char **argv, bench_options *options);

#endif
