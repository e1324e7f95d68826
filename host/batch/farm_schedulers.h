/* What hands chunks to workers: a row for each scheduler that a plan can be written for. */
#ifndef TL_FARM_SCHEDULERS_H
#define TL_FARM_SCHEDULERS_H

#include "farm_plan.h"

#include <stdbool.h>
#include <stdio.h>

/* Which needs a scheduler can be told. */
enum { TL_FARM_PROCESSORS = 1, TL_FARM_MEMORY = 2, TL_FARM_TIME = 4, TL_FARM_PARTITION = 8 };

typedef struct tl_farm_scheduler {
    const char *name, *summary;
    unsigned takes; /* of the above */
    bool submits;   /* by tilelight itself */
    bool progress;  /* is told it by workers, on their standard output */
    /* Writes the plan. Fails with TL_ERR_ARGUMENT, saying what, for a plan that the scheduler cannot be told,
     * before anything is written; TL_ERR_MEMORY. Whether `out` took it is the caller's to ask. */
    tl_status (*print)(const tl_farm_plan *plan, FILE *out, tl_error *err);
} tl_farm_scheduler;

enum { TL_FARM_SCHEDULER_COUNT = 3 };
extern const tl_farm_scheduler tl_farm_schedulers[TL_FARM_SCHEDULER_COUNT];

/* The printers of the rows. */
tl_status tl_farm_print_slurm(const tl_farm_plan *plan, FILE *out, tl_error *err);
tl_status tl_farm_print_openjd(const tl_farm_plan *plan, FILE *out, tl_error *err);
tl_status tl_farm_print_parallel(const tl_farm_plan *plan, FILE *out, tl_error *err);

#endif
