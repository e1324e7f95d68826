/* Is an entry that is sound, and yet not what the driver wants, compiled anew, and then good? */
#define _GNU_SOURCE /* setenv */
#include "frames.h"

#include "device.h"
#include "program_cache.h"

#include <dirent.h>

static char folder[512];

/* The programs that our code has compiled, and taken from binaries: the linker leads its calls
 * through here. */
static struct {
    int sources, binaries;
} made;

cl_program __real_clCreateProgramWithSource(
    cl_context context, cl_uint count, const char **texts, const size_t *sizes, cl_int *code);
cl_program __wrap_clCreateProgramWithSource(
    cl_context context, cl_uint count, const char **texts, const size_t *sizes, cl_int *code);
cl_program __wrap_clCreateProgramWithSource(
    cl_context context, cl_uint count, const char **texts, const size_t *sizes, cl_int *code)
{
    made.sources++;
    return __real_clCreateProgramWithSource(context, count, texts, sizes, code);
}

cl_program __real_clCreateProgramWithBinary(cl_context context,
                                            cl_uint count,
                                            const cl_device_id *devices,
                                            const size_t *sizes,
                                            const unsigned char **binaries,
                                            cl_int *each,
                                            cl_int *code);
cl_program __wrap_clCreateProgramWithBinary(cl_context context,
                                            cl_uint count,
                                            const cl_device_id *devices,
                                            const size_t *sizes,
                                            const unsigned char **binaries,
                                            cl_int *each,
                                            cl_int *code);
cl_program __wrap_clCreateProgramWithBinary(cl_context context,
                                            cl_uint count,
                                            const cl_device_id *devices,
                                            const size_t *sizes,
                                            const unsigned char **binaries,
                                            cl_int *each,
                                            cl_int *code)
{
    made.binaries++;
    return __real_clCreateProgramWithBinary(context, count, devices, sizes, binaries, each,
                                            code);
}

/* Lights on a device of its own, which knows no program yet. */
static void light_anew(tl_image *image)
{
    tl_device *device = NULL;
    tl_light_set lights = {0};
    tl_lighting_options options = tl_lighting_options_default();
    const tl_camera camera = camera_of(64, 40, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 5);
    uint32_t seed = 7;
    tl_error err;
    const tl_light light = random_light(&camera, &seed, 3.0f, 4.0f);
    ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    ASSERT_OK(tl_device_open(NULL, &device, &err), err);
    options.cull = TL_CULL_NONE; /* one pass of kernels to compile */
    made.sources = made.binaries = 0;
    light_frame(device, &options, g, &lights, image);
    tl_device_close(device);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

/* The one entry's file, [*size]; the caller frees it. */
static char *load_entry(size_t *size)
{
    char path[1024] = "";
    DIR *opened = opendir(folder);
    assert_non_null(opened);
    for (const struct dirent *entry; (entry = readdir(opened));)
        if (strstr(entry->d_name, ".program"))
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    closedir(opened);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *bytes = malloc(1 << 24);
    *size = fread(bytes, 1, 1 << 24, file);
    fclose(file);
    return bytes;
}

/* The key in an entry's file: after 8 letters, three sizes and 16 bytes of checksum. */
static tl_bytes key_in(const char *bytes)
{
    uint64_t size;
    memcpy(&size, bytes + 8, sizeof size);
    return (tl_bytes){bytes + 48, size};
}

/* Of a program that has none of our kernels. The caller frees *binary. */
static size_t foreign_binary(unsigned char **binary)
{
    const char *text = "__kernel void nothing(__global int *x) { x[0] = 1; }";
    tl_device *device = NULL;
    tl_error err;
    cl_int code;
    size_t size = 0;
    ASSERT_OK(tl_device_open(NULL, &device, &err), err);
    cl_program program =
        __real_clCreateProgramWithSource(device->context, 1, &text, NULL, &code);
    assert_int_equal(code, CL_SUCCESS);
    assert_int_equal(clBuildProgram(program, 1, &device->id, "", NULL, NULL), CL_SUCCESS);
    clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, NULL);
    *binary = malloc(size);
    clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof *binary, binary, NULL);
    clReleaseProgram(program);
    tl_device_close(device);
    return size;
}

static void assert_made(int sources, int binaries)
{
    assert_int_equal(made.sources, sources);
    assert_int_equal(made.binaries, binaries);
}

static void compiled_anew(void **state)
{
    unsigned char *foreign = NULL;
    const size_t foreign_size = foreign_binary(&foreign);
    const tl_bytes binaries[] = {
        {"no program of any driver, but long enough for a header of one", 62},
        {foreign, foreign_size}};
    const tl_camera camera = camera_of(64, 40, TL_PERSPECTIVE);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE, 5);
    tl_image *want = image_like(g), *image = image_like(g);
    size_t size;
    (void)state;

    light_anew(want);
    assert_made(1, 0);
    light_anew(image);
    assert_made(0, 1);
    assert_same_image(image, want, "from the entry");
    char *bytes = load_entry(&size);
    for (size_t i = 0; i < COUNT_OF(binaries); i++) {
        assert_true(
            tl_program_cache_write(folder, key_in(bytes), (tl_bytes){NULL, 0}, binaries[i]));
        light_anew(image);
        assert_true(made.sources == 1 && made.binaries > 0);
        assert_same_image(image, want, "from source, in place of an unfit entry");
        light_anew(image);
        assert_made(0, 1);
        assert_same_image(image, want, "from the entry made anew");
    }
    free(bytes);
    free(foreign);
    tl_image_destroy(want);
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

static int make_folder(void **state)
{
    open_device(state);
    tl_device_close(*state);
    *state = NULL;
    scratch_path(folder, sizeof folder, "program-stale-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return setenv("TILELIGHT_CACHE", folder, 1);
}

static int remove_folder(void **state)
{
    char command[600];
    (void)state;
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(compiled_anew)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
