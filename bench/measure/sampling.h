/* Samples of one thing, until they say enough. */
#ifndef TL_SAMPLING_H
#define TL_SAMPLING_H

#include "statistics.h"
#include "tilelight/error.h"

typedef struct tl_sampling_rule {
    size_t least_samples; /* 1 and up; taken however long they take */
    double deviation;     /* enough once tl_relative_deviation is not above this */
    double seconds;       /* or once this much time has passed */
} tl_sampling_rule;

/* 10 samples, 1 %, 2 s. */
tl_sampling_rule tl_sampling_rule_default(void);

/* A list of numbers that grows. All zero is an empty one. */
typedef struct tl_samples {
    double *values; /* [count]; owned */
    size_t count, capacity;
} tl_samples;

/* Fails with TL_ERR_MEMORY. */
tl_status tl_samples_add(tl_samples *samples, double value, tl_error *err);

/* Of what was added so far; sorts it. */
tl_summary tl_samples_summarize(const tl_samples *samples);

/* Leaves an empty list. */
void tl_samples_clear(tl_samples *samples);

/* Whether to stop. `start` is when sampling began (tl_seconds). Sorts the samples. */
int tl_sampling_done(const tl_sampling_rule *rule, const tl_samples *samples, double start);

#endif
