#include "reference.h"

#include "parallel.h"
#include "surround.h"
#include "twin.h"

#define DECLARE_TWINS(name, word) extern tl_twin_rows tl_twin_##word##_portable;
TL_ARITHMETICS(DECLARE_TWINS)
#undef DECLARE_TWINS

#ifdef TL_HAS_FMA_TWINS
#    define DECLARE_TWINS(name, word) extern tl_twin_rows tl_twin_##word##_fma;
TL_ARITHMETICS(DECLARE_TWINS)
#    undef DECLARE_TWINS
#endif

static tl_twin_rows *twin_for(tl_arithmetic arithmetic)
{
    static tl_twin_rows *const portable[] = {
#define PORTABLE_TWIN(name, word) [name] = tl_twin_##word##_portable,
        TL_ARITHMETICS(PORTABLE_TWIN)
#undef PORTABLE_TWIN
    };
#ifdef TL_HAS_FMA_TWINS
    static tl_twin_rows *const with_fma[] = {
#    define FMA_TWIN(name, word) [name] = tl_twin_##word##_fma,
        TL_ARITHMETICS(FMA_TWIN)
#    undef FMA_TWIN
    };
    if (__builtin_cpu_supports("fma"))
        return with_fma[arithmetic];
#endif
    return portable[arithmetic];
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
