/* Bloom (kernels/bloom.h). */
#include "stage.h"

#include "bloom_plan.h"
#include "try.h"

enum { BOTH = 2, COLORS = 3 };

static int is_on(const tl_post *post, const tl_gbuffer *gbuffer)
{
    (void)gbuffer;
    return post->options.bloom.strength > 0.0f;
}

static uint32_t side_of(const tl_post *post)
{
    return post->options.bloom.side ? post->options.bloom.side : TL_DEFAULT_BLOOM_SIDE;
}

static tl_bloom_plan plan_of(const tl_post *post)
{
    const float width = post->options.bloom.width;
    return tl_bloom_plan_for((double)(width > 0.0f ? width : TL_DEFAULT_BLOOM_WIDTH),
                             side_of(post));
}

/* Small pixels beyond those of the rows, above and below: what looking up needs, and all passes. */
static uint32_t reach(const tl_post *post)
{
    return TL_BLOOM_REACH * plan_of(post).passes + 1;
}

static uint32_t halo(const tl_post *post)
{
    return reach(post) * side_of(post);
}

static uint32_t up_to_multiple(uint32_t v, uint32_t of)
{
    return (v + of - 1) / of * of;
}

/* The guard at either end holds what blurs reach, taps' ends beyond it. */
static uint32_t guard_of(const tl_post *post)
{
    return TL_BLOOM_ENDS + up_to_multiple(reach(post) + 1, TL_BLOOM_ENDS);
}

static uint32_t pitch_of(const tl_post *post, uint32_t width)
{
    const uint32_t side = side_of(post);
    return up_to_multiple((width + side - 1) / side + 2 * guard_of(post), 64);
}

/* Of both small pictures: their rows are as many as those that are read, by the side. */
static uint64_t row_size(const tl_post_work *work)
{
    const uint64_t row =
        BOTH * COLORS * sizeof(float) * (uint64_t)pitch_of(work->post, work->from->width);
    return (row + side_of(work->post) - 1) / side_of(work->post);
}

static tl_view_bloom view_of(const tl_post_work *work)
{
    const tl_post *post = work->post;
    const tl_bloom_options *o = &post->options.bloom;
    const tl_bloom_plan plan = plan_of(post);
    const uint32_t side = side_of(post);
    const float knee = o->knee * o->threshold;
    const int first = (int)(work->view.first_row / side),
              end = (int)((work->view.end_row + side - 1) / side);
    tl_view_bloom of = {
        .strength = o->strength,
        .lower = o->threshold - knee,
        .threshold = o->threshold,
        .upper = o->threshold + knee,
        .per_4knee = knee > 0.0f ? 0.25f / knee : 0.0f,
        .per_mean = 1.0f / (float)(side * side),
        .side = side,
        .pitch = pitch_of(post, work->view.width),
        .guard = guard_of(post),
        .first_row = first - (int)reach(post),
        .from_row = first - (int)reach(post),
        .to_row = end + (int)reach(post),
    };
    of.rows = (uint32_t)(of.to_row - of.from_row);
    for (int k = 0; k <= TL_BLOOM_REACH; k++)
        of.taps[k] = plan.taps[k];
    return of;
}

/* After a pass, rows that lack their neighbours are of no use. */
static void shrink(tl_view_bloom *of)
{
    of->from_row += TL_BLOOM_REACH;
    of->to_row -= TL_BLOOM_REACH;
}

static size_t numbers_of(const tl_view_bloom *of)
{
    return (size_t)COLORS * of->rows * of->pitch;
}

static size_t rows_of(const tl_view_bloom *of)
{
    return (size_t)(of->to_row - of->from_row);
}

static tl_status blur(tl_post_work *work, tl_view_bloom_stage *stage, tl_error *err)
{
    double *const ms = &work->counts.device_ms[TL_POST_BLOOM];
    tl_view_bloom *const of = &stage->bloom;
    tl_status status = TL_OK;
    for (uint32_t pass = 0; pass < plan_of(work->post).passes; pass++) {
        TRY(TL_POST_LAUNCH(work, TL_PART_BLOOM, blur_across, stage, rows_of(of), of->pitch, ms,
                           err, TL_BUFFER_POST_SMALL, TL_BUFFER_POST_SMALL_TOO));
        shrink(of);
        TRY(TL_POST_LAUNCH(work, TL_PART_BLOOM, blur_down, stage, rows_of(of), of->pitch, ms,
                           err, TL_BUFFER_POST_SMALL_TOO, TL_BUFFER_POST_SMALL));
        TRY(tl_pass_finish(&work->context, err));
    }
done:
    return status;
}

/* Of the bright pass: a work-item has a small pixel on the path for GPUs, else a vector of the picture's. */
static size_t pitch_of_bright(const tl_post_work *work, const tl_view_bloom *of)
{
    const uint32_t width = work->context.programs[TL_PART_BLOOM]->options.width;
    return (size_t)of->pitch * (width > 1 ? of->side : 1);
}

static tl_status reserve_small(tl_post_work *work, const tl_view_bloom *of, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const size_t size = numbers_of(of) * sizeof(float);
    tl_status status = TL_OK;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_SMALL, size, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_SMALL_TOO, size, err));
done:
    return status;
}

static tl_status on_device(tl_post_work *work, int *wrote, tl_error *err)
{
    tl_view_bloom_stage stage = {work->view, view_of(work)};
    const size_t rows = work->view.end_row - work->view.first_row;
    double *const ms = &work->counts.device_ms[TL_POST_BLOOM];
    uint32_t is_bright = 0;
    tl_status status = TL_OK;
    TRY(tl_post_find_program(work, TL_PART_BLOOM, NULL, err));
    TRY(reserve_small(work, &stage.bloom, err));
    TRY(tl_post_clear_count(work, err));
    TRY(TL_POST_LAUNCH(work, TL_PART_BLOOM, gather_bright, &stage, rows_of(&stage.bloom),
                       pitch_of_bright(work, &stage.bloom), ms, err, TL_BUFFER_POST_FROM,
                       TL_BUFFER_POST_SMALL, TL_BUFFER_POST_COUNT));
    TRY(tl_post_read_count(work, &is_bright, err));
    *wrote = is_bright > 0;
    if (!*wrote)
        goto done;
    work->counts.is_bright = 1;
    TRY(blur(work, &stage, err));
    TRY(TL_POST_LAUNCH(work, TL_PART_BLOOM, add_glow, &stage, rows, work->view.pitch, ms, err,
                       TL_BUFFER_POST_SMALL, TL_BUFFER_POST_FROM, TL_BUFFER_POST_TO));
done:
    return status;
}

static void blur_on_host(tl_post_work *work, tl_post_rows_job *job, tl_view_bloom_stage *stage)
{
    const size_t numbers = numbers_of(&stage->bloom);
    float *const small = work->post->numbers, *const small_too = small + numbers;
    for (uint32_t pass = 0; pass < plan_of(work->post).passes; pass++) {
        job->numbers = small;
        job->blurred = small_too;
        tl_post_rows(work, TL_POST_STEP_BLUR_ACROSS, job, rows_of(&stage->bloom));
        shrink(&stage->bloom);
        job->numbers = small_too;
        job->blurred = small;
        tl_post_rows(work, TL_POST_STEP_BLUR_DOWN, job, rows_of(&stage->bloom));
    }
    job->numbers = small;
}

static tl_status on_host(tl_post_work *work, int *wrote, tl_error *err)
{
    tl_view_bloom_stage stage = {work->view, view_of(work)};
    tl_post_rows_job job = {.view = work->view, .from = work->from->planes, .bloom = &stage};
    tl_status status = TL_OK;
    TRY(tl_post_reserve_to(work, err));
    TRY(tl_post_reserve_numbers(work->post, BOTH * numbers_of(&stage.bloom), err));
    job.to = work->to->planes;
    job.numbers = work->post->numbers;
    tl_post_rows(work, TL_POST_STEP_GATHER_BRIGHT, &job, rows_of(&stage.bloom));
    *wrote = job.count > 0;
    if (!*wrote)
        goto done;
    work->counts.is_bright = 1;
    blur_on_host(work, &job, &stage);
    tl_post_rows(work, TL_POST_STEP_ADD_GLOW, &job, work->view.height);
done:
    return status;
}

const tl_stage tl_stage_bloom = {
    .name = TL_POST_BLOOM,
    .is_on = is_on,
    .halo = halo,
    .row_size = row_size,
    .on_device = on_device,
    .on_host = on_host,
};
