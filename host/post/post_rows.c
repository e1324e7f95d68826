/* Compiled once per arithmetic and instruction set: TL_TWIN is the name it then has. What kernels of stages
 * compute, as rows of C. */
#include "stage_rows.h"

#include "mend.h"

tl_post_rows_twin TL_TWIN;

/* Writes a pixel of tl_post_rows_job.to. */
static void put_color(const tl_post_rows_job *job, vec3 color, uint32_t row, uint32_t column)
{
    const size_t at = post_at(&job->view, 0, row, column),
                 plane = (size_t)job->view.plane_rows * job->view.pitch;
    job->to[at] = (float)color.x;
    job->to[at + plane] = (float)color.y;
    job->to[at + 2 * plane] = (float)color.z;
}

static void count_no_colors(tl_post_rows_job *job, uint32_t row)
{
    uint64_t count = 0;
    for (uint32_t column = 0; column < job->view.width; column++)
        count += !is_color(post_color(&job->view, job->from, row, column));
    if (count > 0)
        __atomic_fetch_add(&job->count, count, __ATOMIC_RELAXED);
}

static void mend_row(tl_post_rows_job *job, uint32_t row)
{
    for (uint32_t column = 0; column < job->view.width; column++) {
        const vec3 own = post_color(&job->view, job->from, row, column);
        put_color(job,
                  is_color(own) ? own : mended(&job->view, job->from, (int)row, (int)column),
                  row, column);
    }
}

static void gather_edges(tl_post_rows_job *job, uint32_t row)
{
    const tl_view_gather *of = job->gather;
    const size_t plane = (size_t)of->edges.rows * of->frame.pitch;
    for (uint32_t column = 0; column < job->view.width; column++) {
        const size_t at = (size_t)row * of->frame.pitch + column;
        const tl_words words = tl_words_at(job->planes, at);
        const near_surface s = near_surface_of(&of->frame, *job->needs, job->planes->layout,
                                               &words, (real)column, (real)row);
        job->numbers[at] = (float)edge_place(of->edges.orthographic, s.depth);
        job->numbers[TL_EDGE_NORMAL_X * plane + at] = (float)s.normal.x;
        job->numbers[TL_EDGE_NORMAL_Y * plane + at] = (float)s.normal.y;
        job->numbers[TL_EDGE_NORMAL_Z * plane + at] = (float)s.normal.z;
    }
}

static void smooth_edges(tl_post_rows_job *job, uint32_t row)
{
    for (uint32_t column = 0; column < job->view.width; column++) {
        const int y = (int)row, x = (int)column;
        const real factor = edge_factor(job->edges, job->numbers, y, x);
        put_color(job, smoothed_edge(job->edges, job->from, factor, y, x), row, column);
    }
}

static void (*const steps[TL_POST_STEP_COUNT])(tl_post_rows_job *job, uint32_t row) = {
    [TL_POST_STEP_COUNT_NO_COLORS] = count_no_colors,
    [TL_POST_STEP_MEND] = mend_row,
    [TL_POST_STEP_GATHER_EDGES] = gather_edges,
    [TL_POST_STEP_SMOOTH_EDGES] = smooth_edges,
};

void TL_TWIN(tl_post_rows_job *job, tl_post_step step, size_t begin, size_t end)
{
    for (size_t row = begin; row < end; row++)
        steps[step](job, (uint32_t)row);
}
