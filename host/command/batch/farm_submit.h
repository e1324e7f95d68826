/* Handing a plan to Slurm. */
#ifndef TL_FARM_SUBMIT_H
#define TL_FARM_SUBMIT_H

#include "farm_plan.h"

/* Submits the array job, and the gather to run once all of it has ended, and says their numbers on standard
 * output. Fails with TL_ERR_UNSUPPORTED where there is no sbatch, TL_ERR_WRITE where it refuses, which it
 * says itself on standard error; where only the gather was refused, the message says which job runs. */
tl_status farm_submit(const tl_farm_plan *plan, tl_error *err);

#endif
