#include "shapes.h"

#include "falloff.h"
#include "largest.h"
#include "map.h"
#include "sections.h"
#include "shadow_sections.h"
#include "try.h"
#include "view_profiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void tl_lobe_color(const tl_light_set *set, const tl_light *light, float lobe, float out[3])
{
    static const double per_pi = 0.31830988618379067154;
    const double scale = traits_of(set->model) & TL_LOBE_RADIOMETRIC ? per_pi : 1.0;
    for (int i = 0; i < 3; i++) {
        const double c = (double)light->color[i] * tl_light_candela(set, light) * (double)lobe;
        out[i] = (float)((c < (double)TL_BRIGHTEST ? c : (double)TL_BRIGHTEST) * scale);
    }
}

int tl_light_has_shape(const tl_gbuffer *gbuffer, const tl_light *light)
{
    return light->table > 0 || light->texture > 0 || light->profile > 0 ||
           light->ambient > 0.0f || light->link > 0 || tl_shadow_of(gbuffer, light) != NULL;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The part of v across the unit vector n, as a unit vector. Returns how long it was. */
static double across(const double n[3], const double v[3], double out[3])
{
    const double along = dot(n, v);
    double length2 = 0.0;
    for (int i = 0; i < 3; i++) {
        out[i] = v[i] - along * n[i];
        length2 += out[i] * out[i];
    }
    const double length = sqrt(length2);
    for (int i = 0; i < 3; i++)
        out[i] = length > 0.0 ? out[i] / length : 0.0;
    return length;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Right, up and ahead of a picture, in world space: docs/conventions.md. */
typedef struct stand {
    double right[3], up[3], ahead[3];
} stand;

/* `first` across n, or where it is along n, `second`. */
static void across_either(const double n[3],
                          const double first[3],
                          const double second[3],
                          double out[3])
{
    static const double least_sine = 1e-4;
    if (across(n, first, out) < least_sine)
        across(n, second, out);
}

static const double world_up[3] = {0.0, 1.0, 0.0}, forward[3] = {0.0, 0.0, -1.0};

static void unit(const float from[3], double out[3])
{
    const double v[3] = {(double)from[0], (double)from[1], (double)from[2]};
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        out[i] = v[i] / length;
}

/* A spot's picture is ahead along its axis; without `up` its top is above, or where the axis is vertical,
 * towards -z. */
static stand stand_of_spot(const tl_light *light)
{
    stand s;
    double up[3] = {(double)light->up[0], (double)light->up[1], (double)light->up[2]};
    unit(light->direction, s.ahead);
    if (dot(up, up) > 0.0)
        across(s.ahead, up, s.up);
    else
        across_either(s.ahead, world_up, forward, s.up);
    cross(s.ahead, s.up, s.right);
    return s;
}

/* The poles of a lamp's picture are up and down; its middle is towards -z, or where that is a pole,
 * towards +y. */
static stand stand_of_point(const tl_light *light)
{
    stand s;
    double up[3] = {(double)light->up[0], (double)light->up[1], (double)light->up[2]};
    if (dot(up, up) > 0.0)
        unit(light->up, s.up);
    else
        memcpy(s.up, world_up, sizeof s.up);
    across_either(s.up, forward, world_up, s.ahead);
    cross(s.ahead, s.up, s.right);
    return s;
}

static void turn_map(const tl_camera *camera,
                     const stand *s,
                     double right_scale,
                     double up_scale,
                     tl_view_map *map)
{
    tl_map_direction(camera, s->right, right_scale, map->right);
    tl_map_direction(camera, s->up, up_scale, map->up);
    tl_map_direction(camera, s->ahead, 1.0, map->ahead);
}

/* The square around a spot's cone is the whole picture. */
static tl_status add_texture(const tl_camera *camera,
                             const tl_light_set *lights,
                             const tl_light *light,
                             tl_prepared *prepared,
                             tl_view_shape *shape,
                             tl_error *err)
{
    const tl_light_image *image = &lights->images[light->texture - 1];
    const int is_spot = light->type == TL_LIGHT_SPOT;
    const stand s = is_spot ? stand_of_spot(light) : stand_of_point(light);
    const double half_view = is_spot ? tan((double)light->outer_cone) : 1.0;
    shape->spot_and_link |= (tl_u32)is_spot;
    turn_map(camera, &s, is_spot ? 0.5 * image->width / half_view : 1.0,
             is_spot ? 0.5 * image->height / half_view : 1.0, &shape->map);
    return tl_map_show(lights, light->texture, 1.0, prepared, &shape->map, err);
}

/* `shared`: of the set's profiles, where their shares are. The nadir is ahead along the light's direction, C0
 * to its top, as a spot's picture stands. */
static tl_status add_profile(const tl_camera *camera,
                             const tl_light_set *lights,
                             const tl_light *light,
                             tl_u32 *shared,
                             tl_prepared *prepared,
                             tl_view_shape *shape,
                             tl_error *err)
{
    const stand s = stand_of_spot(light);
    return tl_view_profile_add(camera, lights, light->profile, s.ahead, s.up, shared, prepared,
                               &shape->profile_at, err);
}

static tl_status add_table(const tl_light_set *lights,
                           const tl_light *light,
                           tl_prepared *prepared,
                           tl_view_shape *shape,
                           tl_error *err)
{
    const tl_light_table *table = &lights->tables[light->table - 1];
    void *memory = NULL;
    const tl_status status =
        tl_section_add(prepared, table->count * sizeof(float), &shape->table_at, &memory, err);
    if (status != TL_OK)
        return status;
    memcpy(memory, table->values, table->count * sizeof(float));
    shape->table_last = table->count - 1;
    return TL_OK;
}

/* Shape `index` of the section, of prepared light i. shared: as of add_profile. */
static tl_status add_shape(const tl_gbuffer *gbuffer,
                           const tl_light_set *lights,
                           uint32_t shadow_filter,
                           uint32_t i,
                           uint32_t index,
                           tl_u32 *shared,
                           tl_prepared *prepared,
                           tl_error *err)
{
    const tl_light *light = &lights->lights[prepared->sources[i]];
    const tl_shadow_map *shadow = tl_shadow_of(gbuffer, light);
    tl_view_shape shape = {.falloff = prepared->lights[i].falloff};
    tl_status status = TL_OK;
    tl_lobe_color(lights, light, light->ambient, shape.ambient);
    if (light->table > 0)
        TRY(add_table(lights, light, prepared, &shape, err));
    if (light->texture > 0)
        TRY(add_texture(&gbuffer->camera, lights, light, prepared, &shape, err));
    if (light->profile > 0)
        TRY(add_profile(&gbuffer->camera, lights, light, shared, prepared, &shape, err));
    if (shadow)
        TRY(tl_shadow_section_add(gbuffer, shadow, shadow_filter, prepared, &shape.shadow_at,
                                  err));
    ((tl_view_shape *)tl_section_at(prepared, prepared->frame.shapes_at))[index] = shape;
    prepared->lights[i].falloff = TL_FADE_COUNT + index;
done:
    return status;
}

tl_status tl_shapes_add(const tl_gbuffer *gbuffer,
                        const tl_light_set *lights,
                        uint32_t shadow_filter,
                        tl_prepared *prepared,
                        tl_error *err)
{
    tl_status status = TL_OK;
    uint32_t count = 0, index = 0;
    tl_u32 *shared = NULL;
    tl_u32 links_at;
    int is_linked = 0;
    for (uint32_t i = 0; i < prepared->frame.light_count; i++) {
        const tl_light *light = &lights->lights[prepared->sources[i]];
        count += (uint32_t)tl_light_has_shape(gbuffer, light);
        is_linked |= light->link > 0;
    }
    if (count == 0)
        return TL_OK;
    if (count > TL_BITS_OF_ONE - TL_FADE_COUNT)
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "%u lights with textures, tables, profiles, ambient lobes, shadows or links",
            count);
    shared = calloc(lights->profile_count + 1, sizeof *shared);
    if (!shared)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the profiles of lights"));
    if (is_linked) /* the row before shapes: links.h */
        TRY(tl_section_add(prepared, sizeof(tl_view_links), &links_at, NULL, err));
    TRY(tl_section_add(prepared, count * sizeof(tl_view_shape), &prepared->frame.shapes_at,
                       NULL, err));
    for (uint32_t i = 0; i < prepared->frame.light_count; i++)
        if (tl_light_has_shape(gbuffer, &lights->lights[prepared->sources[i]]))
            TRY(add_shape(gbuffer, lights, shadow_filter, i, index++, shared, prepared, err));
done:
    free(shared);
    return status;
}

static stand stand_of_sky(double rotation)
{
    const double c = cos(rotation), s = sin(rotation);
    const stand of = {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {-s, 0.0, -c}};
    return of;
}

void tl_sky_axes(double rotation, double axes[3][3])
{
    const stand s = stand_of_sky(rotation);
    memcpy(axes[0], s.right, sizeof s.right);
    memcpy(axes[1], s.up, sizeof s.up);
    memcpy(axes[2], s.ahead, sizeof s.ahead);
}

tl_status tl_sky_add(const tl_camera *camera,
                     const tl_light_set *lights,
                     tl_prepared *prepared,
                     tl_error *err)
{
    const stand s = stand_of_sky((double)lights->sky_rotation);
    tl_view_sky sky = {.reserved0 = 0};
    tl_status status = TL_OK;
    if (lights->sky_type == TL_SKY_CONSTANT || !tl_light_set_has_sky(lights))
        return TL_OK;
    TRY(tl_section_add(prepared, sizeof sky, &prepared->frame.sky_at, NULL, err));
    memcpy(sky.zenith, lights->zenith, sizeof sky.zenith);
    memcpy(sky.ground, lights->ground, sizeof sky.ground);
    turn_map(camera, &s, 1.0, 1.0, &sky.map);
    if (lights->sky_type == TL_SKY_IMAGE)
        TRY(tl_map_show(lights, lights->sky_image, (double)lights->sky_intensity, prepared,
                        &sky.map, err));
    memcpy(tl_section_at(prepared, prepared->frame.sky_at), &sky, sizeof sky);
done:
    return status;
}
