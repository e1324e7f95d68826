/* Names of files of a sequence: one place in them is a frame's number. */
#ifndef TL_PATTERN_H
#define TL_PATTERN_H

#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A name in three parts; all zero is none. It points into the text that it was read from. */
typedef struct tl_pattern {
    const char *text;
    size_t before, behind; /* where in text the number begins, and what follows it */
    unsigned
        digits; /* at least so many, zeros in front, a minus among them; 0: there is no number */
} tl_pattern;

#define TL_MOST_DIGITS 20

/* "####" and "@@@@" stand for a number of at least as many digits as there are signs, "%04d" and "%d" for
 * printf's. Where there are several the last is the number: folders may be called as they like. Text without
 * any has no number, which is no failure. Fails with TL_ERR_ARGUMENT for more than TL_MOST_DIGITS. */
tl_status tl_pattern_read(const char *text, tl_pattern *out, tl_error *err);

/* Whether "{name}" is in it. */
bool tl_pattern_has_name(const tl_pattern *pattern);

/* The name of one frame, and what stands for "{name}" in it (NULL: "{name}" is left as it is). The caller
 * frees *out. Fails with TL_ERR_MEMORY. */
tl_status tl_pattern_fill(
    const tl_pattern *pattern, int32_t frame, const char *name, char **out, tl_error *err);

#endif
