/* How radiance is shown for FLIP: Andersson et al. 2021, sections 4 and 5. */
#ifndef TL_FLIP_EXPOSURES_H
#define TL_FLIP_EXPOSURES_H

#include "tilelight/image.h"

typedef struct flip_exposures {
    double first, last; /* stops */
    uint32_t count;     /* at least 2, evenly spaced; 0 for a picture without light */
} flip_exposures;

/* Of a picture of radiance. Fails with TL_ERR_MEMORY. */
tl_status flip_exposures_find(const tl_image *reference, flip_exposures *out, tl_error *err);

/* Radiance, times 2^exposure, to what a screen shows of it, linear, 0 to 1. NaN and what is below 0
 * are 0. */
float flip_tone(float radiance, float scale);

#endif
