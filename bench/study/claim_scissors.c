#include "claims.h"

#include "tilelight/bounds.h"
#include "try.h"

#include <math.h>
#include <stdint.h>

/* The tutorial's picture, lights and field of view (its listing 16: a focal length of 1.2). */
enum { SIDE = 512, LIGHTS = 3, VIEWS = 16 };
static const double focal_length = 1.2;

/* The room is [0, 1]^3, m; lights keep off its walls, viewers farther. */
static const double light_margin = 0.1, viewer_margin = 0.2;
static const double ranges[] = {0.125, 0.25, 0.375, 0.5, 0.75};
enum { RANGES = sizeof ranges / sizeof ranges[0] };

/* In [margin, 1 - margin]. By the generator of Knuth and Lewis, high bits. */
static double random_place(uint32_t *seed, double margin)
{
    *seed = *seed * 1664525u + 1013904223u;
    return margin + (1.0 - 2.0 * margin) * (*seed >> 8) / (double)(1u << 24);
}

static tl_camera random_view(uint32_t *seed)
{
    static const double up[3] = {0.0, 1.0, 0.0};
    double eye[3], target[3];
    for (int i = 0; i < 3; i++) {
        eye[i] = random_place(seed, viewer_margin);
        target[i] = random_place(seed, 0.0);
    }
    target[0] += 1e-3 * (target[0] == eye[0]); /* not straight up */
    return tl_camera_look_at(eye, target, up, 2.0 * atan(1.0 / focal_length), SIDE, SIDE, 1e-3,
                             4.0);
}

/* The wall that pixel (x, y) sees: its depth, m, and normal, world space. */
static float wall_at(const tl_camera *camera, uint32_t x, uint32_t y, float normal[3])
{
    const double u = (x + 0.5) / camera->width, v = (y + 0.5) / camera->height;
    const double ray[3] = {
        (double)camera->left + ((double)camera->right - (double)camera->left) * u,
        (double)camera->top + ((double)camera->bottom - (double)camera->top) * v, -1.0};
    static const double origin[3] = {0.0, 0.0, 0.0};
    double eye[3], along[3], depth = INFINITY;
    int wall = 0;
    tl_camera_world_point(camera, origin, eye);
    tl_camera_world_direction(camera, ray, along);
    for (int i = 0; i < 3; i++) {
        const double to = ((along[i] > 0.0) - eye[i]) / along[i];
        if (along[i] != 0.0 && to < depth) {
            depth = to;
            wall = i;
        }
    }
    for (int i = 0; i < 3; i++)
        normal[i] = i != wall ? 0.0f : along[wall] > 0.0 ? -1.0f : 1.0f;
    return (float)depth;
}

static tl_status make_room(const tl_camera *camera, tl_gbuffer **out, tl_error *err)
{
    const tl_status status = tl_gbuffer_create(camera, TL_GROUP_BASE, out, err);
    for (uint32_t y = 0; y < SIDE && status == TL_OK; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            const size_t at = (size_t)y * (*out)->pitch + x;
            float normal[3];
            tl_gbuffer_plane(*out, TL_DEPTH)[at] = wall_at(camera, x, y, normal);
            for (int i = 0; i < 3; i++) {
                tl_gbuffer_plane(*out, (enum tl_plane)(TL_NORMAL_X + i))[at] = normal[i];
                tl_gbuffer_plane(*out, (enum tl_plane)(TL_ALBEDO_R + i))[at] = 0.5f;
            }
        }
    return status;
}

static tl_status make_lights(uint32_t *seed, tl_light_set *out, tl_error *err)
{
    tl_status status = TL_OK;
    for (int i = 0; i < LIGHTS && status == TL_OK; i++) {
        tl_light light = tl_light_default();
        light.type = TL_LIGHT_POINT;
        light.falloff = TL_FALLOFF_LINEAR;
        for (int k = 0; k < 3; k++)
            light.position[k] = (float)random_place(seed, light_margin);
        status = tl_light_set_add(out, &light, err);
    }
    return status;
}

/* Fragments, of all views; [RANGES]. */
typedef struct counts {
    double scissors[RANGES], tiles[RANGES], in_reach[RANGES];
} counts;

static double in_rectangles(const tl_camera *camera, const tl_light_set *lights)
{
    double sum = 0.0;
    for (size_t i = 0; i < lights->count; i++) {
        const tl_light *light = &lights->lights[i];
        double world[3], view[3];
        tl_pixel_rect rect;
        for (int k = 0; k < 3; k++)
            world[k] = (double)light->position[k];
        tl_camera_view_point(camera, world, view);
        const float center[3] = {(float)view[0], (float)view[1], (float)view[2]};
        tl_sphere_bounds(camera, center, light->range, &rect);
        sum += (double)(rect.x1 - rect.x0) * (double)(rect.y1 - rect.y0);
    }
    return sum;
}

static double in_reach(const tl_gbuffer *room, const tl_light_set *lights)
{
    const tl_camera *c = &room->camera;
    double sum = 0.0;
    for (size_t i = 0; i < lights->count; i++) {
        const tl_light *light = &lights->lights[i];
        double world[3], view[3];
        for (int k = 0; k < 3; k++)
            world[k] = (double)light->position[k];
        tl_camera_view_point(c, world, view);
        for (uint32_t y = 0; y < SIDE; y++)
            for (uint32_t x = 0; x < SIDE; x++) {
                const double depth =
                    (double)tl_gbuffer_plane(room, TL_DEPTH)[(size_t)y * room->pitch + x];
                const double u = (x + 0.5) / SIDE, v = (y + 0.5) / SIDE;
                const double dx = depth * ((double)c->left +
                                           ((double)c->right - (double)c->left) * u) -
                                  view[0],
                             dy = depth * ((double)c->top +
                                           ((double)c->bottom - (double)c->top) * v) -
                                  view[1],
                             dz = -depth - view[2];
                sum +=
                    dx * dx + dy * dy + dz * dz < (double)light->range * (double)light->range;
            }
    }
    return sum;
}

static tl_status count_view(
    tl_lighting *lighting, uint32_t *seed, tl_image *image, counts *sums, tl_error *err)
{
    const tl_camera camera = random_view(seed);
    tl_gbuffer *room = NULL;
    tl_light_set lights = {0};
    tl_lighting_counts lit;
    tl_status status = TL_OK;
    TRY(make_room(&camera, &room, err));
    TRY(make_lights(seed, &lights, err));
    for (int r = 0; r < RANGES; r++) {
        for (size_t i = 0; i < lights.count; i++)
            lights.lights[i].range = (float)ranges[r];
        TRY(tl_lighting_run(lighting, room, &lights, image, NULL, NULL, &lit, err));
        sums->scissors[r] += in_rectangles(&camera, &lights);
        sums->tiles[r] += (double)lit.pair_count;
        sums->in_reach[r] += in_reach(room, &lights);
    }
done:
    tl_gbuffer_destroy(room);
    tl_light_set_clear(&lights);
    return status;
}

static void add_figures(const counts *sums, tl_claim_figures *figures)
{
    const double all = (double)SIDE * SIDE * LIGHTS * VIEWS;
    for (int r = 0; r < RANGES; r++) {
        tl_claim_add(figures, "% saved", 50.0, 50.0, 100.0 * (1.0 - sums->scissors[r] / all),
                     "scissors, lights reach %g of the room's side", ranges[r]);
        tl_claim_add(figures, "% saved", (double)NAN, (double)NAN,
                     100.0 * (1.0 - sums->tiles[r] / all), "tiles, lights reach %g", ranges[r]);
        tl_claim_add(figures, "% saved", (double)NAN, (double)NAN,
                     100.0 * (1.0 - sums->in_reach[r] / all), "out of reach at %g", ranges[r]);
    }
}

tl_status tl_claim_scissors(const tl_claim_options *options,
                            tl_claim_figures *out,
                            tl_error *err)
{
    const tl_lighting_options how = tl_lighting_options_default();
    tl_claim_figures made = {.count = 0};
    tl_lighting *lighting = NULL;
    tl_image *image = NULL;
    counts sums = {{0.0}, {0.0}, {0.0}};
    uint32_t seed = 1;
    tl_status status = TL_OK;
    TRY(tl_image_create(SIDE, SIDE, &image, err));
    TRY(tl_lighting_create(options->device, &how, &lighting, err));
    for (int view = 0; view < VIEWS; view++)
        TRY(count_view(lighting, &seed, image, &sums, err));
    add_figures(&sums, &made);
    *out = made;
done:
    tl_lighting_destroy(lighting);
    tl_image_destroy(image);
    return status;
}
