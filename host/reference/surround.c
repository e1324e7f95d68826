#include "surround.h"

#include "occlusion.h"
#include "parallel.h"

#define DECLARE_TWINS(set)                                                     \
    extern tl_surround_rows tl_surround_float_##set, tl_surround_double_##set, \
        tl_surround_reference_##set;
#define TWINS(set)                                                                             \
    {                                                                                          \
        [TL_TWIN_FLOAT] = tl_surround_float_##set, [TL_TWIN_CHOSEN] = tl_surround_float_##set, \
        [TL_TWIN_DOUBLE] = tl_surround_double_##set,                                           \
        [TL_TWIN_REFERENCE] = tl_surround_reference_##set,                                     \
    }
DECLARE_TWINS(portable)
#ifdef TL_HAS_FMA_TWINS
DECLARE_TWINS(fma)
#endif

/* No knob of kernels/knobs.h changes them. */
static tl_surround_rows *twin_for(tl_arithmetic arithmetic)
{
    static tl_surround_rows *const portable[TL_ARITHMETIC_COUNT] = TWINS(portable);
#ifdef TL_HAS_FMA_TWINS
    static tl_surround_rows *const with_fma[TL_ARITHMETIC_COUNT] = TWINS(fma);
    if (__builtin_cpu_supports("fma"))
        return with_fma[arithmetic];
#endif
    return portable[arithmetic];
}

typedef struct job {
    const tl_prepared *prepared;
    tl_surround_rows *twin;
    tl_word_planes planes;
    tl_surround_step step;
} job;

static void surround_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    j->twin(j->prepared, &j->planes, j->step, begin, end);
}

void tl_reference_surround(const tl_prepared *prepared,
                           const tl_gbuffer *gbuffer,
                           tl_arithmetic arithmetic)
{
    const size_t rows = around_height(&prepared->frame);
    job j = {prepared, twin_for(arithmetic), tl_word_planes_of(gbuffer), TL_SURROUND_GATHER};
    if (!prepared->needs.surroundings)
        return;
    for (; j.step < TL_SURROUND_STEP_COUNT; j.step++)
        tl_parallel(rows, 1, surround_rows, &j);
}
