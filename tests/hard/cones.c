/* Cones of spot lights: cases 7 to 12.
 *
 * Which pixels a cone holds is decided from the definition, in extended precision: the cosine between its
 * axis and the way from the light against that of the outer half-angle. What the kernels decide may differ
 * from that only where the two are closer than rounding (kernels/spot.h: 7u, and 2u for the axis). */
#include "hard_case.h"
#include "hard_frames.h"

#include "directions.h"
#include "spot.h"
#include "tile_rect.h"

static const long double rounding = 0x1p-20L; /* 16u */
static const float quarter_turn = 1.57079637f, half_turn = 3.14159274f;

typedef struct lit_pixel {
    vec3 l; /* to the light, as the kernels compute it */
    float distance2;
    float along; /* axis.l, likewise */
    long double cosine, edge;
    float inner, outer; /* half-angles */
} lit_pixel;

/* Whether a usual form decides on the pixel as the definition does. */
typedef int decides(const lit_pixel *of, int inside);

static long double cosine_of(float outer)
{
    return outer == quarter_turn ? 0.0L : cosl((long double)outer);
}

static lit_pixel pixel_in_cone(const tl_camera *camera,
                               const tl_light *light,
                               const tl_view_light *view,
                               const tl_view_spot *spot,
                               vec3 at)
{
    lit_pixel p = {.l = vector_to_light(at, *view),
                   .edge = cosine_of(light->outer_cone),
                   .inner = light->inner_cone,
                   .outer = light->outer_cone};
    const double against[3] = {-(double)light->direction[0], -(double)light->direction[1],
                               -(double)light->direction[2]};
    const long double l[3] = {p.l.x, p.l.y, p.l.z};
    double axis[3];
    long double along = 0.0L, axis2 = 0.0L, length2 = 0.0L;
    tl_camera_view_direction(camera, against, axis);
    for (int i = 0; i < 3; i++) {
        along += l[i] * axis[i];
        axis2 += (long double)axis[i] * axis[i];
        length2 += l[i] * l[i];
    }
    p.cosine = along / sqrtl(axis2 * length2);
    p.distance2 = dot3(p.l, p.l);
    p.along = along_axis(*spot, p.l);
    return p;
}

/* A cone narrower than floats can tell from none is empty (docs/conventions.md). */
static int is_inside(const lit_pixel *p)
{
    return (float)p->edge != 1.0f && p->cosine > p->edge;
}

/* Whether the kernels let as much through as the definition: within 8u scale + 3u before it is squared
 * (kernels/spot.h); an inner half-angle of half a turn makes a point light. */
static int has_share(const lit_pixel *p, const tl_view_spot *spot)
{
    static const long double u = 0x1p-24L;
    const long double scale = 1.0L / fmaxl(0.001L, cosine_of(p->inner) - p->edge);
    const long double share = fmaxl(0.0L, fminl(1.0L, (p->cosine - p->edge) * scale));
    const float got = cone_share(*spot, p->l, 1.0f / sqrtf(p->distance2));
    if (p->inner >= half_turn)
        return got == 1.0f;
    return fabsl((long double)got - share * share) <=
           2.0L * (8.0L * scale + 3.0L) * u + 2.0L * u;
}

static void count_pixel(hard_bench *bench,
                        const lit_pixel *p,
                        const tl_view_light *light,
                        const tl_view_spot *spot,
                        vec3 at,
                        decides *usually)
{
    const int inside = is_inside(p), found = in_cone(*spot, p->l, p->distance2);
    const int is_sure = fabsl(p->cosine - p->edge) > rounding || (float)p->edge == 1.0f;
    const box point = {at, at};
    if (found && !cone_meets_box(*spot, *light, point))
        hard_count(bench, 0, 1);
    else if (is_sure)
        hard_count(bench, found == inside && (!found || has_share(p, spot)),
                   usually(p, inside));
}

/* Every pair of a pixel and a spot that reaches it. */
static void count_cones(hard_bench *bench,
                        const tl_gbuffer *g,
                        const tl_light_set *lights,
                        decides *usually)
{
    tl_prepared prepared = prepared_of(g, lights);
    for (uint32_t i = 0; i < prepared.frame.light_count; i++)
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++) {
                const tl_light *light = &lights->lights[prepared.sources[i]];
                const vec3 at = seen_position(&prepared, g, x, y);
                const lit_pixel p = pixel_in_cone(&g->camera, light, &prepared.lights[i],
                                                  &prepared.spots[i], at);
                if (p.distance2 > 1e-24f && reaches(prepared.lights[i], p.distance2))
                    count_pixel(bench, &p, &prepared.lights[i], &prepared.spots[i], at,
                                usually);
            }
    tl_prepared_clear(&prepared);
}

/* Cones that are aimed so that their edge passes a pixel, or at it: `miss` is the angle between the axis and
 * the way to the pixel, over the outer half-angle. */
static void add_spot(tl_light_set *lights,
                     const tl_gbuffer *g,
                     uint32_t *seed,
                     uint32_t i,
                     float outer,
                     double miss)
{
    const rim at = random_rim(g, seed, i);
    const vec3 p = position_at(g, at.x, at.y);
    double way[3], other[3], world[3], view[3];
    tl_light light = tl_light_default();
    tl_error err;
    random_direction(seed, way);
    random_direction(seed, other);
    const double distance = (double)uniform(seed, 0.2f, 5.0f);
    const double from[3] = {(double)p.x - distance * way[0], (double)p.y - distance * way[1],
                            (double)p.z - distance * way[2]};
    turn_towards(way, other, miss * (double)outer, view);
    tl_camera_world_point(&g->camera, from, world);
    for (int k = 0; k < 3; k++)
        light.position[k] = (float)world[k];
    tl_camera_world_direction(&g->camera, view, world);
    for (int k = 0; k < 3; k++)
        light.direction[k] = (float)world[k];
    light.type = TL_LIGHT_SPOT;
    light.outer_cone = outer;
    light.inner_cone = i % 2 ? outer : 0.5f * outer;
    light.range = (float)distance * uniform(seed, 1.01f, 2.0f);
    ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
}

static void try_angles(hard_bench *bench,
                       const float *angles,
                       size_t angle_count,
                       decides *usually)
{
    static const double misses[] = {0.0, 1.0, 1.0 - 1e-6, 1.0 + 1e-5, 1.0 - 1e-4, 1.0 + 1e-4};
    for (int projection = 0; projection < 2; projection++) {
        const tl_camera camera =
            camera_of(FRAME_WIDTH, FRAME_HEIGHT, (tl_projection)projection);
        tl_gbuffer *g = surfaces_between(&camera, 2.0f, 5.0f);
        tl_light_set lights = {0};
        uint32_t seed = 7;
        for (uint32_t i = 0; i < COUNT_OF(misses) * angle_count; i++)
            add_spot(&lights, g, &seed, i, angles[i / COUNT_OF(misses)],
                     misses[i % COUNT_OF(misses)]);
        count_cones(bench, g, &lights, usually);
        hard_light(bench, g, &lights);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

static int by_unsigned_square(const lit_pixel *p, int inside)
{
    const float edge = (float)p->edge;
    return (p->along > 0.0f && p->along * p->along > edge * edge * p->distance2) == inside;
}

void hard_wide_cone(hard_bench *bench)
{
    static const float angles[] = {1.58f, 1.8f, 2.2f, 2.7f, 3.1f, 3.1415925f, 3.14159274f};
    try_angles(bench, angles, COUNT_OF(angles), by_unsigned_square);
}

/* (c - cos outer) / (cos inner - cos outer), as a number. */
static int by_quotient(const lit_pixel *p, int inside)
{
    const float edge = cosf(p->outer), c = p->along / sqrtf(p->distance2);
    const float share = (c - edge) / (cosf(p->inner) - edge);
    (void)inside;
    return isfinite(share);
}

void hard_narrow_cone(hard_bench *bench)
{
    static const float angles[] = {0.0f, 1e-30f, 1e-4f, 2.4e-4f, 3e-4f, 1e-3f, 0.01f};
    try_angles(bench, angles, COUNT_OF(angles), by_quotient);
}

static int by_tangent(const lit_pixel *p, int inside)
{
    const float across2 = p->distance2 - p->along * p->along;
    return (sqrtf(fmaxf(across2, 0.0f)) < p->along * tanf(p->outer)) == inside;
}

void hard_quarter_turn(hard_bench *bench)
{
    const float angles[] = {nextafterf(quarter_turn, 0.0f), quarter_turn,
                            nextafterf(quarter_turn, INFINITY), 1.5707f, 1.5709f};
    try_angles(bench, angles, COUNT_OF(angles), by_tangent);
}

static int is_within_rect(tl_tile_rect inner, tl_tile_rect outer)
{
    return inner.x0 >= inner.x1 || (inner.x0 >= outer.x0 && inner.x1 <= outer.x1 &&
                                    inner.y0 >= outer.y0 && inner.y1 <= outer.y1);
}

static int holds_lit_pixels(const tl_gbuffer *g,
                            const tl_prepared *prepared,
                            uint32_t i,
                            tl_tile_rect rect)
{
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const vec3 l =
                vector_to_light(seen_position(prepared, g, x, y), prepared->lights[i]);
            const float distance2 = dot3(l, l);
            const int tile_x = (int)(x / prepared->frame.tile_size);
            const int tile_y = (int)(y / prepared->frame.tile_size);
            if (reaches(prepared->lights[i], distance2) &&
                in_cone(prepared->spots[i], l, distance2) &&
                (tile_x < rect.x0 || tile_x >= rect.x1 || tile_y < rect.y0 ||
                 tile_y >= rect.y1))
                return 0;
        }
    return 1;
}

void hard_cone_sphere(hard_bench *bench)
{
    static const float angles[] = {0.3f,        0.785398f,   0.785399f,   1.2f,
                                   1.5f,        1.57f,       1.57079625f, 1.57079637f,
                                   1.57079649f, 3.14159274f, 0.0f};
    const tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = surfaces_between(&camera, 2.0f, 5.0f);
    tl_light_set lights = {0};
    uint32_t seed = 10;
    for (uint32_t i = 0; i < 6 * COUNT_OF(angles); i++)
        add_spot(&lights, g, &seed, i, angles[i / 6], i % 2 ? 0.0 : 1.0 - 1e-6);
    tl_prepared prepared = prepared_of(g, &lights);
    const tl_view_window window =
        view_window(&prepared.frame, TL_LEAST_DEPTH(0), TL_GREATEST_DEPTH, 0);
    for (uint32_t i = 0; i < prepared.frame.light_count; i++) {
        const tl_tile_rect whole = tile_rect_of(window, &prepared.frame, prepared.lights[i]);
        const tl_tile_rect rect =
            tile_rect_of_spot(window, &prepared.frame, prepared.lights[i], prepared.spots[i]);
        const float edge = prepared.spots[i].least_cos;
        hard_count(bench,
                   is_within_rect(rect, whole) && holds_lit_pixels(g, &prepared, i, rect),
                   1.0f / (2.0f * edge * edge) <= 1.0f);
    }
    tl_prepared_clear(&prepared);
    hard_light(bench, g, &lights);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

/* The cosine of the edge in 16 bits, as packed lights have it: 11 bits of mantissa. */
static int by_half(const lit_pixel *p, int inside)
{
    int exponent;
    const double mantissa = frexp((double)p->edge, &exponent);
    const double edge = ldexp(rint(ldexp(mantissa, 11)), exponent - 11);
    return ((double)p->cosine > edge) == inside;
}

void hard_cone_edge(hard_bench *bench)
{
    static const float angles[] = {0.003f, 0.03f, 0.3f, 0.7f, 1.2f, 1.7f, 2.9f};
    try_angles(bench, angles, COUNT_OF(angles), by_half);
}

/* The distance from the axis as the root of |l|^2 - (axis.l)^2. */
static int by_root(const lit_pixel *p, int inside)
{
    (void)inside;
    return p->distance2 - p->along * p->along >= 0.0f;
}

void hard_cone_axis(hard_bench *bench)
{
    const tl_camera camera = camera_of(FRAME_WIDTH, FRAME_HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g = surfaces_between(&camera, 2.0f, 5.0f);
    tl_light_set lights = {0};
    uint32_t seed = 12;
    for (uint32_t i = 0; i < 60; i++)
        add_spot(&lights, g, &seed, i, i % 2 ? 0.01f : half_turn / 3.0f, 0.0);
    count_cones(bench, g, &lights, by_root);
    hard_light(bench, g, &lights);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}
