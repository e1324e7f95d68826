#include "farm_schedulers.h"

const tl_farm_scheduler tl_farm_schedulers[TL_FARM_SCHEDULER_COUNT] = {
    {"slurm", "a script for sbatch: an array job, and a gather behind it",
     TL_FARM_PROCESSORS | TL_FARM_MEMORY | TL_FARM_TIME | TL_FARM_PARTITION, true, false,
     tl_farm_print_slurm},
    {"openjd", "a job template of Open Job Description (2023-09), in JSON",
     TL_FARM_PROCESSORS | TL_FARM_MEMORY | TL_FARM_TIME, false, true, tl_farm_print_openjd},
    {"parallel", "a script around GNU parallel, on one machine or several over ssh",
     TL_FARM_MEMORY | TL_FARM_TIME, false, false, tl_farm_print_parallel},
};
