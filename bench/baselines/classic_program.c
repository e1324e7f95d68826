#include "classic_program.h"

#include "embedded_classic.h"
#include "embedded_kernels.h"

#include <stdio.h>

enum { MAX_FLAGS = 2048, TEXT_COUNT = 2 };

static const char *const texts[TEXT_COUNT] = {tl_kernel_headers, tl_classic_cl};

/* Drivers compile a kernel again for large grids. With the grid in the flags, and so in the key, an
 * entry of the cache is ready for the launches of whoever finds it. */
static void format_flags(const tl_kernel_options *options, size_t items, char flags[MAX_FLAGS])
{
    const int length = snprintf(
        flags, MAX_FLAGS, "-cl-std=CL1.2 -w -D CLASSIC_GRID_IS_LARGE=%d", items > UINT16_MAX);
    tl_kernel_flags(options, flags + length, (size_t)(MAX_FLAGS - length));
}

static tl_status compile(const tl_device *device,
                         const char *flags,
                         classic_program *out,
                         tl_error *err)
{
    char log[2048] = "";
    cl_int code;
    const char *sources[TEXT_COUNT] = {texts[0], texts[1]};
    out->program = clCreateProgramWithSource(device->context, TEXT_COUNT, sources, NULL, &code);
    if (code != CL_SUCCESS)
        return tl_cl(code, "clCreateProgramWithSource", err);
    if (clBuildProgram(out->program, 1, &device->id, flags, NULL, NULL) == CL_SUCCESS)
        return TL_OK;
    clGetProgramBuildInfo(out->program, device->id, CL_PROGRAM_BUILD_LOG, sizeof log, log,
                          NULL);
    return tl_fail(err, TL_ERR_DEVICE, "the classic kernel does not compile on %s:\n%s",
                   device->info.name, log);
}

tl_status tl_classic_program_make(const tl_device *device,
                                  const tl_kernel_options *options,
                                  size_t items,
                                  classic_program *out,
                                  tl_error *err)
{
    char flags[MAX_FLAGS];
    cl_int code;
    format_flags(options, items, flags);
    *out = (classic_program){0};
    tl_keeper_begin(&out->keeper, device, texts, TEXT_COUNT, flags);
    out->program = tl_keeper_load(&out->keeper, device, flags);
    const tl_status status = out->program ? TL_OK : compile(device, flags, out, err);
    if (status != TL_OK)
        return status;
    out->kernel = clCreateKernel(out->program, "light_tiles_classic", &code);
    return tl_cl(code, "clCreateKernel", err);
}

void tl_classic_program_keep(classic_program *program, size_t items, size_t group)
{
    tl_keeper_note_launch(&program->keeper, 0, items, group);
    tl_keeper_keep(&program->keeper,
                   tl_keeper_has_news(&program->keeper) ? program->program : NULL);
}

void tl_classic_program_clear(classic_program *program)
{
    if (program->kernel)
        clReleaseKernel(program->kernel);
    if (program->program)
        clReleaseProgram(program->program);
    tl_keeper_release(&program->keeper);
    program->kernel = NULL;
    program->program = NULL;
}
