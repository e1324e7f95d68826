/* The lighting step of a job whose picture is to keep something. */
#ifndef TL_JOB_PROMISE_H
#define TL_JOB_PROMISE_H

#include "goal.h"
#include "job_light.h"

/* From the job's G-buffer and lights to its image, which is there. Says what was chosen and found. *options
 * becomes what the picture was lit with; the caller destroys *lighting. */
tl_status job_promise_light(job *j,
                            const tl_goal *goal,
                            tl_device *device,
                            tl_lighting_options *options,
                            tl_lighting_counts *counts,
                            tl_lighting **lighting,
                            tl_error *err);

#endif
