/* The option of every command that takes frames of unknown quality. */
#ifndef TL_STRICT_OPTIONS_H
#define TL_STRICT_OPTIONS_H

#include <argp.h>

/* Its input is a bool. */
extern const struct argp strict_argp; /* --strict */

#endif
