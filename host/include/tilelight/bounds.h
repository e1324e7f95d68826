/* Screen bounds of spheres: which pixels a light may reach. */
#ifndef TL_BOUNDS_H
#define TL_BOUNDS_H

#include "camera.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Pixels [x0, x1) x [y0, y1); all 0 when empty. */
typedef struct tl_pixel_rect {
    uint32_t x0, y0, x1, y1;
} tl_pixel_rect;

/* The pixels whose rays may meet the sphere between the near and the far plane.
 *
 * center is in view space, radius >= 0, both in m. Per axis, the exact interval of x/depth (y/depth;
 * x, y for an orthographic camera) over the part of the sphere between near and far, the other
 * axis ignored. *out keeps every pixel whose centre lies in the closed intervals and at most one
 * more per side; it is empty exactly when an axis is empty or off the image (by more than 14 roundings
 * of double at the image's edge; closer to it, either). For every finite input; a value that is not
 * finite gives the whole image. Cannot fail. */
void tl_sphere_bounds(const tl_camera *camera,
                      const float center[3],
                      float radius,
                      tl_pixel_rect *out);

#ifdef __cplusplus
}
#endif

#endif
