/* Vectors of 128-bit floats, and angles between them that keep their digits at both ends. v = 2^-113. */
#ifndef TL_ORACLE_VECTORS_H
#define TL_ORACLE_VECTORS_H

#include "oracle/wide.h"

typedef struct wide3 {
    wide x, y, z;
} wide3;

static inline wide3 wide3_of(const float f[3])
{
    return (wide3){f[0], f[1], f[2]};
}

/* a + k b */
static inline wide3 wide3_sum(wide3 a, wide k, wide3 b)
{
    return (wide3){a.x + k * b.x, a.y + k * b.y, a.z + k * b.z};
}

static inline wide wide3_dot(wide3 a, wide3 b)
{
    return wide_sum3(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline wide3 wide3_cross(wide3 a, wide3 b)
{
    return (wide3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline wide wide3_length(wide3 a)
{
    return sqrtq(wide3_dot(a, a));
}

/* Of any length but 0. */
static inline wide3 wide3_unit(wide3 a)
{
    const wide3 none = {0, 0, 0};
    return wide3_sum(none, 1 / wide3_length(a), a);
}

/* In [0, pi], off by 10v: each part of the tangent by 3v of the product of lengths. */
static inline wide wide3_angle(wide3 a, wide3 b)
{
    return atan2q(wide3_length(wide3_cross(a, b)), wide3_dot(a, b));
}

#endif
