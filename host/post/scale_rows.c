/* Compiled once per arithmetic and instruction set: TL_TWIN is the name it then has. What scale_columns and
 * scale_rows compute, row by row. */
#include "scale_rows.h"

tl_scale_rows_twin TL_TWIN;

void TL_TWIN(void *context, size_t begin, size_t end)
{
    const tl_scale_job *job = context;
    const tl_view_scale *of = &job->of;
    const float *from = job->from + (size_t)job->color * of->from_rows * of->from_pitch;
    for (size_t i = begin; i < end; i++) {
        const tl_u32 y = of->first_row + (tl_u32)i;
        float *between = job->between + i * of->from_pitch;
        float *to = job->to + ((size_t)job->color * of->rows + y - of->plane_row) * of->pitch;
        for (tl_u32 x = 0; x < of->from_width; x++)
            between[x] = (float)scaled_along_column(of, from, job->tables, y, x);
        for (tl_u32 x = 0; x < of->width; x++)
            to[x] = (float)scaled_along_row(of, between, job->tables, x);
    }
}
