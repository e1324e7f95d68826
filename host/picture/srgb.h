/* The transfer function of screens. */
#ifndef TL_SRGB_H
#define TL_SRGB_H

#include <math.h>

/* IEC 61966-2-1, from encoded to linear, both 0 to 1. */
static inline double tl_linear_from_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

#endif
