#include "device.h"

#include "kernel_program.h"
#include "try.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

tl_status tl_cl(cl_int code, const char *call, tl_error *err)
{
    if (code == CL_SUCCESS)
        return TL_OK;
    if (code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_RESOURCES ||
        code == CL_OUT_OF_HOST_MEMORY || code == CL_INVALID_BUFFER_SIZE)
        return tl_fail(err, TL_ERR_DEVICE_MEMORY,
                       "the device is out of memory (%s, OpenCL code %d); a smaller frame or "
                       "another --device may fit",
                       call, (int)code);
    return tl_fail(err, TL_ERR_DEVICE, "%s failed with OpenCL code %d", call, (int)code);
}

static int contains(const char *text, const char *part)
{
    for (; *text; text++) {
        size_t i = 0;
        while (part[i] && tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (!part[i])
            return 1;
    }
    return 0;
}

static int fits(const tl_device_info *info, const char *selector, size_t index)
{
    char *end = NULL;
    if (!selector || !selector[0])
        return info->is_default;
    if (strcmp(selector, "cpu") == 0 || strcmp(selector, "gpu") == 0)
        return strcmp(info->kind, selector) == 0;
    if (isdigit((unsigned char)selector[0])) {
        const unsigned long wanted = strtoul(selector, &end, 10);
        if (*end == '\0')
            return wanted == index;
    }
    return contains(info->name, selector) || contains(info->platform, selector);
}

static tl_status none_fits(const char *selector,
                           const tl_device_info *infos,
                           size_t count,
                           tl_error *err)
{
    char names[1024] = "";
    size_t length = 0;
    if (count == 0)
        return tl_fail(err, TL_ERR_NO_DEVICE,
                       "no OpenCL device found: install one, such as PoCL (Debian package "
                       "pocl-opencl-icd), or light with --precision reference");
    for (size_t i = 0; i < count && length < sizeof names - 300; i++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%zu: %s (%s)",
                                   i ? ", " : "", i, infos[i].name, infos[i].platform);
    return tl_fail(err, TL_ERR_NO_DEVICE, "no OpenCL device fits \"%s\"; there are %s",
                   selector, names);
}

static tl_status open_queue(tl_device *device, tl_error *err)
{
    tl_status status = TL_OK;
    cl_device_fp_config config = 0;
    cl_int code;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    TRY(tl_cl(code, "clCreateContext", err));
    device->queue =
        clCreateCommandQueue(device->context, device->id, CL_QUEUE_PROFILING_ENABLE, &code);
    TRY(tl_cl(code, "clCreateCommandQueue", err));
    clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config, NULL);
    device->rounds_divide = (config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    device->shares_memory = strcmp(device->info.kind, "cpu") == 0;
done:
    return status;
}

tl_status tl_device_open(const char *selector, tl_device **out, tl_error *err)
{
    tl_status status = TL_OK;
    cl_device_id *ids = NULL;
    tl_device_info *infos = NULL;
    tl_device *device = NULL;
    size_t count = 0, chosen = 0;

    TRY(tl_device_find_all(&ids, &infos, &count, err));
    while (chosen < count && !fits(&infos[chosen], selector, chosen))
        chosen++;
    if (chosen == count)
        TRY(none_fits(selector ? selector : "", infos, count, err));
    device = calloc(1, sizeof *device);
    if (!device)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory opening an OpenCL device"));
    device->id = ids[chosen];
    device->info = infos[chosen];
    TRY(open_queue(device, err));
    *out = device;
    device = NULL;
done:
    tl_device_close(device);
    free(ids);
    free(infos);
    return status;
}

void tl_device_close(tl_device *device)
{
    if (!device)
        return;
    tl_programs_release(device->programs);
    if (device->queue)
        clReleaseCommandQueue(device->queue);
    if (device->context)
        clReleaseContext(device->context);
    free(device);
}

tl_device_info tl_device_describe(const tl_device *device)
{
    return device->info;
}
