/* Lights switched off and scaled from the command line. */
#ifndef TL_LIGHT_CONTROL_OPTIONS_H
#define TL_LIGHT_CONTROL_OPTIONS_H

#include "tilelight/light_control.h"

#include <argp.h>

enum { MOST_LIGHT_CONTROLS = 256 };

typedef struct light_controls {
    tl_light_control
        of[MOST_LIGHT_CONTROLS]; /* [count], in the order in which they were given */
    size_t count;
} light_controls;

/* Its input is a light_controls, all zero to begin with. Cuts NAME=SCALE in two, in place. */
extern const struct argp light_control_argp; /* --light, --group, --solo */

#endif
