/* What kernels may make of the sky's light on a surface (kernels/sky_light.h). */
#ifndef TL_ALLOWANCE_SKY_H
#define TL_ALLOWANCE_SKY_H

#include "rough.h"

/* Of light that surfaces receive: received.sky and .mirrored, and shares of the second. */
typedef struct rough_sky {
    interval diffuse[3], mirrored[3], base, grazing;
} rough_sky;

/* Of a frame that the sky lights. arrives: what surroundings let through, exact. f90: tl_rough_f90 of the
 * surface. */
rough_sky tl_rough_sky(const tl_prepared *prepared,
                       const rough_surface *s,
                       double arrives,
                       interval f90);

#endif
