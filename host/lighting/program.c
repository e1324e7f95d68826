#include "program.h"

#include "embedded_kernels.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FLAGS = 512 };

/* No -cl-fast-relaxed-math: the error bounds in kernels/ assume IEEE arithmetic. */
static void format_flags(const tl_device *device,
                         const tl_kernel_options *options,
                         char flags[MAX_FLAGS])
{
    int length =
        snprintf(flags, MAX_FLAGS, "-cl-std=CL1.2 -w%s",
                 device->rounds_divide ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
#define FLAG(macro, field)                                                                \
    length += snprintf(flags + length, (size_t)(MAX_FLAGS - length), " -D " #macro "=%u", \
                       options->field);
    TL_KERNEL_OPTIONS(FLAG)
#undef FLAG
}

static tl_status fail_with_log(const tl_device *device, cl_program program, tl_error *err)
{
    static const char unavailable[] = "(no log)";
    size_t size = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = size ? malloc(size) : NULL;
    if (log)
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    tl_status status = tl_fail(err, TL_ERR_DEVICE, "the kernels do not compile on %s:\n%s",
                               device->info.name, log ? log : unavailable);
    free(log);
    return status;
}

static tl_status create_kernels(const tl_device *device, tl_program *made, tl_error *err)
{
    tl_status status = TL_OK;
    cl_int code;
#define CREATE(name)                                                    \
    if (device->info.has_double || strcmp(#name, "light_rects") != 0) { \
        made->name = clCreateKernel(made->program, #name, &code);       \
        TRY(tl_cl(code, "clCreateKernel of " #name, err));              \
    }
    TL_KERNELS(CREATE)
#undef CREATE
done:
    return status;
}

tl_status tl_program_build(const tl_device *device,
                           const tl_kernel_options *options,
                           tl_program *out,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_program made = {.options = *options};
    const char *text = tl_kernel_text;
    char flags[MAX_FLAGS];
    cl_int code;

    format_flags(device, options, flags);
    made.program = clCreateProgramWithSource(device->context, 1, &text, NULL, &code);
    TRY(tl_cl(code, "clCreateProgramWithSource", err));
    if (clBuildProgram(made.program, 1, &device->id, flags, NULL, NULL) != CL_SUCCESS)
        TRY(fail_with_log(device, made.program, err));
    TRY(create_kernels(device, &made, err));
    *out = made;
    made = (tl_program){0};
done:
    tl_program_release(&made);
    return status;
}

void tl_program_release(tl_program *program)
{
#define RELEASE(name)  \
    if (program->name) \
        clReleaseKernel(program->name);
    TL_KERNELS(RELEASE)
#undef RELEASE
    if (program->program)
        clReleaseProgram(program->program);
    *program = (tl_program){0};
}
