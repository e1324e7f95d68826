#include "reference.h"

#include "parallel.h"
#include "surround.h"
#include "twin.h"
#include "twins.h"

#define DECLARE(name, word) TL_DECLARE_TWIN(tl_twin_rows, tl_twin_##word);
TL_ARITHMETICS(DECLARE)
#undef DECLARE

static tl_twin_rows *twin_for(tl_arithmetic arithmetic)
{
    tl_twin_rows *const twins[] = {
#define TWIN(name, word) [name] = TL_TWIN_OF(tl_twin_##word),
        TL_ARITHMETICS(TWIN)
#undef TWIN
    };
    return twins[arithmetic];
}

typedef struct job {
    const tl_prepared *prepared;
    tl_twin_rows *twin;
    tl_word_planes planes;
    const float *opacity;
    float *radiance;
} job;

static void light_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    j->twin(j->prepared, &j->planes, j->opacity, j->radiance, begin, end);
}

void tl_reference_light(const tl_prepared *prepared,
                        const tl_gbuffer *gbuffer,
                        tl_arithmetic arithmetic,
                        tl_image *image)
{
    job j = {.prepared = prepared,
             .twin = twin_for(arithmetic),
             .planes = tl_word_planes_of(gbuffer),
             .opacity = gbuffer->opacity,
             .radiance = tl_image_plane(image, 0)};
    tl_reference_surround(prepared, gbuffer, arithmetic);
    tl_parallel(prepared->frame.tiles_y * prepared->frame.tile_size, 1, light_rows, &j);
}
