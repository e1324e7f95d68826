/* Parts of a G-buffer, as G-buffers of their own. */
#include "tilelight/gbuffer.h"

#include "layout.h"
#include "try.h"

#include <assert.h>
#include <string.h>

static tl_camera camera_through(const tl_camera *whole, const tl_region *window)
{
    tl_camera camera = *whole;
    camera.width = window->width;
    camera.height = window->height;
    camera.window_x = whole->window_x + window->x;
    camera.window_y = whole->window_y + window->y;
    camera.whole_width = tl_camera_whole_width(whole);
    camera.whole_height = tl_camera_whole_height(whole);
    return camera;
}

/* Rows of `size` bytes a pixel; padding is what it was made of. */
static void copy_rows(const void *from,
                      uint32_t from_pitch,
                      void *to,
                      uint32_t to_pitch,
                      size_t size,
                      const tl_region *window)
{
    for (uint32_t y = 0; y < window->height; y++)
        memcpy((char *)to + size * to_pitch * y,
               (const char *)from + size * ((size_t)from_pitch * (window->y + y) + window->x),
               size * window->width);
}

/* What does not hang on the place of a pixel is that of the whole. */
static void copy_facts(const tl_gbuffer *from, tl_gbuffer *to)
{
    to->samples = from->samples;
    to->slack_x = from->slack_x;
    to->slack_y = from->slack_y;
    to->neutral = from->neutral;
    to->is_dark = from->is_dark;
    to->knows_indices = from->knows_indices;
    memcpy(to->indices, from->indices, sizeof to->indices);
}

static tl_status copy_ids(const tl_gbuffer *from,
                          const tl_region *window,
                          tl_gbuffer *to,
                          tl_error *err)
{
    tl_status status = TL_OK;
    if (!from->ids)
        return TL_OK;
    TRY(tl_ids_add(to, err));
    copy_rows(from->ids, from->pitch, to->ids, to->pitch, sizeof *to->ids, window);
done:
    return status;
}

static void copy_planes(const tl_gbuffer *from, const tl_region *window, tl_gbuffer *to)
{
    for (uint32_t i = 0; i < TL_MAX_WORDS; i++) {
        const uint32_t size = tl_gbuffer_word_size(from, i);
        if (size > 0)
            copy_rows(tl_gbuffer_words(from, i), from->pitch, tl_gbuffer_words(to, i),
                      to->pitch, size, window);
    }
}

static uint32_t cut_row(uint32_t row, const tl_region *window)
{
    const uint32_t from = row > window->y ? row - window->y : 0;
    return from < window->height ? from : window->height;
}

static tl_status copy_layer(const tl_gbuffer *from,
                            const tl_region *window,
                            tl_gbuffer *of,
                            tl_error *err)
{
    tl_gbuffer *to = NULL;
    const tl_status status = tl_layers_add(of, &to, err);
    if (status != TL_OK)
        return status;
    copy_facts(from, to);
    copy_planes(from, window, to);
    copy_rows(from->opacity, from->pitch, to->opacity, to->pitch, sizeof(float), window);
    to->shown_from = cut_row(from->shown_from, window);
    to->shown_to = cut_row(from->shown_to, window);
    return copy_ids(from, window, to, err);
}

tl_status tl_gbuffer_cut(tl_gbuffer **gbuffer, const tl_region *window, tl_error *err)
{
    tl_gbuffer *const from = *gbuffer;
    const tl_camera camera = camera_through(&from->camera, window);
    tl_gbuffer *made = NULL;
    tl_status status = TL_OK;
    assert(window->width > 0 && window->x + window->width <= from->camera.width);
    assert(window->height > 0 && window->y + window->height <= from->camera.height);
    TRY(tl_gbuffer_create_packed(&camera, from->layout, from->present, &made, err));
    copy_facts(from, made);
    copy_planes(from, window, made);
    TRY(copy_ids(from, window, made, err));
    for (uint32_t i = 0; i < from->layers.count; i++)
        TRY(copy_layer(from->layers.of[i], window, made, err));
    made->layers.left = from->layers.left;
    made->shadows = from->shadows;
    made->materials = from->materials;
    made->objects = from->objects;
    from->shadows = (tl_shadow_maps){0};
    from->materials = (tl_material_names){0};
    from->objects = (tl_objects){0};
    tl_gbuffer_destroy(from);
    *gbuffer = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}
