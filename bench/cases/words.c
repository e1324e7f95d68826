#include "words.h"

#include "tilelight/camera.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

tl_status tl_word_among(const char *option,
                        const char *word,
                        const char *const *words,
                        size_t count,
                        size_t *out,
                        tl_error *err)
{
    char list[512] = "";
    for (size_t i = 0, used = 0; i < count; i++) {
        if (strcmp(word, words[i]) == 0) {
            *out = i;
            return TL_OK;
        }
        used += (size_t)snprintf(list + used, used < sizeof list ? sizeof list - used : 0,
                                 "%s%s", i ? ", " : "", words[i]);
    }
    return tl_fail(err, TL_ERR_ARGUMENT, "%s: \"%s\" is none of %s", option, word, list);
}

/* All of `word` up to `end` as digits, below 2^32. */
static int is_integer(const char *word, const char *end, uint32_t *out)
{
    uint64_t value = 0;
    if (word == end)
        return 0;
    for (; word < end; word++) {
        if (!isdigit((unsigned char)*word))
            return 0;
        value = 10 * value + (uint64_t)(*word - '0');
        if (value > UINT32_MAX)
            return 0;
    }
    *out = (uint32_t)value;
    return 1;
}

tl_status tl_word_integer(const char *option,
                          const char *word,
                          uint32_t least,
                          uint32_t most,
                          uint32_t *out,
                          tl_error *err)
{
    uint32_t value = 0;
    if (!is_integer(word, word + strlen(word), &value) || value < least || value > most)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: \"%s\" is no whole number from %u to %u",
                       option, word, least, most);
    *out = value;
    return TL_OK;
}

tl_status tl_word_number(
    const char *option, const char *word, double least, double most, double *out, tl_error *err)
{
    char *end = NULL;
    const double value = strtod(word, &end);
    if (end == word || *end || isspace((unsigned char)*word) ||
        !(value >= least && value <= most))
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: \"%s\" is no number from %g to %g", option,
                       word, least, most);
    *out = value;
    return TL_OK;
}

tl_status tl_word_size(
    const char *option, const char *word, uint32_t *width, uint32_t *height, tl_error *err)
{
    const char *cross = strchr(word, 'x');
    uint32_t w = 0, h = 0;
    if (!cross || !is_integer(word, cross, &w) ||
        !is_integer(cross + 1, cross + strlen(cross), &h) || w < 1 || w > TL_MAX_EXTENT ||
        h < 1 || h > TL_MAX_EXTENT)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: \"%s\" is no size; write WIDTHxHEIGHT, each from 1 to %d pixels",
                       option, word, TL_MAX_EXTENT);
    *width = w;
    *height = h;
    return TL_OK;
}
