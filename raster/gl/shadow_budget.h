/* How shadow maps share the memory that all may take. */
#ifndef TL_SHADOW_BUDGET_H
#define TL_SHADOW_BUDGET_H

#include "tilelight/report.h"

#include <stddef.h>
#include <stdint.h>

/* Of one map. */
typedef struct tl_shadow_need {
    uint32_t views, size; /* texels each way, of each view */
    double pixels;        /* how many its light may reach, in any unit */
} tl_shadow_need;

/* Lessens sizes, to TL_LEAST_SHADOW_SIZE at most, until all maps take no more than `memory` bytes, which is
 * told: so that the fewest pixels lie along edges of shadows that have become coarser. Fails with
 * TL_ERR_ARGUMENT where no sizes are small enough. */
tl_status tl_shadow_budget(uint64_t memory,
                           tl_shadow_need *needs,
                           size_t count,
                           const tl_notices *notices,
                           tl_error *err);

#endif
