#include "tilelight/bounds.h"

#include "sphere_bounds.h"

/* Cells [*first, *end) of `count` between the edges `at_0` and `at_count` that the interval meets: from the
 * one that holds its one end to the one that holds the other. A pixel whose centre is in the interval is half
 * a cell inside, which no rounding here comes near: an end m is off by 14u |m|, u = 2^-53.
 *   1. The tangent's length, a root, is off by 1.5u, and its product by 2.5u; the other product is exact; so
 *      their sum is off by 3.5u where they have one sign.
 *   2. Else its conjugate takes its place, d2 (c - r)(c + r) over it: 1 + 1 + 1 + 2 + 3.5 + 1 = 9.5u. Of
 *      numerator and denominator one at most is of that kind; their quotient rounds once: 3.5 + 9.5 + 1.
 *   3. An end on the near or the far plane is off by 7.5u. c - r and c + r, under parallel rays, round once.
 * Whether there is a cell is asked of the edges themselves, so that what touches them is in where the
 * interval is exact. 0 if there is none. */
static int cells_of(tl_interval interval,
                    double at_0,
                    double at_count,
                    uint32_t count,
                    uint32_t *first,
                    uint32_t *end)
{
    const double least = at_0 < at_count ? at_0 : at_count;
    const double most = at_0 < at_count ? at_count : at_0;
    if (interval.low > interval.high || interval.high < least || interval.low > most)
        return 0;
    const double scale = (double)count / (at_count - at_0);
    const double a = (interval.low - at_0) * scale, b = (interval.high - at_0) * scale;
    const double from = a < b ? a : b, to = a < b ? b : a;
    *first = from > 0.0 ? (uint32_t)from : 0;
    *end = to < (double)count ? (uint32_t)to + 1 : count;
    if (*first == count)
        *first = count - 1;
    return 1;
}

static int is_finite(const tl_camera *camera, const float center[3], float radius)
{
    return isfinite(center[0]) && isfinite(center[1]) && isfinite(center[2]) &&
           isfinite(radius) && radius >= 0.0f && !isnan(camera->far) && isfinite(camera->near);
}

void tl_sphere_bounds(const tl_camera *camera,
                      const float center[3],
                      float radius,
                      tl_pixel_rect *out)
{
    *out = (tl_pixel_rect){0, 0, camera->width, camera->height};
    if (!is_finite(camera, center, radius))
        return;
    const double depth = -(double)center[2], near = (double)camera->near;
    const double far = (double)camera->far, r = (double)radius;
    const int orthographic = camera->projection == TL_ORTHOGRAPHIC;
    const tl_interval x = sphere_interval((double)center[0], depth, r, near, far, orthographic);
    const tl_interval y = sphere_interval((double)center[1], depth, r, near, far, orthographic);
    if (!cells_of(x, (double)camera->left, (double)camera->right, camera->width, &out->x0,
                  &out->x1) ||
        !cells_of(y, (double)camera->top, (double)camera->bottom, camera->height, &out->y0,
                  &out->y1))
        *out = (tl_pixel_rect){0, 0, 0, 0};
}
