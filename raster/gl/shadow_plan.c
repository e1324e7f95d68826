#include "shadow_plan.h"

#include "shadow_size.h"
#include "try.h"
#include "visible_points.h"

#include <stdlib.h>
#include <string.h>

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
    double near, largest;   /* m: ahead of lights; the largest coordinate */
    bool sees;              /* whether the camera sees anything, and the box around that, m */
    double seen[2][3];
    tl_seen_points points;
} planning;

static const double axes_of_world[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static void begin(const double box[2][3], double near, const tl_gbuffer *gbuffer, planning *p)
{
    double square = 0.0;
    p->gbuffer = gbuffer;
    for (int i = 0; i < 3; i++) {
        p->low[i] = box[0][i];
        p->high[i] = box[1][i];
        square += (p->high[i] - p->low[i]) * (p->high[i] - p->low[i]);
        p->largest = fmax(p->largest, fmax(fabs(p->low[i]), fabs(p->high[i])));
    }
    p->near = near > 0.0 ? near : fmax(nearest_share * sqrt(square), 1e-9);
    p->sees = tl_visible_box(gbuffer, axes_of_world, p->seen);
}

static uint32_t kind_for(const tl_light *light)
{
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return TL_SHADOW_PARALLEL;
    return light->type == TL_LIGHT_SPOT && light->outer_cone <= TL_WIDEST_SHADOW_CONE
               ? TL_SHADOW_SPOT
               : TL_SHADOW_CUBE;
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

/* Point lights, and spots, see as little as they have to: their cone, or all that the camera sees. Returns
 * the tangent of half of how wide their view is. */
static double choose_view(const planning *p, const tl_light *light, tl_shadow_map *map)
{
    float axis[3];
    double angle;
    const double own = map->kind == TL_SHADOW_CUBE ? 1.0 : tan((double)light->outer_cone);
    if (!p->sees || !find_cone(p, map->position, axis, &angle) ||
        (map->kind == TL_SHADOW_SPOT && angle >= (double)light->outer_cone))
        return own;
    map->kind = TL_SHADOW_SPOT;
    map->is_fitted = 1;
    return tan(angle);
}

/* How wide what the camera sees is across a direction, m. */
static double span_across(const planning *p, const float direction[3])
{
    double rows[3][3], seen[2][3];
    tl_shadow_axes(direction, rows);
    if (!tl_visible_box(p->gbuffer, (const double(*)[3])rows, seen))
        return 0.0;
    return fmax(seen[1][0] - seen[0][0], seen[1][1] - seen[0][1]);
}

/* The map of a light, without texels, views and size. */
static tl_shadow_map map_for(const planning *p, const tl_light *light, tl_shadow_need *need)
{
    tl_shadow_map map = {.kind = kind_for(light)};
    double largest = p->largest, tangent = 0.0, span = 0.0;
    if (light->type != TL_LIGHT_POINT)
        memcpy(map.direction, light->direction, sizeof map.direction);
    if (light->type == TL_LIGHT_DIRECTIONAL) {
        span = span_across(p, map.direction);
    } else {
        memcpy(map.position, light->position, sizeof map.position);
        tangent = choose_view(p, light, &map);
    }
    need->views = tl_shadow_view_counts[map.kind];
    tl_shadow_need_of(&p->points, light, map.kind, tangent, span, need);
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
        tl_shadow_views_from(map, axis, angle, p->near);
        return true;
    }
    tl_shadow_axes(map->direction, rows);
    if (!tl_visible_box(p->gbuffer, (const double(*)[3])rows, receivers))
        return false;
    turn_box(p, (const double(*)[3])rows, casters);
    tl_shadow_view_along(map, (const double(*)[3])receivers, (const double(*)[3])casters);
    return true;
}

/* of[i]: the light of maps[i]; needs[i]: its map's. */
static size_t list_maps(const planning *p,
                        const tl_light_set *lights,
                        tl_shadow_map *maps,
                        tl_shadow_need *needs,
                        const tl_light **of)
{
    size_t count = 0;
    for (size_t i = 0; i < lights->count; i++) {
        const tl_light *light = &lights->lights[i];
        if (!light->casts_shadow || !gives_light(light))
            continue;
        of[count] = light;
        maps[count] = map_for(p, light, &needs[count]);
        count++;
    }
    return count;
}

tl_status tl_shadow_plan(const tl_model *model,
                         const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         uint64_t memory,
                         double near,
                         const tl_notices *notices,
                         tl_shadow_maps *out,
                         tl_error *err)
{
    tl_status status = TL_OK;
    planning p = {0};
    double box[2][3];
    if (lights->count == 0 || !tl_model_bounds(model, box[0], box[1]))
        return TL_OK;
    begin((const double(*)[3])box, near, gbuffer, &p);
    tl_shadow_map *maps = calloc(lights->count, sizeof *maps);
    tl_shadow_need *needs = calloc(lights->count, sizeof *needs);
    const tl_light **sources = calloc(lights->count, sizeof(tl_light *));
    if (!maps || !needs || !sources)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a plan of %zu shadow maps",
                    lights->count));
    TRY(tl_seen_points_of(gbuffer, &p.points, err));
    const size_t count = list_maps(&p, lights, maps, needs, sources);
    TRY(tl_shadow_budget(memory, needs, count, notices, err));
    for (size_t i = 0; i < count; i++) {
        maps[i].size = needs[i].size;
        if (find_views(&p, sources[i], &maps[i]))
            TRY(tl_shadow_maps_add(out, &maps[i], err));
    }
done:
    tl_seen_points_clear(&p.points);
    free(maps);
    free(needs);
    free((void *)sources);
    return status;
}
