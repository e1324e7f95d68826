#define _POSIX_C_SOURCE 200809L
#include "batch_notices.h"

#include "batch_sentences.h"
#include "console.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Kinds; what is said beyond them is said each time. */
enum { MOST_NOTICES = 256, LONGEST = 1024 };

static _Thread_local const tl_item *current;

void batch_notices_are_of(const tl_item *item)
{
    current = item;
}

/* Under the lock. NULL: there is none yet. */
static batch_notice *find(batch_notices *notices, const char *key)
{
    for (size_t i = 0; i < notices->count; i++)
        if (strcmp(notices->of[i].key, key) == 0)
            return &notices->of[i];
    return NULL;
}

/* Under the lock. */
static void add(batch_notices *notices, const char *key, const char *sentence)
{
    batch_notice *more = NULL;
    if (notices->count < MOST_NOTICES)
        more = realloc(notices->of, (notices->count + 1) * sizeof *more);
    if (!more)
        return;
    notices->of = more;
    batch_notice made = {
        .key = strdup(key), .first = strdup(sentence), .last = current, .frames = 1};
    if (made.key && made.first) {
        more[notices->count++] = made;
    } else {
        free(made.key);
        free(made.first);
    }
}

static void say(void *context, const char *sentence)
{
    static const tl_item none = {.name = NULL};
    batch_notices *notices = context;
    char key[LONGEST];
    batch_sentence_key(sentence, current ? current : &none, key, sizeof key);
    pthread_mutex_lock(&notices->lock);
    batch_notice *known = find(notices, key);
    if (known && known->last != current) {
        known->last = current;
        known->frames++;
    } else if (!known) {
        console_say(sentence);
        add(notices, key, sentence);
    }
    pthread_mutex_unlock(&notices->lock);
}

void batch_notices_begin(batch_notices *notices)
{
    *notices = (batch_notices){.count = 0};
    notices->taken = (tl_notices){.say = say, .context = notices};
    pthread_mutex_init(&notices->lock, NULL);
}

void batch_notices_tell(batch_notices *notices)
{
    char sentence[LONGEST + 64];
    for (size_t i = 0; i < notices->count; i++) {
        const batch_notice *n = &notices->of[i];
        snprintf(sentence, sizeof sentence, "of %zu frames, first: %s", n->frames, n->first);
        if (n->frames > 1)
            console_say(sentence);
    }
}

void batch_notices_end(batch_notices *notices)
{
    for (size_t i = 0; i < notices->count; i++) {
        free(notices->of[i].key);
        free(notices->of[i].first);
    }
    free(notices->of);
    pthread_mutex_destroy(&notices->lock);
    *notices = (batch_notices){.count = 0};
}
