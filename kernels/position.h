/* Where the surface of a pixel is. */
#ifndef TL_POSITION_H
#define TL_POSITION_H

#include "frame.h"
#include "needs.h"
#include "vec3.h"

/* Where the ray of a column or row of these planes crosses the plane 1 m away, or of parallel rays every one.
 * Planes that are a part of a picture add where that begins, which is exact: whole numbers below 2^15. */
TL_INLINE real ray_across(tl_rays rays, tl_needs needs, real column)
{
    if (needs.window)
        column = column + rays.column0;
    return FMA(column, rays.dx, rays.x0);
}

TL_INLINE real ray_down(tl_rays rays, tl_needs needs, real row)
{
    if (needs.window)
        row = row + rays.row0;
    return FMA(row, rays.dy, rays.y0);
}

/* The view-space position of pixel (column, row) at `depth`; shading and culling must use the same
 * bits. One rounding for the ray, one for the product: x/depth is off the exact ray by at most
 * 2u|ray|, beside what rounding x0 and dx to float leaves (reach.h needs that bound). */
TL_INLINE vec3 view_position(tl_rays rays, tl_needs needs, real column, real row, real depth)
{
    const real ray_x = ray_across(rays, needs, column);
    const real ray_y = ray_down(rays, needs, row);
    if (needs.orthographic) {
        const vec3 parallel = {ray_x, ray_y, -depth};
        return parallel;
    }
    const vec3 p = {ray_x * depth, ray_y * depth, -depth};
    return p;
}

/* The unit vector from a view-space position to the eye; 0 so close to it, or so far, that squares leave the
 * range of numbers, where no direction is left (vec3.h). */
TL_INLINE vec3 direction_to_eye(tl_needs needs, vec3 position)
{
    if (needs.orthographic) {
        const vec3 back = {(real)R(0.0), (real)R(0.0), (real)R(1.0)};
        return back;
    }
    const vec3 away = unit3(position);
    const vec3 v = {-away.x, -away.y, -away.z};
    return v;
}

/* A direction in world space as one in view space. */
TL_INLINE vec3 view_direction(const tl_frame *frame, vec3 world)
{
    const vec3 rows[3] = {
        {(real)frame->view_from_world[0][0], (real)frame->view_from_world[0][1],
         (real)frame->view_from_world[0][2]},
        {(real)frame->view_from_world[1][0], (real)frame->view_from_world[1][1],
         (real)frame->view_from_world[1][2]},
        {(real)frame->view_from_world[2][0], (real)frame->view_from_world[2][1],
         (real)frame->view_from_world[2][2]},
    };
    const vec3 v = {dot3(rows[0], world), dot3(rows[1], world), dot3(rows[2], world)};
    return v;
}

/* A point in world space, m, in view space. Rounding is of the size of what is added, so far from the
 * world's origin the point is as coarse as its coordinates. */
TL_INLINE vec3 view_point(const tl_frame *frame, vec3 world)
{
    const vec3 v = view_direction(frame, world);
    const vec3 p = {v.x + frame->view_from_world[0][3], v.y + frame->view_from_world[1][3],
                    v.z + frame->view_from_world[2][3]};
    return p;
}

/* A world-space normal of any finite length as a unit vector in view space; 0 stays 0, which no
 * light reaches. Of length 1 to within 4.5u (vec3.h); its direction is off by 3u sum |r_i w_i| in each
 * component of the rotation, and u. */
TL_INLINE vec3 view_normal(const tl_frame *frame, vec3 world)
{
    return unit3(view_direction(frame, world));
}

#endif
