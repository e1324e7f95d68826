/* How far what is read from a packed G-buffer may lie from what was packed: a bound per layout, plane and
 * value, computed from the layout's row (kernels/layout.h). host/gbuffer/error_bounds.c derives them,
 * tests/test_layout_round_trip.c asserts them.
 *
 * What was packed is the full-float G-buffer that tl_gbuffer_pack was given (metallic and roughness mapped
 * to Phong where it does so), what is read is in float as kernels and tl_gbuffer_unpack do it. Values
 * beyond tl_layout_range are cut and have no bound. Nothing here can fail. */
#ifndef TL_ERROR_BOUNDS_H
#define TL_ERROR_BOUNDS_H

#include "gbuffer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of a surface at `view`, view space, m: how far each coordinate of the position that is lit may be off,
 * m. Where the layout stores depth, bound[2] is the error of depth and the others follow along the
 * pixel's ray. */
void tl_position_bound(const tl_camera *camera,
                       enum tl_layout_name layout,
                       const double view[3],
                       double bound[3]);

/* rad, up to pi. normal: in world space, of any length but 0. */
double tl_normal_bound(const tl_camera *camera,
                       enum tl_layout_name layout,
                       const double normal[3]);

/* rad; of a tangent of any length but 0, which the layout holds. */
double tl_tangent_bound(enum tl_layout_name layout, const double tangent[3]);

/* Of any other plane that the layout holds, in its own unit. values: of a colour all three channels,
 * whichever of its planes is asked for; of others values[0] alone is read. */
double tl_value_bound(enum tl_layout_name layout, enum tl_plane plane, const double values[3]);

/* What a plane can say: values from *low to *high, others are cut and counted
 * (tl_packing_report). Of TL_DEPTH: depths, m; where positions are stored, their coordinates, which are
 * in world space for some. Of normals [-1, 1]: they are made unit. *high may be +infinity. */
void tl_layout_range(const tl_camera *camera,
                     enum tl_layout_name layout,
                     enum tl_plane plane,
                     double *low,
                     double *high);

#define TL_FAR_OF_NONE 1e6 /* where there is no far plane: times the near plane's distance */

/* The largest bounds of a layout, to compare layouts by; 0 is exact, and is what planes have that the
 * layout cannot hold (tl_layout_planes). */
typedef struct tl_layout_errors {
    /* Of depth in a corner of the image, on either plane: relative; m of an orthographic camera. */
    double depth_near, depth_far;
    /* rad; of normals with z >= 0 in view space, as nearly all are that a camera sees; and of all. */
    double normal, any_normal;
    double albedo, specular; /* of values in [0, 1] */
    bool specular_is_gray;   /* plus half of what the least and greatest channel are apart */
    double shininess;        /* of 1 + exponent, relative */
    double metallic, roughness, occlusion;
    double emissive; /* where all three channels are 1 */
} tl_layout_errors;

tl_layout_errors tl_layout_errors_of(const tl_camera *camera, enum tl_layout_name layout);

#ifdef __cplusplus
}
#endif

#endif
