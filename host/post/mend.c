/* Pixels that are no colours (kernels/mend.h). */
#include "stage.h"

#include "try.h"

static int is_on(const tl_post *post, const tl_gbuffer *gbuffer)
{
    (void)gbuffer;
    return post->options.mend;
}

static uint32_t halo(const tl_post *post)
{
    (void)post;
    return 1;
}

static tl_status on_device(tl_post_work *work, int *wrote, tl_error *err)
{
    const size_t rows = work->view.end_row - work->view.first_row;
    double *const ms = &work->counts.device_ms[TL_POST_MEND];
    uint32_t count = 0;
    tl_status status = TL_OK;
    TRY(tl_post_find_program(work, TL_PART_MEND, NULL, err));
    TRY(tl_post_clear_count(work, err));
    TRY(TL_POST_LAUNCH(work, TL_PART_MEND, count_no_colors, &work->view, rows, work->view.pitch,
                       ms, err, TL_BUFFER_POST_FROM, TL_BUFFER_POST_COUNT));
    TRY(tl_post_read_count(work, &count, err));
    work->counts.mended_count += count;
    *wrote = count > 0;
    if (*wrote)
        TRY(TL_POST_LAUNCH(work, TL_PART_MEND, mend_picture, &work->view, rows,
                           work->view.pitch, ms, err, TL_BUFFER_POST_FROM, TL_BUFFER_POST_TO));
done:
    return status;
}

static tl_status on_host(tl_post_work *work, int *wrote, tl_error *err)
{
    tl_post_rows_job job = {.view = work->view, .from = work->from->planes};
    tl_status status = TL_OK;
    tl_post_rows(work, TL_POST_STEP_COUNT_NO_COLORS, &job, work->view.height);
    work->counts.mended_count += job.count;
    *wrote = job.count > 0;
    if (!*wrote)
        goto done;
    TRY(tl_post_reserve_to(work, err));
    job.to = work->to->planes;
    tl_post_rows(work, TL_POST_STEP_MEND, &job, work->view.height);
done:
    return status;
}

const tl_stage tl_stage_mend = {
    .name = TL_POST_MEND,
    .is_on = is_on,
    .halo = halo,
    .on_device = on_device,
    .on_host = on_host,
};
