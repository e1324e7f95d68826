/* Which item a worker takes next. */
#ifndef TL_BATCH_QUEUE_H
#define TL_BATCH_QUEUE_H

#include "tilelight/error.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

/* Items 0 to count - 1 in their order; then those that were put back, the one that waits longest first. */
typedef struct batch_queue {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    size_t next, count;
    size_t *back;  /* [count], a ring of those that were put back; owned */
    double *due_s; /* [count], on tl_seconds' clock, when each of them may be taken; owned */
    size_t back_first, back_count;
    bool is_stopped;
} batch_queue;

/* Fails with TL_ERR_MEMORY. Released with batch_queue_end. */
tl_status batch_queue_begin(batch_queue *queue, size_t count, tl_error *err);

/* Takes an item; waits where all that are left were put back a moment ago. False: none is left. */
bool batch_queue_take(batch_queue *queue, size_t *item);

/* An item that was taken and has to wait for somebody else: it comes again, after a second. */
void batch_queue_put_back(batch_queue *queue, size_t item);

/* No item is given out any more. */
void batch_queue_stop(batch_queue *queue);

/* Accepts one that is all zero, and leaves it so. */
void batch_queue_end(batch_queue *queue);

#endif
