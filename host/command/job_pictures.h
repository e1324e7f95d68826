/* The end of a job that lights: its pictures. */
#ifndef TL_JOB_PICTURES_H
#define TL_JOB_PICTURES_H

#include "job.h"
#include "picture_options.h"

/* A picture for each output; the job's image stays linear. Codes that are computed pixel by pixel are, on the
 * device that lights; those of thresholds are the host's, which needs no program for them. */
tl_status job_write_pictures(job *j,
                             const picture_options *options,
                             const tl_lighting_options *lighting,
                             tl_device *device,
                             tl_error *err);

#endif
