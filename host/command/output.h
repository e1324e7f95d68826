/* Where results go: which kinds a suffix names, and whether a place can be written to. */
#ifndef TL_OUTPUT_H
#define TL_OUTPUT_H

#include "tilelight/image.h"

#include <argp.h>
#include <stdbool.h>

enum { OUTPUT_STANDARD = 1, OUTPUT_PNG = 2, OUTPUT_EXR = 4, OUTPUT_JSON = 8 };

/* Which of these `path` is, by its suffix or as "-". Anything outside the set `accepted` is a
 * usage error that lists what `option` takes. */
int output_kind(struct argp_state *state, const char *option, const char *path, int accepted);

/* Fails where `path` could not be written later, before any work is done for it: TL_ERR_WRITE for
 * a folder that is missing or read-only, TL_ERR_ARGUMENT where it is `input` (may be NULL). */
tl_status output_check(const char *path, const char *input, tl_error *err);

enum { MOST_OUTPUTS = 16 };

typedef struct picture_options {
    const char *paths[MOST_OUTPUTS]; /* [count] */
    int kinds[MOST_OUTPUTS];
    int count;
    bool automatic; /* exposure */
    float exposure; /* stops */
    tl_look look;
    bool tone_given, curve_given; /* else what the capture asks for */
    bool half;
} picture_options;

/* Its input is a picture_options, all zero to begin with. At least one output is required. */
extern const struct argp picture_argp; /* -o, --exposure, --tone, --curve, --exr */

/* How PNGs are made: as the options say, else as the capture asks (NULL: asks for nothing), else ours. */
tl_look picture_look(const picture_options *options, const tl_look *asked);
const char *picture_tone_word(tl_tone tone);
const char *picture_curve_word(tl_curve curve);

/* output_check for each. */
tl_status picture_check(const picture_options *options, const char *input, tl_error *err);

/* Whether a picture goes to standard output. */
bool picture_on_standard_output(const picture_options *options);

#endif
