/* Planes of surroundings on the CPU: what kernels/occlude.cl computes. */
#ifndef TL_SURROUND_H
#define TL_SURROUND_H

#include "packing.h"
#include "reference.h"

/* The steps of it, each for all rows before the next. */
typedef enum tl_surround_step {
    TL_SURROUND_GATHER,
    TL_SURROUND_OCCLUDE,
    TL_SURROUND_SMOOTH,
    TL_SURROUND_STEP_COUNT
} tl_surround_step;

/* What every twin of it is called with: rows [begin, end) of one step. */
typedef void tl_surround_rows(const tl_prepared *prepared,
                              const tl_word_planes *planes,
                              tl_surround_step step,
                              size_t begin,
                              size_t end);

/* Fills the planes behind the sections of prepared->lights, on all threads, in the arithmetic that kernels of
 * it have; where the frame needs none, nothing. Cannot fail. */
void tl_reference_surround(const tl_prepared *prepared,
                           const tl_gbuffer *gbuffer,
                           tl_arithmetic arithmetic);

#endif
