#include "rims.h"

#include "parallel.h"
#include "twins.h"

TL_DECLARE_TWIN(tl_rim_row, tl_rim_row);

typedef struct job {
    const tl_prepared *prepared;
    tl_rim_row *row;
    tl_word_planes planes;
    uint32_t width, height;
    tl_rim_tile *tiles;
    uint8_t *at_rim;
} job;

static void find_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t row = begin; row < end; row++)
        j->row(j->prepared, &j->planes, j->width, j->height, (uint32_t)row, j->tiles,
               j->at_rim);
}

void tl_rims_find(const tl_prepared *prepared,
                  const tl_gbuffer *gbuffer,
                  tl_rim_tile *tiles,
                  uint8_t *at_rim)
{
    const tl_camera *camera = &gbuffer->camera;
    job j = {.prepared = prepared,
             .row = TL_TWIN_OF(tl_rim_row),
             .planes = tl_word_planes_of(gbuffer),
             .width = camera->width,
             .height = camera->height,
             .tiles = tiles,
             .at_rim = at_rim};
    tl_parallel((camera->height + TL_RIM_TILE - 1) / TL_RIM_TILE, 1, find_rows, &j);
}
