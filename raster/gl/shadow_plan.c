#include "shadow_plan.h"

#include "try.h"
#include "visible_box.h"

#include "tilelight/bounds.h"

#include <stdlib.h>
#include <string.h>

/* Texels each way, at most: beyond, a texel is smaller than a pixel of nearly any picture. */
static const uint32_t most_size[TL_SHADOW_KIND_COUNT] = {
    [TL_SHADOW_SPOT] = 2048,
    [TL_SHADOW_PARALLEL] = 4096,
    [TL_SHADOW_CUBE] = 1024,
};

/* Surfaces nearer to a light than this share of the scene's extent cast no shadow. Depth is as fine
 * whatever it is (kernels/shadow_code.h). */
static const double nearest_share = 1e-5;

/* Of the largest coordinate, what a vertex may be off that is placed in float once for the picture and once
 * for the map: three products and sums each, and the matrix. */
static const double misplaced = 16 * 0x1p-24;

/* What all maps are made for. */
typedef struct planning {
    const tl_gbuffer *gbuffer;
    double low[3], high[3]; /* of all that is drawn, m */
    double extent, largest; /* m: its diagonal; its largest coordinate */
    bool sees;              /* whether the camera sees anything, and the box around that, m */
    double seen[2][3];
} planning;

static const double axes_of_world[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static bool begin(const tl_model *model, const tl_gbuffer *gbuffer, planning *p)
{
    double square = 0.0;
    *p = (planning){.gbuffer = gbuffer};
    if (!tl_model_bounds(model, p->low, p->high))
        return false;
    for (int i = 0; i < 3; i++) {
        square += (p->high[i] - p->low[i]) * (p->high[i] - p->low[i]);
        p->largest = fmax(p->largest, fmax(fabs(p->low[i]), fabs(p->high[i])));
    }
    p->extent = sqrt(square);
    p->sees = tl_visible_box(gbuffer, axes_of_world, p->seen);
    return true;
}

static uint32_t kind_for(const tl_light *light)
{
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return TL_SHADOW_PARALLEL;
    return light->type == TL_LIGHT_SPOT && light->outer_cone <= TL_WIDEST_SHADOW_CONE
               ? TL_SHADOW_SPOT
               : TL_SHADOW_CUBE;
}

/* The longer side of what its reach may cover of the picture, px. */
static uint32_t pixels_across(const tl_camera *camera, const tl_light *light)
{
    const uint32_t whole = camera->width > camera->height ? camera->width : camera->height;
    if (light->type == TL_LIGHT_DIRECTIONAL || isinf(light->range))
        return whole;
    tl_pixel_rect rect;
    float center[3];
    double world[3], view[3];
    for (int i = 0; i < 3; i++)
        world[i] = (double)light->position[i];
    tl_camera_view_point(camera, world, view);
    for (int i = 0; i < 3; i++)
        center[i] = (float)view[i];
    tl_sphere_bounds(camera, center, light->range, &rect);
    const uint32_t width = rect.x1 - rect.x0, height = rect.y1 - rect.y0;
    return width > height ? width : height;
}

static uint32_t size_for(uint32_t kind, uint32_t pixels)
{
    uint32_t size = TL_LEAST_SHADOW_SIZE;
    while (size < pixels && size < most_size[kind])
        size *= 2;
    return size;
}

static bool gives_light(const tl_light *light)
{
    return light->intensity > 0.0f &&
           (light->color[0] > 0.0f || light->color[1] > 0.0f || light->color[2] > 0.0f);
}

/* Towards the box around what the camera sees, from a light that stands apart from it, so that one view sees
 * all of it: the axis, and the angle from there to the farthest corner. False: no view would. */
static bool find_cone(const planning *p, const float position[3], float axis[3], double *angle)
{
    double way[3], length2 = 0.0, least = 1.0;
    for (int i = 0; i < 3; i++) {
        way[i] = 0.5 * (p->seen[0][i] + p->seen[1][i]) - (double)position[i];
        length2 += way[i] * way[i];
    }
    for (int i = 0; i < 3 && length2 > 0.0; i++)
        axis[i] = (float)(way[i] / sqrt(length2));
    for (int corner = 0; corner < 8 && length2 > 0.0; corner++) {
        double to[3], along = 0.0, far2 = 0.0;
        for (int i = 0; i < 3; i++) {
            to[i] = p->seen[corner >> i & 1][i] - (double)position[i];
            along += to[i] * way[i];
            far2 += to[i] * to[i];
        }
        least = fmin(least, far2 > 0.0 ? along / sqrt(far2 * length2) : -1.0);
    }
    *angle = 1.001 * acos(least) + 1e-6; /* rounding, and a scene that is a point */
    return length2 > 0.0 && *angle < (double)TL_WIDEST_SHADOW_CONE;
}

/* Point lights, and spots, see as little as they have to: their cone, or all that the camera sees. */
static void choose_view(const planning *p, const tl_light *light, tl_shadow_map *map)
{
    float axis[3];
    double angle;
    if (map->kind == TL_SHADOW_PARALLEL || !p->sees ||
        !find_cone(p, map->position, axis, &angle) ||
        (map->kind == TL_SHADOW_SPOT && angle >= (double)light->outer_cone))
        return;
    map->kind = TL_SHADOW_SPOT;
    map->is_fitted = 1;
}

/* The map of a light, without texels and views. */
static tl_shadow_map map_for(const planning *p, const tl_light *light)
{
    tl_shadow_map map = {.kind = kind_for(light)};
    double largest = p->largest;
    if (light->type != TL_LIGHT_DIRECTIONAL)
        memcpy(map.position, light->position, sizeof map.position);
    if (light->type != TL_LIGHT_POINT)
        memcpy(map.direction, light->direction, sizeof map.direction);
    choose_view(p, light, &map);
    map.size = size_for(map.kind, pixels_across(&p->gbuffer->camera, light));
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fabs((double)map.position[i]));
    map.slack = (float)(misplaced * largest);
    return map;
}

/* The box around all that is drawn, along other axes. */
static void turn_box(const planning *p, const double rows[3][3], double out[2][3])
{
    for (int i = 0; i < 3; i++) {
        out[0][i] = out[1][i] = 0.0;
        for (int j = 0; j < 3; j++) {
            const double a = rows[i][j] * p->low[j], b = rows[i][j] * p->high[j];
            out[0][i] += fmin(a, b);
            out[1][i] += fmax(a, b);
        }
    }
}

/* False: it sees nothing, for the camera does not. */
static bool find_views(const planning *p, const tl_light *light, tl_shadow_map *map)
{
    double rows[3][3], receivers[2][3], casters[2][3], angle = (double)light->outer_cone;
    float axis[3];
    if (map->kind != TL_SHADOW_PARALLEL) {
        memcpy(axis, light->direction, sizeof axis);
        if (map->is_fitted)
            find_cone(p, map->position, axis, &angle);
        tl_shadow_views_from(map, axis, angle, fmax(nearest_share * p->extent, 1e-9));
        return true;
    }
    tl_shadow_axes(map->direction, rows);
    if (!tl_visible_box(p->gbuffer, (const double(*)[3])rows, receivers))
        return false;
    turn_box(p, (const double(*)[3])rows, casters);
    tl_shadow_view_along(map, (const double(*)[3])receivers, (const double(*)[3])casters);
    return true;
}

static uint64_t size_of_all(const tl_shadow_map *maps, size_t count)
{
    uint64_t size = 0;
    for (size_t i = 0; i < count; i++)
        size += tl_shadow_map_size(&maps[i]);
    return size;
}

/* False: they are as small as they get. */
static bool halve_largest(tl_shadow_map *maps, size_t count)
{
    tl_shadow_map *largest = NULL;
    for (size_t i = 0; i < count; i++)
        if (maps[i].size > TL_LEAST_SHADOW_SIZE &&
            (!largest || tl_shadow_map_size(&maps[i]) > tl_shadow_map_size(largest)))
            largest = &maps[i];
    if (largest)
        largest->size /= 2;
    return largest != NULL;
}

static tl_status keep_within(uint64_t memory,
                             tl_shadow_map *maps,
                             size_t count,
                             const tl_notices *notices,
                             tl_error *err)
{
    const uint64_t wanted = size_of_all(maps, count);
    bool smaller = true;
    while (size_of_all(maps, count) > memory && smaller)
        smaller = halve_largest(maps, count);
    if (!smaller)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "shadow maps of %zu lights take %llu KiB at their smallest, more than "
                       "the %llu that they may; allow more, or let fewer lights cast shadows",
                       count, (unsigned long long)(size_of_all(maps, count) >> 10),
                       (unsigned long long)(memory >> 10));
    if (size_of_all(maps, count) < wanted)
        tl_notice(notices,
                  "shadow maps of %zu lights would take %llu MiB: the largest are halved until "
                  "all take %llu",
                  count, (unsigned long long)(wanted >> 20),
                  (unsigned long long)(size_of_all(maps, count) >> 20));
    return TL_OK;
}

/* sources[i]: the light of maps[i]. */
static size_t list_maps(const planning *p,
                        const tl_light_set *lights,
                        tl_shadow_map *maps,
                        const tl_light **sources)
{
    size_t count = 0;
    for (size_t i = 0; i < lights->count; i++) {
        const tl_light *light = &lights->lights[i];
        if (!light->casts_shadow || !gives_light(light))
            continue;
        sources[count] = light;
        maps[count++] = map_for(p, light);
    }
    return count;
}

tl_status tl_shadow_plan(const tl_model *model,
                         const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         uint64_t memory,
                         const tl_notices *notices,
                         tl_shadow_maps *out,
                         tl_error *err)
{
    tl_status status = TL_OK;
    planning p;
    if (lights->count == 0 || !begin(model, gbuffer, &p))
        return TL_OK;
    tl_shadow_map *maps = calloc(lights->count, sizeof *maps);
    const tl_light **sources = calloc(lights->count, sizeof(tl_light *));
    if (!maps || !sources)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a plan of %zu shadow maps",
                    lights->count));
    const size_t count = list_maps(&p, lights, maps, sources);
    TRY(keep_within(memory, maps, count, notices, err));
    for (size_t i = 0; i < count; i++)
        if (find_views(&p, sources[i], &maps[i]))
            TRY(tl_shadow_maps_add(out, &maps[i], err));
done:
    free(maps);
    free((void *)sources);
    return status;
}
