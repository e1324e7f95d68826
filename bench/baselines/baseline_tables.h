/* The functions behind the rows of baselines.c. */
#ifndef TL_BASELINE_TABLES_H
#define TL_BASELINE_TABLES_H

#include "baselines.h"

tl_status hand_create_exact(const tl_baseline_input *input, void **out, tl_error *err);
tl_status hand_create_relaxed(const tl_baseline_input *input, void **out, tl_error *err);
tl_status hand_run(void *state, tl_image *image, tl_timings *timings, tl_error *err);
void hand_destroy(void *state);

#endif
