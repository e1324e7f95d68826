/* Which known word a mistyped one may have been. */
#ifndef TL_SUGGEST_H
#define TL_SUGGEST_H

#include <stddef.h>

/* The word of words[0 .. count) that is the fewest edits from `typed`, where that is at most a
 * third of its length; else NULL. Cannot fail. */
const char *tl_suggest(const char *typed, const char *const *words, size_t count);

#endif
