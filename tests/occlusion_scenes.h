/* Frames of a few shapes, cast by rays in double, and how much of the hemisphere over a point they leave. */
#ifndef TL_OCCLUSION_SCENES_H
#define TL_OCCLUSION_SCENES_H

#include "frames.h"
#include "occlusion.h"
#include "sections.h"
#include "surround.h"

enum { FRAME_SIDE = 128 }; /* px */

typedef enum shape_kind { SHAPE_PLANE, SHAPE_SPHERE, SHAPE_BOX } shape_kind;

/* In world space. */
typedef struct shape {
    shape_kind kind;
    double at[3];   /* a point of the plane; the centre */
    double size[3]; /* the plane's normal; radius, 0, 0; half the sides */
} shape;

typedef struct shapes {
    const shape *of;
    size_t count;
} shapes;

static inline double dot_of(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double plane_hit(const shape *s,
                               const double o[3],
                               const double d[3],
                               double n[3])
{
    const double away[3] = {s->at[0] - o[0], s->at[1] - o[1], s->at[2] - o[2]};
    const double facing = dot_of(s->size, d);
    for (int i = 0; i < 3; i++)
        n[i] = s->size[i];
    return facing < 0.0 ? dot_of(s->size, away) / facing : -1.0;
}

static inline double sphere_hit(const shape *s,
                                const double o[3],
                                const double d[3],
                                double n[3])
{
    const double to[3] = {o[0] - s->at[0], o[1] - s->at[1], o[2] - s->at[2]};
    const double a = dot_of(d, d), b = dot_of(to, d), r = s->size[0];
    const double root2 = b * b - a * (dot_of(to, to) - r * r);
    if (root2 < 0.0)
        return -1.0;
    const double t = (-b - sqrt(root2)) / a;
    for (int i = 0; i < 3; i++)
        n[i] = (to[i] + t * d[i]) / r;
    return t;
}

static inline double box_hit(const shape *s, const double o[3], const double d[3], double n[3])
{
    double enter = -INFINITY, leave = INFINITY;
    int side = 0;
    for (int i = 0; i < 3; i++) {
        const double a = (s->at[i] - s->size[i] - o[i]) / d[i];
        const double b = (s->at[i] + s->size[i] - o[i]) / d[i];
        if (fmin(a, b) > enter) {
            enter = fmin(a, b);
            side = i;
        }
        leave = fmin(leave, fmax(a, b));
    }
    for (int i = 0; i < 3; i++)
        n[i] = i == side ? (d[i] > 0.0 ? -1.0 : 1.0) : 0.0;
    return enter < leave ? enter : -1.0;
}

/* How far along the ray something is, and its normal; INFINITY: nothing. */
static inline double nearest_hit(shapes in, const double o[3], const double d[3], double n[3])
{
    static double (*const hits[])(const shape *, const double *, const double *, double *) = {
        [SHAPE_PLANE] = plane_hit, [SHAPE_SPHERE] = sphere_hit, [SHAPE_BOX] = box_hit};
    double nearest = INFINITY;
    memset(n, 0, 3 * sizeof *n);
    for (size_t i = 0; i < in.count; i++) {
        double normal[3];
        const double t = hits[in.of[i].kind](&in.of[i], o, d, normal);
        if (!(t > 1e-6 && t < nearest))
            continue;
        nearest = t;
        memcpy(n, normal, sizeof normal);
    }
    return nearest;
}

/* Where the ray of pixel (x, y) begins and goes, in world space; its length along the view axis is 1. */
static inline void pixel_ray(
    const tl_camera *camera, uint32_t x, uint32_t y, double origin[3], double way[3])
{
    const double right = (double)camera->left + ((double)camera->right - (double)camera->left) *
                                                    (x + 0.5) / camera->width;
    const double up = (double)camera->top - ((double)camera->top - (double)camera->bottom) *
                                                (y + 0.5) / camera->height;
    const int parallel = camera->projection == TL_ORTHOGRAPHIC;
    const double from[3] = {parallel ? right : 0.0, parallel ? up : 0.0, 0.0};
    const double along[3] = {parallel ? 0.0 : right, parallel ? 0.0 : up, -1.0};
    tl_camera_world_point(camera, from, origin);
    tl_camera_world_direction(camera, along, way);
}

/* Everything of albedo 1. The caller destroys it. */
static inline tl_gbuffer *cast_frame(const tl_camera *camera, shapes in, uint32_t more_planes)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(camera, TL_GROUP_BASE | more_planes, &g, &err), err);
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            double origin[3], way[3], normal[3];
            pixel_ray(camera, x, y, origin, way);
            const double depth = nearest_hit(in, origin, way, normal);
            if (isinf(depth))
                continue;
            set_pixel(g, TL_DEPTH, at, (float)depth);
            for (int i = 0; i < 3; i++) {
                set_pixel(g, (enum tl_plane)(TL_NORMAL_X + i), at, (float)normal[i]);
                set_pixel(g, (enum tl_plane)(TL_ALBEDO_R + i), at, 1.0f);
            }
        }
    return g;
}

/* From a place to another one. */
static inline tl_camera camera_at(double x, double y, double z, double tx, double ty, double tz)
{
    const double eye[3] = {x, y, z}, target[3] = {tx, ty, tz}, up[3] = {0.0, 1.0, 0.01};
    return tl_camera_look_at(eye, target, up, 0.8, FRAME_SIDE, FRAME_SIDE, 0.1, 1000.0);
}

static inline void make_parallel(tl_camera *camera, float half)
{
    camera->projection = TL_ORTHOGRAPHIC;
    camera->left = camera->bottom = -half;
    camera->right = camera->top = half;
}

/* How a plane is seen: its slope from the picture's plane, degrees. */
static const double plane_slopes[] = {0.0, 20.0, 45.0, 70.0, 85.0, 89.0, 89.9};

/* A plane 5 m before the camera, of this slope, which falls one way or another. The caller destroys it. */
static inline tl_gbuffer *plane_frame(double degrees, int turn, int parallel)
{
    const double slope = degrees * acos(-1.0) / 180.0, way = 0.6 + 2.0 * turn;
    const shape plane = {SHAPE_PLANE,
                         {0.0, 0.0, -5.0},
                         {sin(slope) * cos(way), sin(slope) * sin(way), cos(slope)}};
    tl_camera camera = camera_at(0.0, 0.0, 0.0, 0.0, 0.0, -1.0);
    if (parallel)
        make_parallel(&camera, 2.0f);
    return cast_frame(&camera, (shapes){&plane, 1}, 0);
}

/* A frame whose surroundings are computed in C; prepared is all zero at first. */
typedef struct surrounded {
    tl_prepared prepared;
    const float *share; /* [rows][pitch] */
} surrounded;

static inline surrounded surround(const tl_gbuffer *g,
                                  float radius,
                                  uint32_t samples,
                                  tl_arithmetic arithmetic)
{
    const tl_light_set lights = {.ambient = {1.0f, 1.0f, 1.0f}, .occlusion_radius = radius};
    const tl_prepare_options options = {.tile_size = 16, .occlusion_samples = samples};
    surrounded s = {.share = NULL};
    tl_error err;
    ASSERT_OK(tl_prepare(g, &lights, &options, NULL, &s.prepared, &err), err);
    assert_true(s.prepared.needs.surroundings);
    tl_reference_surround(&s.prepared, g, arithmetic);
    const tl_view_surroundings *view =
        tl_section_at(&s.prepared, s.prepared.frame.surroundings_at);
    s.share =
        (const float *)tl_section_at(&s.prepared, view->planes_at) + TL_AROUND_MARGIN(g->pitch);
    return s;
}

/* Two vectors at right angles to n and to each other. */
static inline void across_of(const double n[3], double a[3], double b[3])
{
    const int least = fabs(n[0]) < fabs(n[1]) ? (fabs(n[0]) < fabs(n[2]) ? 0 : 2)
                                              : (fabs(n[1]) < fabs(n[2]) ? 1 : 2);
    const double axis[3] = {least == 0, least == 1, least == 2};
    const double length = sqrt(1.0 - n[least] * n[least]);
    for (int i = 0; i < 3; i++)
        a[i] = (axis[i] - n[least] * n[i]) / length;
    for (int i = 0; i < 3; i++)
        b[i] = n[(i + 1) % 3] * a[(i + 2) % 3] - n[(i + 2) % 3] * a[(i + 1) % 3];
}

/* What is left of a hemisphere by its cosine: rays through SIDE x SIDE cells of the disk that it is
 * projected to. Hits count by the window of kernels/occlusion.h. */
static inline double cast_share(shapes in, const double at[3], const double n[3], double radius)
{
    enum { SIDE = 24 };
    double a[3], b[3], lost = 0.0;
    across_of(n, a, b);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double sine2 = (i / SIDE + 0.5) / SIDE,
                     angle = 2.0 * acos(-1.0) * (i % SIDE + 0.5) / SIDE;
        double way[3], hit[3];
        for (int k = 0; k < 3; k++)
            way[k] = sqrt(sine2) * (cos(angle) * a[k] + sin(angle) * b[k]) +
                     sqrt(1.0 - sine2) * n[k];
        const double share = nearest_hit(in, at, way, hit) / radius;
        lost += share < 1.0 ? 1.0 - share * share * share * share : 0.0;
    }
    return 1.0 - lost / (SIDE * SIDE);
}

#endif
