#include "batch_sentences.h"

#include <ctype.h>
#include <string.h>

/* The length of the longest of the item's files that `at` begins with; 0: none. */
static size_t file_at(const char *at, const tl_item *item)
{
    size_t longest = 0;
    for (size_t i = 0; i < 2 + item->output_count; i++) {
        const char *const file = i == 0   ? item->input
                                 : i == 1 ? item->lights
                                          : item->outputs[i - 2];
        const size_t length = file ? strlen(file) : 0;
        if (length > longest && strncmp(at, file, length) == 0)
            longest = length;
    }
    return longest;
}

/* Of a number as printf writes them, its sign and exponent too; 0: none is there. */
static size_t number_at(const char *at)
{
    size_t length = *at == '-' || *at == '+';
    if (!isdigit((unsigned char)at[length]))
        return 0;
    while (isdigit((unsigned char)at[length]) ||
           (at[length] == '.' && isdigit((unsigned char)at[length + 1])))
        length++;
    if (at[length] == 'e' && (isdigit((unsigned char)at[length + 1]) ||
                              ((at[length + 1] == '-' || at[length + 1] == '+') &&
                               isdigit((unsigned char)at[length + 2]))))
        for (length += 2; isdigit((unsigned char)at[length]);)
            length++;
    return length;
}

void batch_sentence_key(const char *sentence, const tl_item *item, char *key, size_t size)
{
    size_t used = 0;
    while (*sentence && used + 1 < size) {
        const size_t file = file_at(sentence, item);
        const size_t number = file ? 0 : number_at(sentence);
        key[used++] = file ? '\1' : number ? '\2' : *sentence;
        sentence += file ? file : number ? number : 1;
    }
    key[used] = '\0';
}

bool batch_sentence_is_of(const char *sentence, const tl_item *item)
{
    for (; *sentence; sentence++)
        if (file_at(sentence, item) > 0)
            return true;
    return false;
}
