/* A stage on a device: the picture whole where it fits, else band after band of its rows. */
#include "stage.h"

#include "lighting_state.h"
#include "try.h"

#include <string.h>

enum { ITEMS_OF_GROUP = 32, ROWS_OF_GROUPS = 8 };

/* Rows of a band are a multiple of these, so that pictures of a half or a quarter of the size have bands of
 * whole rows. */
enum { BAND_GRANULE = 8 };

/* A group is a part of a row in every width, where rows are padded to 64 pixels and counted by 8. */
tl_work tl_post_items(const tl_program *program, size_t rows, size_t pitch)
{
    const size_t padded = (rows + ROWS_OF_GROUPS - 1) / ROWS_OF_GROUPS * ROWS_OF_GROUPS;
    return (tl_work){padded * pitch / program->options.width, ITEMS_OF_GROUP};
}

tl_status tl_post_find_program(tl_post_work *work,
                               tl_program_part part,
                               const tl_kernel_options *more,
                               tl_error *err)
{
    const tl_post *post = work->post;
    const tl_kernel_options arithmetic = tl_lighting_arithmetic(post->device, &post->lighting);
    tl_kernel_options all = more ? *more : (tl_kernel_options){0};
    all.width = arithmetic.width;
    all.by_pixel = arithmetic.by_pixel;
    all.real_double = arithmetic.real_double;
    const double clock = tl_seconds();
    const tl_status status =
        tl_program_find(post->device, part, &all, NULL, &work->context.programs[part], err);
    const double ms = 1e3 * (tl_seconds() - clock);
    tl_timings_add(work->timings, "compile", ms);
    work->compile_ms += ms;
    return status;
}

tl_status tl_post_clear_count(tl_post_work *work, tl_error *err)
{
    static const cl_uint none = 0;
    const tl_pass_context *c = &work->context;
    tl_status status = TL_OK;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_COUNT, sizeof none, err));
    TRY(tl_buffers_write(c->buffers, c->device, TL_BUFFER_POST_COUNT, &none, sizeof none, err));
done:
    return status;
}

tl_status tl_post_read_count(tl_post_work *work, uint32_t *count, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    return tl_cl(clEnqueueReadBuffer(c->device->queue,
                                     c->buffers->of[TL_BUFFER_POST_COUNT].memory, CL_TRUE, 0,
                                     sizeof *count, count, 0, NULL, NULL),
                 "clEnqueueReadBuffer", err);
}

/* Rows [first, end), of each colour, from a picture to the device's buffer of it. */
static tl_status send_rows(const tl_post_work *work,
                           const tl_image *image,
                           uint32_t first,
                           uint32_t end,
                           tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const size_t row = (size_t)image->pitch * sizeof(float);
    const size_t plane = row * work->view.plane_rows, at = row * (first - work->view.plane_row);
    tl_status status = TL_OK;
    for (unsigned color = 0; color < 3; color++)
        TRY(tl_cl(
            clEnqueueWriteBuffer(c->device->queue, c->buffers->of[TL_BUFFER_POST_FROM].memory,
                                 CL_TRUE, color * plane + at, row * (end - first),
                                 tl_image_plane(image, color) + (size_t)first * image->pitch, 0,
                                 NULL, NULL),
            "clEnqueueWriteBuffer", err));
done:
    return status;
}

/* And back. */
static tl_status fetch_rows(const tl_post_work *work,
                            tl_buffer_name name,
                            const tl_image *image,
                            uint32_t first,
                            uint32_t end,
                            tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const size_t row = (size_t)image->pitch * sizeof(float);
    const size_t plane = row * work->view.plane_rows, at = row * (first - work->view.plane_row);
    tl_status status = TL_OK;
    for (unsigned color = 0; color < 3; color++)
        TRY(tl_cl(
            clEnqueueReadBuffer(c->device->queue, c->buffers->of[name].memory, CL_TRUE,
                                color * plane + at, row * (end - first),
                                tl_image_plane(image, color) + (size_t)first * image->pitch, 0,
                                NULL, NULL),
            "clEnqueueReadBuffer", err));
done:
    return status;
}

tl_status tl_post_bring_back(tl_post_work *work, tl_error *err)
{
    tl_pass_context *c = &work->context;
    const size_t size = 3 * (size_t)work->from->pitch * work->from->rows * sizeof(float);
    const double clock = tl_seconds();
    tl_status status = TL_OK;
    if (!work->is_stale)
        return TL_OK;
    if (c->device->shares_memory)
        TRY(tl_buffers_touch(c->buffers, c->device, TL_BUFFER_POST_FROM, CL_MAP_READ, size,
                             err));
    else
        TRY(fetch_rows(work, TL_BUFFER_POST_FROM, work->from, 0, work->from->height, err));
    TRY(tl_pass_finish(c, err));
    tl_timings_end(work->timings, "readback", clock);
    work->is_stale = 0;
done:
    return status;
}

tl_post_rows_span tl_post_rows_around(const tl_image *image,
                                      uint32_t first,
                                      uint32_t end,
                                      uint32_t halo)
{
    const uint32_t from = first > halo ? (first - halo) / BAND_GRANULE * BAND_GRANULE : 0;
    const uint32_t to = (end + halo + BAND_GRANULE - 1) / BAND_GRANULE * BAND_GRANULE;
    return (tl_post_rows_span){from, (to < image->rows ? to : image->rows) - from};
}

/* Where the rows of the view stand, and those around them that are read. */
static void aim_at(tl_post_work *work, uint32_t first, uint32_t end, uint32_t halo)
{
    const tl_image *image = work->from;
    const tl_post_rows_span around = tl_post_rows_around(image, first, end, halo);
    const int is_whole = work->context.device->shares_memory || end - first == image->height;
    work->view = (tl_view_picture){.width = image->width,
                                   .height = image->height,
                                   .pitch = image->pitch,
                                   .plane_rows = is_whole ? image->rows : around.count,
                                   .plane_row = is_whole ? 0 : around.first,
                                   .first_row = first,
                                   .end_row = end};
}

/* The view's rows of the picture, and room for what is made of them. */
static tl_status upload(tl_post_work *work, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const size_t size = 3 * (size_t)work->view.pitch * work->view.plane_rows * sizeof(float);
    tl_status status = TL_OK;
    if (c->device->shares_memory) {
        if (!work->is_on_device)
            TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_POST_FROM, work->from->planes,
                                 size, err));
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_POST_TO, work->to->planes, size,
                             err));
        goto done;
    }
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_TO, size, err));
    if (work->is_on_device)
        goto done;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_FROM, size, err));
    const uint32_t end = work->view.plane_row + work->view.plane_rows;
    TRY(send_rows(work, work->from, work->view.plane_row,
                  end < work->view.height ? end : work->view.height, err));
done:
    return status;
}

/* Rows that stay as they are, beside others that do not. */
static void copy_rows(const tl_post_work *work)
{
    const tl_image *from = work->from;
    const size_t first = (size_t)work->view.first_row * from->pitch,
                 size = (work->view.end_row - work->view.first_row) * (size_t)from->pitch;
    for (unsigned i = 0; i < 3; i++)
        memcpy(tl_image_plane(work->to, i) + first, tl_image_plane(from, i) + first,
               size * sizeof(float));
}

/* What a band has written, in the host's memory. */
static tl_status read_band(tl_post_work *work, int wrote, tl_error *err)
{
    tl_pass_context *c = &work->context;
    const size_t size = 3 * (size_t)work->from->pitch * work->from->rows * sizeof(float);
    tl_status status = TL_OK;
    if (c->device->shares_memory)
        TRY(tl_buffers_touch(c->buffers, c->device, TL_BUFFER_POST_TO, CL_MAP_READ, size, err));
    else if (wrote)
        TRY(fetch_rows(work, TL_BUFFER_POST_TO, work->to, work->view.first_row,
                       work->view.end_row, err));
    TRY(tl_pass_finish(c, err));
    if (!wrote)
        copy_rows(work);
done:
    return status;
}

/* The rows of the largest band whose memory is within the limit. */
static tl_status rows_of_band(const tl_post_work *work,
                              const tl_stage *stage,
                              uint32_t *rows,
                              tl_error *err)
{
    const tl_image *image = work->from;
    const uint64_t limit = work->post->lighting.memory_limit, halo = stage->halo(work->post);
    const uint64_t pictures =
        work->context.device->shares_memory ? 0 : 6 * (uint64_t)image->pitch * sizeof(float);
    const uint64_t row = pictures + (stage->row_size ? stage->row_size(work) : 0);
    *rows = image->height;
    if (limit == 0 || row == 0 || row * image->height <= limit)
        return TL_OK;
    const uint64_t most = limit / row;
    const uint64_t beside = 2 * halo + 2 * BAND_GRANULE;
    if (most < beside + BAND_GRANULE)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%llu bytes of device memory do not hold the rows that \"%s\" reads at "
                       "once: it takes about %llu; allow more (--memory)",
                       (unsigned long long)limit, tl_post_stage_rows[stage->name].word,
                       (unsigned long long)((beside + BAND_GRANULE) * row));
    *rows = (uint32_t)((most - beside) / BAND_GRANULE * BAND_GRANULE);
    return TL_OK;
}

static tl_status run_band(tl_post_work *work, const tl_stage *stage, int *wrote, tl_error *err)
{
    tl_status status = TL_OK;
    *wrote = 0;
    TRY(upload(work, err));
    TRY(stage->on_device(work, wrote, err));
done:
    if (tl_pass_finish(&work->context, status == TL_OK ? err : NULL) != TL_OK &&
        status == TL_OK)
        status = TL_ERR_DEVICE;
    return status;
}

static void swap_buffers(tl_buffers *buffers)
{
    const tl_buffers before = *buffers;
    buffers->of[TL_BUFFER_POST_FROM] = before.of[TL_BUFFER_POST_TO];
    buffers->of[TL_BUFFER_POST_TO] = before.of[TL_BUFFER_POST_FROM];
}

static tl_status run_whole(tl_post_work *work, const tl_stage *stage, tl_error *err)
{
    int wrote = 0;
    aim_at(work, 0, work->from->height, 0);
    const tl_status status = run_band(work, stage, &wrote, err);
    work->is_on_device = status == TL_OK;
    if (status != TL_OK || !wrote)
        return status;
    swap_buffers(work->context.buffers);
    tl_post_swap(work);
    work->is_stale = 1;
    return TL_OK;
}

static tl_status run_in_bands(tl_post_work *work,
                              const tl_stage *stage,
                              uint32_t rows,
                              tl_error *err)
{
    const uint32_t height = work->from->height, halo = stage->halo(work->post);
    int any = 0;
    tl_status status = TL_OK;
    uint32_t count = 0;
    TRY(tl_post_bring_back(work, err));
    work->is_on_device = 0;
    for (uint32_t first = 0; first < height; first += rows, count++) {
        int wrote = 0;
        aim_at(work, first, height - first > rows ? first + rows : height, halo);
        TRY(run_band(work, stage, &wrote, err));
        TRY(read_band(work, wrote, err));
        any |= wrote;
    }
    if (any)
        tl_post_swap(work);
    if (count > work->counts.band_count)
        work->counts.band_count = count;
done:
    return status;
}

tl_status tl_post_run_on_device(tl_post_work *work, const tl_stage *stage, tl_error *err)
{
    tl_status status = TL_OK;
    uint32_t rows = 0;
    TRY(tl_post_reserve_to(work, err));
    TRY(rows_of_band(work, stage, &rows, err));
    if (work->counts.band_count == 0)
        work->counts.band_count = 1;
    TRY(rows < work->from->height ? run_in_bands(work, stage, rows, err)
                                  : run_whole(work, stage, err));
done:
    return status;
}
