/* Why one pixel's error is what it is. */
#ifndef TL_STUDY_WORST_H
#define TL_STUDY_WORST_H

#include "pictures.h"

/* Of a pixel whose G-buffer is `config`'s: the attribute that, taken from full float instead, lowers the
 * error most, and the share of the exact radiance that is highlight. In double, by the reference, from
 * numbers as float kernels read them; a stored position counts by its depth alone. attribute: a string
 * literal, "" where nothing lowers it. Fails as tl_lighting_run does, or with TL_ERR_MEMORY. */
tl_status tl_study_worst_find(tl_study_pictures *pictures,
                              const tl_study_config *config,
                              uint32_t x,
                              uint32_t y,
                              uint32_t channel,
                              const char **attribute,
                              double *highlight,
                              tl_error *err);

#endif
