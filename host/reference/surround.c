#include "surround.h"

#include "occlusion.h"
#include "parallel.h"
#include "twins.h"

TL_DECLARE_TWIN(tl_surround_rows, tl_surround_float);
TL_DECLARE_TWIN(tl_surround_rows, tl_surround_double);
TL_DECLARE_TWIN(tl_surround_rows, tl_surround_reference);

/* No knob of kernels/knobs.h changes them. */
static tl_surround_rows *twin_for(tl_arithmetic arithmetic)
{
    tl_surround_rows *const twins[TL_ARITHMETIC_COUNT] = {
        [TL_TWIN_FLOAT] = TL_TWIN_OF(tl_surround_float),
        [TL_TWIN_CHOSEN] = TL_TWIN_OF(tl_surround_float),
        [TL_TWIN_DOUBLE] = TL_TWIN_OF(tl_surround_double),
        [TL_TWIN_REFERENCE] = TL_TWIN_OF(tl_surround_reference),
    };
    return twins[arithmetic];
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
