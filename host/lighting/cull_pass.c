/* Culling on a device: rectangles, boxes, lists. Two ways that make the same lists: a work-item per
 * row of tiles (cull_rows.cl), a work-group per tile (cull_tiles.cl). */
#include "launch.h"
#include "try.h"

#include <string.h>

static size_t rect_pitch(const tl_pass_context *c)
{
    return TL_RECT_PITCH((size_t)c->frame.light_count);
}

static size_t cell_count(const tl_pass_context *c)
{
    return (size_t)TL_CELLS(c->frame.tiles_x) * TL_CELLS(c->frame.tiles_y);
}

/* Lights from which on those of the path for GPUs are listed by cell first: a tile's group would else
 * look at all of them, though few are near. */
enum { LIGHTS_FOR_CELLS = 4096 };

/* A row of the path for CPUs keeps bits; both paths leave counts. */
static tl_status reserve(const tl_pass_context *c, tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const size_t element = c->precision_is_double ? sizeof(double) : sizeof(float);
    const size_t padded = (size_t)frame->tiles_y * frame->box_pitch;
    const size_t words = c->by_pixel ? 0 : TL_LIGHT_BLOCK / 32;
    const struct {
        tl_buffer_name name;
        size_t size;
    } wanted[] = {
        {TL_BUFFER_BOXES, TL_MAX_BOXES * 6 * element * padded},
        {TL_BUFFER_BITS, words * sizeof(cl_int) * padded},
        {TL_BUFFER_COUNTS, sizeof(cl_int) * padded},
        {TL_BUFFER_RECTS, TL_RECT_PLANE_COUNT * rect_pitch(c) * sizeof(cl_int)},
        {TL_BUFFER_STARTS, tl_tile_count(frame) * sizeof(cl_uint)},
        {TL_BUFFER_ENDS, tl_tile_count(frame) * sizeof(cl_uint)},
        {TL_BUFFER_CELLS, 3 * cell_count(c) * sizeof(cl_uint)},
        {TL_BUFFER_LIST_END, 2 * sizeof(cl_uint)},
        {TL_BUFFER_CELL_LIST, 0},
        {TL_BUFFER_LIST, 0},
    };
    tl_status status = TL_OK;
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++)
        TRY(tl_buffers_reserve(c->buffers, c->device, wanted[i].name, wanted[i].size, err));
done:
    return status;
}

/* Lets the lists start from the first entry. */
static tl_status forget_lists(const tl_pass_context *c, tl_error *err)
{
    static const cl_uint starts[2] = {0, 0};
    return tl_buffers_send(c->buffers, c->device, TL_BUFFER_LIST_END, starts, sizeof starts,
                           err);
}

/* light_rects of a device without double: the same header on the host. */
static tl_status rects_on_host(const tl_pass_context *c, tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const size_t pitch = rect_pitch(c);
    const size_t size = TL_RECT_PLANE_COUNT * pitch * sizeof(cl_int);
    tl_status status = TL_OK;
    void *mapped = NULL;
    TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_RECTS, CL_MAP_WRITE, size, &mapped,
                       err));
    cl_int *rects = memset(mapped, 0, size);
    const int orthographic = (int)c->prepared->needs.orthographic;
    const tl_view_window window =
        view_window(frame, TL_LEAST_DEPTH(orthographic), TL_GREATEST_DEPTH, orthographic);
    for (uint32_t i = frame->global_count; i < frame->light_count; i++) {
        const tl_tile_rect rect =
            tile_rect_of_spot(window, frame, c->prepared->lights[i], c->prepared->spots[i]);
        rects[TL_RECT_X0 * pitch + i] = rect.x0;
        rects[TL_RECT_X1 * pitch + i] = rect.x1;
        rects[TL_RECT_Y0 * pitch + i] = rect.y0;
        rects[TL_RECT_Y1 * pitch + i] = rect.y1;
    }
    TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_RECTS, mapped, err));
    TRY(forget_lists(c, err));
done:
    return status;
}

static tl_status find_rects(tl_pass_context *c, double *ms, tl_error *err)
{
    const size_t pitch = rect_pitch(c);
    const tl_work size =
        c->by_pixel ? (tl_work){pitch, TL_RECT_GRANULE} : tl_alone(pitch / TL_RECT_GRANULE);
    if (!c->programs[TL_PART_CULL]->light_rects)
        return rects_on_host(c, err);
    return TL_LAUNCH_CULL(c, light_rects, size, ms, err, TL_BUFFER_LIGHTS, TL_BUFFER_RECTS,
                          TL_BUFFER_LIST_END);
}

static cl_uint capacity_of(const tl_pass_context *c, tl_buffer_name name)
{
    const size_t capacity = c->buffers->of[name].size / sizeof(cl_uint);
    return capacity < UINT32_MAX ? (cl_uint)capacity : UINT32_MAX;
}

static tl_status list_by_row(tl_pass_context *c, double *ms, tl_error *err)
{
    return TL_LAUNCH_CULL(c, cull_rows, tl_alone(c->frame.tiles_y), ms, err, TL_BUFFER_PLANES,
                          TL_BUFFER_LIGHTS, TL_BUFFER_RECTS, TL_BUFFER_BOXES, TL_BUFFER_COUNTS,
                          TL_BUFFER_BITS, TL_BUFFER_STARTS, TL_BUFFER_ENDS, TL_BUFFER_LIST_END,
                          TL_BUFFER_LIST);
}

static tl_status list_by_tile(tl_pass_context *c, double *ms, tl_error *err)
{
    const tl_work tiles = tl_groups(tl_tile_count(&c->frame));
    tl_status status = TL_OK;
    if (c->frame.box_count > 0)
        TRY(TL_LAUNCH_CULL(c, bound_tiles, tiles, ms, err, TL_BUFFER_PLANES, TL_BUFFER_BOXES));
    if (c->frame.has_cells)
        TRY(TL_LAUNCH_CULL(c, list_cells, tl_groups(cell_count(c)), ms, err, TL_BUFFER_RECTS,
                           TL_BUFFER_CELLS, TL_BUFFER_LIST_END, TL_BUFFER_CELL_LIST));
    TRY(TL_LAUNCH_CULL(c, list_tiles, tiles, ms, err, TL_BUFFER_LIGHTS, TL_BUFFER_RECTS,
                       TL_BUFFER_BOXES, TL_BUFFER_CELLS, TL_BUFFER_CELL_LIST, TL_BUFFER_COUNTS,
                       TL_BUFFER_STARTS, TL_BUFFER_ENDS, TL_BUFFER_LIST_END, TL_BUFFER_LIST));
done:
    return status;
}

/* Lists into as much of the list buffers as there is. */
static tl_status list_lights(tl_pass_context *c, double *ms, tl_error *err)
{
    c->frame.list_capacity = capacity_of(c, TL_BUFFER_LIST);
    c->frame.cell_capacity = capacity_of(c, TL_BUFFER_CELL_LIST);
    return c->by_pixel ? list_by_tile(c, ms, err) : list_by_row(c, ms, err);
}

/* The sum of `rows` rows of `columns` counts, `pitch` apart, from number `first` on. */
static tl_status sum_counts(const tl_pass_context *c,
                            tl_buffer_name name,
                            size_t first,
                            size_t rows,
                            size_t columns,
                            size_t pitch,
                            uint64_t *sum,
                            tl_error *err)
{
    const size_t size = (first + rows * pitch) * sizeof(cl_uint);
    void *mapped = NULL;
    tl_status status = TL_OK;
    *sum = 0;
    TRY(tl_buffers_map(c->buffers, c->device, name, CL_MAP_READ, size, &mapped, err));
    const cl_uint *counts = (const cl_uint *)mapped + first;
    for (size_t row = 0; row < rows; row++)
        for (size_t column = 0; column < columns; column++)
            *sum += counts[row * pitch + column];
    TRY(tl_buffers_unmap(c->buffers, c->device, name, mapped, err));
done:
    return status;
}

/* How long the lists turned out, written or not; *cells_length is 0 where there are none of cells.
 * Where those did not fit, *tiles_length is not known and 0. */
static tl_status measure_lists(const tl_pass_context *c,
                               tl_list_lengths *lengths,
                               tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const size_t cells = cell_count(c);
    tl_status status = TL_OK;
    *lengths = (tl_list_lengths){0, 0};
    if (frame->has_cells)
        TRY(sum_counts(c, TL_BUFFER_CELLS, 2 * cells, 1, cells, cells, &lengths->cells, err));
    if (lengths->cells <= frame->cell_capacity)
        TRY(sum_counts(c, TL_BUFFER_COUNTS, 0, frame->tiles_y, frame->tiles_x, frame->box_pitch,
                       &lengths->tiles, err));
done:
    return status;
}

tl_status tl_pass_cull(tl_pass_context *c, tl_list_lengths *lengths, double *ms, tl_error *err)
{
    const cl_uint ranged_count = c->frame.light_count - c->frame.global_count;
    tl_status status = TL_OK;
    c->frame.has_cells = c->by_pixel && ranged_count >= LIGHTS_FOR_CELLS;
    TRY(reserve(c, err));
    TRY(find_rects(c, ms, err));
    TRY(list_lights(c, ms, err));
    TRY(measure_lists(c, lengths, err));
done:
    return status;
}

int tl_lists_fit(const tl_pass_context *c, const tl_list_lengths *lengths)
{
    return lengths->tiles <= c->frame.list_capacity && lengths->cells <= c->frame.cell_capacity;
}

tl_status tl_pass_cull_again(tl_pass_context *c,
                             tl_list_lengths *lengths,
                             double *ms,
                             tl_error *err)
{
    tl_status status = TL_OK;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_LIST,
                           (size_t)lengths->tiles * sizeof(cl_uint), err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_CELL_LIST,
                           (size_t)lengths->cells * sizeof(cl_uint), err));
    TRY(forget_lists(c, err));
    TRY(list_lights(c, ms, err));
    TRY(measure_lists(c, lengths, err));
done:
    return status;
}
