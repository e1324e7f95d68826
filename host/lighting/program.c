#include "program.h"

#include "embedded_kernels.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FLAGS = 512, MAX_PROGRAMS = 16 };

struct tl_programs {
    tl_program of[MAX_PROGRAMS];
    int count, oldest;
};

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

/* Accepts one that is all zero, and leaves it so. */
static void release(tl_program *program)
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

static tl_status build(const tl_device *device,
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
    release(&made);
    return status;
}

/* Where the next program goes; the one built longest ago gives way. */
static tl_program *free_slot(struct tl_programs *programs)
{
    if (programs->count < MAX_PROGRAMS)
        return &programs->of[programs->count++];
    tl_program *slot = &programs->of[programs->oldest];
    programs->oldest = (programs->oldest + 1) % MAX_PROGRAMS;
    release(slot);
    return slot;
}

tl_status tl_program_find(tl_device *device,
                          const tl_kernel_options *options,
                          const tl_program **out,
                          tl_error *err)
{
    tl_program built = {0};
    if (!device->programs)
        device->programs = calloc(1, sizeof *device->programs);
    if (!device->programs)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for kernel programs");
    for (int i = 0; i < device->programs->count; i++) {
        *out = &device->programs->of[i];
        if (memcmp(&(*out)->options, options, sizeof *options) == 0)
            return TL_OK;
    }
    const tl_status status = build(device, options, &built, err);
    if (status != TL_OK)
        return status;
    tl_program *slot = free_slot(device->programs);
    *slot = built;
    *out = slot;
    return TL_OK;
}

void tl_programs_release(struct tl_programs *programs)
{
    if (!programs)
        return;
    for (int i = 0; i < programs->count; i++)
        release(&programs->of[i]);
    free(programs);
}
