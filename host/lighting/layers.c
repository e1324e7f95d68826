/* Layers of a frame: each is lit as a frame of its own, with lists and buffers of its own, and blended over
 * the picture, from the farthest to the nearest. */
#include "lighting_state.h"
#include "scene_causes.h"
#include "try.h"

#include <stdlib.h>

/* One for each layer, which keeps its buffers from frame to frame. What tiles list is kept of surfaces
 * alone. */
static tl_status reserve(tl_lighting *lighting, uint32_t count, tl_error *err)
{
    tl_status status = TL_OK;
    tl_lighting_options options = lighting->options;
    options.keeps_tile_lights = 0;
    if (count <= lighting->layer_capacity)
        return TL_OK;
    tl_lighting **more = realloc(lighting->layers, count * sizeof(tl_lighting *));
    if (!more)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for lighting %u layers", count));
    lighting->layers = more;
    while (lighting->layer_capacity < count) {
        TRY(tl_lighting_create(lighting->device, &options, &more[lighting->layer_capacity],
                               err));
        lighting->layer_capacity++;
    }
done:
    return status;
}

/* lighting->lit, where there is need of it. */
static tl_status reserve_lit(tl_lighting *lighting, const tl_image *image, tl_error *err)
{
    tl_image *made = NULL;
    if (tl_lighting_is_on_host(lighting) || !lighting->device->shares_memory)
        return TL_OK;
    if (lighting->lit && lighting->lit->width == image->width &&
        lighting->lit->height == image->height)
        return TL_OK;
    const tl_status status =
        tl_image_create_parts(image->width, image->height, image->part_count, &made, err);
    if (status != TL_OK)
        return status;
    tl_image_destroy(lighting->lit);
    lighting->lit = made;
    return TL_OK;
}

static void add_counts(tl_lighting_counts *sum, const tl_lighting_counts *of)
{
    sum->layer_count++;
    sum->layer_list_length += of->list_length;
    sum->device_bytes += of->device_bytes;
    sum->device_cull_ms += of->device_cull_ms;
    sum->device_shade_ms += of->device_shade_ms;
    sum->shade_wall_ms += of->shade_wall_ms;
    sum->shade_processor_ms += of->shade_processor_ms;
}

tl_status tl_lighting_layers(tl_lighting *lighting,
                             const tl_gbuffer *gbuffer,
                             const tl_light_set *lights,
                             tl_image *image,
                             tl_timings *timings,
                             tl_lighting_counts *counts,
                             tl_error *err)
{
    const tl_layers *layers = &gbuffer->layers;
    const uint32_t most = lighting->options.layers;
    const uint32_t count = layers->count < most ? layers->count : most;
    const double clock = tl_seconds();
    tl_status status = TL_OK;
    if (count == 0)
        return TL_OK;
    TRY(reserve(lighting, count, err));
    TRY(reserve_lit(lighting, image, err));
    for (uint32_t i = count; i-- > 0;) {
        tl_lighting_counts own;
        lighting->layers[i]->part = lighting->part;
        TRY(tl_lighting_surface(lighting->layers[i], layers->of[i], lights, image,
                                lighting->lit, NULL, NULL, &own, err));
        add_counts(counts, &own);
        tl_causes_of_layer(&lighting->explanation, &lighting->layers[i]->explanation);
    }
    tl_timings_end(timings, "layers", clock);
done:
    return status;
}

void tl_lighting_layers_clear(tl_lighting *lighting)
{
    for (uint32_t i = 0; i < lighting->layer_capacity; i++)
        tl_lighting_destroy(lighting->layers[i]);
    free(lighting->layers);
    tl_image_destroy(lighting->lit);
}
