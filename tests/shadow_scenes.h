/* Shadow maps made without OpenGL, texel by texel from planes in double, and looked up as kernels do. */
#ifndef TL_SHADOW_SCENES_H
#define TL_SHADOW_SCENES_H

#include "testing.h"

#include "encode.h"
#include "prepared.h"
#include "shadow_sections.h"
#include "shape.h"

enum { MAP_SIZE = 256 }; /* texels */

/* In view space, m: n.p = offset, n towards the light. */
typedef struct plane {
    double n[3], offset;
} plane;

typedef enum joint { ONE, RIDGE, VALLEY } joint;

/* What lies in the light: a plane, or two: the lower or the higher of them, as the light sees it. */
typedef struct solid {
    plane of[2];
    joint how;
} solid;

static inline double random_in(uint32_t *seed, double low, double high)
{
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(*seed >> 8) * 0x1p-24;
}

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How far along a ray a plane is. */
static inline double met_at(const plane *p, const double from[3], const double along[3])
{
    return (p->offset - dot(p->n, from)) / dot(p->n, along);
}

/* Which of the planes a ray meets first, or of a ridge last. */
static inline const plane *met_plane(const solid *s,
                                     const double from[3],
                                     const double along[3])
{
    if (s->how == ONE)
        return &s->of[0];
    const double first = met_at(&s->of[0], from, along),
                 second = met_at(&s->of[1], from, along);
    return &s->of[(s->how == RIDGE) == (second > first)];
}

/* --- maps ------------------------------------------------------------------------------------------ */

/* The ray of a place in a view, in that view's space. */
static inline void ray_at(
    const tl_camera *view, double x, double y, double from[3], double along[3])
{
    const double right =
        (double)view->left + ((double)view->right - (double)view->left) * x / view->width;
    const double up =
        (double)view->top - ((double)view->top - (double)view->bottom) * y / view->height;
    const int is_parallel = view->projection == TL_ORTHOGRAPHIC;
    from[0] = is_parallel ? right : 0.0;
    from[1] = is_parallel ? up : 0.0;
    from[2] = 0.0;
    along[0] = is_parallel ? 0.0 : right;
    along[1] = is_parallel ? 0.0 : up;
    along[2] = -1.0;
}

/* The same in the world. */
static inline void world_ray(
    const tl_camera *view, double x, double y, double from[3], double along[3])
{
    double place[3], way[3];
    ray_at(view, x, y, place, way);
    tl_camera_world_point(view, place, from);
    tl_camera_world_direction(view, way, along);
}

static inline double stored_depth(const tl_camera *view, double ahead)
{
    return view->projection == TL_ORTHOGRAPHIC
               ? ((double)view->far - ahead) / ((double)view->far - (double)view->near)
               : (double)view->near / ahead;
}

static inline double depth_on(const tl_camera *view, const plane *p, double x, double y)
{
    double from[3], along[3];
    world_ray(view, x, y, from, along);
    return stored_depth(view, met_at(p, from, along));
}

static inline uint32_t slope_bits(double slope)
{
    const float scaled = (float)(slope * TL_SLOPE_SCALE);
    return (scaled < 0.0f ? 0x8000u : 0u) |
           rounded_bits(REAL_AS_WORD(fminf(fabsf(scaled), 65504.0f) * 0x1p-112f), 13u);
}

static inline void fill_texel(
    const tl_camera *view, const plane *p, uint32_t x, uint32_t y, uint32_t out[2])
{
    const double depth = depth_on(view, p, x + 0.5, y + 0.5);
    const double unit = view->projection == TL_ORTHOGRAPHIC ? 1.0 : depth;
    const double right = depth_on(view, p, x + 1.0, y + 0.5) - depth_on(view, p, x, y + 0.5);
    const double down = depth_on(view, p, x + 0.5, y + 1.0) - depth_on(view, p, x + 0.5, y);
    const float rounded = (float)depth;
    memcpy(&out[0], &rounded, sizeof rounded);
    out[1] = slope_bits(down / unit) << 16 | slope_bits(right / unit);
}

/* Between near and far. */
static inline int is_seen(const tl_camera *view, double ahead)
{
    return ahead > (double)view->near && ahead < (double)view->far;
}

static inline void fill(tl_shadow_map *map, const solid *s)
{
    for (uint32_t v = 0; v < tl_shadow_view_count(map); v++)
        for (uint32_t y = 0; y < MAP_SIZE; y++)
            for (uint32_t x = 0; x < MAP_SIZE; x++) {
                double from[3], along[3];
                world_ray(&map->views[v], x + 0.5, y + 0.5, from, along);
                const plane *met = met_plane(s, from, along);
                if (is_seen(&map->views[v], met_at(met, from, along)))
                    fill_texel(&map->views[v], met, x, y,
                               map->texels + 2 * (((size_t)v * MAP_SIZE + y) * MAP_SIZE + x));
            }
}

/* A light at the eye, or along its axis; views as capture makes them. */
static inline tl_shadow_map map_of(uint32_t kind)
{
    static const double receivers[2][3] = {{-3, -3, -9}, {3, 3, -1}};
    tl_shadow_map map = {.kind = kind, .size = MAP_SIZE, .direction = {0.0f, 0.0f, -1.0f}};
    if (kind == TL_SHADOW_PARALLEL)
        tl_shadow_view_along(&map, receivers, receivers);
    else
        tl_shadow_views_from(&map, map.direction, 0.6, 1e-4);
    return map;
}

/* The floor, and before the left half of what the light sees a plate, whose rim is between two texels. */
static inline void fill_with_plate(tl_shadow_map *map, const plane *plate, const plane *ground)
{
    for (uint32_t v = 0; v < tl_shadow_view_count(map); v++)
        for (uint32_t y = 0; y < MAP_SIZE; y++)
            for (uint32_t x = 0; x < MAP_SIZE; x++) {
                double from[3], along[3];
                const plane *met = x < MAP_SIZE / 2 ? plate : ground;
                world_ray(&map->views[v], x + 0.5, y + 0.5, from, along);
                if (is_seen(&map->views[v], met_at(met, from, along)))
                    fill_texel(&map->views[v], met, x, y,
                               map->texels + 2 * (((size_t)v * MAP_SIZE + y) * MAP_SIZE + x));
            }
}

/* --- looking them up ------------------------------------------------------------------------------- */

typedef struct lookup {
    tl_gbuffer *gbuffer;
    tl_shadow_maps maps;
    tl_prepared prepared;
    tl_view_shadow shadow;
} lookup;

/* A map like this one, to be filled. */
static inline void begin_map(lookup *l, const tl_shadow_map *like)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.2, 64, 64, 0.1, 100.0);
    tl_error err;
    *l = (lookup){.gbuffer = NULL};
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &l->gbuffer, &err), err);
    ASSERT_OK(tl_shadow_maps_add(&l->maps, like, &err), err);
}

/* The map as it is filled now is looked up by this filter. */
static inline void look_up(lookup *l, uint32_t filter)
{
    tl_u32 at = 0;
    tl_error err;
    ASSERT_OK(tl_shadow_map_check(&l->maps.of[0], &err), err);
    ASSERT_OK(
        tl_shadow_section_add(l->gbuffer, &l->maps.of[0], filter, &l->prepared, &at, &err),
        err);
    l->shadow = shadow_behind((tl_numbers)l->prepared.lights, at);
}

static inline void begin(lookup *l, uint32_t kind, uint32_t filter, const solid *s)
{
    const tl_shadow_map like = map_of(kind);
    begin_map(l, &like);
    fill(&l->maps.of[0], s);
    look_up(l, filter);
}

/* Without what is known of slopes: what is left is the constant offset towards the light. */
static inline void forget_slopes(lookup *l)
{
    tl_u32 *texels = (tl_u32 *)(void *)((float *)(void *)l->prepared.lights +
                                        (size_t)l->shadow.texels_at * 4);
    for (size_t i = 0; i < tl_shadow_map_size(&l->maps.of[0]) / 8; i++)
        texels[2 * i + 1] = 0;
    l->shadow.slope_x = l->shadow.slope_y = 0.0f;
}

static inline void end(lookup *l)
{
    tl_prepared_clear(&l->prepared);
    tl_shadow_maps_clear(&l->maps);
    tl_gbuffer_destroy(l->gbuffer);
}

/* The share that arrives at a point of a plane. */
static inline float share_on(const lookup *l, const double point[3], const double n[3])
{
    const surface s = {.position = {(float)point[0], (float)point[1], (float)point[2]},
                       .normal = {(float)n[0], (float)n[1], (float)n[2]}};
    const int is_parallel = l->shadow.kind == TL_SHADOW_PARALLEL;
    const vec3 away = {-s.position.x, -s.position.y, -s.position.z}, sun = {0, 0, 1};
    const vec3 to_light = is_parallel ? sun : away;
    const float distance = sqrtf(dot3(to_light, to_light));
    return unshadowed_share((tl_numbers)l->prepared.lights, l->shadow, s, to_light, distance,
                            dot3(s.normal, to_light));
}

/* A point that the light sees, away from the view's border; the plane it is on. */
static inline const plane *random_point(const lookup *l,
                                        const solid *s,
                                        uint32_t *seed,
                                        double point[3])
{
    const tl_camera *view = &l->maps.of[0].views[0];
    const uint32_t index = l->shadow.kind == TL_SHADOW_CUBE ? 5 : 0; /* against z */
    double from[3], along[3];
    world_ray(view + index, random_in(seed, 20, MAP_SIZE - 20),
              random_in(seed, 20, MAP_SIZE - 20), from, along);
    const plane *met = met_plane(s, from, along);
    const double far = met_at(met, from, along);
    for (int i = 0; i < 3; i++)
        point[i] = from[i] + far * along[i];
    return met;
}

/* Through (0, 0, -5), tilted from the light by this angle, towards `turn`. */
static inline plane tilted(double tilt, double turn)
{
    const plane p = {{sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt)},
                     -5.0 * cos(tilt)};
    return p;
}

/* The cosine between a plane and the light at a point. */
static inline double cosine_at(const lookup *l, const plane *p, const double point[3])
{
    return l->shadow.kind == TL_SHADOW_PARALLEL ? p->n[2]
                                                : -dot(p->n, point) / sqrt(dot(point, point));
}

/* Whether the light is above all planes there, by more than where slopes are cut, and a filter's width from
 * there on too; and how far the point is away is within reason. */
static inline int is_lit_well(const lookup *l, const solid *s, const double point[3])
{
    static const double least = 0.12;
    if (point[2] > -0.5 || point[2] < -50.0)
        return 0;
    return cosine_at(l, &s->of[0], point) > least &&
           (s->how == ONE || cosine_at(l, &s->of[1], point) > least);
}

#endif
