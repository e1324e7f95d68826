/* Options that give accuracy away for time: one for each knob of kernels/knobs.h. */
#ifndef TL_APPROXIMATION_OPTIONS_H
#define TL_APPROXIMATION_OPTIONS_H

#include "tilelight/approximations.h"

#include <argp.h>
#include <jansson.h>

/* Its input is a tl_approximations. */
extern const struct argp approximation_argp;

/* The word of each knob; new. */
json_t *approximations_json(const tl_approximations *of);

/* Says in a notice that the picture is not the same everywhere, where that is so. */
void approximations_tell(const tl_approximations *of);

#endif
