/* Which tiles a light with a range may reach: the broad phase of culling.
 *
 * The rectangle may be too large but never too small. What is in it is decided by reach.h, on
 * computed positions, so three margins stand between the exact interval of the sphere and the
 * tiles that are kept (u = 2^-24):
 *   1. range. Computed d2 < range2 allows an exact distance up to sqrt(range2 (1 + 8u)): six
 *      roundings in d2. Where a device flushes denormals, squares below 2^-63 m (1.1e-19) vanish in each
 *      of three axes, so more than that is added; where none does, they vanish below 1e-22.
 *   2. ray. A computed position has x/depth off its pixel's ray by at most 8u (|left| + |right|):
 *      2u|ray| in view_position, 2u (|x0| + |dx| width) in rounding x0 and dx. A stored one by what
 *      the frame says (tl_frame.slack_x, slack_y), in m under parallel rays. Left and right are those
 *      of the whole picture's rows, top and bottom of row 0 and of the band's last: rays between them
 *      are no longer than the longer of the two.
 *   3. depth. near and far are bounds of the computed depths, not the camera's planes.
 * A slack of many screens makes rectangles of the whole picture; an infinite one says that nothing is
 * known of the positions, not even that they are before the eye, and no light is left out. */
#ifndef TL_TILE_RECT_H
#define TL_TILE_RECT_H

#include "frame.h"
#include "sphere_bounds.h"

#ifdef TL_HAS_SPHERE_BOUNDS

#    define TL_RAY_MARGIN 0x1p-21 /* 8u */

/* Tiles [x0, x1) x [y0, y1); all 0 where empty. In memory they are four planes of rect_pitch ints,
 * in this order, so that culling compares many lights with a row at once. */
typedef struct tl_tile_rect {
    int x0, x1, y0, y1;
} tl_tile_rect;
enum { TL_RECT_X0, TL_RECT_X1, TL_RECT_Y0, TL_RECT_Y1, TL_RECT_PLANE_COUNT };

/* Rectangles are made up to a multiple of this, the last ones empty: what no vector of lights can
 * reach beyond. */
#    define TL_RECT_GRANULE 32
#    define TL_RECT_PITCH(light_count) \
        (((light_count) + TL_RECT_GRANULE - 1) / TL_RECT_GRANULE * TL_RECT_GRANULE)

/* What the rectangles of one frame have in common. Edges: x/depth, or m for parallel rays. */
typedef struct tl_view_window {
    double left, width, top,
        height;       /* width of one px to the right, height of one px down (< 0) */
    double near, far; /* m, of computed positions */
    double margin_x, margin_y;
    int orthographic;
} tl_view_window;

/* What bounds every depth: for rectangles that do not wait for those of the frame. */
#    define TL_LEAST_DEPTH(orthographic) ((orthographic) ? -0x1p128 : 0x1p-149)
#    define TL_GREATEST_DEPTH 0x1p128

/* near, far: they hold every computed depth. */
TL_INLINE tl_view_window view_window(const tl_frame *frame,
                                     double near,
                                     double far,
                                     int orthographic)
{
    const tl_rays rays = frame->rays;
    const double right_px = (double)rays.column0 + (double)(frame->tiles_x * frame->tile_size);
    const double bottom_px =
        (double)rays.row0 + (double)(frame->first_row + frame->tiles_y * frame->tile_size);
    tl_view_window w;
    w.width = (double)rays.dx;
    w.height = (double)rays.dy;
    w.left = (double)rays.x0 - 0.5 * w.width;
    w.top = (double)rays.y0 - 0.5 * w.height;
    w.near = near;
    w.far = far;
    w.margin_x = TL_RAY_MARGIN * (fabs(w.left) + fabs(w.left + w.width * right_px)) +
                 (double)frame->slack_x;
    w.margin_y = TL_RAY_MARGIN * (fabs(w.top) + fabs(w.top + w.height * bottom_px)) +
                 (double)frame->slack_y;
    w.orthographic = orthographic;
    return w;
}

/* Tiles from the one that holds `low` to the one that holds `high` >= 0, in px, cut to [0, count). What
 * is no number (the step of rays may vanish) leaves none out. */
TL_INLINE int first_tile(double low, double tile_size, int count)
{
    const double tile = floor(low / tile_size);
    return !(tile > 0.0) ? 0 : tile < (double)count ? (int)tile : count;
}

TL_INLINE int tile_after(double high, double tile_size, int count)
{
    const double tile = floor(high / tile_size);
    return tile < (double)(count - 1) ? (int)tile + 1 : count;
}

/* A sphere's; its centre is of floats. */
TL_INLINE tl_tile_rect tile_rect_of_sphere(tl_view_window w,
                                           const tl_frame *frame,
                                           double centre_x,
                                           double centre_y,
                                           double depth,
                                           double r)
{
    const double size = (double)frame->tile_size;
    const int tiles_x = (int)frame->tiles_x, tiles_y = (int)frame->tiles_y;
    const tl_tile_rect whole = {0, tiles_x, 0, tiles_y};
    if (isinf(w.margin_x) || isinf(w.margin_y))
        return whole;
    const tl_interval x = sphere_interval(centre_x, depth, r, w.near, w.far, w.orthographic);
    const tl_interval y = sphere_interval(centre_y, depth, r, w.near, w.far, w.orthographic);
    tl_tile_rect rect = {0, 0, 0, 0};
    if (!(x.low <= x.high) || !(y.low <= y.high))
        return rect;

    const double column0 = (double)frame->rays.column0;
    const double x0 = (x.low - w.margin_x - w.left) / w.width - column0;
    const double x1 = (x.high + w.margin_x - w.left) / w.width - column0;
    const double first = (double)frame->rays.row0 + (double)frame->first_row;
    const double y0 = (y.high + w.margin_y - w.top) / w.height - first;
    const double y1 = (y.low - w.margin_y - w.top) / w.height - first;
    if (x1 < 0.0 || y1 < 0.0)
        return rect;
    rect.x0 = first_tile(x0, size, tiles_x);
    rect.y0 = first_tile(y0, size, tiles_y);
    rect.x1 = tile_after(x1, size, tiles_x);
    rect.y1 = tile_after(y1, size, tiles_y);
    return rect;
}

/* The range that an exact distance may have at most. */
TL_INLINE double widened_range(tl_view_light light)
{
    return sqrt((double)light.range2 * (1.0 + 0x1p-21)) + 0x1p-61;
}

TL_INLINE tl_tile_rect tile_rect_of(tl_view_window w,
                                    const tl_frame *frame,
                                    tl_view_light light)
{
    return tile_rect_of_sphere(w, frame, (double)light.position[0], (double)light.position[1],
                               -(double)light.position[2], widened_range(light));
}

/* Of a spot what its sphere and the least sphere around what its cone cuts out of that have in common. The
 * latter, of range R and half-angle a: up to 45 degrees it goes through the light and the rim, with centre
 * and radius R/(2 cos a); up to 90 degrees the rim is a great circle of it, with centre at R cos a and
 * radius R sin a. The cone is that of spot.h, which pixels are in whatever rounding does; its cosine, its
 * sine, its axis, and the way of a position as it is rounded are off by 2u each: less than 16u of R in all,
 * and R is no more than twice the radius. The centre is rounded to floats. */
TL_INLINE tl_tile_rect tile_rect_of_spot(tl_view_window w,
                                         const tl_frame *frame,
                                         tl_view_light light,
                                         tl_view_spot spot)
{
    const tl_tile_rect all = tile_rect_of(w, frame, light);
    const double c = (double)spot.cull_cos, s = (double)spot.cull_sin;
    if (!(c > 0.0))
        return all;
    const double range = widened_range(light);
    const double away = c > s ? range / (2.0 * c) : range * c;
    const double radius = (c > s ? away : range * s) * (1.0 + 0x1p-19);
    float centre[3];
    double rounded = 0.0;
    for (int i = 0; i < 3; i++) {
        centre[i] = (float)((double)light.position[i] - away * (double)spot.axis[i]);
        rounded += 0x1p-23 * fabs((double)centre[i]);
    }
    const tl_tile_rect cone =
        tile_rect_of_sphere(w, frame, (double)centre[0], (double)centre[1], -(double)centre[2],
                            radius + rounded + 1e-30);
    tl_tile_rect both;
    both.x0 = cone.x0 > all.x0 ? cone.x0 : all.x0;
    both.x1 = cone.x1 < all.x1 ? cone.x1 : all.x1;
    both.y0 = cone.y0 > all.y0 ? cone.y0 : all.y0;
    both.y1 = cone.y1 < all.y1 ? cone.y1 : all.y1;
    const tl_tile_rect none = {0, 0, 0, 0};
    return both.x0 < both.x1 && both.y0 < both.y1 ? both : none;
}

#endif
#endif
