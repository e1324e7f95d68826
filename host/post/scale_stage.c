/* A picture of another size (kernels/scale.h), in bands of the new one's rows where the memory limit asks for
 * them. */
#include "filters.h"
#include "scale_rows.h"
#include "stage.h"

#include "lighting_state.h"
#include "parallel.h"
#include "try.h"
#include "twins.h"

#include <stdlib.h>
#include <string.h>

/* Both axes, and their tables behind one another. */
typedef struct scaling {
    tl_taps rows, columns;
    float *tables;
    size_t table_count; /* numbers */
} scaling;

static int is_on(const tl_post *post, const tl_gbuffer *gbuffer)
{
    const uint32_t side = tl_samples_side(gbuffer->samples);
    const tl_post_options *o = &post->options;
    return o->width > 0 && (o->width != gbuffer->camera.width / side ||
                            o->height != gbuffer->camera.height / side);
}

static tl_status make_tables(const tl_post_work *work, scaling *s, tl_error *err)
{
    const tl_post_options *o = &work->post->options;
    tl_status status = TL_OK;
    TRY(tl_taps_make(o->filter, work->from->height, o->height, &s->rows, err));
    TRY(tl_taps_make(o->filter, work->from->width, o->width, &s->columns, err));
    const size_t row_size = tl_taps_size(&s->rows), column_size = tl_taps_size(&s->columns);
    s->table_count = row_size + column_size;
    s->tables = malloc(s->table_count * sizeof *s->tables);
    if (!s->tables)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the weights of a filter"));
    memcpy(s->tables, s->rows.numbers, row_size * sizeof(float));
    memcpy(s->tables + row_size, s->columns.numbers, column_size * sizeof(float));
done:
    return status;
}

static void clear_tables(scaling *s)
{
    free(s->tables);
    tl_taps_clear(&s->columns);
    tl_taps_clear(&s->rows);
}

/* Rows [first, end) of the new picture, of planes that hold both pictures whole. */
static tl_view_scale view_of(const tl_post_work *work,
                             const scaling *s,
                             uint32_t first,
                             uint32_t end)
{
    const tl_image *from = work->from, *to = work->to;
    return (tl_view_scale){.from_width = from->width,
                           .from_pitch = from->pitch,
                           .from_rows = from->rows,
                           .width = to->width,
                           .pitch = to->pitch,
                           .rows = to->rows,
                           .first_row = first,
                           .end_row = end,
                           .row_taps = s->rows.taps,
                           .column_taps = s->columns.taps,
                           .row_count = s->rows.padded,
                           .column_count = s->columns.padded,
                           .column_table = (tl_u32)tl_taps_size(&s->rows)};
}

TL_DECLARE_TWIN(tl_scale_rows_twin, tl_scale_float);
TL_DECLARE_TWIN(tl_scale_rows_twin, tl_scale_double);

static tl_scale_rows_twin *twin_for(tl_precision precision)
{
    return precision == TL_PRECISION_REFERENCE ? TL_TWIN_OF(tl_scale_double)
                                               : TL_TWIN_OF(tl_scale_float);
}

static tl_status run_on_host(tl_post_work *work, const scaling *s, tl_error *err)
{
    tl_scale_job job = {.of = view_of(work, s, 0, work->to->height),
                        .tables = s->tables,
                        .from = work->from->planes,
                        .to = work->to->planes};
    job.between = malloc((size_t)work->to->height * work->from->pitch * sizeof(float));
    if (!job.between)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels",
                       work->from->width, work->to->height);
    for (job.color = 0; job.color < 3; job.color++)
        tl_parallel(work->to->height, 1, twin_for(work->post->lighting.precision), &job);
    free(job.between);
    return TL_OK;
}

/* Rows of the old picture that a band of the new one reads. */
typedef struct row_range {
    uint32_t first, end;
} row_range;

static row_range rows_read(const scaling *s, uint32_t first, uint32_t end)
{
    return (row_range){tl_taps_first(&s->rows, first),
                       tl_taps_first(&s->rows, end - 1) + s->rows.taps};
}

/* Bytes of the device's own memory that a band takes. */
static uint64_t band_size(const tl_post_work *work, const scaling *s, uint32_t rows)
{
    const double read = (double)work->from->height / work->to->height * rows + s->rows.taps + 1;
    uint64_t size = 3 * (uint64_t)rows * work->from->pitch;
    if (!work->context.device->shares_memory)
        size += 3 * (uint64_t)rows * work->to->pitch + 3 * (uint64_t)read * work->from->pitch;
    return size * sizeof(float) + s->table_count * sizeof(float);
}

static tl_status rows_of_band(const tl_post_work *work,
                              const scaling *s,
                              uint32_t *rows,
                              tl_error *err)
{
    const uint64_t limit = work->post->lighting.memory_limit;
    *rows = work->to->height;
    while (limit > 0 && *rows > 1 && band_size(work, s, *rows) > limit)
        *rows = (*rows + 1) / 2;
    if (limit == 0 || band_size(work, s, *rows) <= limit)
        return TL_OK;
    return tl_fail(err, TL_ERR_ARGUMENT,
                   "%llu bytes of device memory do not hold the rows that \"scale\" reads at "
                   "once: it takes about %llu; allow more (--memory)",
                   (unsigned long long)limit, (unsigned long long)band_size(work, s, 1));
}

/* Rows between a picture and a buffer that holds them alone. */
static tl_status copy_rows(const tl_post_work *work,
                           tl_buffer_name name,
                           const tl_image *image,
                           row_range rows,
                           int to_host,
                           tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const size_t row = (size_t)image->pitch * sizeof(float), count = rows.end - rows.first;
    const size_t origin[3] = {0, 0, 0}, host_origin[3] = {0, rows.first, 0};
    const size_t region[3] = {row, count, 3};
    const cl_mem memory = c->buffers->of[name].memory;
    if (to_host)
        return tl_cl(clEnqueueReadBufferRect(c->device->queue, memory, CL_TRUE, origin,
                                             host_origin, region, row, row * count, row,
                                             row * image->rows, image->planes, 0, NULL, NULL),
                     "clEnqueueReadBufferRect", err);
    return tl_cl(clEnqueueWriteBufferRect(c->device->queue, memory, CL_TRUE, origin,
                                          host_origin, region, row, row * count, row,
                                          row * image->rows, image->planes, 0, NULL, NULL),
                 "clEnqueueWriteBufferRect", err);
}

/* Both pictures, or the rows of them that a band is of. */
static tl_status place(tl_post_work *work, row_range read, tl_view_scale *of, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const tl_image *from = work->from, *to = work->to;
    const size_t from_plane = (size_t)from->pitch * sizeof(float),
                 to_plane = (size_t)to->pitch * sizeof(float);
    tl_status status = TL_OK;
    if (c->device->shares_memory) {
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_POST_FROM, from->planes,
                             3 * from_plane * from->rows, err));
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_POST_TO, to->planes,
                             3 * to_plane * to->rows, err));
        goto done;
    }
    of->from_row = read.first;
    of->from_rows = read.end - read.first;
    of->plane_row = of->first_row;
    of->rows = of->end_row - of->first_row;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_FROM,
                           3 * from_plane * of->from_rows, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_TO, 3 * to_plane * of->rows,
                           err));
    TRY(copy_rows(work, TL_BUFFER_POST_FROM, from, read, 0, err));
done:
    return status;
}

static tl_status run_band(
    tl_post_work *work, const scaling *s, uint32_t first, uint32_t end, tl_error *err)
{
    tl_pass_context *c = &work->context;
    const size_t rows = 3 * (size_t)(end - first);
    double *const ms = &work->counts.device_ms[TL_POST_SCALE];
    tl_view_scale of = view_of(work, s, first, end);
    tl_status status = TL_OK;
    TRY(place(work, rows_read(s, first, end), &of, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_BETWEEN,
                           rows * of.from_pitch * sizeof(float), err));
    TRY(TL_POST_LAUNCH(work, TL_PART_FINAL, scale_columns, &of, rows, of.from_pitch, ms, err,
                       TL_BUFFER_POST_FROM, TL_BUFFER_POST_NUMBERS, TL_BUFFER_POST_BETWEEN));
    TRY(TL_POST_LAUNCH(work, TL_PART_FINAL, scale_rows, &of, rows, of.pitch, ms, err,
                       TL_BUFFER_POST_BETWEEN, TL_BUFFER_POST_NUMBERS, TL_BUFFER_POST_TO));
    if (c->device->shares_memory)
        TRY(tl_buffers_touch(c->buffers, c->device, TL_BUFFER_POST_TO, CL_MAP_READ,
                             3 * (size_t)of.pitch * of.rows * sizeof(float), err));
    else
        TRY(copy_rows(work, TL_BUFFER_POST_TO, work->to, (row_range){first, end}, 1, err));
done:
    if (tl_pass_finish(c, status == TL_OK ? err : NULL) != TL_OK && status == TL_OK)
        status = TL_ERR_DEVICE;
    return status;
}

static tl_status run_on_device(tl_post_work *work, const scaling *s, tl_error *err)
{
    const tl_pass_context *c = &work->context;
    const uint32_t height = work->to->height;
    uint32_t rows = 0, count = 0;
    tl_status status = TL_OK;
    TRY(rows_of_band(work, s, &rows, err));
    TRY(tl_post_find_program(work, TL_PART_FINAL, NULL, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_POST_NUMBERS,
                           s->table_count * sizeof(float), err));
    TRY(tl_buffers_write(c->buffers, c->device, TL_BUFFER_POST_NUMBERS, s->tables,
                         s->table_count * sizeof(float), err));
    for (uint32_t first = 0; first < height; first += rows, count++)
        TRY(run_band(work, s, first, height - first > rows ? first + rows : height, err));
    if (count > work->counts.band_count)
        work->counts.band_count = count;
done:
    return status;
}

static tl_status on_host(tl_post_work *work, int *wrote, tl_error *err)
{
    const tl_post_options *o = &work->post->options;
    scaling s = {.tables = NULL};
    tl_status status = TL_OK;
    tl_image_destroy(work->to);
    work->to = NULL;
    TRY(tl_image_create(o->width, o->height, &work->to, err));
    TRY(make_tables(work, &s, err));
    if (tl_precision_is_on_host(work->post->lighting.precision))
        TRY(run_on_host(work, &s, err));
    else
        TRY(run_on_device(work, &s, err));
    *wrote = 1;
done:
    clear_tables(&s);
    return status;
}

/* The host's among the stages, for its pictures differ in size; it takes the device itself. */
const tl_stage tl_stage_scale = {
    .name = TL_POST_SCALE,
    .is_on = is_on,
    .on_host = on_host,
};
