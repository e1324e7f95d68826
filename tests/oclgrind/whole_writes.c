/* Stands between a program and oclgrind 21.10 (LD_PRELOAD, before it), whose --uninitialized takes for
 * uninitialised what is not:
 *
 *   - of a buffer that is written in parts it remembers the last part alone. Here a part is written together
 *     with all that was written before it.
 *   - of a buffer whose number a released one had before it remembers the size of that one. Here none is
 *     released, so no number comes again.
 *
 * What no one wrote stays uninitialised for it. */
#define _GNU_SOURCE /* RTLD_NEXT */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BUFFERS = 4096 };

/* What the host has written of a buffer: its first `size` bytes. */
typedef struct written {
    cl_mem buffer;
    char *bytes;
    size_t size;
} written;

static written buffers[MOST_BUFFERS];

static written *written_of(cl_mem buffer)
{
    for (size_t i = 0; i < MOST_BUFFERS; i++) {
        if (!buffers[i].buffer)
            buffers[i].buffer = buffer;
        if (buffers[i].buffer == buffer)
            return &buffers[i];
    }
    abort();
}

CL_API_ENTRY cl_int CL_API_CALL clReleaseMemObject(cl_mem buffer)
{
    (void)buffer;
    return CL_SUCCESS;
}

CL_API_ENTRY cl_int CL_API_CALL clEnqueueWriteBuffer(cl_command_queue queue,
                                                     cl_mem buffer,
                                                     cl_bool blocking,
                                                     size_t offset,
                                                     size_t size,
                                                     const void *from,
                                                     cl_uint wait_count,
                                                     const cl_event *wait_for,
                                                     cl_event *event)
{
    cl_int (*const write)(cl_command_queue, cl_mem, cl_bool, size_t, size_t, const void *,
                          cl_uint, const cl_event *, cl_event *) =
        (cl_int(*)(cl_command_queue, cl_mem, cl_bool, size_t, size_t, const void *, cl_uint,
                   const cl_event *, cl_event *))dlsym(RTLD_NEXT, "clEnqueueWriteBuffer");
    written *const w = written_of(buffer);
    if (offset > w->size) /* what lies between was not written: leave it to oclgrind */
        return write(queue, buffer, blocking, offset, size, from, wait_count, wait_for, event);
    if (offset + size > w->size) {
        w->bytes = realloc(w->bytes, offset + size);
        if (!w->bytes)
            abort();
        w->size = offset + size;
    }
    memcpy(w->bytes + offset, from, size);
    return write(queue, buffer, CL_TRUE, 0, w->size, w->bytes, wait_count, wait_for, event);
}
