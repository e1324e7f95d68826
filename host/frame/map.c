#include "map.h"

#include "largest.h"
#include "sections.h"

#include <stdlib.h>

tl_status tl_maps_begin(const tl_light_set *lights, tl_prepared *prepared, tl_error *err)
{
    if (lights->image_count > prepared->image_capacity) {
        tl_u32 *grown = realloc(prepared->images_at, lights->image_count * sizeof *grown);
        if (!grown)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu images",
                           lights->image_count);
        prepared->images_at = grown;
        prepared->image_capacity = lights->image_count;
    }
    for (size_t i = 0; i < lights->image_count; i++)
        prepared->images_at[i] = 0;
    return TL_OK;
}

static tl_status add_pixels(
    const tl_light_image *image, double scale, tl_prepared *prepared, tl_u32 *at, tl_error *err)
{
    const size_t count = (size_t)image->width * image->height;
    void *memory = NULL;
    const tl_status status = tl_section_add(prepared, count * TL_SECTION_ROW, at, &memory, err);
    if (status != TL_OK)
        return status;
    float *to = memory;
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++) {
            const double v = (double)image->pixels[3 * i + c] * scale;
            to[4 * i + c] = v < (double)TL_BRIGHTEST ? (float)v : TL_BRIGHTEST;
            if (to[4 * i + c] > prepared->brightest_texel)
                prepared->brightest_texel = to[4 * i + c];
        }
    return TL_OK;
}

tl_status tl_map_show(const tl_light_set *lights,
                      uint32_t number,
                      double scale,
                      tl_prepared *prepared,
                      tl_view_map *map,
                      tl_error *err)
{
    const int is_plain = scale >= 1.0 && scale <= 1.0;
    const tl_light_image *image = &lights->images[number - 1];
    tl_u32 at = is_plain ? prepared->images_at[number - 1] : 0;
    if (at == 0) {
        const tl_status status = add_pixels(image, scale, prepared, &at, err);
        if (status != TL_OK)
            return status;
        if (is_plain)
            prepared->images_at[number - 1] = at;
    }
    map->pixels_at = at;
    map->width = image->width;
    map->height = image->height;
    return TL_OK;
}

void tl_map_direction(const tl_camera *camera,
                      const double world[3],
                      double scale,
                      float view[3])
{
    double turned[3];
    tl_camera_view_direction(camera, world, turned);
    for (int i = 0; i < 3; i++)
        view[i] = (float)(turned[i] * scale);
}
