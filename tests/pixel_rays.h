/* The rays of a picture's pixels, and what of a scene they ought to hit: to check captures by. */
#ifndef TL_PIXEL_RAYS_H
#define TL_PIXEL_RAYS_H

#include "gltf_scene.h"

/* From the eye, or the plane of depth 0; a step along `along` is a metre of depth. World space. */
typedef struct pixel_ray {
    double from[3], along[3];
} pixel_ray;

/* Through (x, y) of the image, in pixels; (0.5, 0.5) is the first one's centre. */
static inline pixel_ray ray_through(const tl_camera *camera, double x, double y)
{
    const double across = (double)camera->left +
                          x / camera->width * ((double)camera->right - (double)camera->left);
    const double upward = (double)camera->top -
                          y / camera->height * ((double)camera->top - (double)camera->bottom);
    const double view[2][3] = {{0, 0, 0}, {across, upward, -1}};
    pixel_ray ray;
    double beyond[3];
    assert_int_equal(camera->projection, TL_PERSPECTIVE);
    tl_camera_world_point(camera, view[0], ray.from);
    tl_camera_world_point(camera, view[1], beyond);
    for (int c = 0; c < 3; c++)
        ray.along[c] = beyond[c] - ray.from[c];
    return ray;
}

/* How a pixel differs from what `hit` says, the depth of a ray or INFINITY. Where what is hit changes
 * within a hundredth of a pixel, either will do. Pixels compared are counted. */
static inline void assert_depths(const shot *taken,
                                 double (*hit)(const void *scene, const pixel_ray *ray),
                                 const void *scene,
                                 double within,
                                 size_t *surface_count)
{
    static const double offsets[5][2] = {{0, 0}, {0.01, 0}, {-0.01, 0}, {0, 0.01}, {0, -0.01}};
    const tl_camera *const camera = &taken->gbuffer->camera;
    *surface_count = 0;
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++) {
            const double depth = (double)shown_at(taken, TL_DEPTH, x, y);
            double nearest = INFINITY, farthest = -INFINITY;
            for (int i = 0; i < 5; i++) {
                const pixel_ray ray =
                    ray_through(camera, x + 0.5 + offsets[i][0], y + 0.5 + offsets[i][1]);
                const double expected = hit(scene, &ray);
                nearest = fmin(nearest, expected);
                farthest = fmax(farthest, expected);
            }
            if (isfinite(nearest) != isfinite(farthest) || farthest - nearest > 0.05 * nearest)
                continue;
            *surface_count += isfinite(nearest) != 0;
            if (isfinite(depth) != isfinite(nearest) ||
                (isfinite(depth) &&
                 !(depth >= nearest * (1 - within) && depth <= farthest * (1 + within))))
                fail_msg("pixel %u, %u: depth %.9g, want %.9g to %.9g", x, y, depth, nearest,
                         farthest);
        }
}

#endif
