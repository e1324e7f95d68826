#include "passes.h"

#include "launch.h"
#include "occlusion.h"
#include "try.h"
#include "user_kernel.h"

size_t tl_tile_count(const tl_frame *frame)
{
    return (size_t)frame->tiles_x * frame->tiles_y;
}

tl_status tl_pass_list_all(tl_pass_context *c, uint64_t *list_length, tl_error *err)
{
    const tl_frame *frame = &c->frame;
    const cl_uint ranged_count = frame->light_count - frame->global_count;
    const size_t tiles_size = tl_tile_count(&c->frame) * sizeof(cl_uint);
    void *mapped = NULL;
    tl_status status = TL_OK;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_STARTS, tiles_size, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_ENDS, tiles_size, err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_LIST,
                           ranged_count * sizeof(cl_uint), err));
    TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_STARTS, CL_MAP_WRITE, tiles_size,
                       &mapped, err));
    for (size_t tile = 0; tile < tl_tile_count(&c->frame); tile++)
        ((cl_uint *)mapped)[tile] = 0;
    TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_STARTS, mapped, err));
    TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_ENDS, CL_MAP_WRITE, tiles_size, &mapped,
                       err));
    for (size_t tile = 0; tile < tl_tile_count(&c->frame); tile++)
        ((cl_uint *)mapped)[tile] = ranged_count;
    TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_ENDS, mapped, err));
    if (ranged_count > 0) {
        TRY(tl_buffers_map(c->buffers, c->device, TL_BUFFER_LIST, CL_MAP_WRITE,
                           ranged_count * sizeof(cl_uint), &mapped, err));
        for (cl_uint i = 0; i < ranged_count; i++)
            ((cl_uint *)mapped)[i] = frame->global_count + i;
        TRY(tl_buffers_unmap(c->buffers, c->device, TL_BUFFER_LIST, mapped, err));
    }
    *list_length = (uint64_t)ranged_count * tl_tile_count(&c->frame);
done:
    return status;
}

tl_status tl_pass_occlude(tl_pass_context *c, double *ms, tl_error *err)
{
    static const tl_buffer_name from_planes[] = {TL_BUFFER_PLANES, TL_BUFFER_LIGHTS},
                                numbers[] = {TL_BUFFER_LIGHTS};
    const tl_program *program = c->programs[TL_PART_OCCLUDE];
    const size_t pixels = (size_t)around_width(&c->frame) * around_height(&c->frame);
    const tl_work size = c->by_pixel ? tl_groups(pixels / TL_GROUP)
                                     : tl_alone(pixels / (TL_PATCH_COLUMNS * TL_PATCH_ROWS));
    tl_status status = TL_OK;
    TRY(tl_launch(c, TL_PART_OCCLUDE, program->gather_surroundings, "gather_surroundings",
                  from_planes, 2, size, ms, err));
    TRY(tl_launch(c, TL_PART_OCCLUDE, program->occlude, "occlude", numbers, 1, size, ms, err));
    TRY(tl_launch(c, TL_PART_OCCLUDE, program->smooth_surroundings, "smooth_surroundings",
                  numbers, 1, size, ms, err));
done:
    return status;
}

/* A user's kernel, which stands in for shade_tiles, says itself what its work-items are. */
tl_status tl_pass_shade(tl_pass_context *c, double *ms, tl_error *err)
{
    const tl_program *program = c->programs[TL_PART_SHADE];
    const tl_buffer_name arguments[] = {
        TL_BUFFER_PLANES, TL_BUFFER_LIGHTS,
        TL_BUFFER_STARTS, c->ignores_lists ? TL_BUFFER_STARTS : TL_BUFFER_ENDS,
        TL_BUFFER_LIST,   TL_BUFFER_RADIANCE,
        TL_BUFFER_TIMES};
    const cl_uint all = sizeof arguments / sizeof arguments[0];
    const cl_uint count = program->options.timed ? all : all - 1;
    const size_t tiles = tl_tile_count(&c->frame),
                 pixels = (size_t)c->frame.tile_size * c->frame.tile_size;
    if (c->by_pixel && !program->user.text)
        return tl_launch(c, TL_PART_SHADE, program->shade_pixels, "shade_pixels", arguments,
                         count, tl_groups(tiles * pixels / TL_GROUP), ms, err);
    const int items_are_pixels = program->user.text && program->user.items == TL_ITEMS_PIXEL;
    const tl_work size = items_are_pixels ? (tl_work){tiles * pixels, pixels} : tl_alone(tiles);
    if (program->user.text) {
        const tl_status status = tl_user_kernel_check_group(c->device, program->shade_tiles,
                                                            &program->user, size.group, err);
        if (status != TL_OK)
            return status;
    }
    return tl_launch(c, TL_PART_SHADE, program->shade_tiles, "shade_tiles", arguments, count,
                     size, ms, err);
}

/* A group is a part of a row in every width: rows are padded to 64 pixels, bands to 8 rows. */
tl_status tl_pass_blend(tl_pass_context *c, double *ms, tl_error *err)
{
    enum { ITEMS_OF_GROUP = 32 };
    static const tl_buffer_name arguments[] = {TL_BUFFER_OPACITY, TL_BUFFER_RADIANCE,
                                               TL_BUFFER_BEHIND};
    const tl_program *program = c->programs[TL_PART_BLEND];
    const size_t rows = (size_t)c->frame.tiles_y * c->frame.tile_size;
    const size_t items = rows * c->frame.pitch / program->options.width;
    return tl_launch(c, TL_PART_BLEND, program->blend_layer, "blend_layer", arguments,
                     sizeof arguments / sizeof arguments[0], (tl_work){items, ITEMS_OF_GROUP},
                     ms, err);
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
