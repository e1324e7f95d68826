/* What a job does to its lit picture before it is written. */
#ifndef TL_JOB_POST_H
#define TL_JOB_POST_H

#include "job.h"
#include "lighting_options.h"

/* Runs the stages that the choice and the frame call for, and says what they came to. The job's image becomes
 * what they make of it. */
tl_status job_post(job *j, const lighting_choice *choice, tl_device *device, tl_error *err);

#endif
