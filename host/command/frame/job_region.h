/* A part of a job's picture: what of the G-buffer it takes, and the pictures cut to it. */
#ifndef TL_JOB_REGION_H
#define TL_JOB_REGION_H

#include "job.h"
#include "lighting_options.h"
#include "post_options.h"

/* Cuts the G-buffer to what lighting and the stages after it read for the region; of none (width 0) it does
 * nothing. Fails with TL_ERR_ARGUMENT where the region leaves the picture, and with TL_ERR_MEMORY. */
tl_status job_cut_region(job *j,
                         const tl_region *region,
                         const lighting_choice *lighting,
                         const post_choice *post,
                         tl_device *device,
                         tl_error *err);

/* Cuts the job's picture and its layers to the region, once they are pixels. Fails with TL_ERR_MEMORY. */
tl_status job_crop_pictures(job *j, const tl_region *region, tl_error *err);

#endif
