#include "program_keeper.h"

#include "program_key.h"

#include <stdlib.h>
#include <string.h>

/* A program takes 2 to 3 s of one core to compile. Who holds the lock for longer than this is
 * stopped or starved, and compiling beside it costs less than waiting on. */
static const double most_patience_s = 20.0;

/* PoCL takes 256 MB of address space to write a binary, and does not look whether it got them. */
enum { ADDRESS_SPACE = 512 << 20 };

static tl_bytes key_of(const tl_keeper *keeper)
{
    return (tl_bytes){keeper->key, keeper->key_size};
}

void tl_keeper_begin(tl_keeper *keeper,
                     const tl_device *device,
                     const char *const *texts,
                     size_t text_count,
                     const char *flags)
{
    *keeper = (tl_keeper){.lock = -1};
    keeper->folder = tl_program_cache_folder();
    if (!keeper->folder)
        return;
    keeper->key = tl_program_key(device, texts, text_count, flags, &keeper->key_size);
    if (!keeper->key)
        tl_keeper_release(keeper);
}

/* NULL unless the driver takes the binary as it is. */
static cl_program build_binary(const tl_device *device, tl_bytes binary, const char *flags)
{
    const unsigned char *const data = binary.data;
    const unsigned char *pointer = data;
    cl_int code, accepted = CL_INVALID_BINARY;
    cl_program program = clCreateProgramWithBinary(device->context, 1, &device->id,
                                                   &binary.size, &pointer, &accepted, &code);
    if (code != CL_SUCCESS)
        return NULL;
    if (accepted == CL_SUCCESS &&
        clBuildProgram(program, 1, &device->id, flags, NULL, NULL) == CL_SUCCESS)
        return program;
    clReleaseProgram(program);
    return NULL;
}

static void take_shapes(tl_keeper *keeper, tl_bytes note)
{
    const size_t count = note.size / sizeof keeper->shapes[0];
    keeper->shape_count =
        (int)(count < TL_MAX_LAUNCH_SHAPES ? count : (size_t)TL_MAX_LAUNCH_SHAPES);
    keeper->kept_count = keeper->shape_count;
    memcpy(keeper->shapes, note.data, (size_t)keeper->shape_count * sizeof keeper->shapes[0]);
}

static cl_program load_now(tl_keeper *keeper, const tl_device *device, const char *flags)
{
    tl_program_entry entry;
    if (!tl_program_cache_read(keeper->folder, key_of(keeper), &entry))
        return NULL;
    cl_program program = build_binary(device, entry.binary, flags);
    if (program) {
        take_shapes(keeper, entry.note);
        keeper->is_loaded = 1;
    }
    tl_program_entry_release(&entry);
    return program;
}

cl_program tl_keeper_load(tl_keeper *keeper, const tl_device *device, const char *flags)
{
    if (!keeper->folder)
        return NULL;
    cl_program program = load_now(keeper, device, flags);
    if (program)
        return program;
    keeper->lock = tl_program_cache_lock(keeper->folder, key_of(keeper), most_patience_s);
    program = load_now(keeper, device, flags); /* another may have made it meanwhile */
    if (program)
        tl_keeper_keep(keeper, NULL);
    return program;
}

void tl_keeper_reject(tl_keeper *keeper)
{
    keeper->is_loaded = keeper->shape_count = keeper->kept_count = 0;
}

void tl_keeper_note_launch(tl_keeper *keeper, uint32_t kernel, size_t items, size_t group)
{
    const tl_launch_shape shape = {kernel, (uint32_t)group, items > UINT16_MAX};
    for (int i = 0; i < keeper->shape_count; i++)
        if (memcmp(&keeper->shapes[i], &shape, sizeof shape) == 0)
            return;
    if (keeper->shape_count < TL_MAX_LAUNCH_SHAPES)
        keeper->shapes[keeper->shape_count++] = shape;
}

int tl_keeper_has_news(const tl_keeper *keeper)
{
    return keeper->folder && keeper->shape_count > keeper->kept_count;
}

/* The caller frees *out, and finds it NULL where the driver gives none. */
static size_t binary_of(cl_program program, unsigned char **out)
{
    size_t size = 0;
    *out = NULL;
    void *const room = malloc(ADDRESS_SPACE);
    free(room);
    if (!room ||
        clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL) !=
            CL_SUCCESS ||
        size == 0 || !(*out = malloc(size)))
        return 0;
    if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof *out, out, NULL) != CL_SUCCESS) {
        free(*out);
        *out = NULL;
    }
    return size;
}

void tl_keeper_keep(tl_keeper *keeper, cl_program program)
{
    unsigned char *binary = NULL;
    if (!keeper->folder)
        return;
    if (program) {
        const size_t size = binary_of(program, &binary);
        const tl_bytes note = {keeper->shapes,
                               (size_t)keeper->shape_count * sizeof keeper->shapes[0]};
        if (binary && tl_program_cache_write(keeper->folder, key_of(keeper), note,
                                             (tl_bytes){binary, size}))
            tl_program_cache_trim(keeper->folder, TL_CACHE_LIMIT);
        keeper->kept_count = keeper->shape_count; /* or not again, if it failed */
    }
    free(binary);
    tl_program_cache_unlock(keeper->folder, key_of(keeper), keeper->lock);
    keeper->lock = -1;
}

void tl_keeper_release(tl_keeper *keeper)
{
    tl_keeper_keep(keeper, NULL);
    free(keeper->folder);
    free(keeper->key);
    *keeper = (tl_keeper){.lock = -1};
}
