/* Options of the pictures that a job writes. */
#ifndef TL_PICTURE_OPTIONS_H
#define TL_PICTURE_OPTIONS_H

#include "tilelight/post.h"

#include <argp.h>
#include <stdbool.h>

enum { MOST_OUTPUTS = 16 };

typedef struct picture_options {
    const char *paths[MOST_OUTPUTS]; /* [count]; "-" is standard output */
    int kinds[MOST_OUTPUTS];
    int count;
    bool named_elsewhere; /* none has to be given */
    bool automatic;       /* exposure */
    float exposure;       /* stops */
    tl_look look;
    bool tone_given, curve_given; /* else what the capture asks for */
    uint32_t depth;               /* bits of a PNG's channels: 16; else 8 */
    tl_exr_form exr;
    const char *record;     /* what outputs say that they were made from; NULL: nothing */
    uint32_t width, height; /* px; 0: as lit */
    tl_filter filter;
    bool filter_given;
} picture_options;

/* Its input is a picture_options, all zero to begin with. At least one output is required, unless they
 * are named elsewhere. */
extern const struct argp picture_argp; /* -o, and how pictures are made of what was lit */

/* How PNGs are made: as the options say, else as the capture asks (NULL: asks for nothing), else ours. */
tl_look picture_look(const picture_options *options, const tl_look *asked);
const char *picture_tone_word(tl_tone tone);
const char *picture_curve_word(tl_curve curve);
const char *picture_dither_word(tl_dither dither);
const char *picture_filter_word(tl_filter filter);
/* Of the compression that it has, usual or asked for. */
const char *picture_exr_word(tl_exr_form form);

/* output_check for each. */
tl_status picture_check(const picture_options *options, const char *input, tl_error *err);

/* Whether a picture goes to standard output. */
bool picture_on_standard_output(const picture_options *options);

#endif
