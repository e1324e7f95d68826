/* The transfer function of screens. */
#ifndef TL_SRGB_H
#define TL_SRGB_H

#include <math.h>

/* IEC 61966-2-1, from encoded to linear, both 0 to 1. */
static inline double tl_linear_from_srgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

/* And back. */
static inline double tl_srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

#endif
