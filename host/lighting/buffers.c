#include "buffers.h"

static void release(tl_buffers *buffers, tl_buffer_name name)
{
    if (buffers->of[name].memory)
        clReleaseMemObject(buffers->of[name].memory);
    buffers->of[name].memory = NULL;
    buffers->of[name].size = 0;
    buffers->of[name].host = NULL;
}

static tl_status make(tl_buffers *buffers,
                      const tl_device *device,
                      tl_buffer_name name,
                      cl_mem_flags flags,
                      void *host,
                      size_t size,
                      tl_error *err)
{
    cl_int code;
    release(buffers, name);
    buffers->of[name].memory = clCreateBuffer(device->context, flags, size, host, &code);
    if (code != CL_SUCCESS)
        return tl_cl(code, "clCreateBuffer", err);
    buffers->of[name].size = size;
    buffers->of[name].host = host;
    return TL_OK;
}

tl_status tl_buffers_reserve(tl_buffers *buffers,
                             const tl_device *device,
                             tl_buffer_name name,
                             size_t size,
                             tl_error *err)
{
    if (buffers->of[name].memory && size <= buffers->of[name].size)
        return TL_OK;
    size = size > sizeof(cl_uint) ? size : sizeof(cl_uint);
    return make(buffers, device, name, CL_MEM_READ_WRITE, NULL, size, err);
}

tl_status tl_buffers_touch(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           cl_map_flags flags,
                           size_t size,
                           tl_error *err)
{
    cl_int code;
    void *const mapped = clEnqueueMapBuffer(device->queue, buffers->of[name].memory, CL_FALSE,
                                            flags, 0, size, 0, NULL, NULL, &code);
    const tl_status status = tl_cl(code, "clEnqueueMapBuffer", err);
    if (status != TL_OK)
        return status;
    return tl_buffers_unmap(buffers, device, name, mapped, err);
}

tl_status tl_buffers_share(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           void *host,
                           size_t size,
                           tl_error *err)
{
    if (buffers->of[name].host != host || buffers->of[name].size != size)
        return make(buffers, device, name, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, host, size,
                    err);
    /* The same memory with another frame in it: mapping is how OpenCL learns of that. */
    return tl_buffers_touch(buffers, device, name, CL_MAP_WRITE, size, err);
}

static tl_status write(tl_buffers *buffers,
                       const tl_device *device,
                       tl_buffer_name name,
                       const void *from,
                       size_t size,
                       cl_bool blocking,
                       tl_error *err)
{
    if (size == 0) /* OpenCL refuses to write nothing */
        return TL_OK;
    return tl_cl(clEnqueueWriteBuffer(device->queue, buffers->of[name].memory, blocking, 0,
                                      size, from, 0, NULL, NULL),
                 "clEnqueueWriteBuffer", err);
}

tl_status tl_buffers_write(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           const void *from,
                           size_t size,
                           tl_error *err)
{
    return write(buffers, device, name, from, size, CL_TRUE, err);
}

tl_status tl_buffers_send(tl_buffers *buffers,
                          const tl_device *device,
                          tl_buffer_name name,
                          const void *from,
                          size_t size,
                          tl_error *err)
{
    return write(buffers, device, name, from, size, CL_FALSE, err);
}

tl_status tl_buffers_map(tl_buffers *buffers,
                         const tl_device *device,
                         tl_buffer_name name,
                         cl_map_flags flags,
                         size_t size,
                         void **out,
                         tl_error *err)
{
    cl_int code;
    *out = clEnqueueMapBuffer(device->queue, buffers->of[name].memory, CL_TRUE, flags, 0, size,
                              0, NULL, NULL, &code);
    return tl_cl(code, "clEnqueueMapBuffer", err);
}

tl_status tl_buffers_unmap(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           void *mapped,
                           tl_error *err)
{
    return tl_cl(
        clEnqueueUnmapMemObject(device->queue, buffers->of[name].memory, mapped, 0, NULL, NULL),
        "clEnqueueUnmapMemObject", err);
}

uint64_t tl_buffers_size(const tl_buffers *buffers)
{
    uint64_t size = 0;
    for (int i = 0; i < TL_BUFFER_COUNT; i++)
        if (!buffers->of[i].host)
            size += buffers->of[i].size;
    return size;
}

void tl_buffers_let_go(tl_buffers *buffers)
{
    for (int i = 0; i < TL_BUFFER_COUNT; i++)
        if (buffers->of[i].host)
            release(buffers, (tl_buffer_name)i);
}

void tl_buffers_release(tl_buffers *buffers)
{
    for (int i = 0; i < TL_BUFFER_COUNT; i++)
        release(buffers, (tl_buffer_name)i);
}
