#include "launch.h"

#include <assert.h>

static void note_launch(tl_pass_context *c, cl_event event, double *ms)
{
    assert(c->launch_count < TL_MAX_LAUNCHES);
    c->launches[c->launch_count].event = event;
    c->launches[c->launch_count++].ms = ms;
}

tl_status tl_launch(tl_pass_context *c,
                    tl_program_part part,
                    cl_kernel kernel,
                    const char *name,
                    const tl_buffer_name *buffers,
                    cl_uint buffer_count,
                    tl_work size,
                    double *ms,
                    tl_error *err)
{
    return tl_launch_with(c, part, kernel, name, &c->frame, sizeof c->frame, buffers,
                          buffer_count, size, ms, err);
}

tl_status tl_launch_with(tl_pass_context *c,
                         tl_program_part part,
                         cl_kernel kernel,
                         const char *name,
                         const void *first,
                         size_t first_size,
                         const tl_buffer_name *buffers,
                         cl_uint buffer_count,
                         tl_work size,
                         double *ms,
                         tl_error *err)
{
    cl_event event;
    cl_int code = clSetKernelArg(kernel, 0, first_size, first);
    for (cl_uint i = 0; code == CL_SUCCESS && i < buffer_count; i++)
        code =
            clSetKernelArg(kernel, i + 1, sizeof(cl_mem), &c->buffers->of[buffers[i]].memory);
    if (code == CL_SUCCESS)
        code = clEnqueueNDRangeKernel(c->device->queue, kernel, 1, NULL, &size.items,
                                      &size.group, 0, NULL, &event);
    if (code != CL_SUCCESS)
        return tl_cl(code, name, err);
    tl_program_note_launch(c->programs[part], kernel, size.items, size.group);
    note_launch(c, event, ms);
    return TL_OK;
}

tl_work tl_alone(size_t items)
{
    return (tl_work){items, 1};
}

tl_work tl_groups(size_t groups)
{
    return (tl_work){groups * TL_GROUP, TL_GROUP};
}
