/* The end of a job that lights: its pictures. */
#ifndef TL_JOB_PICTURES_H
#define TL_JOB_PICTURES_H

#include "job.h"
#include "picture_options.h"

/* A picture for each output; the job's image stays linear. */
tl_status job_write_pictures(job *j, const picture_options *options, tl_error *err);

#endif
