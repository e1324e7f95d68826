/* Options of what a scene is seen with. */
#ifndef TL_CAPTURE_OPTIONS_H
#define TL_CAPTURE_OPTIONS_H

#include "tilelight/capture.h"

#include <argp.h>

/* Its input is a tl_capture_options. */
extern const struct argp capture_argp; /* --size, --camera, --layout ... */

#endif
