#include "some_pixels.h"

#include "parallel.h"
#include "twins.h"

#include <stdlib.h>

TL_DECLARE_TWIN(tl_some_twin, tl_some_twin);

typedef struct job {
    const tl_prepared *prepared;
    const tl_pixel_groups *pixels;
    tl_some_twin *twin;
    tl_word_planes planes;
    float (*radiance)[3];
} job;

/* Without memory for lists every light is looked at: slower, and the same bits. */
static void light_groups(void *context, size_t begin, size_t end)
{
    const job *j = context;
    const tl_pixel_groups *pixels = j->pixels;
    uint32_t *reaching =
        malloc(((size_t)j->prepared->frame.light_count + 1) * sizeof *reaching);
    for (size_t g = begin; g < end; g++) {
        const size_t first = pixels->begins[g];
        j->twin(j->prepared, &j->planes, pixels->at + first, pixels->begins[g + 1] - first,
                reaching, j->radiance + first);
    }
    free(reaching);
}

void tl_reference_some(const tl_prepared *prepared,
                       const tl_gbuffer *gbuffer,
                       const tl_pixel_groups *pixels,
                       float (*radiance)[3])
{
    enum { GROUPS_A_THREAD_TAKES = 16 };
    job j = {prepared, pixels, TL_TWIN_OF(tl_some_twin), tl_word_planes_of(gbuffer), radiance};
    tl_parallel(pixels->count, GROUPS_A_THREAD_TAKES, light_groups, &j);
}
