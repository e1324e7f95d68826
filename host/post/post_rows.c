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

/* index: of the rows that the step writes; so below. */
static void gather_bright(tl_post_rows_job *job, uint32_t index)
{
    const tl_view_bloom *b = &job->bloom->bloom;
    const int row = b->from_row + (int)index, side = (int)b->side;
    int is_bright = 0;
    for (uint32_t at = 0; at < b->pitch; at++) {
        const int left = ((int)at - (int)b->guard) * side;
        vec3 of[4];
        for (int x = 0; x < 4; x++)
            of[x] =
                bright_columns(job->bloom, job->from, row * side, left + (x < side ? x : 0));
        vec3 mean = {of[0].x + of[1].x, of[0].y + of[1].y, of[0].z + of[1].z};
        if (side == 4) {
            mean.x = mean.x + (of[2].x + of[3].x);
            mean.y = mean.y + (of[2].y + of[3].y);
            mean.z = mean.z + (of[2].z + of[3].z);
        }
        job->numbers[bloom_at(b, 0, row, at)] = (float)mean.x;
        job->numbers[bloom_at(b, 1, row, at)] = (float)mean.y;
        job->numbers[bloom_at(b, 2, row, at)] = (float)mean.z;
        is_bright |= mean.x > R(0.0) || mean.y > R(0.0) || mean.z > R(0.0);
    }
    if (is_bright)
        __atomic_fetch_or(&job->count, 1u, __ATOMIC_RELAXED);
}

static void blur_row(tl_post_rows_job *job, uint32_t index, long apart)
{
    const tl_view_bloom *b = &job->bloom->bloom;
    const int row = b->from_row + (int)index;
    for (uint32_t color = 0; color < 3; color++)
        for (uint32_t at = TL_BLOOM_ENDS; at < b->pitch - TL_BLOOM_ENDS; at++) {
            const size_t here = bloom_at(b, color, row, at);
            job->blurred[here] = (float)seven_taps(b, job->numbers + here, apart);
        }
}

static void blur_across(tl_post_rows_job *job, uint32_t index)
{
    blur_row(job, index, 1);
}

static void blur_down(tl_post_rows_job *job, uint32_t index)
{
    blur_row(job, index, (long)job->bloom->bloom.pitch);
}

static real glow_at(const tl_post_rows_job *job, uint32_t color, uint32_t row, uint32_t column)
{
    const tl_view_bloom *b = &job->bloom->bloom;
    const scalar below = bloom_beyond(row, b->side);
    const float *top =
        job->numbers + bloom_at(b, color, bloom_before(row, b->side),
                                (uint32_t)(bloom_before(column, b->side) + (int)b->guard));
    return between(bloom_beyond(column, b->side),
                   between(below, (real)top[0], (real)top[b->pitch]),
                   between(below, (real)top[1], (real)top[b->pitch + 1]));
}

static void add_glow(tl_post_rows_job *job, uint32_t row)
{
    const tl_view_bloom *b = &job->bloom->bloom;
    for (uint32_t column = 0; column < job->view.width; column++) {
        const vec3 own = post_color(&job->view, job->from, row, column);
        const vec3 seen = {with_glow(b, own.x, glow_at(job, 0, row, column)),
                           with_glow(b, own.y, glow_at(job, 1, row, column)),
                           with_glow(b, own.z, glow_at(job, 2, row, column))};
        put_color(job, seen, row, column);
    }
}

static void (*const steps[TL_POST_STEP_COUNT])(tl_post_rows_job *job, uint32_t row) = {
    [TL_POST_STEP_COUNT_NO_COLORS] = count_no_colors,
    [TL_POST_STEP_MEND] = mend_row,
    [TL_POST_STEP_GATHER_EDGES] = gather_edges,
    [TL_POST_STEP_SMOOTH_EDGES] = smooth_edges,
    [TL_POST_STEP_GATHER_BRIGHT] = gather_bright,
    [TL_POST_STEP_BLUR_ACROSS] = blur_across,
    [TL_POST_STEP_BLUR_DOWN] = blur_down,
    [TL_POST_STEP_ADD_GLOW] = add_glow,
};

void TL_TWIN(tl_post_rows_job *job, tl_post_step step, size_t begin, size_t end)
{
    for (size_t row = begin; row < end; row++)
        steps[step](job, (uint32_t)row);
}
