#include "tilelight/layers.h"

#include "aligned.h"
#include "parallel.h"
#include "try.h"

#include "tilelight/gbuffer.h"

#include <assert.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Padding is none of it. */
static tl_status add_opacity(tl_gbuffer *layer, tl_error *err)
{
    const size_t size = (size_t)layer->pitch * layer->rows * sizeof *layer->opacity;
    layer->opacity = tl_aligned_alloc(size);
    if (!layer->opacity)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the opacity of a layer (%zu MB)",
                       size >> 20);
    memset(layer->opacity, 0, size);
    return TL_OK;
}

tl_status tl_layers_add(tl_gbuffer *of, tl_gbuffer **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_layers *layers = &of->layers;
    tl_gbuffer *made = NULL;
    assert(layers->count < TL_MOST_LAYERS);
    tl_gbuffer **more = realloc(layers->of, (layers->count + 1) * sizeof(tl_gbuffer *));
    if (!more)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a layer"));
    layers->of = more;
    TRY(tl_gbuffer_create_packed(&of->camera, of->layout, of->present, &made, err));
    made->samples = of->samples;
    made->layer_of = of;
    made->shown_to = made->camera.height;
    TRY(add_opacity(made, err));
    layers->of[layers->count++] = made;
    if (out)
        *out = made;
    made = NULL;
done:
    tl_gbuffer_destroy(made);
    return status;
}

void tl_layer_copy_opacity(const tl_gbuffer *from, tl_gbuffer *to)
{
    memcpy(to->opacity, from->opacity, (size_t)to->pitch * to->rows * sizeof *to->opacity);
}

double tl_layers_left_share(const tl_gbuffer *of)
{
    return (double)of->layers.left / ((double)of->camera.width * of->camera.height);
}

typedef struct counting {
    const tl_gbuffer *layer;
    atomic_ullong count;
} counting;

static void count_rows(void *context, size_t begin, size_t end)
{
    counting *c = context;
    unsigned long long count = 0;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < c->layer->camera.width; x++)
            count += c->layer->opacity[y * c->layer->pitch + x] > 0.0f;
    atomic_fetch_add(&c->count, count);
}

double tl_layer_coverage(const tl_gbuffer *of, uint32_t index)
{
    counting c = {.layer = of->layers.of[index]};
    atomic_init(&c.count, 0);
    tl_parallel(of->camera.height, 16, count_rows, &c);
    return (double)atomic_load(&c.count) / ((double)of->camera.width * of->camera.height);
}

void tl_layers_clear(tl_layers *layers)
{
    for (uint32_t i = 0; i < layers->count; i++)
        tl_gbuffer_destroy(layers->of[i]);
    free(layers->of);
    *layers = (tl_layers){0};
}
