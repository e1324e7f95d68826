#include "explain_use.h"

#include "surface_pixels.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <stdlib.h>

/* Planes that say something, tile by tile. */
static tl_status find_planes(const tl_gbuffer *gbuffer,
                             uint32_t tile_size,
                             uint32_t *planes,
                             tl_error *err)
{
    tl_gbuffer *unpacked = NULL;
    tl_status status = TL_OK;
    if (gbuffer->layout != TL_LAYOUT_FLOAT)
        TRY(tl_gbuffer_unpack(gbuffer, &unpacked, err));
    tl_surface_planes(unpacked ? unpacked : gbuffer, tile_size, planes);
done:
    tl_gbuffer_destroy(unpacked);
    return status;
}

/* Pixels of the picture. */
typedef struct area {
    uint32_t x, y, width, height;
} area;

static area area_of_tile(const job *j, const explained *e, uint32_t tile)
{
    const tl_camera *camera = &j->gbuffer->camera;
    const uint32_t x = tile % e->tiles_x * e->tile_size, y = tile / e->tiles_x * e->tile_size;
    return (area){x, y, camera->width - x < e->tile_size ? camera->width - x : e->tile_size,
                  camera->height - y < e->tile_size ? camera->height - y : e->tile_size};
}

/* Whether a layer has a surface there: the nearest one has, where any has. */
static bool shows_layer(const job *j, area of)
{
    if (j->gbuffer->layers.count == 0)
        return false;
    const tl_gbuffer *nearest = j->gbuffer->layers.of[0];
    for (uint32_t y = of.y; y < of.y + of.height; y++)
        for (uint32_t x = of.x; x < of.x + of.width; x++)
            if (nearest->opacity[(size_t)y * nearest->pitch + x] > 0.0f)
                return true;
    return false;
}

/* Causes that are no light's and that a tile may have or lack: planes that say something there, whole sky,
 * layers. */
static uint64_t causes_of_tile(const job *j, const explained *e, uint32_t tile, uint32_t planes)
{
    static const uint64_t sky =
        TL_BY(TL_CAUSE_SKY) | TL_BY(TL_CAUSE_SKY_GRADIENT) | TL_BY(TL_CAUSE_SKY_IMAGE);
    const area of = area_of_tile(j, e, tile);
    uint64_t causes = e->of.causes | e->of.assumed;
    if (!(planes & TL_GROUP_OCCLUSION))
        causes &= ~TL_BY(TL_CAUSE_OCCLUSION);
    if (!(planes & TL_GROUP_EMISSIVE))
        causes &= ~TL_BY(TL_CAUSE_EMISSION);
    if ((e->of.present & TL_GROUP_PHONG) && !(planes & TL_THREE(TL_SPECULAR_R)))
        causes &= ~TL_BY(TL_CAUSE_GLOSS);
    if (e->surfaces[tile] == 0)
        causes &= sky | TL_BY(TL_CAUSE_BLENDED);
    if (e->surfaces[tile] == of.width * of.height)
        causes &= ~sky;
    if ((causes & TL_BY(TL_CAUSE_BLENDED)) && !shows_layer(j, of))
        causes &= ~TL_BY(TL_CAUSE_BLENDED);
    return causes;
}

/* The effects that lights which reach everything call for. */
static uint64_t effects_of_globals(const tl_effect_use *of_lights)
{
    uint64_t effects = 0;
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        if (of_lights->global_lights[i] > 0)
            effects |= TL_ON(i);
    return effects;
}

/* Effects that no cause of lights is needed for. */
static uint64_t effects_without_lights(void)
{
    return ~tl_effects_of_light(~0ull, ~0ull);
}

static void count_tile(explained *e, uint64_t used)
{
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        e->use[i].tiles += (uint32_t)(used >> i & 1u);
}

tl_status explain_find_use(const job *j,
                           const tl_effect_use *of_lights,
                           explained *e,
                           tl_error *err)
{
    const uint32_t tiles = e->tiles_x * e->tiles_y;
    const uint64_t of_globals = effects_of_globals(of_lights);
    uint32_t *planes = malloc(((size_t)tiles + 1) * sizeof *planes), lit_tiles = 0;
    tl_status status = TL_OK;
    if (!planes)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the planes of %u tiles", tiles));
    TRY(find_planes(j->gbuffer, e->tile_size, planes, err));
    for (uint32_t t = 0; t < tiles; t++) {
        const uint64_t lights =
            e->surfaces[t] > 0 ? of_lights->tiles[t] | of_globals : of_lights->tiles[t];
        const uint64_t possible = tl_effects_of(causes_of_tile(j, e, t, planes[t]));
        count_tile(e, e->of.effects & possible & (lights | effects_without_lights()));
        lit_tiles += e->surfaces[t] > 0;
    }
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        e->use[i].pairs = (double)of_lights->pairs[i] +
                          (double)of_lights->global_lights[i] * (double)lit_tiles;
done:
    free(planes);
    return status;
}
