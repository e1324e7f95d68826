#include "sky_light_section.h"

#include "largest.h"
#include "map.h"
#include "sections.h"
#include "shapes.h"
#include "sky_light.h"
#include "sky_prefilter.h"
#include "split_sum.h"
#include "try.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

static float cut(double light)
{
    return light < (double)TL_BRIGHTEST ? (float)light : TL_BRIGHTEST;
}

static tl_status add_texels(
    const tl_sky_map *map, double scale, tl_prepared *prepared, tl_u32 *at, tl_error *err)
{
    void *memory = NULL;
    const tl_status status =
        tl_section_add(prepared, map->texel_count * sizeof *map->texels, at, &memory, err);
    if (status != TL_OK)
        return status;
    float(*to)[4] = memory;
    for (size_t i = 0; i < map->texel_count; i++)
        for (int c = 0; c < 3; c++)
            to[i][c] = cut((double)map->texels[i][c] * scale);
    return TL_OK;
}

static tl_status add_levels(const tl_sky_map *map,
                            tl_prepared *prepared,
                            tl_u32 *at,
                            tl_error *err)
{
    void *memory = NULL;
    const tl_status status =
        tl_section_add(prepared, TL_SKY_LEVELS * 2 * sizeof(float), at, &memory, err);
    if (status != TL_OK)
        return status;
    float *to = memory;
    for (unsigned level = 0; level < TL_SKY_LEVELS; level++) {
        to[2 * level] = (float)tl_sky_level_start(level, map->size);
        to[2 * level + 1] = (float)tl_sky_level_size(level, map->size);
    }
    return TL_OK;
}

static tl_status add_table(tl_prepared *prepared, tl_u32 *at, tl_error *err)
{
    const size_t size = TL_SKY_TABLE * TL_SKY_TABLE * 4 * sizeof(float);
    void *memory = NULL;
    const tl_status status = tl_section_add(prepared, size, at, &memory, err);
    if (status == TL_OK)
        memcpy(memory, tl_split_sum_table(), size);
    return status;
}

/* The polynomial in the map's axes, turned into those of view space: axes[i] is axis i there. */
static void set_irradiance(const tl_sky_moments *of,
                           double axes[3][3],
                           double scale,
                           float out[12])
{
    double first[3] = {0.0, 0.0, 0.0}, second[3][3] = {{0.0}};
    for (int i = 0; i < 3; i++)
        for (int x = 0; x < 3; x++) {
            first[x] += of->first[i] * axes[i][x];
            for (int k = 0; k < 3; k++)
                for (int y = 0; y < 3; y++)
                    second[x][y] += of->second[i][k] * axes[i][x] * axes[k][y];
        }
    const double by_one = scale * 3.0 / (32.0 * pi), by_first = scale / (2.0 * pi),
                 by_second = scale * 15.0 / (32.0 * pi);
    out[0] = (float)(of->light * by_one);
    for (int x = 0; x < 3; x++) {
        const int y = (x + 1) % 3;
        out[1 + x] = (float)(first[x] * by_first);
        out[4 + x] = (float)(second[x][x] * by_second);
        out[7 + x] = (float)(2.0 * second[x][y] * by_second);
    }
}

/* What radiance of the map is multiplied with, where it lights; less where its mean would be beyond
 * TL_BRIGHTEST. */
static double scale_of(const tl_light_set *lights, const tl_sky_map *map)
{
    const double intensity =
        lights->sky_type == TL_SKY_IMAGE ? (double)lights->sky_intensity : 1.0;
    double scale = intensity * (double)lights->sky_light;
    for (int c = 0; c < 3; c++)
        if (map->moments[c].light * scale > 4.0 * pi * (double)TL_BRIGHTEST)
            scale = 4.0 * pi * (double)TL_BRIGHTEST / map->moments[c].light;
    return scale;
}

static tl_status find_map(const tl_light_set *lights, tl_prepared *prepared, tl_error *err)
{
    tl_sky_map *map = NULL;
    const tl_status status = tl_sky_map_of(lights, mirrors_sky(prepared->needs), &map, err);
    if (status != TL_OK)
        return status;
    tl_sky_map_release(prepared->sky_map);
    prepared->sky_map = map;
    return TL_OK;
}

tl_status tl_sky_light_add(const tl_camera *camera,
                           const tl_light_set *lights,
                           tl_prepared *prepared,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_view_sky_light sky = {.texels_at = 0};
    double world[3][3], axes[3][3];
    TRY(find_map(lights, prepared, err));
    const double scale = scale_of(lights, prepared->sky_map);
    tl_sky_axes((double)lights->sky_rotation, world);
    for (int i = 0; i < 3; i++)
        tl_camera_view_direction(camera, world[i], axes[i]);
    if (mirrors_sky(prepared->needs)) {
        TRY(add_texels(prepared->sky_map, scale, prepared, &sky.texels_at, err));
        TRY(add_levels(prepared->sky_map, prepared, &sky.levels_at, err));
        TRY(add_table(prepared, &sky.table_at, err));
    }
    TRY(tl_section_add(prepared, sizeof sky, &prepared->frame.sky_light_at, NULL, err));
    for (int x = 0; x < 3; x++) {
        sky.right[x] = (float)axes[0][x];
        sky.up[x] = (float)axes[1][x];
        sky.ahead[x] = (float)axes[2][x];
        set_irradiance(&prepared->sky_map->moments[x], axes, scale, sky.irradiance[x]);
    }
    memcpy(tl_section_at(prepared, prepared->frame.sky_light_at), &sky, sizeof sky);
done:
    return status;
}
