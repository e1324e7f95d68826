/* How far a configuration's picture is off, and by which causes. */
#ifndef TL_STUDY_STEPS_H
#define TL_STUDY_STEPS_H

#include "pictures.h"
#include "values.h"

/* Fills in the errors of `record`, by its configuration: the whole, and cause by cause. Each cause is what
 * changes from the picture in which its knobs and all later ones are exact to the one in which its own are
 * as configured; these differences add up to the whole, value by value. map (may be NULL): [height][width],
 * the largest error of each pixel's channels. Fails as tl_study_picture does, or as
 * tl_image_write_exr and tl_image_read. */
tl_status tl_study_steps_find(tl_study_pictures *pictures,
                              tl_study_record *record,
                              float *map,
                              tl_error *err);

#endif
