/* A batch that is under way. */
#ifndef TL_BATCH_STATE_H
#define TL_BATCH_STATE_H

#include "batch_cost.h"
#include "batch_notices.h"
#include "batch_queue.h"
#include "frame_options.h"
#include "item_list.h"
#include "job.h"
#include "lighter.h"
#include "record.h"

#include <pthread.h>

/* How its progress is told. X(name, word, meaning) */
#define TL_BATCH_PROGRESSES(X)                                                        \
    X(BATCH_PROGRESS_AUTO, "auto", "bar on a terminal, else plain")                   \
    X(BATCH_PROGRESS_BAR, "bar", "a line that the next one overwrites")               \
    X(BATCH_PROGRESS_PLAIN, "plain", "a line every ten seconds")                      \
    X(BATCH_PROGRESS_OPENJD, "openjd",                                                \
      "Open Job Description's openjd_progress and openjd_status, on standard output") \
    X(BATCH_PROGRESS_NONE, "none", "not at all")

typedef enum batch_progress_kind {
#define BATCH_PROGRESS_NAME(name, word, meaning) name,
    TL_BATCH_PROGRESSES(BATCH_PROGRESS_NAME)
#undef BATCH_PROGRESS_NAME
        BATCH_PROGRESS_COUNT
} batch_progress_kind;

enum { BATCH_MOST_WORKERS = 64 };

typedef struct batch_options {
    frame_options frame;
    tl_batch_request request; /* but for outputs and lights, which the frame has */
    bool force, dry_run;
    uint32_t
        in_flight; /* workers, at most BATCH_MOST_WORKERS; 0 before it is run: as many as suit the machine */
    batch_progress_kind progress;
} batch_options;

/* X(name, word) What became of an item. */
#define TL_BATCH_OUTCOMES(X)              \
    X(BATCH_LEFT, "left") /* not begun */ \
    X(BATCH_DONE, "done")                 \
    X(BATCH_UP_TO_DATE, "up_to_date")     \
    X(BATCH_FAILED, "failed")

typedef enum batch_outcome {
#define BATCH_OUTCOME_NAME(name, word) name,
    TL_BATCH_OUTCOMES(BATCH_OUTCOME_NAME)
#undef BATCH_OUTCOME_NAME
        BATCH_OUTCOME_COUNT
} batch_outcome;

typedef struct batch_result {
    batch_outcome outcome;
    tl_status status; /* of a failure */
    char *sentence;   /* the same, owned; NULL: none */
} batch_result;

/* What is known so far; under its lock. */
typedef struct batch_tally {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    size_t of[BATCH_OUTCOME_COUNT];
    unsigned running; /* workers */
    /* Failures that are not of a frame, one after another, and alike */
    char streak_key[512];
    unsigned streak;
    tl_error stopped; /* why nothing more is begun; status TL_OK: nothing has stopped it */
} batch_tally;

typedef struct batch {
    const batch_options *options;
    const tl_item_list *items;
    char *text; /* of the options that show in outputs; owned */
    tl_record_cache *records;
    batch_result *results; /* [items->count], each its worker's until that is done */
    job common;            /* has the lights, where all frames have the same */
    lighter with;
    pthread_mutex_t lighting; /* who holds it uses `with` */
    batch_queue queue;
    batch_notices notices;
    batch_cost cost;
    batch_tally tally;
} batch;

#endif
