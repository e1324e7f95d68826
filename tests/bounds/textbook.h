/* How others bound spheres, for tests to show what such bounds lose: each formula as it is used, in float.
 * The image is centred. */
#ifndef TL_TEST_TEXTBOOK_H
#define TL_TEST_TEXTBOOK_H

#include "bounds/sphere_verdict.h"

/* Policarpo and Fonseca 2005, "Deferred Shading Tutorial", listing 16, after Lengyel 2002: the planes through
 * the eye that touch the sphere, by the quadratic for their normals; without a near plane; both ends cut to
 * whole pixels. Its focal length is that of the camera here, where the listing has it written in. */
tl_pixel_rect tl_listing_16(const tl_sphere_case *of);

/* Mara and McGuire 2013, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere": tangent points
 * by a rotation, and the circle's crossings of the near plane. Ends are rounded outwards to whole pixels. */
tl_pixel_rect tl_mara_mcguire(const tl_sphere_case *of);

#endif
