/* Steps of stages on the CPU: which twin, on which threads. */
#include "stage.h"

#include "lighting_state.h"
#include "parallel.h"
#include "twins.h"

TL_DECLARE_TWIN(tl_post_rows_twin, tl_post_float);
TL_DECLARE_TWIN(tl_post_rows_twin, tl_post_double);

static tl_post_rows_twin *twin_for(tl_precision precision)
{
    return precision == TL_PRECISION_REFERENCE ? TL_TWIN_OF(tl_post_double)
                                               : TL_TWIN_OF(tl_post_float);
}

typedef struct rows_of_step {
    tl_post_rows_twin *twin;
    tl_post_step step;
    tl_post_rows_job *job;
} rows_of_step;

static void run_rows(void *context, size_t begin, size_t end)
{
    const rows_of_step *of = context;
    of->twin(of->job, of->step, begin, end);
}

void tl_post_rows(const tl_post_work *work,
                  tl_post_step step,
                  tl_post_rows_job *job,
                  size_t rows)
{
    rows_of_step of = {twin_for(work->post->lighting.precision), step, job};
    tl_parallel(rows, 1, run_rows, &of);
}
