#include "tile_choices.h"

#include "choices.h"
#include "falloff.h"
#include "sections.h"

#include <string.h>

/* Whether it is not whole_space() of kernels/spot.h, which lets all light through. */
static int has_cone(const tl_view_spot *cone)
{
    const tl_view_spot whole = {
        .least_cos = -1.0f, .least_cos2 = -1.0f, .scale = 1.0f, .cull_cos = -1.0f};
    return memcmp(cone, &whole, sizeof whole) != 0;
}

static int has_lobe(const tl_view_light *light)
{
    return light->specular[0] > 0.0f || light->specular[1] > 0.0f || light->specular[2] > 0.0f;
}

tl_u32 tl_calls_of_light(const tl_view_light *light, const tl_view_spot *cone)
{
    return (has_cone(cone) ? (tl_u32)TL_CHOICE_CONES : 0) |
           (has_lobe(light) ? (tl_u32)TL_CHOICE_LOBES : 0) |
           (has_shape(light->falloff) ? (tl_u32)TL_CHOICE_SHAPES : 0);
}

/* Of effects that are on; an effect that is off is nothing to choose. Lobes are a part by itself in the short
 * code of plain models alone. */
static tl_u32 choosable(const tl_needs *needs)
{
    return (needs->spots ? (tl_u32)TL_CHOICE_CONES : 0) |
           (needs->shapes ? (tl_u32)TL_CHOICE_SHAPES : 0) |
           (needs->specular && is_plain(*needs) ? (tl_u32)TL_CHOICE_LOBES : 0);
}

tl_status tl_choices_open(tl_prepared *prepared, tl_error *err)
{
    const tl_u32 count = prepared->frame.light_count;
    tl_u32 some = 0, all = ~0u;
    void *memory;
    prepared->needs.choices = 0;
    prepared->frame.calls_at = 0;
    for (tl_u32 i = 0; i < count; i++) {
        const tl_u32 calls = tl_calls_of_light(&prepared->lights[i], &prepared->spots[i]);
        some |= calls;
        all &= calls;
    }
    const tl_u32 open = some & ~all & choosable(&prepared->needs);
    if (!open)
        return TL_OK;
    const tl_status status = tl_section_add(prepared, count * sizeof(tl_u32),
                                            &prepared->frame.calls_at, &memory, err);
    if (status != TL_OK)
        return status;
    tl_u32 *calls = memory;
    for (tl_u32 i = 0; i < count; i++)
        calls[i] = tl_calls_of_light(&prepared->lights[i], &prepared->spots[i]);
    prepared->needs.choices = open;
    return TL_OK;
}
