/* Ambient occlusion of what has nothing around it. */
#include "hard_case.h"

#include "occlusion_scenes.h"

static const float radius = 0.5f; /* m */

/* The pixel that shows a place of view space; 0: none does. */
static int shown_at(const tl_gbuffer *g, const double place[3], size_t *at)
{
    const tl_camera *c = &g->camera;
    const double scale = c->projection == TL_ORTHOGRAPHIC ? 1.0 : -place[2];
    const double left = (double)c->left, top = (double)c->top;
    const double x = (place[0] / scale - left) / ((double)c->right - left) * c->width;
    const double y = (place[1] / scale - top) / ((double)c->bottom - top) * c->height;
    if (!(x >= 0.0 && x < c->width && y >= 0.0 && y < c->height))
        return 0;
    *at = (size_t)y * g->pitch + (size_t)x;
    return 1;
}

/* A point of the hemisphere over a place, of the radius. */
static void point_over(const double place[3], const double n[3], uint32_t *seed, double out[3])
{
    double away[3];
    do {
        for (int i = 0; i < 3; i++)
            away[i] = (double)uniform(seed, -1.0f, 1.0f);
    } while (dot_of(away, away) > 1.0);
    const double side = dot_of(away, n) < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++)
        out[i] = place[i] + side * (double)radius * away[i];
}

/* The share of points over a pixel that the picture's depth does not hide. */
static double usual_share(const tl_gbuffer *g, uint32_t x, uint32_t y, uint32_t *seed)
{
    enum { POINTS = 16 };
    static const double bias = 0.025; /* m */
    const size_t here = (size_t)y * g->pitch + x;
    const double depth = (double)tl_gbuffer_plane(g, TL_DEPTH)[here];
    double place[3], along[3], n[3];
    int hidden = 0;
    pixel_ray(&g->camera, x, y, place, along);
    for (int i = 0; i < 3; i++) {
        place[i] += depth * along[i];
        n[i] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + i))[here];
    }
    for (int i = 0; i < POINTS; i++) {
        double point[3];
        size_t at;
        point_over(place, n, seed, point);
        hidden += shown_at(g, point, &at) &&
                  (double)tl_gbuffer_plane(g, TL_DEPTH)[at] < -point[2] - bias;
    }
    return 1.0 - (double)hidden / POINTS;
}

static void count_plane(hard_bench *bench, const tl_gbuffer *g, uint32_t *seed)
{
    surrounded s = surround(g, radius, 0, TL_TWIN_FLOAT);
    for (uint32_t y = 0; y < FRAME_SIDE; y++)
        for (uint32_t x = 0; x < FRAME_SIDE; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            if (isfinite(tl_gbuffer_plane(g, TL_DEPTH)[at]))
                hard_count(bench, same_bits(s.share[at], 1.0f),
                           usual_share(g, x, y, seed) > 0.99);
        }
    tl_prepared_clear(&s.prepared);
}

void hard_flat_occlusion(hard_bench *bench)
{
    uint32_t seed = 29;
    for (size_t i = 0; i < COUNT_OF(plane_slopes); i++)
        for (int parallel = 0; parallel < 2; parallel++) {
            tl_gbuffer *g = plane_frame(plane_slopes[i], (int)i % 2, parallel);
            count_plane(bench, g, &seed);
            tl_gbuffer_destroy(g);
        }
}
