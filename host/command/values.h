/* The values of options: numbers in a range, words of a table. What does not fit is a usage error
 * that names the option and what it accepts; it ends the program with status 2. */
#ifndef TL_VALUES_H
#define TL_VALUES_H

#include "layout_names.h"

#include <argp.h>
#include <stddef.h>
#include <stdint.h>

/* `option` is what messages call it: "--exposure". Both ends of the range are accepted. */
double value_number(
    struct argp_state *state, const char *option, const char *text, double least, double most);
uint32_t value_integer(struct argp_state *state,
                       const char *option,
                       const char *text,
                       uint32_t least,
                       uint32_t most);

/* One of `choices`, [count]. */
uint32_t value_among(struct argp_state *state,
                     const char *option,
                     const char *text,
                     const uint32_t *choices,
                     size_t count);

/* "WIDTHxHEIGHT", px, each 1 to TL_MAX_EXTENT. */
void value_size(struct argp_state *state,
                const char *option,
                const char *text,
                uint32_t *width,
                uint32_t *height);

/* The words an option takes, by the values of their enumeration. */
typedef struct value_words {
    const char *kind, *kinds; /* "mode", "modes" */
    const char *const *words; /* [count] */
    size_t count;
} value_words;

unsigned value_word(struct argp_state *state,
                    const char *option,
                    const char *text,
                    const value_words *words);

enum tl_layout_name value_layout(struct argp_state *state,
                                 const char *option,
                                 const char *text);

/* The arguments that are no options, each required. */
typedef struct value_arguments {
    const char *const *names; /* [count], as the help text has them */
    const char **values;      /* [count] */
    size_t count;
} value_arguments;

/* For the parser of a subcommand: takes ARGP_KEY_ARG and ARGP_KEY_END. */
error_t value_argument(int key,
                       char *text,
                       struct argp_state *state,
                       const value_arguments *arguments);

#endif
