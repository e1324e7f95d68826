#include "word_list.h"

#include "bench_case.h"

#include <string.h>

tl_status tl_word_list_split(
    const char *option, const char *list, const char *all, tl_word_list *out, tl_error *err)
{
    out->is_all = all && strcmp(list, "all") == 0;
    if (out->is_all)
        list = all;
    const size_t length = strlen(list);
    if (length >= TL_MOST_LIST)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: the list has more than %d characters", option,
                       TL_MOST_LIST - 1);
    memcpy(out->text, list, length + 1);
    out->count = 0;
    for (char *word = out->text; word; out->count++) {
        char *comma = strchr(word, ',');
        if (comma)
            *comma = '\0';
        if (*word == '\0')
            return tl_fail(err, TL_ERR_ARGUMENT,
                           "%s: \"%s\" is no list: write words with commas between them",
                           option, list);
        if (strlen(word) >= TL_BENCH_WORD_SIZE)
            return tl_fail(err, TL_ERR_ARGUMENT, "%s: \"%s\" is too long a word", option, word);
        out->of[out->count] = word;
        word = comma ? comma + 1 : NULL;
    }
    return TL_OK;
}
