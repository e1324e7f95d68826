/* Which parts of a picture's light are written beside it. */
#ifndef TL_AOV_OPTIONS_H
#define TL_AOV_OPTIONS_H

#include "lighting_options.h"
#include "picture_options.h"

#include <argp.h>

/* Its input is a lighting_choice. */
extern const struct argp aov_argp;

/* A usage error where parts are asked for, and no output can hold them. */
void aov_check_together(const lighting_choice *choice,
                        const picture_options *pictures,
                        struct argp_state *state);

#endif
