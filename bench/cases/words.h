/* One word of an axis' list to a value. Each fails with TL_ERR_ARGUMENT, naming the option and what
 * it accepts; *out is written on success alone. */
#ifndef TL_WORDS_H
#define TL_WORDS_H

#include "tilelight/error.h"

#include <stddef.h>
#include <stdint.h>

/* Which of `words`, [count]. */
tl_status tl_word_among(const char *option,
                        const char *word,
                        const char *const *words,
                        size_t count,
                        size_t *out,
                        tl_error *err);

/* Both ends of the ranges are accepted. */
tl_status tl_word_integer(const char *option,
                          const char *word,
                          uint32_t least,
                          uint32_t most,
                          uint32_t *out,
                          tl_error *err);
tl_status tl_word_number(const char *option,
                         const char *word,
                         double least,
                         double most,
                         double *out,
                         tl_error *err);

/* "WIDTHxHEIGHT", each 1 to TL_MAX_EXTENT px. */
tl_status tl_word_size(
    const char *option, const char *word, uint32_t *width, uint32_t *height, tl_error *err);

#endif
