/* An opened OpenCL device: one context, one in-order profiling queue, the programs built so far. For
 * one thread at a time. */
#ifndef TL_DEVICE_H
#define TL_DEVICE_H

#include "tilelight/lighting.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

struct tl_device {
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    tl_device_info info;
    struct tl_programs *programs; /* kernel_program.h; NULL until the first */
    int shares_memory;            /* 1: buffers over host memory need no copy */
    int rounds_divide;            /* 1: -cl-fp32-correctly-rounded-divide-sqrt is accepted */
};

/* What OpenCL says of a device; is_default is left 0. */
tl_device_info tl_device_ask(cl_platform_id platform, cl_device_id id);

/* Every device of every platform, in OpenCL's order, the default one marked. The caller frees
 * *ids and *infos, [*count]. Fails with TL_ERR_MEMORY. */
tl_status tl_device_find_all(cl_device_id **ids,
                             tl_device_info **infos,
                             size_t *count,
                             tl_error *err);

/* TL_OK for CL_SUCCESS; otherwise TL_ERR_DEVICE or TL_ERR_DEVICE_MEMORY, naming the call and the code. */
tl_status tl_cl(cl_int code, const char *call, tl_error *err);

#endif
