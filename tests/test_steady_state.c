/* What does a frame cost beside its kernels, once one like it has been lit: does it allocate, create,
 * compile or copy anything but its lights?
 *
 * The linker leads every call that our code makes to the functions below through the counters here;
 * what the driver does inside is its own. */
#include "frames.h"

#include "device.h"
#include "prepared.h"

/* X(call): none of these may happen in the steady state on a device that shares memory. */
#define FORBIDDEN(X)             \
    X(malloc)                    \
    X(calloc)                    \
    X(realloc)                   \
    X(aligned_alloc)             \
    X(posix_memalign)            \
    X(clCreateBuffer)            \
    X(clCreateKernel)            \
    X(clCreateProgramWithSource) \
    X(clCreateProgramWithBinary) \
    X(clEnqueueReadBuffer)       \
    X(clEnqueueReadBufferRect)   \
    X(clEnqueueWriteBufferRect)  \
    X(clEnqueueCopyBuffer)       \
    X(clEnqueueFillBuffer)

typedef enum counted_call {
#define COUNTED(call) COUNT_##call,
    FORBIDDEN(COUNTED)
#undef COUNTED
        COUNT_OF_CALLS
} counted_call;

static struct {
    int calls[COUNT_OF_CALLS];
    int writes, launches, maps;
    size_t bytes_written;
    const void *mapped[64]; /* what the first maps returned */
} counts;

/* X(type, call, (parameters), (arguments)) */
#define WRAPPED(X)                                                                             \
    X(void *, malloc, (size_t size), (size))                                                   \
    X(void *, calloc, (size_t count, size_t size), (count, size))                              \
    X(void *, realloc, (void *old, size_t size), (old, size))                                  \
    X(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))               \
    X(int, posix_memalign, (void **out, size_t alignment, size_t size),                        \
      (out, alignment, size))                                                                  \
    X(cl_mem, clCreateBuffer,                                                                  \
      (cl_context context, cl_mem_flags flags, size_t size, void *host, cl_int *code),         \
      (context, flags, size, host, code))                                                      \
    X(cl_kernel, clCreateKernel, (cl_program program, const char *name, cl_int *code),         \
      (program, name, code))                                                                   \
    X(cl_program, clCreateProgramWithSource,                                                   \
      (cl_context context, cl_uint count, const char **texts, const size_t *sizes,             \
       cl_int *code),                                                                          \
      (context, count, texts, sizes, code))                                                    \
    X(cl_program, clCreateProgramWithBinary,                                                   \
      (cl_context context, cl_uint count, const cl_device_id *devices, const size_t *sizes,    \
       const unsigned char **binaries, cl_int *each, cl_int *code),                            \
      (context, count, devices, sizes, binaries, each, code))                                  \
    X(cl_int, clEnqueueReadBuffer,                                                             \
      (cl_command_queue queue, cl_mem memory, cl_bool wait, size_t at, size_t size, void *to,  \
       cl_uint count, const cl_event *events, cl_event *event),                                \
      (queue, memory, wait, at, size, to, count, events, event))                               \
    X(cl_int, clEnqueueReadBufferRect,                                                         \
      (cl_command_queue queue, cl_mem memory, cl_bool wait, const size_t *origin,              \
       const size_t *host_origin, const size_t *region, size_t row, size_t slice,              \
       size_t host_row, size_t host_slice, void *to, cl_uint count, const cl_event *events,    \
       cl_event *event),                                                                       \
      (queue, memory, wait, origin, host_origin, region, row, slice, host_row, host_slice, to, \
       count, events, event))                                                                  \
    X(cl_int, clEnqueueWriteBufferRect,                                                        \
      (cl_command_queue queue, cl_mem memory, cl_bool wait, const size_t *origin,              \
       const size_t *host_origin, const size_t *region, size_t row, size_t slice,              \
       size_t host_row, size_t host_slice, const void *from, cl_uint count,                    \
       const cl_event *events, cl_event *event),                                               \
      (queue, memory, wait, origin, host_origin, region, row, slice, host_row, host_slice,     \
       from, count, events, event))                                                            \
    X(cl_int, clEnqueueCopyBuffer,                                                             \
      (cl_command_queue queue, cl_mem from, cl_mem to, size_t from_at, size_t to_at,           \
       size_t size, cl_uint count, const cl_event *events, cl_event *event),                   \
      (queue, from, to, from_at, to_at, size, count, events, event))                           \
    X(cl_int, clEnqueueFillBuffer,                                                             \
      (cl_command_queue queue, cl_mem memory, const void *pattern, size_t pattern_size,        \
       size_t at, size_t size, cl_uint count, const cl_event *events, cl_event *event),        \
      (queue, memory, pattern, pattern_size, at, size, count, events, event))

#define WRAP(type, call, parameters, arguments) \
    type __real_##call parameters;              \
    type __wrap_##call parameters;              \
    type __wrap_##call parameters               \
    {                                           \
        counts.calls[COUNT_##call]++;           \
        return __real_##call arguments;         \
    }
WRAPPED(WRAP)

cl_int __real_clEnqueueWriteBuffer(cl_command_queue,
                                   cl_mem,
                                   cl_bool,
                                   size_t,
                                   size_t,
                                   const void *,
                                   cl_uint,
                                   const cl_event *,
                                   cl_event *);
cl_int __wrap_clEnqueueWriteBuffer(cl_command_queue queue,
                                   cl_mem memory,
                                   cl_bool wait,
                                   size_t at,
                                   size_t size,
                                   const void *from,
                                   cl_uint count,
                                   const cl_event *events,
                                   cl_event *event);
cl_int __wrap_clEnqueueWriteBuffer(cl_command_queue queue,
                                   cl_mem memory,
                                   cl_bool wait,
                                   size_t at,
                                   size_t size,
                                   const void *from,
                                   cl_uint count,
                                   const cl_event *events,
                                   cl_event *event)
{
    counts.writes++;
    counts.bytes_written += size;
    return __real_clEnqueueWriteBuffer(queue, memory, wait, at, size, from, count, events,
                                       event);
}

cl_int __real_clEnqueueNDRangeKernel(cl_command_queue,
                                     cl_kernel,
                                     cl_uint,
                                     const size_t *,
                                     const size_t *,
                                     const size_t *,
                                     cl_uint,
                                     const cl_event *,
                                     cl_event *);
cl_int __wrap_clEnqueueNDRangeKernel(cl_command_queue queue,
                                     cl_kernel kernel,
                                     cl_uint dimensions,
                                     const size_t *offset,
                                     const size_t *global,
                                     const size_t *local,
                                     cl_uint count,
                                     const cl_event *events,
                                     cl_event *event);
cl_int __wrap_clEnqueueNDRangeKernel(cl_command_queue queue,
                                     cl_kernel kernel,
                                     cl_uint dimensions,
                                     const size_t *offset,
                                     const size_t *global,
                                     const size_t *local,
                                     cl_uint count,
                                     const cl_event *events,
                                     cl_event *event)
{
    counts.launches++;
    return __real_clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local,
                                         count, events, event);
}

void *__real_clEnqueueMapBuffer(cl_command_queue,
                                cl_mem,
                                cl_bool,
                                cl_map_flags,
                                size_t,
                                size_t,
                                cl_uint,
                                const cl_event *,
                                cl_event *,
                                cl_int *);
void *__wrap_clEnqueueMapBuffer(cl_command_queue queue,
                                cl_mem memory,
                                cl_bool wait,
                                cl_map_flags flags,
                                size_t at,
                                size_t size,
                                cl_uint count,
                                const cl_event *events,
                                cl_event *event,
                                cl_int *code);
void *__wrap_clEnqueueMapBuffer(cl_command_queue queue,
                                cl_mem memory,
                                cl_bool wait,
                                cl_map_flags flags,
                                size_t at,
                                size_t size,
                                cl_uint count,
                                const cl_event *events,
                                cl_event *event,
                                cl_int *code)
{
    void *mapped = __real_clEnqueueMapBuffer(queue, memory, wait, flags, at, size, count,
                                             events, event, code);
    if ((size_t)counts.maps < COUNT_OF(counts.mapped))
        counts.mapped[counts.maps] = mapped;
    counts.maps++;
    return mapped;
}

static const char *const call_names[] = {
#define NAME(call) #call,
    FORBIDDEN(NAME)
#undef NAME
};

static int was_mapped(const void *memory)
{
    for (int i = 0; i < counts.maps; i++)
        if (counts.mapped[i] == memory)
            return 1;
    return 0;
}

enum { WIDTH = 200, HEIGHT = 120, LIGHTS = 40, SCENES = 2, FRAMES = 6 };

typedef struct scene {
    tl_gbuffer *gbuffer; /* copied into the one that is lit */
    tl_light_set lights;
    tl_image *want; /* lit by a tl_lighting that knows nothing else */
} scene;

static void make_scene(scene *made,
                       tl_device *device,
                       const tl_lighting_options *options,
                       uint32_t seed)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_error err;
    made->gbuffer = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, seed);
    for (int i = 0; i < LIGHTS; i++) {
        const tl_light light = random_light(&camera, &seed, 0.5f, 3.0f);
        ASSERT_OK(tl_light_set_add(&made->lights, &light, &err), err);
    }
    made->want = image_like(made->gbuffer);
    light_frame(device, options, made->gbuffer, &made->lights, made->want);
}

static void check_counts(const tl_device *device, const tl_gbuffer *g, const tl_image *image)
{
    const int shares_memory = strcmp(device->info.kind, "cpu") == 0;
    /* Where the host makes rectangles, it also says in eight bytes where lists start. */
    const int extra_writes = device->info.has_double ? 0 : 1;
    for (int i = 0; i < COUNT_OF_CALLS; i++) {
        const int by_copy =
            i == COUNT_clEnqueueReadBufferRect || i == COUNT_clEnqueueWriteBufferRect;
        if (counts.calls[i] != (by_copy && !shares_memory ? 1 : 0))
            fail_msg("%d calls of %s in a frame like those before", counts.calls[i],
                     call_names[i]);
    }
    assert_int_equal(counts.writes, 1 + extra_writes);
    assert_int_equal(counts.bytes_written,
                     LIGHTS * sizeof(tl_view_light) + 8 * (size_t)extra_writes);
    assert_true(counts.launches > 0);
    if (shares_memory) {
        assert_true(was_mapped(g->planes));
        assert_true(was_mapped(image->planes));
    }
}

static void steady(tl_device *device, tl_lighting_options options)
{
    scene scenes[SCENES] = {{0}};
    tl_lighting *lighting = NULL;
    tl_lighting_counts figures;
    tl_timings timings = {0};
    tl_error err;
    for (uint32_t i = 0; i < SCENES; i++)
        make_scene(&scenes[i], device, &options, 11 + i);
    tl_gbuffer *g = NULL;
    ASSERT_OK(
        tl_gbuffer_create(&scenes[0].gbuffer->camera, scenes[0].gbuffer->present, &g, &err),
        err);
    tl_image *image = image_like(g);
    const size_t planes_size = (size_t)__builtin_popcount(g->present) * g->rows * g->pitch * 4;
    ASSERT_OK(tl_lighting_create(device, &options, &lighting, &err), err);
    for (int frame = 0; frame < FRAMES; frame++) {
        const scene *now = &scenes[frame % SCENES];
        memcpy(g->planes, now->gbuffer->planes, planes_size);
        memset(&counts, 0, sizeof counts);
        ASSERT_OK(
            tl_lighting_run(lighting, g, &now->lights, image, &timings, NULL, &figures, &err),
            err);
        if (frame == 0) /* the counters count */
            assert_true(counts.calls[COUNT_realloc] > 0 &&
                        counts.calls[COUNT_clCreateBuffer] > 0);
        if (frame >= SCENES)
            check_counts(device, g, image);
        assert_same_image(image, now->want, "one frame after another");
    }
    tl_lighting_destroy(lighting);
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
    for (int i = 0; i < SCENES; i++) {
        tl_gbuffer_destroy(scenes[i].gbuffer);
        tl_light_set_clear(&scenes[i].lights);
        tl_image_destroy(scenes[i].want);
    }
}

static void every_culling(void **state)
{
    for (int cull = 0; cull < TL_CULL_COUNT; cull++) {
        tl_lighting_options options = tl_lighting_options_default();
        options.cull = (tl_cull)cull;
        steady(*state, options);
    }
}

static void path_of_gpus(void **state)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.path = TL_PATH_GPU;
    steady(*state, options);
}

/* The rectangles of lights then come from the host. */
static void without_double(void **state)
{
    tl_device *device = NULL;
    tl_error err;
    (void)state;
    ASSERT_OK(tl_device_open(NULL, &device, &err), err);
    device->info.has_double = 0;
    steady(device, tl_lighting_options_default());
    tl_device_close(device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_culling),
                                       cmocka_unit_test(path_of_gpus),
                                       cmocka_unit_test(without_double)};
    return cmocka_run_group_tests(tests, open_device, close_device);
}
