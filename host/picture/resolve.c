#include "tilelight/image.h"

#include "parallel.h"

#include <assert.h>

typedef struct job {
    const tl_image *from, *to;
    uint32_t side;
} job;

/* At most 64 floats of 24 bits: a double holds their sum without a rounding unless they are 2^23 apart. */
static float mean_of(const float *corner, size_t pitch, uint32_t side)
{
    double sum = 0.0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++)
            sum += (double)corner[y * pitch + x];
    return (float)(sum / (side * side));
}

static void resolve_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (unsigned channel = 0; channel < tl_image_plane_count(j->to); channel++)
        for (size_t row = begin; row < end; row++) {
            const float *const from =
                tl_image_plane(j->from, channel) + row * j->side * j->from->pitch;
            float *const to = tl_image_plane(j->to, channel) + row * j->to->pitch;
            for (size_t x = 0; x < j->to->width; x++)
                to[x] = mean_of(from + x * j->side, j->from->pitch, j->side);
        }
}

tl_status tl_image_resolve(const tl_image *from, uint32_t side, tl_image **out, tl_error *err)
{
    assert(side > 0 && from->width % side == 0 && from->height % side == 0);
    job j = {.from = from, .side = side};
    tl_image *made = NULL;
    const tl_status status = tl_image_create_parts(from->width / side, from->height / side,
                                                   from->part_count, &made, err);
    if (status != TL_OK)
        return status;
    j.to = made;
    tl_parallel(made->height, 4, resolve_rows, &j);
    *out = made;
    return TL_OK;
}
