#include "peaks.h"

#include "device.h"
#include "peaks_text.h"
#include "try.h"

#include <math.h>
#include <stdio.h>

enum {
    CHAINS = 12, /* of peak_flops */
    LAUNCHES = 12,
    ARRAY_SIZE = 1 << 26, /* bytes: beyond the last-level caches that CPUs of today share */
    CPU_BLOCK = 4096,     /* vectors of a work-item on a CPU: 256 KB of 16 lanes */
    ITEMS_PER_UNIT = 16,  /* on a CPU: small parts even out what else the machine does */
    GPU_GROUP = 256,
    GPU_GROUPS_PER_UNIT = 32,
};
static const double wanted_seconds = 0.01; /* of one launch of arithmetic */

typedef struct roof {
    tl_device *device;
    cl_program program;
    cl_kernel flops, copy, read;
    cl_mem from, to;
    size_t lanes, group;
} roof;

static tl_status make_kernel(const roof *r, const char *name, cl_kernel *out, tl_error *err)
{
    cl_int code;
    *out = clCreateKernel(r->program, name, &code);
    return tl_cl(code, name, err);
}

static tl_status make_buffer(const roof *r, cl_mem *out, tl_error *err)
{
    cl_int code;
    *out = clCreateBuffer(r->device->context, CL_MEM_READ_WRITE, ARRAY_SIZE, NULL, &code);
    return tl_cl(code, "clCreateBuffer", err);
}

static tl_status prepare(roof *r, tl_error *err)
{
    static const cl_float one = 1.0f;
    const char *text = tl_peaks_cl;
    char flags[64];
    tl_status status = TL_OK;
    cl_int code;
    r->lanes = r->device->info.vector_width;
    r->group = r->lanes == 1 ? GPU_GROUP : 1;
    snprintf(flags, sizeof flags, "-cl-std=CL1.2 -D WIDTH=%zu", r->lanes);
    r->program = clCreateProgramWithSource(r->device->context, 1, &text, NULL, &code);
    TRY(tl_cl(code, "clCreateProgramWithSource", err));
    TRY(tl_cl(clBuildProgram(r->program, 1, &r->device->id, flags, NULL, NULL),
              "clBuildProgram (peaks)", err));
    TRY(make_kernel(r, "peak_flops", &r->flops, err));
    TRY(make_kernel(r, "peak_copy", &r->copy, err));
    TRY(make_kernel(r, "peak_read", &r->read, err));
    TRY(make_buffer(r, &r->from, err));
    TRY(make_buffer(r, &r->to, err));
    TRY(tl_cl(clEnqueueFillBuffer(r->device->queue, r->from, &one, sizeof one, 0, ARRAY_SIZE, 0,
                                  NULL, NULL),
              "clEnqueueFillBuffer", err));
done:
    return status;
}

static void release(roof *r)
{
    const cl_kernel kernels[] = {r->flops, r->copy, r->read};
    const cl_mem buffers[] = {r->from, r->to};
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++)
        if (kernels[i])
            clReleaseKernel(kernels[i]);
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++)
        if (buffers[i])
            clReleaseMemObject(buffers[i]);
    if (r->program)
        clReleaseProgram(r->program);
}

/* One launch, and its time on the device. */
static tl_status launch(
    const roof *r, cl_kernel kernel, size_t items, double *seconds, tl_error *err)
{
    tl_status status = TL_OK;
    cl_event event = NULL;
    cl_ulong start = 0, end = 0;
    TRY(tl_cl(clEnqueueNDRangeKernel(r->device->queue, kernel, 1, NULL, &items, &r->group, 0,
                                     NULL, &event),
              "clEnqueueNDRangeKernel", err));
    TRY(tl_cl(clWaitForEvents(1, &event), "clWaitForEvents", err));
    TRY(tl_cl(
        clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, NULL),
        "clGetEventProfilingInfo", err));
    TRY(tl_cl(clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL),
              "clGetEventProfilingInfo", err));
    *seconds = 1e-9 * (double)(end > start ? end - start : 1);
done:
    if (event)
        clReleaseEvent(event);
    return status;
}

static tl_status measure_flops(const roof *r, double *out, tl_error *err)
{
    static const cl_float a = 0.5f,
                          b = 1.0f; /* converges to 2: never denormal, never infinite */
    const size_t units = r->device->info.compute_units;
    const size_t items =
        r->group == 1 ? units * ITEMS_PER_UNIT : units * GPU_GROUPS_PER_UNIT * GPU_GROUP;
    tl_status status = TL_OK;
    cl_uint rounds = 1024;
    double best = 0.0;
    clSetKernelArg(r->flops, 0, sizeof r->to, &r->to);
    clSetKernelArg(r->flops, 1, sizeof a, &a);
    clSetKernelArg(r->flops, 2, sizeof b, &b);
    for (int i = 0; i < LAUNCHES; i++) {
        double seconds = 0.0;
        clSetKernelArg(r->flops, 3, sizeof rounds, &rounds);
        TRY(launch(r, r->flops, items, &seconds, err));
        const double rate = 2.0 * CHAINS * (double)r->lanes * rounds * (double)items / seconds;
        best = rate > best ? rate : best;
        if (seconds < wanted_seconds && rounds < 1u << 24) {
            rounds *= 2;
            i = -1;
        }
    }
    *out = best;
done:
    return status;
}

static tl_status measure_memory(
    const roof *r, cl_kernel kernel, double bytes_per_byte, double *out, tl_error *err)
{
    const cl_uint block = r->group == 1 ? CPU_BLOCK : 4;
    const size_t vectors = ARRAY_SIZE / sizeof(cl_float) / r->lanes;
    tl_status status = TL_OK;
    double best = 0.0;
    clSetKernelArg(kernel, 0, sizeof r->from, &r->from);
    clSetKernelArg(kernel, 1, sizeof r->to, &r->to);
    clSetKernelArg(kernel, 2, sizeof block, &block);
    for (int i = 0; i < LAUNCHES; i++) {
        double seconds = 0.0;
        TRY(launch(r, kernel, vectors / block, &seconds, err));
        best = fmax(best, bytes_per_byte * ARRAY_SIZE / seconds);
    }
    *out = best;
done:
    return status;
}

tl_status tl_peaks_measure(tl_device *device, tl_peaks *out, tl_error *err)
{
    roof r = {.device = device};
    tl_peaks peaks = {0};
    tl_status status = TL_OK;
    TRY(prepare(&r, err));
    TRY(measure_flops(&r, &peaks.flops, err));
    TRY(measure_memory(&r, r.copy, 2.0, &peaks.copy_bytes, err));
    TRY(measure_memory(&r, r.read, 1.0, &peaks.read_bytes, err));
    peaks.bytes = fmax(peaks.read_bytes, peaks.copy_bytes);
    *out = peaks;
done:
    release(&r);
    return status;
}
