#include "passes.h"

#include "try.h"
#include "user_kernel.h"

#include <assert.h>
#include <stdlib.h>

typedef struct work {
    size_t items, group; /* work-items in all, and per work-group */
} work;

static void note_launch(tl_pass_context *c, cl_event event, double *ms)
{
    assert(c->launch_count < TL_MAX_LAUNCHES);
    c->launches[c->launch_count].event = event;
    c->launches[c->launch_count++].ms = ms;
}

/* The frame comes first, then the buffers. */
static tl_status launch(tl_pass_context *c,
                        cl_kernel kernel,
                        const char *name,
                        const tl_buffer_name *buffers,
                        cl_uint buffer_count,
                        work size,
                        double *ms,
                        tl_error *err)
{
    cl_event event;
    cl_int code = clSetKernelArg(kernel, 0, sizeof c->frame, &c->frame);
    for (cl_uint i = 0; code == CL_SUCCESS && i < buffer_count; i++)
        code =
            clSetKernelArg(kernel, i + 1, sizeof(cl_mem), &c->buffers->of[buffers[i]].memory);
    if (code == CL_SUCCESS)
        code = clEnqueueNDRangeKernel(c->device->queue, kernel, 1, NULL, &size.items,
                                      &size.group, 0, NULL, &event);
    if (code != CL_SUCCESS)
        return tl_cl(code, name, err);
    tl_program_note_launch(c->program, kernel, size.items, size.group);
    note_launch(c, event, ms);
    return TL_OK;
}

#define LAUNCH(context, name, size, ms, err, ...)                                     \
    launch(context, (context)->program->name, #name, (tl_buffer_name[]){__VA_ARGS__}, \
           sizeof((tl_buffer_name[]){__VA_ARGS__}) / sizeof(tl_buffer_name), size, ms, err)

/* In work-groups of one: our kernels share nothing within a group. */
static work alone(size_t items)
{
    return (work){items, 1};
}

static size_t tile_count(const tl_pass_context *c)
{
    return (size_t)c->frame.tiles_x * c->frame.tiles_y;
}

static size_t rect_pitch(const tl_pass_context *c)
{
    return TL_RECT_PITCH((size_t)c->frame.light_count);
}

static tl_status reserve_tiles(const tl_pass_context *c, tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const size_t element = c->precision_is_double ? sizeof(double) : sizeof(float);
    const size_t padded = (size_t)frame->tiles_y * frame->box_pitch;
    const struct {
        tl_buffer_name name;
        size_t size;
    } wanted[] = {
        {TL_BUFFER_BOXES, TL_MAX_BOXES * 6 * element * padded},
        {TL_BUFFER_COUNTS, sizeof(cl_int) * padded},
        {TL_BUFFER_BITS, TL_LIGHT_BLOCK / 32 * sizeof(cl_int) * padded},
        {TL_BUFFER_RECTS, TL_RECT_PLANE_COUNT * rect_pitch(c) * sizeof(cl_int)},
        {TL_BUFFER_STARTS, tile_count(c) * sizeof(cl_uint)},
        {TL_BUFFER_ENDS, tile_count(c) * sizeof(cl_uint)},
        {TL_BUFFER_LENGTHS, frame->tiles_y * sizeof(cl_ulong)},
        {TL_BUFFER_LIST_END, sizeof(cl_uint)},
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
    static const cl_uint start = 0;
    return tl_buffers_send(c->buffers, c->device, TL_BUFFER_LIST_END, &start, sizeof start,
                           err);
}

/* light_rects of a device without double: the same header on the host. */
static tl_status rects_on_host(const tl_pass_context *c, tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const size_t pitch = rect_pitch(c);
    tl_status status = TL_OK;
    cl_int *rects = calloc(TL_RECT_PLANE_COUNT * pitch, sizeof *rects);
    if (!rects)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the rectangles of lights"));
    const int orthographic = (int)c->prepared->needs.orthographic;
    const tl_view_window window =
        view_window(frame, TL_LEAST_DEPTH(orthographic), TL_GREATEST_DEPTH, orthographic);
    for (uint32_t i = frame->global_count; i < frame->light_count; i++) {
        const tl_tile_rect rect = tile_rect_of(window, frame, c->prepared->lights[i]);
        rects[TL_RECT_X0 * pitch + i] = rect.x0;
        rects[TL_RECT_X1 * pitch + i] = rect.x1;
        rects[TL_RECT_Y0 * pitch + i] = rect.y0;
        rects[TL_RECT_Y1 * pitch + i] = rect.y1;
    }
    TRY(tl_buffers_write(c->buffers, c->device, TL_BUFFER_RECTS, rects,
                         TL_RECT_PLANE_COUNT * pitch * sizeof *rects, err));
    TRY(forget_lists(c, err));
done:
    free(rects);
    return status;
}

static tl_status find_rects(tl_pass_context *c, double *ms, tl_error *err)
{
    if (!c->program->light_rects)
        return rects_on_host(c, err);
    return LAUNCH(c, light_rects, alone(rect_pitch(c) / TL_RECT_GRANULE), ms, err,
                  TL_BUFFER_LIGHTS, TL_BUFFER_RECTS, TL_BUFFER_LIST_END);
}

/* Lists into as much of TL_BUFFER_LIST as there is. */
static tl_status cull_rows(tl_pass_context *c, double *ms, tl_error *err)
{
    const size_t capacity = c->buffers->of[TL_BUFFER_LIST].size / sizeof(cl_uint);
    c->frame.list_capacity = capacity < UINT32_MAX ? (cl_uint)capacity : UINT32_MAX;
    return LAUNCH(c, cull_rows, alone(c->frame.tiles_y), ms, err, TL_BUFFER_PLANES,
                  TL_BUFFER_LIGHTS, TL_BUFFER_RECTS, TL_BUFFER_BOXES, TL_BUFFER_COUNTS,
                  TL_BUFFER_BITS, TL_BUFFER_STARTS, TL_BUFFER_ENDS, TL_BUFFER_LENGTHS,
                  TL_BUFFER_LIST_END, TL_BUFFER_LIST);
}

static tl_status sum_lengths(const tl_pass_context *c, uint64_t *list_length, tl_error *err)
{
    const size_t size = c->frame.tiles_y * sizeof(cl_ulong);
    void *mapped = NULL;
    uint64_t sum = 0;
    tl_status status = TL_OK;
    TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_LENGTHS, CL_MAP_READ, size, &mapped,
                       err));
    for (uint32_t row = 0; row < c->frame.tiles_y; row++)
        sum += ((const cl_ulong *)mapped)[row];
    TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_LENGTHS, mapped, err));
    *list_length = sum;
done:
    return status;
}

tl_status tl_pass_cull(tl_pass_context *c, uint64_t *list_length, double *ms, tl_error *err)
{
    tl_status status = TL_OK;
    TRY(reserve_tiles(c, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_LIST, 0, err));
    TRY(find_rects(c, ms, err));
    TRY(cull_rows(c, ms, err));
    TRY(sum_lengths(c, list_length, err));
done:
    return status;
}

tl_status tl_pass_cull_again(tl_pass_context *c,
                             uint64_t list_length,
                             double *ms,
                             tl_error *err)
{
    tl_status status = TL_OK;
    if (list_length <= c->frame.list_capacity)
        goto done;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_LIST,
                           (size_t)list_length * sizeof(cl_uint), err));
    TRY(forget_lists(c, err));
    TRY(cull_rows(c, ms, err));
done:
    return status;
}

tl_status tl_pass_list_all(tl_pass_context *c, uint64_t *list_length, tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const cl_uint ranged_count = frame->light_count - frame->global_count;
    const size_t tiles_size = tile_count(c) * sizeof(cl_uint);
    void *mapped = NULL;
    tl_status status = TL_OK;
    TRY(reserve_tiles(c, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_LIST,
                           ranged_count * sizeof(cl_uint), err));
    TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_STARTS, CL_MAP_WRITE, tiles_size,
                       &mapped, err));
    for (size_t tile = 0; tile < tile_count(c); tile++)
        ((cl_uint *)mapped)[tile] = 0;
    TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_STARTS, mapped, err));
    TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_ENDS, CL_MAP_WRITE, tiles_size, &mapped,
                       err));
    for (size_t tile = 0; tile < tile_count(c); tile++)
        ((cl_uint *)mapped)[tile] = ranged_count;
    TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_ENDS, mapped, err));
    if (ranged_count > 0) {
        TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_LIST, CL_MAP_WRITE,
                           ranged_count * sizeof(cl_uint), &mapped, err));
        for (cl_uint i = 0; i < ranged_count; i++)
            ((cl_uint *)mapped)[i] = frame->global_count + i;
        TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_LIST, mapped, err));
    }
    *list_length = (uint64_t)ranged_count * tile_count(c);
done:
    return status;
}

tl_status tl_pass_shade(tl_pass_context *c, double *ms, tl_error *err)
{
    const size_t tiles = tile_count(c),
                 pixels = (size_t)c->frame.tile_size * c->frame.tile_size;
    const int by_pixel = c->program->user.text && c->program->user.items == TL_ITEMS_PIXEL;
    const work size = by_pixel ? (work){tiles * pixels, pixels} : alone(tiles);
    if (c->program->user.text) {
        const tl_status status = tl_user_kernel_check_group(c->device, c->program->shade_tiles,
                                                            &c->program->user, size.group, err);
        if (status != TL_OK)
            return status;
    }
    return LAUNCH(c, shade_tiles, size, ms, err, TL_BUFFER_PLANES, TL_BUFFER_LIGHTS,
                  TL_BUFFER_STARTS, TL_BUFFER_ENDS, TL_BUFFER_LIST, TL_BUFFER_RADIANCE);
}

tl_status tl_pass_finish(tl_pass_context *c, tl_error *err)
{
    const tl_status status = tl_cl(clFinish(c->device->queue), "clFinish", err);
    const double now = tl_seconds();
    cl_ulong first = CL_ULONG_MAX, last = 0;
    for (int i = 0; i < c->launch_count; i++) {
        cl_ulong start = 0, end = 0;
        const cl_event event = c->launches[i].event;
        if (clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start,
                                    NULL) == CL_SUCCESS &&
            clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL) ==
                CL_SUCCESS) {
            *c->launches[i].ms += 1e-6 * (double)(end - start);
            first = start < first ? start : first;
            last = end > last ? end : last;
        }
        clReleaseEvent(event);
    }
    /* The device's clock is its own; but its last launch ended just now. */
    if (c->first_start_s == 0.0 && last > 0)
        c->first_start_s = now - 1e-9 * (double)(last - first);
    c->launch_count = 0;
    return status;
}
