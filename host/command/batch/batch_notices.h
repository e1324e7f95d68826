/* Notices of many frames: what is said of each is told once, and at the end of how many it was. */
#ifndef TL_BATCH_NOTICES_H
#define TL_BATCH_NOTICES_H

#include "items.h"

#include "tilelight/report.h"

#include <pthread.h>

typedef struct batch_notice {
    char *key, *first;   /* batch_sentences.h; the sentence as it came first; owned */
    const tl_item *last; /* that it was said of */
    size_t frames;
} batch_notice;

/* Begun with batch_notices_begin, released with batch_notices_end. */
typedef struct batch_notices {
    pthread_mutex_t lock;
    batch_notice *of; /* [count] */
    size_t count;
    tl_notices taken; /* says what this thread's item has been told, into here */
} batch_notices;

void batch_notices_begin(batch_notices *notices);

/* What this thread says from now on is of that item, which outlives it. */
void batch_notices_are_of(const tl_item *item);

/* Tells of how many frames each notice was that was said of several. */
void batch_notices_tell(batch_notices *notices);

void batch_notices_end(batch_notices *notices);

#endif
