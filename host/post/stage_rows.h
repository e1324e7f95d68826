/* Stages after lighting in C: what the text of their kernels, compiled once per arithmetic, is called
 * with. */
#ifndef TL_STAGE_ROWS_H
#define TL_STAGE_ROWS_H

#include "bloom.h"
#include "edges.h"
#include "packing.h"

#include <stddef.h>
#include <stdint.h>

/* Steps of stages, each for all rows before the next.
 * X(name) */
#define TL_POST_STEPS(X)            \
    X(TL_POST_STEP_COUNT_NO_COLORS) \
    X(TL_POST_STEP_MEND)            \
    X(TL_POST_STEP_GATHER_EDGES)    \
    X(TL_POST_STEP_SMOOTH_EDGES)    \
    X(TL_POST_STEP_GATHER_BRIGHT)   \
    X(TL_POST_STEP_BLUR_ACROSS)     \
    X(TL_POST_STEP_BLUR_DOWN)       \
    X(TL_POST_STEP_ADD_GLOW)

typedef enum tl_post_step {
#define TL_POST_STEP_NAME(name) name,
    TL_POST_STEPS(TL_POST_STEP_NAME)
#undef TL_POST_STEP_NAME
        TL_POST_STEP_COUNT
} tl_post_step;

/* What a step works on; what it does not need is 0. */
typedef struct tl_post_rows_job {
    tl_view_picture view;
    const float *from; /* as POST_FROM */
    float *to;
    uint64_t count; /* is raised */
    float *numbers; /* between the steps of a stage */
    const tl_view_gather *gather;
    const tl_needs *needs;
    const tl_word_planes *planes;
    const tl_view_edge_stage *edges;
    float *blurred; /* what becomes of `numbers` */
    const tl_view_bloom_stage *bloom;
} tl_post_rows_job;

/* What every twin of them is called with: rows [begin, end). */
typedef void tl_post_rows_twin(tl_post_rows_job *job,
                               tl_post_step step,
                               size_t begin,
                               size_t end);

#endif
