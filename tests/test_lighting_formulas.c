/* Do the reference, and the kernels in float, give what the published equations say?
 *
 * The oracle is written from the equations, in long double and world space: it shares no header with the
 * kernels. Phong: Policarpo and Fonseca 2005, equations 1 to 4 (with the half vector of unit vectors,
 * specular 0 where N.L <= 0); normalised Blinn-Phong, and a linear falloff that begins at a distance: the
 * ISPC project's deferred example; Lambert; inverse square and the cones of spots: KHR_lights_punctual;
 * metal-rough to Phong: docs/conventions.md. What may lie between the two is derived below, light by light. */
#include "frames.h"

#include "prepared.h"
#include "reach.h"

#include <float.h>

enum { WIDTH = 40, HEIGHT = 30, LIGHT_COUNT = 30 };

typedef long double wide;
typedef struct v3 {
    wide v[3];
} v3;

static wide dot(v3 a, v3 b)
{
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

static v3 add(v3 a, wide k, v3 b)
{
    for (int i = 0; i < 3; i++)
        a.v[i] += k * b.v[i];
    return a;
}

static v3 unit(v3 a)
{
    const v3 zero = {{0, 0, 0}};
    return add(zero, 1 / sqrtl(dot(a, a)), a);
}

static v3 from_floats(const float f[3])
{
    return (v3){{f[0], f[1], f[2]}};
}

/* Rows of the view matrix as world vectors; the eye as a point. */
static v3 axis(const tl_camera *c, int row)
{
    return from_floats(c->view_from_world[row]);
}

/* The camera's matrix is a rotation to float only; its inverse is taken, not its transpose. */
static v3 world_from_view(const tl_camera *c, v3 p)
{
    v3 rows[3], out = {{0, 0, 0}};
    wide det, k[3];
    for (int i = 0; i < 3; i++) {
        rows[i] = axis(c, i);
        k[i] = p.v[i];
    }
    for (int i = 0; i < 3; i++) {
        const v3 a = rows[(i + 1) % 3], b = rows[(i + 2) % 3];
        const v3 cross = {{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2],
                           a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
        det = dot(rows[i], cross);
        out = add(out, k[i] / det, cross);
    }
    return out;
}

static wide fade(const tl_light *light, wide d)
{
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return 1;
    if (d >= (wide)light->range)
        return 0;
    if (light->falloff == TL_FALLOFF_LINEAR)
        return d <= (wide)light->begin
                   ? 1
                   : ((wide)light->range - d) / ((wide)light->range - (wide)light->begin);
    const wide share = isinf(light->range) ? 0 : d / (wide)light->range;
    const wide nearest = d < 0.01L ? 0.01L : d;
    return (1 - share * share * share * share) / (nearest * nearest);
}

/* What a spot's cone lets through, where cosines are off by `off`; in float its sum and square are, too. */
static wide cone(const tl_light *light, v3 to_light, wide off)
{
    if (light->type != TL_LIGHT_SPOT || light->inner_cone >= 3.14159274f)
        return 1;
    const wide cosine = -dot(unit(from_floats(light->direction)), to_light) + off;
    const wide outer = cosl((wide)light->outer_cone);
    const wide share = (cosine - outer) / fmaxl(0.001L, cosl((wide)light->inner_cone) - outer);
    const wide cut = fminl(1, fmaxl(0, share));
    return cut * cut;
}

static float value(const tl_gbuffer *g, int plane, size_t at)
{
    const float *values = tl_gbuffer_plane(g, (enum tl_plane)plane);
    return values ? values[at] : plane == TL_OCCLUSION ? 1.0f : 0.0f;
}

static v3 values(const tl_gbuffer *g, int first, size_t at)
{
    return (v3){{value(g, first, at), value(g, first + 1, at), value(g, first + 2, at)}};
}

typedef struct seen {
    v3 point, normal, eye, albedo, diffuse, specular,
        emissive; /* world space; eye: a direction */
    wide shininess, occlusion;
} seen;

static seen surface(const tl_gbuffer *g, uint32_t x, uint32_t y)
{
    const tl_camera *c = &g->camera;
    const size_t at = (size_t)y * g->pitch + x;
    const wide depth = value(g, TL_DEPTH, at);
    const wide sx = c->left + ((wide)x + 0.5L) * ((wide)c->right - c->left) / c->width;
    const wide sy = c->top + ((wide)y + 0.5L) * ((wide)c->bottom - c->top) / c->height;
    const int parallel = c->projection == TL_ORTHOGRAPHIC;
    v3 view = {{parallel ? sx : sx * depth, parallel ? sy : sy * depth, -depth}};
    const v3 towards = {{0, 0, 1}}, none = {{0, 0, 0}};
    seen s;
    s.eye = unit(world_from_view(c, parallel ? towards : add(none, -1, view)));
    for (int i = 0; i < 3; i++)
        view.v[i] -= c->view_from_world[i][3];
    s.point = world_from_view(c, view);
    s.normal = unit(values(g, TL_NORMAL_X, at));
    s.albedo = s.diffuse = values(g, TL_ALBEDO_R, at);
    s.specular = values(g, TL_SPECULAR_R, at);
    s.emissive = values(g, TL_EMISSIVE_R, at);
    s.shininess = value(g, TL_SHININESS, at);
    s.occlusion = value(g, TL_OCCLUSION, at);
    if (g->present & TL_GROUP_METAL_ROUGH) {
        const wide metal = value(g, TL_METALLIC, at), rough = value(g, TL_ROUGHNESS, at);
        const wide alpha2 = fmaxl(powl(rough, 4), 2.0L / 10002);
        for (int i = 0; i < 3; i++) {
            s.diffuse.v[i] = s.albedo.v[i] * (1 - metal);
            s.specular.v[i] = 0.04L + metal * (s.albedo.v[i] - 0.04L);
        }
        s.shininess = 2 / alpha2 - 2;
    }
    return s;
}

/* What each arithmetic may add, in u = 2^-24. */
typedef struct arithmetic {
    tl_precision precision;
    /* What a frame hands to the formulas is rounded to float: the light in view space, the rays,
     * the camera's matrix: together they displace a light from a surface by at most 8u of the
     * distances involved. Computing position, difference and length in float adds 6u. */
    wide displaced;
    /* Of each term: falloff 6u (falloff.h), N.L 6u, colours 4u, and 1u for each later sum. */
    wide term;
    wide lobe; /* times 40: specular.h */
} arithmetic;

static const wide u = 0x1p-24L;
static const arithmetic reference = {TL_PRECISION_REFERENCE, 8, 2, 0};
static const arithmetic single = {TL_PRECISION_TWIN, 14, 16 + LIGHT_COUNT, 1};

static wide displacement(const tl_camera *c, v3 point)
{
    const wide moved = sqrtl(dot(point, point)) + fabsl((wide)c->view_from_world[0][3]) +
                       fabsl((wide)c->view_from_world[1][3]) +
                       fabsl((wide)c->view_from_world[2][3]);
    return moved;
}

/* Radiance, and in *slack how far it moves when every light is displaced: falloffs fall, so their
 * ends bound them; directions turn by displacement / distance, which changes N.L by as much and
 * cos^e by at most sqrt(e) of it, where e sin cos^(e - 1) is steepest. */
static v3 radiance(const tl_gbuffer *g,
                   const tl_light_set *lights,
                   const arithmetic *by,
                   uint32_t x,
                   uint32_t y,
                   v3 *slack)
{
    const seen s = surface(g, x, y);
    const wide moved = by->displaced * u * displacement(&g->camera, s.point);
    const int normalized = lights->model == TL_MODEL_BLINN_PHONG_NORMALIZED;
    v3 out = s.emissive;
    for (int i = 0; i < 3; i++) {
        out.v[i] += s.albedo.v[i] * lights->ambient[i] * s.occlusion;
        slack->v[i] = by->term * u * out.v[i];
    }
    for (size_t n = 0; n < lights->count; n++) {
        const tl_light *light = &lights->lights[n];
        const v3 none = {{0, 0, 0}};
        const v3 away = light->type == TL_LIGHT_DIRECTIONAL
                            ? add(none, -1, from_floats(light->direction))
                            : add(from_floats(light->position), -1, s.point);
        const v3 l = unit(away), h = unit(add(l, 1, s.eye));
        const wide n_dot_l = dot(s.normal, l), n_dot_h = dot(s.normal, h);
        const wide d = sqrtl(dot(away, away)), turn = moved / d + 4 * u;
        const wide weight = fade(light, d) * cone(light, l, 0) * light->intensity;
        /* Of a cosine: how far the way turns, and 8u in float (kernels/spot.h), which has its own
         * cosine, axis and scale rounded, 3u. */
        const wide off = turn + 11 * u;
        const wide fall = (fade(light, d - moved) * cone(light, l, off) -
                           fade(light, d + moved) * cone(light, l, -off)) *
                          light->intensity;
        const wide lobe = n_dot_h > 0 ? powl(n_dot_h, s.shininess) : 0;
        /* The normalised lobe's cosine turns too, but is not above 1. */
        const wide steep = turn * (1 + sqrtl(s.shininess) + normalized) + by->lobe * u * 40;
        for (int i = 0; i < 3; i++) {
            const wide diffuse = light->color[i] * s.diffuse.v[i] * light->diffuse;
            wide specular = light->color[i] * s.specular.v[i] * light->specular;
            if (lights->model == TL_MODEL_LAMBERT)
                specular = 0;
            if (normalized)
                specular *= s.diffuse.v[i] * (s.shininess + 2) / 8;
            if (n_dot_l > 0)
                out.v[i] +=
                    weight * (diffuse * n_dot_l + specular * lobe * (normalized ? n_dot_l : 1));
            slack->v[i] += (fall + weight * by->term * u) * (diffuse + specular) +
                           weight * (diffuse * turn + specular * steep);
            if (fabsl(n_dot_l) < turn)
                slack->v[i] += weight * specular;
        }
    }
    return out;
}

/* Inner and outer half-angles: soft, hard, half of space, more than that, all of it, with an edge and
 * without. */
static const float cones[][2] = {{0.3f, 0.6f}, {0.8f, 0.8f},        {0.0f, 1.57079637f},
                                 {1.0f, 2.5f}, {0.0f, 3.14159274f}, {3.14159274f, 3.14159274f}};

/* Aimed into the middle of what is seen, more or less. */
static void aim(const tl_camera *camera, uint32_t *seed, size_t number, tl_light *light)
{
    const double view[3] = {(double)uniform(seed, -2.0f, 2.0f),
                            (double)uniform(seed, -2.0f, 2.0f), -4.5};
    double world[3], length2 = 0.0;
    tl_camera_world_point(camera, view, world);
    for (int i = 0; i < 3; i++) {
        world[i] -= (double)light->position[i];
        length2 += world[i] * world[i];
    }
    for (int i = 0; i < 3; i++)
        light->direction[i] = (float)(world[i] / sqrt(length2));
    light->type = TL_LIGHT_SPOT;
    light->inner_cone = cones[number % COUNT_OF(cones)][0];
    light->outer_cone = cones[number % COUNT_OF(cones)][1];
}

static void add_lights(const tl_camera *camera, tl_light_set *lights)
{
    uint32_t seed = 1975;
    tl_error err;
    for (int i = 0; i < LIGHT_COUNT; i++) {
        tl_light light = random_light(camera, &seed, 0.5f, 6.0f);
        light.intensity = uniform(&seed, 0.1f, 3.0f);
        if (light.falloff == TL_FALLOFF_LINEAR && i % 3 != 0)
            light.begin = light.range * (i % 3 == 1 ? 0.5f : 0.9f);
        if (i % 10 == 0)
            light.type = TL_LIGHT_DIRECTIONAL;
        if (i % 10 == 1) {
            light.range = INFINITY;
            light.begin = 0.0f;
            light.falloff = TL_FALLOFF_INVERSE_SQUARE;
        }
        if (i % 10 >= 6 || i == 11)
            aim(camera, &seed, (size_t)i, &light);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
    for (int i = 0; i < 3; i++) {
        lights->ambient[i] = 0.05f + 0.1f * (float)i;
        lights->sky[i] = 0.25f * (float)i;
    }
}

static void assert_frame(const arithmetic *by,
                         uint32_t present,
                         tl_projection projection,
                         enum tl_shading_model model)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, projection);
    const tl_lighting_options options = {.precision = by->precision, .tile_size = 16};
    tl_gbuffer *g = random_gbuffer(&camera, present, 42);
    tl_image *got = image_like(g);
    tl_light_set lights = {0};
    add_lights(&camera, &lights);
    lights.model = model;
    light_frame(NULL, &options, g, &lights, got);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint32_t x = i % WIDTH, y = i / WIDTH;
        const int sky = isinf(value(g, TL_DEPTH, (size_t)y * g->pitch + x));
        v3 slack = {{1e-7L, 1e-7L, 1e-7L}};
        const v3 want = sky ? from_floats(lights.sky) : radiance(g, &lights, by, x, y, &slack);
        for (unsigned c = 0; c < 3; c++) {
            const wide v = (wide)tl_image_plane(got, c)[(size_t)y * got->pitch + x];
            if (!(fabsl(v - want.v[c]) <= slack.v[c]))
                fail_msg("pixel (%u, %u), channel %u: got %.9Lg, want %.9Lg", x, y, c, v,
                         want.v[c]);
        }
    }
    tl_light_set_clear(&lights);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

static const uint32_t scenes[] = {
    TL_GROUP_BASE,
    TL_GROUP_BASE | TL_GROUP_PHONG,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION,
    TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
};

static void equations_hold(const arithmetic *by)
{
    for (size_t i = 0; i < COUNT_OF(scenes); i++)
        for (int model = 0; model < TL_MODEL_COUNT; model++) {
            if (!(traits_of((tl_u32)model) & TL_LOBE_PLAIN)) /* tests/test_model_lobes.c */
                continue;
            assert_frame(by, scenes[i], TL_PERSPECTIVE, (enum tl_shading_model)model);
            assert_frame(by, scenes[i], TL_ORTHOGRAPHIC, (enum tl_shading_model)model);
        }
}

static void equations_hold_for_the_reference(void **state)
{
    (void)state;
    equations_hold(&reference);
}

/* The twin's bits are the kernels' bits: tests/test_same_bits.c. */
static void equations_hold_in_float(void **state)
{
    (void)state;
    equations_hold(&single);
}

/* One light at the eye, one surface that faces it: every factor can be done by hand. */
static void one_light_by_hand(void **state)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    static const struct {
        tl_falloff falloff;
        float range, begin, intensity, want; /* at 2 m, albedo 0.5 */
    } cases[] = {
        {TL_FALLOFF_LINEAR, 4.0f, 0.0f, 1.0f, 0.25f},
        {TL_FALLOFF_LINEAR, 2.0f, 0.0f, 1.0f, 0.0f},
        {TL_FALLOFF_LINEAR, 5.0f, 1.0f, 1.0f, 0.375f},
        {TL_FALLOFF_LINEAR, 4.0f, 2.5f, 1.0f, 0.5f},
        {TL_FALLOFF_LINEAR, 4.0f, 4.0f, 1.0f, 0.5f}, /* ends where it begins */
        {TL_FALLOFF_LINEAR, 0x1.000002p1f, 0x1p1f, 1.0f, 0.5f},
        {TL_FALLOFF_LINEAR, 2.0f, 2.0f, 1.0f, 0.0f},
        {TL_FALLOFF_LINEAR, 2.0f, 1.0f, 1.0f, 0.0f},
        {TL_FALLOFF_INVERSE_SQUARE, INFINITY, 0.0f, 8.0f, 1.0f},
        {TL_FALLOFF_INVERSE_SQUARE, 4.0f, 0.0f, 8.0f, 0.9375f},
        {TL_FALLOFF_INVERSE_SQUARE, 1.9f, 0.0f, 8.0f, 0.0f},
    };
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 1, 1, 0.1, 10.0);
    const tl_lighting_options options = {.precision = TL_PRECISION_TWIN, .tile_size = 8};
    tl_gbuffer *g = NULL;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    tl_image *image = image_like(g);
    set_pixel(g, TL_DEPTH, 0, 2.0f);
    set_pixel(g, TL_NORMAL_Z, 0, 1.0f);
    set_pixel(g, TL_ALBEDO_R, 0, 0.5f);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_light_set lights = {0};
        tl_light light = tl_light_default();
        light.falloff = cases[i].falloff;
        light.range = cases[i].range;
        light.begin = cases[i].begin;
        light.intensity = cases[i].intensity;
        ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
        light_frame(NULL, &options, g, &lights, image);
        assert_true(same_bits(tl_image_plane(image, 0)[0], cases[i].want));
        assert_true(same_bits(tl_image_plane(image, 1)[0], 0.0f));
        tl_light_set_clear(&lights);
    }
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

/* Kernels are promised finite numbers, however near a falloff begins to where it ends; and where lights
 * are kept that reach nothing. */
static void falloffs_stay_finite(void **state)
{
    static const float ranges[] = {1e-45f, 1e-38f, 1.0f, 1e18f, FLT_MAX};
    const tl_camera camera = camera_of(1, 1, TL_PERSPECTIVE);
    tl_gbuffer *g = NULL;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    for (size_t i = 0; i < COUNT_OF(ranges); i++)
        for (int k = 0; k < 3; k++) {
            const float r = ranges[i];
            tl_light_set lights = {0};
            tl_prepared prepared = {0};
            tl_light light = tl_light_default();
            float offset;
            light.falloff = TL_FALLOFF_LINEAR;
            light.range = r;
            light.begin = k == 0 ? 1e-45f : k == 1 ? nextafterf(r, 0.0f) : r;
            ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
            ASSERT_OK(tl_prepare(g, &lights,
                                 &(tl_prepare_options){.tile_size = 16,
                                                       .box_count = 1,
                                                       .effects = TL_EFFECTS_ALL},
                                 NULL, &prepared, &err),
                      err);
            memcpy(&offset, &prepared.lights[0].falloff, sizeof offset);
            assert_true(isfinite(prepared.lights[0].fade));
            if (light.begin > 0.0f)
                assert_true(offset >= 1.0f && offset <= 0x1p24f);
            tl_prepared_clear(&prepared);
            tl_light_set_clear(&lights);
        }
    tl_gbuffer_destroy(g);
}

/* A surface 2 m before the eye, that a spot at the eye lights straight on, turned away by `turn`. */
static float spot_at(float inner, float outer, double turn, float range, tl_light_type type)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 1, 1, 0.1, 10.0);
    const tl_lighting_options options = {.precision = TL_PRECISION_TWIN, .tile_size = 8};
    tl_light_set lights = {0};
    tl_light light = tl_light_default();
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    tl_image *image = image_like(g);
    set_pixel(g, TL_DEPTH, 0, 2.0f);
    set_pixel(g, TL_NORMAL_Z, 0, 1.0f);
    set_pixel(g, TL_ALBEDO_R, 0, 1.0f);
    light.type = type;
    light.range = range;
    light.inner_cone = inner;
    light.outer_cone = outer;
    light.intensity = 4.0f;
    light.direction[0] = (float)sin(turn);
    light.direction[2] = (float)-cos(turn);
    ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    light_frame(NULL, &options, g, &lights, image);
    const float got = tl_image_plane(image, 0)[0];
    tl_light_set_clear(&lights);
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
    return got;
}

/* Where its meaning leaves no room for rounding: 0 outside, all of the light within the inner cone. */
static void cones_by_hand(void **state)
{
    static const float quarter = 1.57079637f, half = 3.14159274f;
    static const struct {
        const char *name;
        float inner, outer;
        double turn;
        float want; /* share of the light */
    } cases[] = {
        {"no width, on the axis", 0.0f, 0.0f, 0.0, 0.0f},
        {"next to no width, on the axis", 0.0f, 1e-4f, 0.0, 0.0f},
        {"within the inner cone", 0.5f, 0.6f, 0.45, 1.0f},
        {"outside", 0.5f, 0.6f, 0.65, 0.0f},
        {"hard, within", 0.5f, 0.5f, 0.49, 1.0f},
        {"hard, outside", 0.5f, 0.5f, 0.51, 0.0f},
        {"half of space, on the axis", 0.0f, quarter, 0.0, 1.0f},
        {"half of space, outside", 0.0f, quarter, 1.58, 0.0f},
        {"half of space, hard, within", quarter, quarter, 1.56, 1.0f},
        {"more than half of space, within", 2.0f, 2.5f, 1.9, 1.0f},
        {"more than half of space, outside", 2.0f, 2.5f, 2.6, 0.0f},
        {"all of it, hard, but for what is behind", 3.0f, half, 2.9, 1.0f},
        {"all of it, behind", half, half, 3.14159265358979, 1.0f},
        {"all of it", half, half, 2.0, 1.0f},
    };
    static const float ranges[] = {4.0f, INFINITY};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        for (size_t r = 0; r < COUNT_OF(ranges); r++) {
            const float point = spot_at(0, 1, 0.0, ranges[r], TL_LIGHT_POINT);
            const float got = spot_at(cases[i].inner, cases[i].outer, cases[i].turn, ranges[r],
                                      TL_LIGHT_SPOT);
            if (!same_bits(got, cases[i].want * point))
                fail_msg("%s: %a, want %a", cases[i].name, (double)got,
                         (double)(cases[i].want * point));
        }
}

/* A light contributes if and only if d2 < range2. */
static void range_is_exclusive(void **state)
{
    const tl_view_light light = {.range2 = 2.0f};
    (void)state;
    assert_true(reaches(light, nextafterf(2.0f, 0.0f)));
    assert_false(reaches(light, 2.0f));
    assert_false(reaches(light, NAN));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equations_hold_for_the_reference),
        cmocka_unit_test(equations_hold_in_float),
        cmocka_unit_test(one_light_by_hand),
        cmocka_unit_test(cones_by_hand),
        cmocka_unit_test(falloffs_stay_finite),
        cmocka_unit_test(range_is_exclusive),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
