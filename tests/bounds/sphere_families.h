/* Spheres before cameras, random and adversarial: what is hard for bounds, one family each. */
#ifndef TL_TEST_SPHERE_FAMILIES_H
#define TL_TEST_SPHERE_FAMILIES_H

#include "bounds/draws.h"
#include "bounds/sphere_verdict.h"

typedef struct tl_sphere_family {
    const char *name;
    tl_sphere_case (*draw)(tl_draws *draws);
} tl_sphere_family;

enum { TL_SPHERE_FAMILIES = 23 };
extern const tl_sphere_family tl_sphere_families[TL_SPHERE_FAMILIES];

/* Hard cases by name, for near 0.1 m and far 100 m. */
typedef struct tl_named_sphere {
    const char *name;
    float center[3], radius;
} tl_named_sphere;

enum { TL_NAMED_SPHERES = 28 };
extern const tl_named_sphere tl_named_spheres[TL_NAMED_SPHERES];

/* View space is world space. fov: of the height, in degrees; offset: of the image's centre from the view
 * axis, in half widths. */
tl_camera tl_test_camera(double fov, double offset, uint32_t width, uint32_t height);

#endif
