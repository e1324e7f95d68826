/* The camera of a frame: where it stands and which rays it sees.
 *
 * View space is right-handed: +x right, +y up, looking along -z; `depth` is -z, positive in front.
 * Pixel (0, 0) is the top left, its centre is (0.5, 0.5). */
#ifndef TL_CAMERA_H
#define TL_CAMERA_H

#include "error.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TL_MAX_EXTENT = 16384 }; /* px per side, of anything */

typedef enum tl_projection { TL_PERSPECTIVE, TL_ORTHOGRAPHIC } tl_projection;

typedef struct tl_camera {
    tl_projection projection;
    uint32_t width, height; /* px, 1 to TL_MAX_EXTENT */
    /* Edges of the image. Perspective: x/depth and y/depth (tangents, signed). Orthographic: x
     * and y in m. left < right, bottom < top; off-centre is allowed. */
    float left, right, bottom, top;
    float near,
        far; /* m; 0 < near < far, far may be INFINITY. Orthographic: near may be <= 0 */
    /* view = view_from_world * (x, y, z, 1): a rotation and a translation in m, row-major. */
    float view_from_world[3][4];
    /* Of a part of a picture (tl_gbuffer_cut): where in it its upper left pixel is, and the size of the
     * picture, whose edges those above are. All 0: it is the whole picture. */
    uint32_t window_x, window_y, whole_width, whole_height;
} tl_camera;

/* Of the picture that the edges are of, px. */
static inline uint32_t tl_camera_whole_width(const tl_camera *camera)
{
    return camera->whole_width ? camera->whole_width : camera->width;
}
static inline uint32_t tl_camera_whole_height(const tl_camera *camera)
{
    return camera->whole_height ? camera->whole_height : camera->height;
}

/* Whether its upper left pixel is another one than the picture's. */
static inline int tl_camera_is_moved(const tl_camera *camera)
{
    return camera->window_x != 0 || camera->window_y != 0;
}

/* Fails with TL_ERR_ARGUMENT, saying which field is outside the ranges above, for a value that is
 * not finite, and for a view_from_world whose rows are not orthonormal to 1e-3. */
tl_status tl_camera_check(const tl_camera *camera, tl_error *err);

/* World to view and back; computed in double from the camera's floats. Cannot fail. */
void tl_camera_view_point(const tl_camera *camera, const double world[3], double view[3]);
void tl_camera_view_direction(const tl_camera *camera, const double world[3], double view[3]);
void tl_camera_world_point(const tl_camera *camera, const double view[3], double world[3]);
void tl_camera_world_direction(const tl_camera *camera, const double view[3], double world[3]);

/* Gives it the edges of a centred image, of which these two are the right and the top one. */
void tl_camera_center(tl_camera *camera, double right, double top);

/* A perspective camera at `eye` that looks at `target` with `up` above it. vertical_fov is the
 * full angle in radians, in (0, pi). The caller has checked that the three points span a plane. */
tl_camera tl_camera_look_at(const double eye[3],
                            const double target[3],
                            const double up[3],
                            double vertical_fov,
                            uint32_t width,
                            uint32_t height,
                            double near,
                            double far);

#ifdef __cplusplus
}
#endif

#endif
