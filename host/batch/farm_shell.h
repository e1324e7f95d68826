/* Parts of shell scripts that hand chunks to workers. */
#ifndef TL_FARM_SHELL_H
#define TL_FARM_SHELL_H

#include "farm_plan.h"

#include <stdio.h>

/* A function `light`: `light CHUNK` is one worker. */
void tl_farm_print_worker(FILE *out, const tl_farm_plan *plan);

/* "100 frames in 4 chunks": [48]. */
void tl_farm_size(const tl_farm_plan *plan, char text[48]);

/* What every scheduler's page has to say, as lines that begin with `mark`: how to take the work up again, and
 * what the machines of workers need. */
void tl_farm_print_advice(FILE *out, const char *mark);

#endif
