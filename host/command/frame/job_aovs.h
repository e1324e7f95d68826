/* The layers of a job's picture. */
#ifndef TL_JOB_AOVS_H
#define TL_JOB_AOVS_H

#include "job.h"
#include "lighter.h"
#include "lighting_options.h"

/* Takes the terms of the picture that was just lit, which leaves a picture without parts, and lights groups
 * of lights by themselves, as the choice asks for; where it asks for none, nothing. with: what
 * lit it. Fails as tl_lighting_run does, and with TL_ERR_ARGUMENT where two groups have one name in a
 * file. */
tl_status job_take_aovs(job *j, const lighting_choice *choice, lighter *with, tl_error *err);

#endif
