/* What frames of a batch took: time, by stages, and memory. */
#ifndef TL_BATCH_COST_H
#define TL_BATCH_COST_H

#include "tilelight/report.h"

#include <jansson.h>
#include <pthread.h>
#include <stdint.h>

/* Of a frame, in their order. X(name, word, meaning) */
#define TL_BATCH_STAGES(X)                                                 \
    X(BATCH_CHECK, "check", "what its outputs were made from is compared") \
    X(BATCH_READ, "read", "the capture and its lights are read")           \
    X(BATCH_WAIT, "wait", "until no other frame is being lit")             \
    X(BATCH_LIGHT, "light", "lighting, and what comes after it")           \
    X(BATCH_WRITE, "write", "its outputs are written")

typedef enum batch_stage {
#define BATCH_STAGE_NAME(name, word, meaning) name,
    TL_BATCH_STAGES(BATCH_STAGE_NAME)
#undef BATCH_STAGE_NAME
        BATCH_STAGE_COUNT
} batch_stage;

/* Begun with batch_cost_begin. */
typedef struct batch_cost {
    pthread_mutex_t lock;
    double wall_s[BATCH_STAGE_COUNT]; /* of all frames together */
    /* the same, of the host's threads: what the driver's own take is the rest of what the process takes */
    double processor_s[BATCH_STAGE_COUNT];
    tl_timings timings;         /* finer, of all frames together */
    uint64_t bytes, most_bytes; /* of frames under way: now, and at most */
    double start_s, start_processor_s, main_s;
} batch_cost;

/* Where a thread stands. */
typedef struct batch_clock {
    double wall_s, processor_s;
} batch_clock;

void batch_cost_begin(batch_cost *cost);

batch_clock batch_clock_now(void);

/* Adds the time since then to a stage. Returns the time now, so that stages chain. */
batch_clock batch_cost_end_stage(batch_cost *cost, batch_stage stage, batch_clock since);

void batch_cost_add_timings(batch_cost *cost, const tl_timings *timings);

/* A frame's memory: taken, and given back. */
void batch_cost_take(batch_cost *cost, uint64_t bytes);
void batch_cost_give_back(batch_cost *cost, uint64_t bytes);

/* What a batch came to, for --json: times in seconds. To be asked by the thread that began it, once the others
 * are gone. */
json_t *batch_cost_json(batch_cost *cost, size_t lit_count);

/* The same for people, on standard error. */
void batch_cost_print(batch_cost *cost, size_t lit_count);

void batch_cost_end_all(batch_cost *cost);

#endif
