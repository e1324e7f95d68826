#include "suggest.h"

#include <ctype.h>
#include <string.h>

enum { LONGEST_WORD = 63 };

static size_t least(size_t a, size_t b, size_t c)
{
    const size_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

/* Insertions, deletions and replacements from a to b, letter case ignored; only the current row of
 * the Wagner-Fischer table is kept. b has at most LONGEST_WORD letters. */
static size_t edit_distance(const char *a, const char *b)
{
    const size_t b_length = strlen(b);
    size_t row[LONGEST_WORD + 1];
    for (size_t j = 0; j <= b_length; j++)
        row[j] = j;
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b_length; j++) {
            const size_t above = row[j + 1];
            const int same = tolower((unsigned char)a[i]) == tolower((unsigned char)b[j]);
            row[j + 1] = least(above + 1, row[j] + 1, diagonal + !same);
            diagonal = above;
        }
    }
    return row[b_length];
}

const char *tl_suggest(const char *typed, const char *const *words, size_t count)
{
    const char *best = NULL;
    size_t fewest = LONGEST_WORD;
    if (strlen(typed) > LONGEST_WORD)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        if (strlen(words[i]) > LONGEST_WORD)
            continue;
        const size_t edits = edit_distance(typed, words[i]);
        if (edits < fewest && 3 * edits <= strlen(words[i])) {
            fewest = edits;
            best = words[i];
        }
    }
    return best;
}
