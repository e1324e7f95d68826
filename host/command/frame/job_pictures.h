/* The end of a job that lights: its pictures. */
#ifndef TL_JOB_PICTURES_H
#define TL_JOB_PICTURES_H

#include "job.h"
#include "lighter.h"
#include "picture_options.h"

/* Makes the codes of PNGs where any output is one; the job's image stays linear. Codes that are computed pixel
 * by pixel are, by what lit it; those of thresholds are the host's, which needs no program for them. */
tl_status job_show_pictures(job *j,
                            const picture_options *options,
                            const tl_lighting_options *lighting,
                            lighter *with,
                            tl_error *err);

/* A picture for each output, of the job's image and codes. Needs no device. */
tl_status job_write_pictures(job *j, const picture_options *options, tl_error *err);

#endif
