/* A kernel that answers a test's question, behind the headers of the kernels. */
#ifndef TL_PROBE_PROGRAM_H
#define TL_PROBE_PROGRAM_H

#include "testing.h"

#include "device.h"
#include "embedded_kernels.h"
#include "kernel_program.h"

/* Built for these options. The caller releases it. */
static cl_program build_probe(const tl_device *device,
                              const tl_kernel_options *options,
                              const char *text)
{
    const char *texts[] = {tl_kernel_headers, text};
    char flags[2048], log[4096] = "";
    cl_int code;
    const int length =
        snprintf(flags, sizeof flags, "-cl-std=CL1.2 -w%s",
                 device->rounds_divide ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
    tl_kernel_flags(options, flags + length, sizeof flags - (size_t)length);
    cl_program program = clCreateProgramWithSource(device->context, 2, texts, NULL, &code);
    assert_int_equal(code, CL_SUCCESS);
    if (clBuildProgram(program, 1, &device->id, flags, NULL, NULL) != CL_SUCCESS) {
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log,
                              NULL);
        fail_msg("the probe does not compile:\n%s", log);
    }
    return program;
}

#endif
