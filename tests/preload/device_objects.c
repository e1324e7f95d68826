/* Stands between a program and OpenCL (LD_PRELOAD). Counts the objects that are made and released; where
 * DEVICE_OBJECTS names a file, it gets a line for each kind at the end: "buffer 12 12". With DEVICE_ROOM, in
 * bytes, the device runs out of memory beyond that: of buffers of its own, those over the host's memory are free.
 * "dangling" counts memory that was freed while a buffer was over it. */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

typedef enum kind { CONTEXT, QUEUE, BUFFER, PROGRAM, KERNEL, EVENT, KIND_COUNT } kind;
static const char *const words[KIND_COUNT] = {"context", "queue",  "buffer",
                                              "program", "kernel", "event"};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static unsigned long made[KIND_COUNT], released[KIND_COUNT], refused;
static size_t taken; /* bytes of the device's own buffers */

/* Where buffers over the host's memory begin; NULL: a free place. */
enum { MOST_HOSTS = 256 };
static struct {
    cl_mem buffer;
    const void *begin;
} hosts[MOST_HOSTS];
static unsigned long dangling;
static void (*free_of_library)(void *);

static void *real(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found)
        abort();
    return found;
}

static void count(kind of, int is_made)
{
    pthread_mutex_lock(&lock);
    (is_made ? made : released)[of]++;
    pthread_mutex_unlock(&lock);
}

__attribute__((destructor)) static void tell(void)
{
    const char *path = getenv("DEVICE_OBJECTS");
    FILE *out = path ? fopen(path, "w") : NULL;
    for (int i = 0; out && i < KIND_COUNT; i++)
        fprintf(out, "%s %lu %lu\n", words[i], made[i], released[i]);
    if (out) {
        fprintf(out, "dangling %lu 0\nrefused %lu\n", dangling, refused);
        fclose(out);
    }
}

__attribute__((constructor)) static void find_free(void)
{
    free_of_library = (void (*)(void *))real("free");
}

/* In the free place where `was` is NULL, else in that of the buffer. */
static void note_host(cl_mem was, cl_mem buffer, const void *begin)
{
    pthread_mutex_lock(&lock);
    for (int i = 0; i < MOST_HOSTS; i++)
        if (hosts[i].buffer == was) {
            hosts[i].buffer = buffer;
            hosts[i].begin = begin;
            break;
        }
    pthread_mutex_unlock(&lock);
}

void free(void *memory)
{
    pthread_mutex_lock(&lock);
    for (int i = 0; memory && i < MOST_HOSTS; i++)
        dangling += hosts[i].begin == memory;
    pthread_mutex_unlock(&lock);
    if (free_of_library)
        free_of_library(memory);
}

/* A function that makes an object, and says so by what it returns. */
#define MAKES(of, type, name, parameters, arguments)                                      \
    CL_API_ENTRY type CL_API_CALL name parameters                                         \
    {                                                                                     \
        type(CL_API_CALL *next) parameters = (type(CL_API_CALL *) parameters)real(#name); \
        const type object = next arguments;                                               \
        if (object)                                                                       \
            count(of, 1);                                                                 \
        return object;                                                                    \
    }
/* A function that releases one. */
#define RELEASES(of, type, name)                                                    \
    CL_API_ENTRY cl_int CL_API_CALL name(type object)                               \
    {                                                                               \
        cl_int(CL_API_CALL *next)(type) = (cl_int(CL_API_CALL *)(type))real(#name); \
        count(of, 0);                                                               \
        return next(object);                                                        \
    }

MAKES(CONTEXT,
      cl_context,
      clCreateContext,
      (const cl_context_properties *a,
       cl_uint b,
       const cl_device_id *c,
       void(CL_CALLBACK *d)(const char *, const void *, size_t, void *),
       void *e,
       cl_int *f),
      (a, b, c, d, e, f))
RELEASES(CONTEXT, cl_context, clReleaseContext)
MAKES(QUEUE,
      cl_command_queue,
      clCreateCommandQueue,
      (cl_context a, cl_device_id b, cl_command_queue_properties c, cl_int *d),
      (a, b, c, d))
RELEASES(QUEUE, cl_command_queue, clReleaseCommandQueue)
MAKES(PROGRAM,
      cl_program,
      clCreateProgramWithSource,
      (cl_context a, cl_uint b, const char **c, const size_t *d, cl_int *e),
      (a, b, c, d, e))
MAKES(PROGRAM,
      cl_program,
      clCreateProgramWithBinary,
      (cl_context a,
       cl_uint b,
       const cl_device_id *c,
       const size_t *d,
       const unsigned char **e,
       cl_int *f,
       cl_int *g),
      (a, b, c, d, e, f, g))
RELEASES(PROGRAM, cl_program, clReleaseProgram)
MAKES(KERNEL, cl_kernel, clCreateKernel, (cl_program a, const char *b, cl_int *c), (a, b, c))
RELEASES(KERNEL, cl_kernel, clReleaseKernel)
RELEASES(EVENT, cl_event, clReleaseEvent)

CL_API_ENTRY cl_int CL_API_CALL clEnqueueNDRangeKernel(cl_command_queue queue,
                                                       cl_kernel kernel,
                                                       cl_uint dimensions,
                                                       const size_t *offset,
                                                       const size_t *global,
                                                       const size_t *local,
                                                       cl_uint wait_count,
                                                       const cl_event *wait,
                                                       cl_event *event)
{
    cl_int(CL_API_CALL * next)(cl_command_queue, cl_kernel, cl_uint, const size_t *,
                               const size_t *, const size_t *, cl_uint, const cl_event *,
                               cl_event *) = real("clEnqueueNDRangeKernel");
    const cl_int code =
        next(queue, kernel, dimensions, offset, global, local, wait_count, wait, event);
    if (event && code == CL_SUCCESS)
        count(EVENT, 1);
    return code;
}

static size_t size_of(cl_mem buffer)
{
    size_t size = 0;
    cl_mem_flags flags = 0;
    clGetMemObjectInfo(buffer, CL_MEM_FLAGS, sizeof flags, &flags, NULL);
    if (!(flags & CL_MEM_USE_HOST_PTR))
        clGetMemObjectInfo(buffer, CL_MEM_SIZE, sizeof size, &size, NULL);
    return size;
}

/* Takes `size` bytes, where they are there. */
static int take(size_t size)
{
    const char *room = getenv("DEVICE_ROOM");
    int fits = 1;
    pthread_mutex_lock(&lock);
    fits = !room || taken + size <= strtoull(room, NULL, 10);
    if (fits)
        taken += size;
    else
        refused++;
    pthread_mutex_unlock(&lock);
    return fits;
}

CL_API_ENTRY cl_mem CL_API_CALL
clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void *host, cl_int *code)
{
    cl_mem(CL_API_CALL * next)(cl_context, cl_mem_flags, size_t, void *, cl_int *) =
        real("clCreateBuffer");
    if (!(flags & CL_MEM_USE_HOST_PTR) && !take(size)) {
        *code = CL_MEM_OBJECT_ALLOCATION_FAILURE;
        return NULL;
    }
    const cl_mem buffer = next(context, flags, size, host, code);
    if (buffer)
        count(BUFFER, 1);
    if (buffer && flags & CL_MEM_USE_HOST_PTR)
        note_host(NULL, buffer, host);
    return buffer;
}

CL_API_ENTRY cl_int CL_API_CALL clReleaseMemObject(cl_mem buffer)
{
    cl_int(CL_API_CALL * next)(cl_mem) = real("clReleaseMemObject");
    const size_t size = size_of(buffer);
    pthread_mutex_lock(&lock);
    taken -= size;
    pthread_mutex_unlock(&lock);
    count(BUFFER, 0);
    note_host(buffer, NULL, NULL);
    return next(buffer);
}
