#include "bench_layers.h"

#include "try.h"

#include <math.h>

static const float nearer = 0.99f, opacity = 0.5f;

/* Pixels [begin, end) of `count`, in its middle. */
typedef struct span {
    uint32_t begin, end;
} span;

static span middle(uint32_t count, uint32_t part)
{
    const uint32_t kept = (uint32_t)ceil((double)count / sqrt((double)part));
    return (span){(count - kept) / 2, (count - kept) / 2 + kept};
}

static void copy_surfaces(const tl_gbuffer *from, float scale, uint32_t part, tl_gbuffer *to)
{
    const span rows = middle(from->camera.height, part),
               columns = middle(from->camera.width, part);
    for (uint32_t y = rows.begin; y < rows.end; y++)
        for (uint32_t x = columns.begin; x < columns.end; x++) {
            const size_t at = (size_t)y * from->pitch + x;
            for (int p = 0; p < TL_PLANE_COUNT; p++)
                if (tl_gbuffer_plane(from, (enum tl_plane)p))
                    tl_gbuffer_plane(to, (enum tl_plane)p)[at] =
                        tl_gbuffer_plane(from, (enum tl_plane)p)[at];
            tl_gbuffer_plane(to, TL_DEPTH)[at] *= scale;
            to->opacity[at] = isfinite(tl_gbuffer_plane(to, TL_DEPTH)[at]) ? opacity : 0.0f;
        }
}

tl_status tl_bench_layers_add(tl_gbuffer *gbuffer, uint32_t count, uint32_t part, tl_error *err)
{
    tl_status status = TL_OK;
    for (uint32_t i = 0; i < count; i++) {
        tl_gbuffer *layer = NULL;
        TRY(tl_layers_add(gbuffer, &layer, err));
        copy_surfaces(gbuffer, powf(nearer, (float)(count - i)), part, layer);
    }
done:
    return status;
}
