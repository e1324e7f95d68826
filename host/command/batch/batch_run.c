#define _POSIX_C_SOURCE 200809L
#include "batch_run.h"

#include "batch_item.h"
#include "batch_sentences.h"
#include "console.h"
#include "interrupts.h"
#include "parallel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* So many frames in a row that fail alike, for a reason that is not theirs: the next ones would, too. */
enum { MOST_ALIKE = 5 };

uint32_t batch_usual_in_flight(void)
{
    const unsigned wanted = tl_thread_count() + 1;
    return wanted < BATCH_MOST_WORKERS ? wanted : BATCH_MOST_WORKERS;
}

/* Of failures: whether the next frame would fail alike. Those that name a file of the frame are the frame's
 * own, but for what cannot be written. */
static bool is_of_all(const tl_item *item, tl_status status, const tl_error *err)
{
    return status == TL_ERR_WRITE || !batch_sentence_is_of(err->message, item);
}

/* Under the lock of the tally. */
static void note_streak(batch *b, const tl_item *item, tl_status status, const tl_error *err)
{
    batch_tally *tally = &b->tally;
    char key[sizeof tally->streak_key] = "";
    if (status != TL_OK && is_of_all(item, status, err))
        batch_sentence_key(err->message, item, key, sizeof key);
    tally->streak =
        key[0] && strcmp(key, tally->streak_key) == 0 ? tally->streak + 1 : key[0] != '\0';
    memcpy(tally->streak_key, key, sizeof key);
    if (tally->streak < MOST_ALIKE || tally->stopped.status != TL_OK)
        return;
    tl_fail(&tally->stopped, status, "%u frames in a row failed alike, the last: %.1000s",
            tally->streak, err->message);
    batch_queue_stop(&b->queue);
}

/* The sentence, with the frame in front where that does not name it. */
static char *sentence_of(const tl_item *item, const tl_error *err)
{
    const bool names_it = batch_sentence_is_of(err->message, item);
    const size_t size = strlen(item->input) + strlen(err->message) + 3;
    char *sentence = malloc(size);
    if (sentence)
        snprintf(sentence, size, "%s%s%s", names_it ? "" : item->input, names_it ? "" : ": ",
                 err->message);
    return sentence;
}

static void note(
    batch *b, size_t index, batch_outcome outcome, tl_status status, const tl_error *err)
{
    const tl_item *item = &b->items->of[index];
    batch_result *result = &b->results[index];
    batch_tally *tally = &b->tally;
    result->outcome = status == TL_OK ? outcome : BATCH_FAILED;
    result->status = status;
    result->sentence = status == TL_OK ? NULL : sentence_of(item, err);
    if (result->sentence)
        console_complain(result->sentence);
    pthread_mutex_lock(&tally->lock);
    tally->of[BATCH_LEFT]--;
    tally->of[result->outcome]++;
    note_streak(b, item, status, err);
    pthread_cond_signal(&tally->changed);
    pthread_mutex_unlock(&tally->lock);
}

static void *work(void *context)
{
    batch *b = context;
    size_t index;
    while (batch_queue_take(&b->queue, &index)) {
        const tl_item *item = &b->items->of[index];
        batch_outcome outcome = BATCH_LEFT;
        tl_error err = {.status = TL_OK};
        batch_notices_are_of(item);
        const tl_status status = batch_item_make(b, item, &outcome, &err);
        if (status == TL_OK && outcome == BATCH_LEFT)
            batch_queue_put_back(&b->queue, index);
        else
            note(b, index, outcome, status, &err);
    }
    pthread_mutex_lock(&b->tally.lock);
    b->tally.running--;
    pthread_cond_signal(&b->tally.changed);
    pthread_mutex_unlock(&b->tally.lock);
    return NULL;
}

static void tell_interrupt(void)
{
    console_say(
        "interrupted: the frames under way are finished; a second signal stops at once");
}

/* Until all workers are gone. */
static void watch(batch *b, batch_progress *progress)
{
    batch_tally *tally = &b->tally;
    bool told = false;
    pthread_mutex_lock(&tally->lock);
    while (tally->running > 0) {
        struct timespec due;
        size_t of[BATCH_OUTCOME_COUNT];
        clock_gettime(CLOCK_MONOTONIC, &due);
        due.tv_nsec += 200 * 1000 * 1000;
        due.tv_sec += due.tv_nsec / 1000000000;
        due.tv_nsec %= 1000000000;
        pthread_cond_timedwait(&tally->changed, &tally->lock, &due);
        memcpy(of, tally->of, sizeof of);
        pthread_mutex_unlock(&tally->lock);
        batch_progress_tell(progress, b->items->count, of, false);
        if (interrupts_seen() && !told) {
            batch_queue_stop(&b->queue);
            tell_interrupt();
            told = true;
        }
        pthread_mutex_lock(&tally->lock);
    }
    pthread_mutex_unlock(&tally->lock);
    batch_progress_tell(progress, b->items->count, tally->of, true);
}

static bool start_worker(batch *b, pthread_t *thread)
{
    pthread_mutex_lock(&b->tally.lock);
    const bool started = pthread_create(thread, NULL, work, b) == 0;
    b->tally.running += started;
    pthread_mutex_unlock(&b->tally.lock);
    return started;
}

tl_status batch_run(batch *b, batch_progress *progress, tl_error *err)
{
    pthread_t threads[BATCH_MOST_WORKERS];
    uint32_t started = 0;
    while (started < b->options->in_flight && start_worker(b, &threads[started]))
        started++;
    if (started == 0)
        return tl_fail(err, TL_ERR_MEMORY, "no thread can be started");
    watch(b, progress);
    while (started > 0)
        pthread_join(threads[--started], NULL);
    return TL_OK;
}
