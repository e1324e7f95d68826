#include "device.h"

#include "driver_folder.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char pocl_platform[] = "Portable Computing Language";

static const struct {
    cl_device_type type;
    const char *word;
} kinds[] = {{CL_DEVICE_TYPE_CPU, "cpu"}, {CL_DEVICE_TYPE_GPU, "gpu"}};

static void ask_text(cl_device_id id, cl_device_info what, char *text, size_t size)
{
    text[0] = '\0';
    clGetDeviceInfo(id, what, size, text, NULL);
    text[size - 1] = '\0';
}

/* Lanes of our own vectors; 1 where work-items are lanes. Two registers per vector beat one with AVX2
 * (x 1.14, when a light on a block was still one long chain; not measured since), up to the widest
 * that OpenCL has. */
static uint32_t lanes_of(cl_device_id id, cl_device_type type)
{
    cl_uint native = 1;
    if (type != CL_DEVICE_TYPE_CPU)
        return 1;
    clGetDeviceInfo(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof native, &native, NULL);
    return native >= 8 ? 16 : native >= 4 ? 8 : native >= 2 ? 4 : 1;
}

tl_device_info tl_device_ask(cl_platform_id platform, cl_device_id id)
{
    tl_device_info info = {.kind = "other"};
    cl_device_type type = 0;
    cl_ulong memory = 0;
    cl_uint units = 0;
    cl_device_fp_config doubles = 0;

    ask_text(id, CL_DEVICE_NAME, info.name, sizeof info.name);
    ask_text(id, CL_DRIVER_VERSION, info.driver, sizeof info.driver);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof info.platform - 1, info.platform,
                      NULL);
    clGetDeviceInfo(id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    clGetDeviceInfo(id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, NULL);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (type & kinds[i].type)
            strcpy(info.kind, kinds[i].word);
    info.compute_units = units;
    info.memory_size = memory;
    info.has_double = doubles != 0;
    info.vector_width = lanes_of(id, type & CL_DEVICE_TYPE_CPU);
    return info;
}

/* PoCL by name, else any CPU, else any device. */
static void mark_default(tl_device_info *infos, size_t count)
{
    size_t best = 0;
    int best_rank = -1;
    for (size_t i = 0; i < count; i++) {
        const int rank = strcmp(infos[i].platform, pocl_platform) == 0 ? 2
                         : strcmp(infos[i].kind, "cpu") == 0           ? 1
                                                                       : 0;
        if (rank > best_rank) {
            best = i;
            best_rank = rank;
        }
    }
    if (count > 0)
        infos[best].is_default = 1;
}

enum { MAX_PLATFORMS = 32, MAX_PER_PLATFORM = 64 };

tl_status tl_device_find_all(cl_device_id **ids,
                             tl_device_info **infos,
                             size_t *count,
                             tl_error *err)
{
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint platform_count = 0;
    size_t found = 0;
    cl_device_id *all = NULL;
    tl_device_info *described = NULL;

    tl_driver_folder_lend();
    if (clGetPlatformIDs(MAX_PLATFORMS, platforms, &platform_count) != CL_SUCCESS)
        platform_count = 0;
    if (platform_count > MAX_PLATFORMS)
        platform_count = MAX_PLATFORMS;
    all = calloc((size_t)platform_count * MAX_PER_PLATFORM + 1, sizeof *all);
    described = calloc((size_t)platform_count * MAX_PER_PLATFORM + 1, sizeof *described);
    if (!all || !described) {
        free(all);
        free(described);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory listing OpenCL devices");
    }
    for (cl_uint p = 0; p < platform_count; p++) {
        cl_uint here = 0;
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, MAX_PER_PLATFORM, all + found,
                           &here) != CL_SUCCESS)
            continue;
        for (cl_uint i = 0; i < here && i < MAX_PER_PLATFORM; i++, found++)
            described[found] = tl_device_ask(platforms[p], all[found]);
    }
    tl_driver_folder_forget();
    mark_default(described, found);
    *ids = all;
    *infos = described;
    *count = found;
    return TL_OK;
}

tl_status tl_device_list(tl_device_info **out, size_t *count, tl_error *err)
{
    cl_device_id *ids = NULL;
    const tl_status status = tl_device_find_all(&ids, out, count, err);
    if (status == TL_OK)
        free(ids);
    return status;
}
