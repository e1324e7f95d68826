#define _POSIX_C_SOURCE 200809L
#include "batch_queue.h"

#include "tilelight/report.h"

#include <stdlib.h>
#include <time.h>

/* How long another process's frame is left alone. */
static const double wait_s = 1.0;

tl_status batch_queue_begin(batch_queue *queue, size_t count, tl_error *err)
{
    pthread_condattr_t clock;
    batch_queue made = {.count = count,
                        .back = calloc(count + 1, sizeof *made.back),
                        .due_s = calloc(count + 1, sizeof *made.due_s)};
    if (!made.back || !made.due_s) {
        free(made.back);
        free(made.due_s);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu frames", count);
    }
    *queue = made;
    pthread_mutex_init(&queue->lock, NULL);
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&queue->changed, &clock);
    pthread_condattr_destroy(&clock);
    return TL_OK;
}

/* Until that time, or until something changes; under the lock. */
static void wait_until(batch_queue *queue, double due_s)
{
    const time_t whole = (time_t)due_s;
    const struct timespec due = {.tv_sec = whole,
                                 .tv_nsec = (long)(1e9 * (due_s - (double)whole))};
    pthread_cond_timedwait(&queue->changed, &queue->lock, &due);
}

/* Under the lock. */
static size_t take_back(batch_queue *queue)
{
    const size_t item = queue->back[queue->back_first];
    queue->back_first = (queue->back_first + 1) % queue->count;
    queue->back_count--;
    return item;
}

bool batch_queue_take(batch_queue *queue, size_t *item)
{
    bool found = false;
    pthread_mutex_lock(&queue->lock);
    while (!found && !queue->is_stopped) {
        if (queue->next < queue->count) {
            *item = queue->next++;
            found = true;
        } else if (queue->back_count == 0) {
            break;
        } else if (queue->due_s[queue->back_first] <= tl_seconds()) {
            *item = take_back(queue);
            found = true;
        } else {
            wait_until(queue, queue->due_s[queue->back_first]);
        }
    }
    pthread_mutex_unlock(&queue->lock);
    return found;
}

void batch_queue_put_back(batch_queue *queue, size_t item)
{
    pthread_mutex_lock(&queue->lock);
    const size_t last = (queue->back_first + queue->back_count++) % queue->count;
    queue->back[last] = item;
    queue->due_s[last] = tl_seconds() + wait_s;
    pthread_mutex_unlock(&queue->lock);
}

void batch_queue_stop(batch_queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->is_stopped = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
}

void batch_queue_end(batch_queue *queue)
{
    if (!queue->back)
        return;
    pthread_cond_destroy(&queue->changed);
    pthread_mutex_destroy(&queue->lock);
    free(queue->back);
    free(queue->due_s);
    *queue = (batch_queue){.count = 0};
}
