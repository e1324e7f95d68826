/* Spheres held against the pixels that they reach. */
#ifndef TL_SPHERE_PIXELS_H
#define TL_SPHERE_PIXELS_H

#include "hard_case.h"

/* Whether a usual form keeps the pixel for the sphere, whose centre is in view space. */
typedef int hard_keeps(
    const tl_camera *camera, const float centre[3], float radius, uint32_t x, uint32_t y);

/* The most usual one: the centre's place on the screen, and radius over depth around it; nothing of a centre
 * behind the eye. */
hard_keeps hard_around_centre;

/* Counts every pair of a pixel and a light that reaches it, and lights the frame. Takes both. */
void hard_try_spheres(hard_bench *bench,
                      tl_gbuffer *g,
                      tl_light_set *lights,
                      hard_keeps *usually);

#endif
