/* A part of the picture, by the command line. */
#ifndef TL_REGION_OPTIONS_H
#define TL_REGION_OPTIONS_H

#include "tilelight/gbuffer.h"

#include <argp.h>

/* Its input is a tl_region, all zero to begin with: no region. */
extern const struct argp region_argp; /* --region */

#endif
