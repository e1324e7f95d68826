/* What a job does to its lit picture before it is written. */
#ifndef TL_JOB_POST_H
#define TL_JOB_POST_H

#include "job.h"
#include "lighter.h"
#include "lighting_options.h"
#include "picture_options.h"
#include "post_options.h"

/* Runs the stages that the choice and the frame call for, by the exposure of the pictures, with what
 * lit it, and says what they came to. The job's image becomes what they make of it. */
tl_status job_post(job *j,
                   const post_choice *choice,
                   const picture_options *pictures,
                   const tl_lighting_options *lighting,
                   lighter *with,
                   tl_error *err);

/* Which stages ran and why, for --explain: on standard error. */
void job_post_explain(const job *j,
                      const post_choice *choice,
                      const tl_lighting_options *lighting);

#endif
