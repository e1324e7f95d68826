/* One captured frame's way to its pictures, what `light` and `batch` share: it is read, then lit, then its
 * pictures are written (job_pictures.h). Lighting needs what lights; of the others as many may be under way as
 * there are jobs. */
#ifndef TL_FRAME_STEPS_H
#define TL_FRAME_STEPS_H

#include "explain.h"
#include "frame_options.h"
#include "job.h"
#include "lighter.h"

/* The G-buffer of a capture, repaired, and cut to what the region needs. input: as job_read. */
tl_status frame_read(job *j,
                     const frame_options *options,
                     const char *input,
                     const lighter *with,
                     tl_error *err);

/* Its picture, after all stages, and what screens show of it. told: as job_light. */
tl_status frame_light(
    job *j, const frame_options *options, lighter *with, explained *told, tl_error *err);

#endif
