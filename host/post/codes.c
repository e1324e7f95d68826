/* Codes of a screen (kernels/tone.h), on the device. */
#include "show.h"
#include "dither.h"
#include "stage.h"

#include "lighting_state.h"
#include "try.h"

/* As final.cl has it. */
typedef struct view_codes {
    tl_view_picture of;
    tl_view_look look;
} view_codes;

/* Rows [first, end) of the picture, in memory that both share or in a copy of them. */
static tl_status place(tl_post_work *work, view_codes *as, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const tl_image *image = work->from;
    const size_t row = (size_t)image->pitch * sizeof(float);
    const size_t count = as->of.end_row - as->of.first_row;
    const size_t origin[3] = {0, 0, 0}, host_origin[3] = {0, as->of.first_row, 0};
    const size_t region[3] = {row, count, 3};
    tl_status status = TL_OK;
    if (c->device->shares_memory)
        return tl_buffers_share(c->buffers, c->device, TL_BUFFER_POST_FROM, image->planes,
                                3 * row * image->rows, err);
    as->of.plane_row = as->of.first_row;
    as->of.plane_rows = (tl_u32)count;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_FROM, 3 * row * count, err));
    TRY(tl_cl(clEnqueueWriteBufferRect(c->device->queue,
                                       c->buffers->of[TL_BUFFER_POST_FROM].memory, CL_TRUE,
                                       origin, host_origin, region, row, row * count, row,
                                       row * image->rows, image->planes, 0, NULL, NULL),
              "clEnqueueWriteBufferRect", err));
done:
    return status;
}

static tl_status show_band(
    tl_post_work *work, view_codes as, uint8_t *rgb, double *ms, tl_error *err)
{
    tl_pass_context *c = &work->context;
    const size_t rows = as.of.end_row - as.of.first_row, row = 3 * (size_t)as.of.width;
    tl_status status = TL_OK;
    TRY(place(work, &as, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_CODES, rows * row, err));
    TRY(TL_POST_LAUNCH(work, TL_PART_FINAL, show_codes, &as, rows, as.of.pitch, ms, err,
                       TL_BUFFER_POST_FROM, TL_BUFFER_POST_NUMBERS, TL_BUFFER_POST_CODES));
    TRY(tl_cl(clEnqueueReadBuffer(c->device->queue, c->buffers->of[TL_BUFFER_POST_CODES].memory,
                                  CL_TRUE, 0, rows * row, rgb + as.of.first_row * row, 0, NULL,
                                  NULL),
              "clEnqueueReadBuffer", err));
done:
    if (tl_pass_finish(c, status == TL_OK ? err : NULL) != TL_OK && status == TL_OK)
        status = TL_ERR_DEVICE;
    return status;
}

/* Rows of the largest band within the memory limit, one at least. */
static uint32_t rows_of_band(const tl_post_work *work)
{
    const tl_image *image = work->from;
    const uint64_t limit = work->post->lighting.memory_limit;
    const uint64_t copied =
        work->context.device->shares_memory ? 0 : 12 * (uint64_t)image->pitch;
    const uint64_t most = limit / (3 * (uint64_t)image->width + copied);
    if (limit == 0 || most >= image->height)
        return image->height;
    return most > 0 ? (uint32_t)most : 1;
}

static tl_status show_on_device(
    tl_post_work *work, const tl_show *show, uint8_t *rgb, double *ms, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const tl_image *image = work->from;
    const uint32_t rows = rows_of_band(work);
    view_codes as = {.look = show->look};
    tl_status status = TL_OK;
    TRY(tl_post_find_program(work, TL_PART_FINAL, NULL, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_NUMBERS, sizeof show->numbers,
                           err));
    TRY(tl_buffers_write(c->buffers, c->device, TL_BUFFER_POST_NUMBERS, show->numbers,
                         sizeof show->numbers, err));
    for (uint32_t first = 0; first < image->height; first += rows) {
        as.of = (tl_view_picture){.width = image->width,
                                  .height = image->height,
                                  .pitch = image->pitch,
                                  .plane_rows = image->rows,
                                  .first_row = first,
                                  .end_row = image->height - first > rows ? first + rows
                                                                          : image->height};
        TRY(show_band(work, as, rgb, ms, err));
    }
done:
    return status;
}

tl_status tl_post_codes(tl_post *post,
                        const tl_image *image,
                        float exposure,
                        tl_look look,
                        uint8_t *rgb,
                        tl_timings *timings,
                        double *device_ms,
                        tl_error *err)
{
    tl_image same = *image; /* read alone */
    tl_show show;
    double ms = 0.0;
    tl_post_work work = {.post = post,
                         .from = &same,
                         .context = {.device = post->device, .buffers = &post->buffers},
                         .timings = timings};
    tl_status status = TL_OK;
    if (post->lighting.precision != TL_PRECISION_FLOAT || !tl_show_fits(exposure)) {
        tl_image_to_rgb8(image, exposure, look, rgb);
        goto done;
    }
    tl_show_prepare(&show, exposure, look);
    tl_dither_shift(image->x, image->y, show.numbers + TL_SHOW_TILE);
    status = show_on_device(&work, &show, rgb, &ms, err);
    tl_post_let_go(&work);
done:
    if (device_ms)
        *device_ms = ms;
    return status;
}
