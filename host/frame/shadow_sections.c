#include "shadow_sections.h"

#include "place_slack.h"
#include "sections.h"
#include "try.h"

#include <math.h>
#include <string.h>

const tl_shadow_map *tl_shadow_of(const tl_gbuffer *gbuffer, const tl_light *light)
{
    return light->casts_shadow ? tl_shadow_map_of(&tl_gbuffer_owner(gbuffer)->shadows, light)
                               : NULL;
}

/* --- what places of surfaces are off --------------------------------------------------------------- */

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* slack: what is known of the map already. */
static void set_slack(const tl_gbuffer *gbuffer, double slack, tl_view_shadow *out)
{
    float factors[3];
    tl_place_slack(gbuffer, slack, factors);
    out->slack = factors[0];
    out->slack_per_depth = factors[1];
    out->slack_per_depth2 = factors[2];
}

/* --- views ----------------------------------------------------------------------------------------- */

/* A direction of the world, times `scale`, in the frame's view space. */
static void set_row(const tl_camera *camera, const double world[3], double scale, float out[3])
{
    double view[3];
    tl_camera_view_direction(camera, world, view);
    for (int i = 0; i < 3; i++)
        out[i] = (float)(view[i] * scale);
}

/* Rows of the light's own view: right, down, ahead. */
static void row_of_view(const tl_camera *view, int axis, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)view->view_from_world[axis][i] * (axis == 0 ? 1.0 : -1.0);
}

static void set_perspective(const tl_camera *camera,
                            const tl_shadow_map *map,
                            tl_view_shadow *out)
{
    const tl_camera *view = &map->views[0];
    float *const rows[3] = {out->right, out->down, out->ahead};
    for (int axis = 0; axis < 3; axis++) {
        double world[3] = {axis == 0, axis == 1, axis == 2};
        if (map->kind == TL_SHADOW_SPOT)
            row_of_view(view, axis, world);
        set_row(camera, world, 1.0, rows[axis]);
    }
    const double scale = map->size / ((double)view->right - (double)view->left);
    out->scale = (float)scale;
    out->right_at = (float)(-(double)view->left * scale);
    out->down_at = (float)((double)view->top * scale);
    out->near = view->near;
    out->offset = (float)(TL_SHADOW_OFFSET / scale);
    out->slope_x = out->slope_y = (float)((double)view->near / scale);
}

/* Where the camera's own origin is in the map's view. */
static void origin_in(const tl_camera *camera, const tl_camera *view, double out[3])
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double world[3];
    tl_camera_world_point(camera, origin, world);
    tl_camera_view_point(view, world, out);
}

static void set_parallel(const tl_camera *camera, const tl_shadow_map *map, tl_view_shadow *out)
{
    const tl_camera *view = &map->views[0];
    const double scale_x = map->size / ((double)view->right - (double)view->left);
    const double scale_y = map->size / ((double)view->top - (double)view->bottom);
    const double per_depth = 1.0 / ((double)view->far - (double)view->near);
    double world[3], origin[3];
    origin_in(camera, view, origin);
    row_of_view(view, 0, world);
    set_row(camera, world, scale_x, out->right);
    row_of_view(view, 1, world);
    set_row(camera, world, scale_y, out->down);
    row_of_view(view, 2, world);
    set_row(camera, world, -per_depth, out->ahead);
    out->right_at = (float)((origin[0] - (double)view->left) * scale_x);
    out->down_at = (float)(((double)view->top - origin[1]) * scale_y);
    out->offset = (float)(TL_SHADOW_OFFSET / fmin(scale_x, scale_y));
    out->ahead_at = (float)(((double)view->far + origin[2]) * per_depth);
    out->slope_x = (float)(per_depth / (scale_x * scale_x));
    out->slope_y = (float)(per_depth / (scale_y * scale_y));
}

/* How far from the frame's eye the map's own place is, m: what is reckoned from there rounds with that. */
static double distance_to(const tl_camera *camera, const tl_camera *view)
{
    double origin[3];
    origin_in(camera, view, origin);
    return length_of(origin);
}

tl_status tl_shadow_section_add(const tl_gbuffer *gbuffer,
                                const tl_shadow_map *map,
                                uint32_t filter,
                                tl_prepared *prepared,
                                tl_u32 *at,
                                tl_error *err)
{
    tl_status status = TL_OK;
    tl_view_shadow shadow = {.kind = map->kind, .size = map->size, .filter = filter};
    void *memory = NULL;
    if (map->kind == TL_SHADOW_PARALLEL)
        set_parallel(&gbuffer->camera, map, &shadow);
    else
        set_perspective(&gbuffer->camera, map, &shadow);
    set_slack(gbuffer,
              (double)map->slack +
                  TL_PLACE_MISREAD * distance_to(&gbuffer->camera, &map->views[0]),
              &shadow);
    TRY(tl_section_add(prepared, tl_shadow_map_size(map), &shadow.texels_at, &memory, err));
    memcpy(memory, map->texels, tl_shadow_map_size(map));
    TRY(tl_section_add(prepared, sizeof shadow, at, &memory, err));
    memcpy(memory, &shadow, sizeof shadow);
done:
    return status;
}
