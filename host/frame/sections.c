#include "sections.h"

#include <stdlib.h>
#include <string.h>

TL_STATIC_ASSERT(sizeof(tl_view_light) % TL_SECTION_ROW == 0, lights_are_whole_rows);
TL_STATIC_ASSERT(sizeof(tl_view_spot) % TL_SECTION_ROW == 0, cones_are_whole_rows);

tl_status tl_sections_reserve(tl_prepared *prepared, size_t size, tl_error *err)
{
    if (size <= prepared->memory_size)
        return TL_OK;
    const ptrdiff_t spots_at =
        prepared->spots ? (char *)prepared->spots - (char *)prepared->lights : 0;
    char *grown = realloc(prepared->lights, size);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for lights of %zu bytes", size);
    prepared->lights = (tl_view_light *)(void *)grown;
    if (prepared->spots)
        prepared->spots = (tl_view_spot *)(void *)(grown + spots_at);
    prepared->memory_size = size;
    return TL_OK;
}

tl_status tl_section_add(
    tl_prepared *prepared, size_t size, tl_u32 *at, void **memory, tl_error *err)
{
    const size_t rows = size / TL_SECTION_ROW + (size % TL_SECTION_ROW != 0);
    const size_t before =
        prepared->frame.light_count * TL_LIGHT_AND_CONE + prepared->sections_size;
    if (rows + before / TL_SECTION_ROW > UINT32_MAX)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "lights and what belongs to them take more than 64 GiB");
    const tl_status status = tl_sections_reserve(prepared, before + rows * TL_SECTION_ROW, err);
    if (status != TL_OK)
        return status;
    *at = (tl_u32)(before / TL_SECTION_ROW);
    void *const made = tl_section_at(prepared, *at);
    memset(made, 0, rows * TL_SECTION_ROW);
    prepared->sections_size += rows * TL_SECTION_ROW;
    if (memory)
        *memory = made;
    return TL_OK;
}

void *tl_section_at(const tl_prepared *prepared, tl_u32 row)
{
    return (char *)prepared->lights + (size_t)row * TL_SECTION_ROW;
}
