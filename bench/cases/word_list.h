/* A list of words with commas between them, as options have it. */
#ifndef TL_WORD_LIST_H
#define TL_WORD_LIST_H

#include "tilelight/error.h"

#include <stddef.h>

enum { TL_MOST_LIST = 4096 }; /* bytes */

typedef struct tl_word_list {
    char text[TL_MOST_LIST]; /* commas made into ends of words */
    const char *of[TL_MOST_LIST / 2];
    size_t count;
    int is_all; /* it was the word "all" */
} tl_word_list;

/* all: the list that "all" stands for; NULL: none, and "all" is a word like others. Words are shorter than
 * TL_BENCH_WORD_SIZE. Fails with TL_ERR_ARGUMENT, naming the option. */
tl_status tl_word_list_split(
    const char *option, const char *list, const char *all, tl_word_list *out, tl_error *err);

#endif
