/* What the numbers of another program's capture mean: the options of every command that takes captures. */
#ifndef TL_IMPORT_OPTIONS_H
#define TL_IMPORT_OPTIONS_H

#include "tilelight/import.h"

#include "values.h"

#include <argp.h>

/* Its input is a tl_import_options, which it makes the default at first. Options that do not go together
 * are usage errors. */
extern const struct argp import_argp;

/* For the parser of a subcommand, in place of value_argument: the one argument, a capture, may be left out
 * where maps name files for its planes. */
error_t import_argument(int key,
                        char *text,
                        struct argp_state *state,
                        const value_arguments *arguments,
                        const tl_import_options *options);

#endif
