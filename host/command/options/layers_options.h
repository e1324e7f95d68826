/* How many of a capture's layers are lit. */
#ifndef TL_LAYERS_OPTIONS_H
#define TL_LAYERS_OPTIONS_H

#include <argp.h>

/* Input: a tl_lighting_options. */
extern const struct argp layers_argp;

#endif
