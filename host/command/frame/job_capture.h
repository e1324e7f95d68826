/* The capturing step of a job. */
#ifndef TL_JOB_CAPTURE_H
#define TL_JOB_CAPTURE_H

#include "capture_options.h"
#include "job.h"

/* A G-buffer of the scene, repaired; with the scene's lights where none were given. */
tl_status job_capture(
    job *j, const char *scene, const tl_capture_options *options, bool strict, tl_error *err);

#endif
