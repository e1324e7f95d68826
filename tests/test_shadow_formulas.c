/* Does a surface never shadow itself, and does what is behind another one lie in its shadow?
 *
 * Maps are made here without OpenGL, texel by texel from planes: one at every angle to the light, and two
 * that meet at a fold, to which both are turned, whatever their normals say, and a step narrower than a texel.
 * On them all light arrives everywhere, in every kind of map, with every filter; in maps without slopes it
 * does not. Behind the rim of a plate the share falls from 1 to
 * 0 over the filter's width, and is a half at the rim. */
#include "testing.h"

#include "encode.h"
#include "prepared.h"
#include "shadow_sections.h"
#include "shape.h"

enum { SIZE = 256, POINTS = 4000 };

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

static uint32_t seed = 1;

static double random_in(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) * 0x1p-24;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How far along a ray a plane is. */
static double met_at(const plane *p, const double from[3], const double along[3])
{
    return (p->offset - dot(p->n, from)) / dot(p->n, along);
}

/* Which of the planes a ray meets first, or of a ridge last. */
static const plane *met_plane(const solid *s, const double from[3], const double along[3])
{
    if (s->how == ONE)
        return &s->of[0];
    const double first = met_at(&s->of[0], from, along),
                 second = met_at(&s->of[1], from, along);
    return &s->of[(s->how == RIDGE) == (second > first)];
}

/* --- maps ------------------------------------------------------------------------------------------ */

/* The ray of a place in a view, in that view's space. */
static void ray_at(const tl_camera *view, double x, double y, double from[3], double along[3])
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
static void world_ray(
    const tl_camera *view, double x, double y, double from[3], double along[3])
{
    double place[3], way[3];
    ray_at(view, x, y, place, way);
    tl_camera_world_point(view, place, from);
    tl_camera_world_direction(view, way, along);
}

static double stored_depth(const tl_camera *view, double ahead)
{
    return view->projection == TL_ORTHOGRAPHIC
               ? ((double)view->far - ahead) / ((double)view->far - (double)view->near)
               : (double)view->near / ahead;
}

static double depth_on(const tl_camera *view, const plane *p, double x, double y)
{
    double from[3], along[3];
    world_ray(view, x, y, from, along);
    return stored_depth(view, met_at(p, from, along));
}

static uint32_t slope_bits(double slope)
{
    const float scaled = (float)(slope * TL_SLOPE_SCALE);
    return (scaled < 0.0f ? 0x8000u : 0u) |
           rounded_bits(REAL_AS_WORD(fminf(fabsf(scaled), 65504.0f) * 0x1p-112f), 13u);
}

static void fill_texel(
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
static int is_seen(const tl_camera *view, double ahead)
{
    return ahead > (double)view->near && ahead < (double)view->far;
}

static void fill(tl_shadow_map *map, const solid *s)
{
    for (uint32_t v = 0; v < tl_shadow_view_count(map); v++)
        for (uint32_t y = 0; y < SIZE; y++)
            for (uint32_t x = 0; x < SIZE; x++) {
                double from[3], along[3];
                world_ray(&map->views[v], x + 0.5, y + 0.5, from, along);
                const plane *met = met_plane(s, from, along);
                if (is_seen(&map->views[v], met_at(met, from, along)))
                    fill_texel(&map->views[v], met, x, y,
                               map->texels + 2 * (((size_t)v * SIZE + y) * SIZE + x));
            }
}

/* A light at the eye, or along its axis; views as capture makes them. */
static tl_shadow_map map_of(uint32_t kind)
{
    static const double receivers[2][3] = {{-3, -3, -9}, {3, 3, -1}};
    tl_shadow_map map = {.kind = kind, .size = SIZE, .direction = {0.0f, 0.0f, -1.0f}};
    if (kind == TL_SHADOW_PARALLEL)
        tl_shadow_view_along(&map, receivers, receivers);
    else
        tl_shadow_views_from(&map, map.direction, 0.6, 1e-4);
    return map;
}

/* --- looking them up ------------------------------------------------------------------------------- */

typedef struct lookup {
    tl_gbuffer *gbuffer;
    tl_shadow_maps maps;
    tl_prepared prepared;
    tl_view_shadow shadow;
} lookup;

static void begin(lookup *l, uint32_t kind, uint32_t filter, const solid *s)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.2, 64, 64, 0.1, 100.0);
    const tl_shadow_map like = map_of(kind);
    tl_u32 at = 0;
    tl_error err;
    *l = (lookup){.gbuffer = NULL};
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &l->gbuffer, &err), err);
    ASSERT_OK(tl_shadow_maps_add(&l->maps, &like, &err), err);
    fill(&l->maps.of[0], s);
    ASSERT_OK(tl_shadow_map_check(&l->maps.of[0], &err), err);
    ASSERT_OK(
        tl_shadow_section_add(l->gbuffer, &l->maps.of[0], filter, &l->prepared, &at, &err),
        err);
    l->shadow = shadow_behind((tl_numbers)l->prepared.lights, at);
}

static void end(lookup *l)
{
    tl_prepared_clear(&l->prepared);
    tl_shadow_maps_clear(&l->maps);
    tl_gbuffer_destroy(l->gbuffer);
}

/* The share that arrives at a point of a plane. */
static float share_on(const lookup *l, const double point[3], const double n[3])
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
static const plane *random_point(const lookup *l, const solid *s, double point[3])
{
    const tl_camera *view = &l->maps.of[0].views[0];
    const uint32_t index = l->shadow.kind == TL_SHADOW_CUBE ? 5 : 0; /* against z */
    double from[3], along[3];
    world_ray(view + index, random_in(20, SIZE - 20), random_in(20, SIZE - 20), from, along);
    const plane *met = met_plane(s, from, along);
    const double far = met_at(met, from, along);
    for (int i = 0; i < 3; i++)
        point[i] = from[i] + far * along[i];
    return met;
}

/* Through (0, 0, -5), tilted from the light by this angle, towards `turn`. */
static plane tilted(double tilt, double turn)
{
    const plane p = {{sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt)},
                     -5.0 * cos(tilt)};
    return p;
}

/* The cosine between a plane and the light at a point. */
static double cosine_at(const lookup *l, const plane *p, const double point[3])
{
    return l->shadow.kind == TL_SHADOW_PARALLEL ? p->n[2]
                                                : -dot(p->n, point) / sqrt(dot(point, point));
}

/* Whether the light is above all planes there, by more than where slopes are cut, and a filter's width from
 * there on too; and how far the point is away is within reason. */
static int is_lit_well(const lookup *l, const solid *s, const double point[3])
{
    static const double least = 0.12;
    if (point[2] > -0.5 || point[2] < -50.0)
        return 0;
    return cosine_at(l, &s->of[0], point) > least &&
           (s->how == ONE || cosine_at(l, &s->of[1], point) > least);
}

static const uint32_t filters[] = {1, 2, 3, 5, TL_MOST_SHADOW_FILTER};

/* Of both planes, as smooth shading has it at their fold. */
static void mean_normal(const solid *s, double n[3])
{
    double sum[3];
    for (int i = 0; i < 3; i++)
        sum[i] = s->of[0].n[i] + s->of[1].n[i];
    for (int i = 0; i < 3; i++)
        n[i] = sum[i] / sqrt(dot(sum, sum));
}

static void hold_lit(const solid *s, int is_smooth, const char *what, double tilt)
{
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++)
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            lookup l;
            begin(&l, kind, filters[f], s);
            for (int i = 0; i < POINTS; i++) {
                double point[3];
                const plane *on = random_point(&l, s, point);
                if (!is_lit_well(&l, s, point))
                    continue;
                double normal[3];
                memcpy(normal, on->n, sizeof normal);
                if (is_smooth)
                    mean_normal(s, normal);
                const float share = share_on(&l, point, normal);
                if (!(share >= 1.0f))
                    fail_msg("%s, tilted by %g, kind %u, filter %u: a share of %g arrives at "
                             "(%g, %g, %g)",
                             what, tilt, kind, filters[f], (double)share, point[0], point[1],
                             point[2]);
            }
            end(&l);
        }
}

static const double tilts[] = {0.0, 0.3, 0.8, 1.2, 1.4, 1.44};

static void planes_are_lit(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(tilts); i++) {
        const solid s = {{tilted(tilts[i], random_in(0.0, 6.28))}, ONE};
        hold_lit(&s, 0, "a plane", tilts[i]);
    }
}

static void folds_are_lit(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(tilts); i++)
        for (joint how = RIDGE; how <= VALLEY; how++) {
            const solid s = {{tilted(tilts[i], random_in(0.0, 6.28)),
                              tilted(random_in(0.0, 1.4), random_in(0.0, 6.28))},
                             how};
            hold_lit(&s, 0, how == RIDGE ? "a ridge" : "a valley", tilts[i]);
            hold_lit(&s, 1, how == RIDGE ? "a smooth ridge" : "a smooth valley", tilts[i]);
        }
}

/* What the naive form does: a plane aslant is dark in stripes. */
static void without_slopes_planes_are_dark(void **state)
{
    const solid s = {{tilted(1.2, 0.5)}, ONE};
    (void)state;
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++) {
        lookup l;
        int dark = 0;
        begin(&l, kind, 2, &s);
        tl_u32 *texels = (tl_u32 *)(void *)((float *)(void *)l.prepared.lights +
                                            (size_t)l.shadow.texels_at * 4);
        for (size_t i = 0; i < tl_shadow_map_size(&l.maps.of[0]) / 8; i++)
            texels[2 * i + 1] = 0;
        l.shadow.slope_x = l.shadow.slope_y = 0.0f;
        for (int i = 0; i < POINTS; i++) {
            double point[3];
            const plane *on = random_point(&l, &s, point);
            dark += share_on(&l, point, on->n) < 0.75f;
        }
        assert_true(dark > POINTS / 10);
        end(&l);
    }
}

/* The floor, and before the left half of what the light sees a plate, whose rim is between two texels. */
static void fill_with_plate(tl_shadow_map *map, const plane *plate, const plane *ground)
{
    for (uint32_t v = 0; v < tl_shadow_view_count(map); v++)
        for (uint32_t y = 0; y < SIZE; y++)
            for (uint32_t x = 0; x < SIZE; x++) {
                double from[3], along[3];
                const plane *met = x < SIZE / 2 ? plate : ground;
                world_ray(&map->views[v], x + 0.5, y + 0.5, from, along);
                if (is_seen(&map->views[v], met_at(met, from, along)))
                    fill_texel(&map->views[v], met, x, y,
                               map->texels + 2 * (((size_t)v * SIZE + y) * SIZE + x));
            }
}

/* Where a ray of the view is across it, at a depth. */
static double across_at(const tl_camera *view, double x, double depth)
{
    double from[3], along[3];
    world_ray(view, x, SIZE / 2, from, along);
    return from[0] + along[0] * depth;
}

/* A step of three texels' width down, which takes three tenths of a texel: its riser is under no texel's
 * centre, and only its own normal tells of it. */
static void risers_are_lit(void **state)
{
    static const double upper = 4.0, begins = SIZE / 2 + 0.1, ends = SIZE / 2 + 0.4;
    (void)state;
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++)
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            lookup l;
            const solid s = {{tilted(0.0, 0.0)}, ONE};
            begin(&l, kind, filters[f], &s);
            const tl_camera *view = &l.maps.of[0].views[kind == TL_SHADOW_CUBE ? 5 : 0];
            const double texel =
                fabs(across_at(view, ends, upper) - across_at(view, begins, upper)) / 0.3;
            const double lower = upper + 3.0 * texel;
            const plane high = {{0, 0, 1}, -upper}, low = {{0, 0, 1}, -lower};
            fill_with_plate(&l.maps.of[0], &high, &low);
            memcpy((float *)(void *)l.prepared.lights + (size_t)l.shadow.texels_at * 4,
                   l.maps.of[0].texels, tl_shadow_map_size(&l.maps.of[0]));
            const double run = across_at(view, ends, lower) - across_at(view, begins, upper);
            const double length = hypot(run, lower - upper);
            const double normal[3] = {(lower - upper) / length, 0.0, run / length};
            for (int i = 0; i < POINTS / 10; i++) {
                const double part = random_in(0.2, 0.8);
                const double depth = upper + part * (lower - upper);
                double from[3], along[3];
                world_ray(view, SIZE / 2, random_in(20, SIZE - 20), from, along);
                const double point[3] = {across_at(view, begins, upper) + part * run,
                                         from[1] + along[1] * depth, -depth};
                const float share = share_on(&l, point, normal);
                if (!(share >= 1.0f))
                    fail_msg("kind %u, filter %u: a share of %g arrives at %g of a riser", kind,
                             filters[f], (double)share, part);
            }
            end(&l);
        }
}

/* Where the square around a place is half beside the plate, half of the light arrives; and so on, linearly.
 * */
static void rims_are_as_wide_as_the_filter(void **state)
{
    const solid s = {{tilted(0.4, 1.0)}, ONE};
    const plane plate = {{0.0, 0.0, 1.0}, -2.5};
    (void)state;
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++)
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            lookup l;
            begin(&l, kind, filters[f], &s);
            fill_with_plate(&l.maps.of[0], &plate, &s.of[0]);
            memcpy((float *)(void *)l.prepared.lights + (size_t)l.shadow.texels_at * 4,
                   l.maps.of[0].texels, tl_shadow_map_size(&l.maps.of[0]));
            const tl_camera *view = &l.maps.of[0].views[kind == TL_SHADOW_CUBE ? 5 : 0];
            for (int i = 0; i < POINTS; i++) {
                const double x = SIZE / 2 + random_in(-8.0, 8.0), y = random_in(20, SIZE - 20);
                double from[3], along[3], point[3];
                world_ray(view, x, y, from, along);
                const double far = met_at(&s.of[0], from, along);
                for (int k = 0; k < 3; k++)
                    point[k] = from[k] + far * along[k];
                const double want = fmin(fmax(0.5 + (x - SIZE / 2) / filters[f], 0.0), 1.0);
                const double got = (double)share_on(&l, point, s.of[0].n);
                if (fabs(got - want) > 1e-3)
                    fail_msg("kind %u, filter %u: %g of the light arrives %g texels from the "
                             "rim, not %g",
                             kind, filters[f], got, x - SIZE / 2, want);
            }
            end(&l);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_lit),
        cmocka_unit_test(folds_are_lit),
        cmocka_unit_test(risers_are_lit),
        cmocka_unit_test(rims_are_as_wide_as_the_filter),
        cmocka_unit_test(without_slopes_planes_are_dark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
