/* Sentences of many frames that say the same but for numbers and names of files. */
#ifndef TL_BATCH_SENTENCES_H
#define TL_BATCH_SENTENCES_H

#include "items.h"

#include "tilelight/report.h"

/* The sentence with one sign in place of each of the item's files, and of each number. key: [size], cut to
 * fit. */
void batch_sentence_key(const char *sentence, const tl_item *item, char *key, size_t size);

/* Whether it names a file of the item's. */
bool batch_sentence_is_of(const char *sentence, const tl_item *item);

#endif
