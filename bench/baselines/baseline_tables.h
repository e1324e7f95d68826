/* The functions behind the rows of baselines.c. */
#ifndef TL_BASELINE_TABLES_H
#define TL_BASELINE_TABLES_H

#include "baselines.h"
#include "needs.h"

/* Fails with TL_ERR_UNSUPPORTED where the frame has spot lights, or a shading model or a falloff
 * outside these: bits 1 << row of kernels/models.h and of kernels/falloff.h. */
tl_status tl_baseline_check(const tl_needs *needs,
                            uint32_t models,
                            uint32_t falloffs,
                            tl_error *err);

tl_status hand_create_exact(const tl_baseline_input *input, void **out, tl_error *err);
tl_status hand_create_relaxed(const tl_baseline_input *input, void **out, tl_error *err);
tl_status hand_run(void *state, tl_image *image, tl_timings *timings, tl_error *err);
void hand_destroy(void *state);

tl_status multipass_create_quads(const tl_baseline_input *input, void **out, tl_error *err);
tl_status multipass_create_volumes(const tl_baseline_input *input, void **out, tl_error *err);
tl_status multipass_run(void *state, tl_image *image, tl_timings *timings, tl_error *err);
void multipass_destroy(void *state);

tl_status classic_create(const tl_baseline_input *input, void **out, tl_error *err);
tl_status classic_run(void *state, tl_image *image, tl_timings *timings, tl_error *err);
void classic_destroy(void *state);

tl_status brute_create(const tl_baseline_input *input, void **out, tl_error *err);
tl_status brute_run(void *state, tl_image *image, tl_timings *timings, tl_error *err);
void brute_destroy(void *state);

#endif
