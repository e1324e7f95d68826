/* Moments of a sky's light, from which its irradiance follows (kernels/sky_light.h). */
#ifndef TL_SKY_MOMENTS_H
#define TL_SKY_MOMENTS_H

#include "sky_source.h"

/* Of one channel, with d the unit direction (right, up, ahead) that light L comes from, over all solid
 * angle. */
typedef struct tl_sky_moments {
    double light;        /* of L */
    double first[3];     /* of L d */
    double second[3][3]; /* of L d d^T */
    double power;        /* of L^2 */
} tl_sky_moments;

/* The integrals over every texel in closed form; rows on all threads, added up in their order, so that bits
 * do not depend on threads. Fails with TL_ERR_MEMORY. */
tl_status tl_sky_moments_of(const tl_sky_source *source, tl_sky_moments out[3], tl_error *err);

/* What nine spherical harmonics may leave out of the irradiance over pi in any direction; derived in
 * docs/sky-light.md. Two bounds hold; the smaller one. */
double tl_sky_truncation(const tl_sky_moments *of);

#endif
