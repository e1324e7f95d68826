/* A scene as rays meet it: the triangles that capture draws, in Embree, and holes where its materials have
 * them. What shadow maps are held against. */
#ifndef TL_RAY_SCENE_H
#define TL_RAY_SCENE_H

#include "tilelight/error.h"

#include <stdbool.h>

typedef struct ray_scene ray_scene;

/* The default scene of a file, at rest. The caller releases *out with ray_scene_close. Fails as tl_capture
 * does, and with TL_ERR_DEVICE where Embree does not start. */
tl_status ray_scene_open(const char *path, ray_scene **out, tl_error *err);

/* Accepts NULL. */
void ray_scene_close(ray_scene *scene);

/* Whether anything is on the way from `from` in `direction`, of unit length, between `near` and `far`, m, in
 * world space. On any thread. */
bool ray_scene_blocks(const ray_scene *scene,
                      const double from[3],
                      const double direction[3],
                      double near,
                      double far);

/* The normal of the first triangle on such a way, of unit length, on the side that the ray comes from. False:
 * there is none, and `normal` is left alone. On any thread. */
bool ray_scene_normal(const ray_scene *scene,
                      const double from[3],
                      const double direction[3],
                      double near,
                      double far,
                      double normal[3]);

#endif
