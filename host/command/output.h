/* Where results go: which kinds a suffix names, and whether a place can be written to. */
#ifndef TL_OUTPUT_H
#define TL_OUTPUT_H

#include "tilelight/error.h"

#include <argp.h>

enum {
    OUTPUT_STANDARD = 1,
    OUTPUT_PNG = 2,
    OUTPUT_EXR = 4,
    OUTPUT_JSON = 8,
    OUTPUT_PFM = 16,
    OUTPUT_STANDARD_PFM = 32
};

/* Which of the set `accepted` `path` is, as below; 0: none. */
int output_kind_of(const char *path, int accepted);

/* Which of these `path` is, by its suffix, as "-" or as "pfm:-". Anything outside the set `accepted` is a
 * usage error that lists what `option` takes. */
int output_kind(struct argp_state *state, const char *option, const char *path, int accepted);

/* Fails where `path` could not be written later, before any work is done for it: TL_ERR_WRITE for
 * a folder that is missing or read-only, TL_ERR_ARGUMENT where it is `input` (may be NULL). */
tl_status output_check(const char *path, const char *input, tl_error *err);

#endif
