/* Directions made from others. */
#ifndef TL_TEST_DIRECTIONS_H
#define TL_TEST_DIRECTIONS_H

#include <math.h>

/* The direction that is `angle` away from `from`, on the side of `other`: both of length 1, and not along one
 * line. */
static inline void turn_towards(const double from[3],
                                const double other[3],
                                double angle,
                                double out[3])
{
    double across[3], along = 0.0, length2 = 0.0;
    for (int i = 0; i < 3; i++)
        along += other[i] * from[i];
    for (int i = 0; i < 3; i++) {
        across[i] = other[i] - along * from[i];
        length2 += across[i] * across[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = cos(angle) * from[i] + sin(angle) * across[i] / sqrt(length2);
}

#endif
