#include "tile_choices.h"

#include "choices.h"
#include "falloff.h"
#include "sections.h"
#include "spot.h"

#include <string.h>

static int has_cone(const tl_view_spot *cone)
{
    const tl_view_spot whole = whole_space();
    return memcmp(cone, &whole, sizeof whole) != 0;
}

static int has_lobe(const tl_view_light *light)
{
    return light->specular[0] > 0.0f || light->specular[1] > 0.0f || light->specular[2] > 0.0f;
}

static tl_u32 calls_of(const tl_view_light *light, const tl_view_spot *cone, int is_shaped)
{
    return (has_cone(cone) ? (tl_u32)TL_CHOICE_CONES : 0) |
           (has_lobe(light) ? (tl_u32)TL_CHOICE_LOBES : 0) |
           (is_shaped ? (tl_u32)TL_CHOICE_SHAPES : 0);
}

void tl_choices_note(tl_prepared *prepared,
                     const tl_view_light *light,
                     const tl_view_spot *cone,
                     int is_shaped)
{
    const tl_u32 calls = calls_of(light, cone, is_shaped);
    prepared->some_call |= calls;
    prepared->all_call &= calls;
}

/* Lobes are a part by itself in the short code of plain models alone. */
tl_u32 tl_choosable(const tl_needs *needs)
{
    return (needs->spots ? (tl_u32)TL_CHOICE_CONES : 0) |
           (needs->shapes ? (tl_u32)TL_CHOICE_SHAPES : 0) |
           (needs->specular && is_plain(*needs) ? (tl_u32)TL_CHOICE_LOBES : 0);
}

tl_status tl_choices_open(tl_prepared *prepared, tl_error *err)
{
    const tl_u32 count = prepared->frame.light_count;
    void *memory;
    const tl_u32 open =
        prepared->some_call & ~prepared->all_call & tl_choosable(&prepared->needs);
    if (!open)
        return TL_OK;
    const tl_status status = tl_section_add(prepared, count * sizeof(tl_u32),
                                            &prepared->frame.calls_at, &memory, err);
    if (status != TL_OK)
        return status;
    tl_u32 *calls = memory;
    for (tl_u32 i = 0; i < count; i++)
        calls[i] = calls_of(&prepared->lights[i], &prepared->spots[i],
                            has_shape(prepared->lights[i].falloff));
    prepared->needs.choices = open;
    return TL_OK;
}
