/* Quantities of a pixel with all that float may make of them: intervals, in double. allowance.c has the
 * rules. Included by files that are compiled in double. */
#ifndef TL_ROUGH_H
#define TL_ROUGH_H

#include "lit_pixel.h"

static const double U = 0x1p-24 * (1.0 + 0x1p-10);
static const double flushed = 0x1p-124; /* four operations, each flushed below 2^-126 */
static const double division = 5.0, root = 6.0, power = 32.0; /* u */

typedef struct interval {
    double low, high;
} interval;

static inline double clamp_low(double x)
{
    return x > 0.0 ? x : 0.0;
}

/* Of numbers that are not negative: what `roundings` steps may make of them. */
static inline interval rounded(interval a, double roundings)
{
    return (interval){clamp_low(a.low * (1.0 - roundings * U) - flushed),
                      a.high * (1.0 + roundings * U) + flushed};
}

static inline interval times(interval a, interval b)
{
    return rounded((interval){a.low * b.low, a.high * b.high}, 1.0);
}

static inline interval around(double value, double error)
{
    return (interval){clamp_low(value - error), value + error};
}

static inline interval at_most(interval a, double most)
{
    return (interval){a.low < most ? a.low : most, a.high < most ? a.high : most};
}

/* A surface, and how far a kernel's may be from it. */
typedef struct rough_surface {
    surface exact;
    size_t at; /* in the planes of the frame */
    substance made;
    tl_u32 model, traits;
    double moved_x, moved_y; /* m; of the position. z is the depth, exact */
    double normal_moved;     /* of the direction of the normal */
    double eye_moved;        /* of to_eye, in any direction */
    int is_lit;              /* 0: it has no normal, and no light reaches it */
    int has_normal, has_eye; /* 0: its square leaves the range of float */
    interval exponent, alpha2;
    tl_off off; /* of what kernels approximate */
} rough_surface;

/* The way to a light. A directional light has no position: l is its unit vector, as given. */
typedef struct way {
    vec3 l;
    double l_moved;               /* m, in any direction */
    double exact;                 /* m, |l| */
    interval distance, distance2; /* as computed */
    double root_off;              /* share of itself that 1/|l| is approximated to */
    int may_reach, does_reach;
} way;

/* n.l / |l|. */
typedef struct incidence {
    double exact;
    interval cosine; /* 0 where n.l <= 0 */
    int may_be_above, is_above;
} incidence;

#endif
