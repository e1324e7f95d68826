/* The memory of one thread of the hand-written baselines, kept from frame to frame. */
#ifndef TL_HAND_WORKER_H
#define TL_HAND_WORKER_H

#include "hand.h"

typedef struct hand_worker {
    hand_candidates candidates;
    float *values;              /* what candidates' arrays of floats stand in */
    const tl_view_light **list; /* [list_capacity], the lists of a row of tiles, one by one */
    size_t list_length, list_capacity;
    size_t ends[TL_MAX_EXTENT / HAND_TILE]; /* where each tile's list ends */
    double list_seconds, shade_seconds;     /* since they were last asked for */
    bool failed;                            /* memory ran out */
} hand_worker;

/* For up to light_count candidates. Fails with TL_ERR_MEMORY. */
tl_status hand_worker_create(hand_worker *worker, size_t light_count, tl_error *err);

/* Accepts one that is all zero. */
void hand_worker_clear(hand_worker *worker);

/* Finds the candidates of a row of tiles, in index order. */
void hand_worker_collect(hand_worker *worker, const hand_frame *frame, uint32_t row);

/* Where `count` more lights of the row's lists go; NULL, and `failed`, out of memory. */
const tl_view_light **hand_worker_reserve(hand_worker *worker, size_t count);

#endif
