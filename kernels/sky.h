/* What is seen where nothing was hit, where that is not one colour.
 *
 *   gradient  by the sine s of the elevation of the pixel's ray: from the horizon's colour to that of the
 *             zenith, or below the horizon to that of the ground, linear in |s|.
 *   image     a map of the whole of space (texture.h) in the ray's direction.
 *
 * Rays of an orthographic camera are parallel: it sees one colour. */
#ifndef TL_SKY_H
#define TL_SKY_H

#include "position.h"
#include "texture.h"

/* The direction in which a pixel is seen, in view space, of any length. */
TL_INLINE vec3 ray_direction(tl_rays rays, tl_needs needs, real column, real row)
{
    vec3 ray = {(real)R(0.0), (real)R(0.0), (real)R(-1.0)};
    if (!needs.orthographic) {
        ray.x = ray_across(rays, needs, column);
        ray.y = ray_down(rays, needs, row);
    }
    return ray;
}

/* s is off by 3u for its sum, 4.5u for squares, root, quotient and product, u for up, which is rounded; the
 * colour by as much of the largest, and 3u for the mixture. Asserted by tests/test_map_accuracy.c. */
TL_INLINE vec3 sky_gradient(const float horizon[3], tl_view_sky sky, vec3 ray)
{
    const real s = dot3(ray, lanes_of(sky.map.up)) * (R(1.0) / SQRT(dot3(ray, ray)));
    const real steep = ABSOLUTE(s);
    const mask above = s > R(0.0);
    const real share = pick(steep < R(1.0), steep, R(1.0));
    const vec3 level = lanes_of(horizon);
    const vec3 far = pick3(above, lanes_of(sky.zenith), lanes_of(sky.ground));
    const vec3 color = {mixed(level.x, far.x, share), mixed(level.y, far.y, share),
                        mixed(level.z, far.z, share)};
    return color;
}

/* lights: their buffer, which has the sky behind them. Only where needs.sky is not 0. */
TL_INLINE vec3 sky_radiance(const tl_frame *frame,
                            tl_needs needs,
                            TL_GLOBAL const tl_view_light *lights,
                            real column,
                            real row)
{
    const tl_numbers numbers = (tl_numbers)lights;
    const tl_view_sky sky =
        *(TL_GLOBAL const tl_view_sky *)(numbers + (size_t)frame->sky_at * 4);
    const vec3 ray = ray_direction(frame->rays, needs, column, row);
    if (needs.sky == TL_GRADIENT_SKY)
        return sky_gradient(frame->sky, sky, ray);
    return map_around(numbers, sky.map, ray);
}

/* What a pixel sends to the eye, `lit` where something was hit, whatever the sky. */
TL_INLINE vec3 seen_radiance(const tl_frame *frame,
                             tl_needs needs,
                             TL_GLOBAL const tl_view_light *lights,
                             real depth,
                             vec3 lit,
                             real column,
                             real row)
{
    const mask is_sky = depth >= (real)INFINITY;
    if (!paints_sky(needs) || !any_lane(is_sky))
        return lit;
    return pick3(is_sky, sky_radiance(frame, needs, lights, column, row), lit);
}

#endif
