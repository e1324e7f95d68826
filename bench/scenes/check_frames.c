#include "check_frames.h"

#include "bench_scene.h"
#include "ray_cast.h"
#include "scene_lights.h"
#include "try.h"

#include <math.h>
#include <string.h>

enum {
    ORTHOGRAPHIC = 1,
    STRETCHED = 2, /* normals that are not of length 1 */
    PEAKS = 4,     /* exponents up to 10000, lights that are mirrored to the eye */
    MIXED = 8,     /* both falloffs, a sun, a lamp without a range, ambient light, a sky */
    EDGES = 16,  /* lights that reach a pixel, or stand above its surface, to within rounding */
    CUTOFF = 32, /* lights without a range, which a cutoff ends while they are bright */
    ALL_SKY = 64,
    LATER = 128,      /* half of the linear falloffs begin at a distance, some where they end */
    NORMALIZED = 256, /* lit by the model blinn-phong-normalized */
    SPOTS = 512       /* most lights are spots, of every angle, some with an edge at a pixel */
};

#define PHONG (TL_GROUP_BASE | TL_GROUP_PHONG)
#define METAL (TL_GROUP_BASE | TL_GROUP_METAL_ROUGH)
#define ALL_EXTRAS (TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE)

typedef struct check_frame {
    const char *name, *meaning, *scene;
    uint32_t width, height, light_count;
    double range; /* m */
    uint32_t present;
    int traits;
} check_frame;

static const check_frame frames[] = {
    {"spheres", "bumped spheres, 64 lights, a quarter sky", "spheres", 97, 61, 64, 3.0, PHONG,
     0},
    {"wall", "a wall, 300 lights", "wall", 64, 64, 300, 1.5, PHONG, 0},
    {"foliage", "depth breaks in every tile, 100 lights", "foliage", 65, 43, 100, 2.0, PHONG,
     0},
    {"grazing", "a floor to the horizon, 48 lights", "grazing", 130, 35, 48, 6.0, PHONG, 0},
    {"matte", "no specular planes", "spheres", 49, 31, 40, 4.0, TL_GROUP_BASE, MIXED},
    {"mixed", "both falloffs, a sun, a lamp without a range, ambient light, a sky", "spheres",
     61, 40, 60, 4.0, PHONG, MIXED},
    {"metal", "metallic and roughness, occlusion, emission", "spheres", 83, 47, 60, 4.0,
     METAL | ALL_EXTRAS, MIXED},
    {"orthographic", "parallel rays, Phong, emission", "wall", 61, 40, 50, 3.0,
     PHONG | TL_GROUP_EMISSIVE, MIXED | ORTHOGRAPHIC},
    {"normals", "normals of lengths from 0.25 to 4", "wall", 40, 40, 50, 3.0, PHONG,
     MIXED | STRETCHED},
    {"peaks", "exponents from 0 to 10000, lights in highlights", "wall", 64, 48, 120, 4.0,
     PHONG, MIXED | PEAKS},
    {"later", "linear falloffs that begin at a distance, some where they end", "spheres", 67,
     45, 60, 4.0, PHONG, MIXED | LATER},
    {"normalized", "the model blinn-phong-normalized, exponents from 0 to 10000", "wall", 64,
     40, 100, 4.0, PHONG, MIXED | PEAKS | LATER | NORMALIZED},
    {"normalized-metal", "the same model on metallic and roughness", "spheres", 51, 37, 60, 4.0,
     METAL | ALL_EXTRAS, MIXED | NORMALIZED},
    {"edges", "lights whose range ends at a pixel, in the plane of its surface, or 5 mm off it",
     "wall", 48, 33, 120, 1.0, PHONG, EDGES},
    {"cutoff", "lights without a range, ended by a cutoff where they are bright", "wall", 50,
     30, 60, 1.0, PHONG, CUTOFF},
    {"spots", "spot lights of every angle, some whose edge is at a pixel", "spheres", 71, 44,
     90, 5.0, PHONG, MIXED | LATER | SPOTS},
    {"spots-parallel", "the same under parallel rays, and the model blinn-phong-normalized",
     "wall", 45, 39, 70, 5.0, METAL | ALL_EXTRAS, MIXED | ORTHOGRAPHIC | NORMALIZED | SPOTS},
    {"many", "1500 lights on every tile", "wall", 24, 24, 1500, 30.0, PHONG, 0},
    {"unlit", "no light, ambient light only", "spheres", 33, 17, 0, 1.0, METAL | ALL_EXTRAS,
     MIXED},
    {"sky", "nothing hit, 20 lights", "wall", 40, 24, 20, 3.0, PHONG, MIXED | ALL_SKY},
    {"dot", "one pixel, three lights", "wall", 1, 1, 3, 5.0, PHONG, 0},
};
const int tl_check_frame_count = sizeof frames / sizeof frames[0];

static const float cutoff = 0.5f; /* lx */

const char *tl_check_frame_name(int index)
{
    return frames[index].name;
}

const char *tl_check_frame_meaning(int index)
{
    return frames[index].meaning;
}

/* A number in [0, 1): xorshift32, whose first numbers are small while the seed is. */
static double random_number(uint32_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return (double)*seed * 0x1p-32;
}

static double random_between(uint32_t *seed, double low, double high)
{
    return low + (high - low) * random_number(seed);
}

/* The scenes' camera looks along world -z: kernels that forget to turn normals would show nothing. */
static void turn(tl_camera *camera)
{
    static const double eye[3] = {3.0, -2.0, 5.0}, target[3] = {2.5, -2.2, 1.0};
    static const double up[3] = {0.1, 1.0, 0.2};
    const tl_camera turned = tl_camera_look_at(eye, target, up, 1.0, 1, 1, 0.1, 1.0);
    memcpy(camera->view_from_world, turned.view_from_world, sizeof camera->view_from_world);
}

static tl_camera camera_of(const check_frame *row, const tl_gbuffer *cast)
{
    static const float metres = 6.0f; /* where a perspective view is as wide */
    tl_camera camera = cast->camera;
    if (row->traits & ORTHOGRAPHIC) {
        camera.projection = TL_ORTHOGRAPHIC;
        camera.left *= metres;
        camera.right *= metres;
        camera.bottom *= metres;
        camera.top *= metres;
    }
    if (row->traits & MIXED)
        turn(&camera);
    return camera;
}

/* The same surface before a camera that is turned. */
static void turn_normal(const tl_gbuffer *from, tl_gbuffer *to, size_t at)
{
    double world[3], view[3], turned[3];
    for (int i = 0; i < 3; i++)
        world[i] = (double)tl_gbuffer_plane(from, (enum tl_plane)(TL_NORMAL_X + i))[at];
    tl_camera_view_direction(&from->camera, world, view);
    tl_camera_world_direction(&to->camera, view, turned);
    for (int i = 0; i < 3; i++)
        tl_gbuffer_plane(to, (enum tl_plane)(TL_NORMAL_X + i))[at] = (float)turned[i];
}

/* What the scene computed, where this frame has it too. */
static void copy_planes(const tl_gbuffer *from, tl_gbuffer *to)
{
    const size_t size = (size_t)from->pitch * from->rows * sizeof(float);
    for (int p = 0; p < TL_PLANE_COUNT; p++) {
        const float *source = tl_gbuffer_plane(from, (enum tl_plane)p);
        float *target = tl_gbuffer_plane(to, (enum tl_plane)p);
        if (source && target)
            memcpy(target, source, size);
    }
    for (size_t at = 0; at < (size_t)to->pitch * to->rows; at++)
        turn_normal(from, to, at);
}

static void set(tl_gbuffer *g, enum tl_plane plane, size_t at, double value)
{
    float *values = tl_gbuffer_plane(g, plane);
    if (values)
        values[at] = (float)value;
}

static void dress_pixel(const check_frame *row, tl_gbuffer *g, size_t at, uint32_t *seed)
{
    static const double exponents[] = {0.0, 1.0, 10.0, 100.0, 1000.0, 10000.0};
    const double ends[] = {0.0, 1.0, random_number(seed), random_number(seed)};
    const double stretch = exp2(random_between(seed, -2.0, 2.0));
    set(g, TL_METALLIC, at, ends[(int)random_between(seed, 0.0, 4.0)]);
    set(g, TL_ROUGHNESS, at, ends[(int)random_between(seed, 0.0, 4.0)]);
    set(g, TL_OCCLUSION, at, random_number(seed));
    for (int i = 0; i < 3; i++) {
        float *normal = tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + i));
        set(g, (enum tl_plane)(TL_EMISSIVE_R + i), at, 0.2 * random_number(seed));
        if (row->traits & STRETCHED)
            normal[at] *= (float)stretch;
    }
    if (row->traits & PEAKS)
        set(g, TL_SHININESS, at, exponents[(int)random_between(seed, 0.0, 6.0)]);
}

static int is_hit(const tl_gbuffer *g, size_t at)
{
    return !isinf(tl_gbuffer_plane(g, TL_DEPTH)[at]);
}

static void dress(const check_frame *row, tl_gbuffer *g)
{
    uint32_t seed = 2463534242u;
    for (uint32_t y = 0; y < row->height; y++)
        for (uint32_t x = 0; x < row->width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            if (is_hit(g, at))
                dress_pixel(row, g, at, &seed);
        }
}

static tl_status mix_lights(tl_light_set *lights, tl_error *err)
{
    tl_status status = TL_OK;
    uint32_t seed = 88675123u;
    tl_light sun = tl_light_default(), lamp = tl_light_default();
    for (size_t i = 0; i < lights->count; i++) {
        tl_light *light = &lights->lights[i];
        light->falloff = i % 2 ? TL_FALLOFF_LINEAR : TL_FALLOFF_INVERSE_SQUARE;
        light->intensity = (float)random_between(&seed, 0.2, 2.0);
        light->diffuse = (float)random_between(&seed, 0.0, 1.5);
        light->specular = (float)random_between(&seed, 0.0, 1.5);
    }
    for (int i = 0; i < 3; i++) {
        sun.direction[i] = (float[]){0.48f, -0.6f, -0.64f}[i];
        lamp.position[i] = (float[]){1.0f, 3.0f, -5.0f}[i];
        lights->ambient[i] = 0.02f * (float)(i + 1);
        lights->sky[i] = 0.1f * (float)(i + 1);
    }
    sun.type = TL_LIGHT_DIRECTIONAL;
    sun.intensity = 0.4f;
    lamp.intensity = 3.0f;
    if (lights->count > 0) {
        TRY(tl_light_set_add(lights, &sun, err));
        TRY(tl_light_set_add(lights, &lamp, err));
    }
done:
    return status;
}

static void begin_later(tl_light_set *lights)
{
    uint32_t seed = 521288629u;
    for (size_t i = 1; i < lights->count; i += 2) {
        tl_light *light = &lights->lights[i];
        if (light->falloff == TL_FALLOFF_LINEAR)
            light->begin =
                i % 10 == 1 ? light->range : light->range * (float)random_number(&seed);
    }
}

/* Some pixel: its point and its normal, world space. */
static void some_surface(const tl_gbuffer *g, uint32_t *seed, double point[3], double normal[3])
{
    const tl_camera *c = &g->camera;
    const uint32_t x = (uint32_t)random_between(seed, 0.0, c->width);
    const uint32_t y = (uint32_t)random_between(seed, 0.0, c->height);
    const size_t at = (size_t)y * g->pitch + x;
    const double depth = (double)tl_gbuffer_plane(g, TL_DEPTH)[at];
    const double ray[2] = {
        (double)c->left + (x + 0.5) * ((double)c->right - (double)c->left) / c->width,
        (double)c->top + (y + 0.5) * ((double)c->bottom - (double)c->top) / c->height};
    const double view[3] = {ray[0] * depth, ray[1] * depth, -depth};
    tl_camera_world_point(c, view, point);
    for (int i = 0; i < 3; i++)
        normal[i] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + i))[at];
}

static double distance_to(const tl_light *light, const double point[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        const double along = (double)light->position[i] - point[i];
        square += along * along;
    }
    return sqrt(square);
}

static void place(tl_light *light, const double from[3], const double direction[3], double away)
{
    for (int i = 0; i < 3; i++)
        light->position[i] = (float)(from[i] + away * direction[i]);
}

/* So that the light ends at the point, bright as it is there. */
static void end_by_cutoff(tl_light *light, const double point[3])
{
    const double d = distance_to(light, point);
    light->range = INFINITY;
    light->falloff = TL_FALLOFF_INVERSE_SQUARE;
    light->intensity = (float)((double)cutoff * d * d);
    for (int c = 0; c < 3; c++)
        light->color[c] = 1.0f;
}

/* In turn: a range that ends at the point; in the plane of the surface; nearer than the 1 cm that
 * lights are in size. */
static void put_on_edge(tl_light *light,
                        size_t number,
                        const double point[3],
                        const double normal[3])
{
    const double across[3] = {-normal[1], normal[0], 0.0};
    if (number % 3 == 0) {
        light->range = (float)distance_to(light, point);
    } else if (number % 3 == 1) {
        place(light, point, across, 0.3);
    } else {
        place(light, point, normal, 0.005);
        light->falloff = TL_FALLOFF_INVERSE_SQUARE;
        light->intensity = 1e-4f;
    }
}

/* Where the surface mirrors it to the eye, off by about the width of a highlight of exponent 1000. */
static void put_in_highlight(tl_light *light,
                             const tl_camera *camera,
                             uint32_t *seed,
                             const double point[3],
                             const double normal[3])
{
    static const double view_eye[3] = {0.0, 0.0, 0.0};
    double eye[3], to_eye[3], length = 0.0, facing = 0.0;
    tl_camera_world_point(camera, view_eye, eye);
    for (int i = 0; i < 3; i++) {
        to_eye[i] = eye[i] - point[i];
        length += to_eye[i] * to_eye[i];
        facing += to_eye[i] * normal[i];
    }
    for (int i = 0; i < 3; i++) {
        const double mirrored = (2.0 * facing * normal[i] - to_eye[i]) / sqrt(length);
        light->position[i] = (float)(point[i] + mirrored + random_between(seed, -0.03, 0.03));
    }
}

static void move_lights(const check_frame *row, const tl_gbuffer *g, tl_light_set *lights)
{
    uint32_t seed = 362436069u;
    for (size_t i = 0; i < lights->count; i++) {
        tl_light *light = &lights->lights[i];
        double point[3], normal[3];
        some_surface(g, &seed, point, normal);
        if (row->traits & CUTOFF)
            end_by_cutoff(light, point);
        else if (row->traits & EDGES)
            put_on_edge(light, i, point, normal);
        else if (isfinite(point[0]))
            put_in_highlight(light, &g->camera, &seed, point, normal);
    }
}

static double unit(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return length;
}

/* Aimed near the point. In turn: an edge at the point itself, hard; a soft one; hard, around it; half of
 * space; more than that; all of it; of no width. */
static void aim_at_point(tl_light *light, size_t number, uint32_t *seed, const double point[3])
{
    const float outer[] = {0.0f, 0.7f, 0.4f, 1.57079637f, 2.5f, 3.14159274f, 0.0f};
    const float inner[] = {0.0f, 0.2f, 0.4f, 0.0f, 2.0f, 1.0f, 0.0f};
    const size_t kind = number % (sizeof outer / sizeof outer[0]);
    double towards[3], aim[3], cosine = 0.0;
    for (int i = 0; i < 3; i++) {
        towards[i] = point[i] - (double)light->position[i];
        aim[i] = towards[i] + random_between(seed, -0.5, 0.5);
    }
    unit(towards);
    if (!(unit(aim) > 0.0) || !isfinite(aim[0]))
        return;
    for (int i = 0; i < 3; i++) {
        light->direction[i] = (float)aim[i];
        cosine += aim[i] * towards[i];
    }
    light->type = TL_LIGHT_SPOT;
    light->outer_cone = kind == 0 ? (float)acos(fmin(cosine, 1.0)) : outer[kind];
    light->inner_cone = kind == 0 ? light->outer_cone : inner[kind];
}

/* All but the sun and every eighth. */
static void make_spots(const tl_gbuffer *g, tl_light_set *lights)
{
    uint32_t seed = 123456789u;
    for (size_t i = 0; i < lights->count; i++) {
        double point[3], normal[3];
        some_surface(g, &seed, point, normal);
        if (i % 8 != 7 && lights->lights[i].type != TL_LIGHT_DIRECTIONAL)
            aim_at_point(&lights->lights[i], i, &seed, point);
    }
}

static void clear_depth(tl_gbuffer *g)
{
    float *depths = tl_gbuffer_plane(g, TL_DEPTH);
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        depths[i] = INFINITY;
}

static tl_status make_gbuffer(const check_frame *row, tl_gbuffer **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *cast = NULL, *made = NULL;
    TRY(tl_ray_cast(tl_bench_scene_find(row->scene), TL_GROUP_BASE | TL_GROUP_PHONG, row->width,
                    row->height, &cast, err));
    const tl_camera camera = camera_of(row, cast);
    TRY(tl_gbuffer_create(&camera, row->present, &made, err));
    copy_planes(cast, made);
    dress(row, made);
    *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    tl_gbuffer_destroy(cast);
    return status;
}

tl_status tl_check_frame_make(int index, tl_checked_frame *out, tl_error *err)
{
    const check_frame *row = &frames[index];
    tl_status status = TL_OK;
    tl_checked_frame made = {.light_cutoff = row->traits & CUTOFF ? cutoff : 0.0f};
    tl_bench_scene_options options = tl_bench_scene_options_default();
    options.light_count = row->light_count;
    options.range = row->range;
    TRY(make_gbuffer(row, &made.gbuffer, err));
    TRY(tl_scene_lights(made.gbuffer, &options, &made.lights, err));
    if (row->traits & MIXED)
        TRY(mix_lights(&made.lights, err));
    if (row->traits & LATER)
        begin_later(&made.lights);
    if (row->traits & NORMALIZED)
        made.lights.model = TL_MODEL_BLINN_PHONG_NORMALIZED;
    if (row->traits & (EDGES | CUTOFF | PEAKS))
        move_lights(row, made.gbuffer, &made.lights);
    if (row->traits & SPOTS)
        make_spots(made.gbuffer, &made.lights);
    if (row->traits & ALL_SKY)
        clear_depth(made.gbuffer);
    TRY(tl_gbuffer_repair(made.gbuffer, row->name, false, NULL, err));
    *out = made;
    made = (tl_checked_frame){0};
done:
    tl_checked_frame_clear(&made);
    return status;
}

void tl_checked_frame_clear(tl_checked_frame *frame)
{
    tl_light_set_clear(&frame->lights);
    tl_gbuffer_destroy(frame->gbuffer);
    *frame = (tl_checked_frame){0};
}
