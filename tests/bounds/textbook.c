#include "bounds/textbook.h"

#include <limits.h>
#include <math.h>

/* What processors make of a float that no int holds. */
static int to_int(float v)
{
    return fabsf(v) < 0x1p31f ? (int)v : INT_MIN;
}

/* Pixels [low, high) of one axis, counted from the left or from the bottom. */
typedef struct cut {
    int low, high;
} cut;

static tl_pixel_rect rect_of(const tl_camera *camera, cut x, cut y)
{
    const int w = (int)camera->width, h = (int)camera->height;
    const cut cx = {x.low > 0 ? x.low : 0, x.high < w ? x.high : w};
    const cut cy = {y.low > 0 ? y.low : 0, y.high < h ? y.high : h};
    if (cx.low >= cx.high || cy.low >= cy.high)
        return (tl_pixel_rect){0, 0, 0, 0};
    return (tl_pixel_rect){(uint32_t)cx.low, (uint32_t)(h - cy.high), (uint32_t)cx.high,
                           (uint32_t)(h - cy.low)};
}

static cut listing_16_axis(float c, float z, float r, float focal, int count)
{
    cut pixels = {0, count};
    const float l2 = c * c + z * z, r2 = r * r;
    const float d = r2 * c * c - l2 * (r2 - z * z);
    if (!(d >= 0.0f))
        return pixels;
    for (int side = 1; side >= -1; side -= 2) {
        const float n = (r * c + (float)side * sqrtf(d)) / l2;
        const float nz = (r - n * c) / z;
        const float pz = (l2 - r2) / (z - nz / n * c);
        if (!(pz < 0.0f))
            continue;
        const int at = to_int((nz * focal / n + 1.0f) * (float)count * 0.5f);
        if (-pz * nz / n < c)
            pixels.low = at > pixels.low ? at : pixels.low;
        else
            pixels.high = at < pixels.high ? at : pixels.high;
    }
    return pixels;
}

tl_pixel_rect tl_listing_16(const tl_sphere_case *of)
{
    const tl_camera *c = &of->camera;
    return rect_of(c,
                   listing_16_axis(of->center[0], of->center[2], of->radius, 1.0f / c->right,
                                   (int)c->width),
                   listing_16_axis(of->center[1], of->center[2], of->radius, 1.0f / c->top,
                                   (int)c->height));
}

static cut mara_mcguire_axis(float c, float z, float r, float near_z, float focal, int count)
{
    const float l2 = c * c + z * z, length2 = l2 - r * r;
    const int is_inside = !(length2 > 0.0f), is_clipped = z + r >= near_z;
    const float cosine = is_inside ? 0.0f : sqrtf(length2) / sqrtf(l2);
    const float sine = is_inside ? 0.0f : r / sqrtf(l2);
    const float half = sqrtf(r * r - (near_z - z) * (near_z - z));
    float ends[2];
    for (int side = 0; side < 2; side++) {
        const float s = side ? -sine : sine, k = side ? -half : half;
        float x = (cosine * c - s * z) * cosine, at = (s * c + cosine * z) * cosine;
        if (is_clipped && (is_inside || at > near_z)) {
            x = c + k;
            at = near_z;
        }
        ends[side] = (x / -at * focal + 1.0f) * (float)count * 0.5f;
    }
    const float low = fminf(ends[0], ends[1]), high = fmaxf(ends[0], ends[1]);
    return (cut){to_int(fmaxf(floorf(low), 0.0f)), to_int(fminf(ceilf(high), (float)count))};
}

tl_pixel_rect tl_mara_mcguire(const tl_sphere_case *of)
{
    const tl_camera *c = &of->camera;
    return rect_of(c,
                   mara_mcguire_axis(of->center[0], of->center[2], of->radius, -c->near,
                                     1.0f / c->right, (int)c->width),
                   mara_mcguire_axis(of->center[1], of->center[2], of->radius, -c->near,
                                     1.0f / c->top, (int)c->height));
}
