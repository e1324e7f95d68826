/* Cones of spots against positions and boxes, random and adversarial: does a box that the cone is said not to
 * meet (kernels/spot.h) hold no position that it lights, to the last bit? And does it light what is in it? */
#ifndef TL_TEST_CONE_FAMILIES_H
#define TL_TEST_CONE_FAMILIES_H

#include "bounds/draws.h"
#include "bounds/tally.h"

/* A light, the direction and the half-angle of its cone, and a box around a position. */
typedef struct tl_cone_case {
    float light[3], direction[3], half_angle; /* m, of any length, radians */
    float low[3], high[3], position[3];
} tl_cone_case;

typedef struct tl_cone_family {
    const char *name;
    tl_cone_case (*draw)(tl_draws *draws);
} tl_cone_family;

enum { TL_CONE_FAMILIES = 12 };
extern const tl_cone_family tl_cone_families[TL_CONE_FAMILIES];

#endif
