/* Launches of kernels whose arguments are a frame and buffers. */
#ifndef TL_LAUNCH_H
#define TL_LAUNCH_H

#include "passes.h"

typedef struct tl_work {
    size_t items, group; /* work-items in all, and per work-group */
} tl_work;

/* In work-groups of one: kernels for CPUs share nothing within a group. */
tl_work tl_alone(size_t items);

/* In work-groups of TL_GROUP: kernels of the path for GPUs. */
tl_work tl_groups(size_t groups);

/* Launches a kernel of the part's program, which takes the context's frame and then the buffers; `name`
 * is for errors. Its device time is added to *ms by tl_pass_finish. Fails with TL_ERR_DEVICE. */
tl_status tl_launch(tl_pass_context *context,
                    tl_program_part part,
                    cl_kernel kernel,
                    const char *name,
                    const tl_buffer_name *buffers,
                    cl_uint buffer_count,
                    tl_work size,
                    double *ms,
                    tl_error *err);

/* The same of a kernel whose first argument is the `size` bytes at `first`. */
tl_status tl_launch_with(tl_pass_context *context,
                         tl_program_part part,
                         cl_kernel kernel,
                         const char *name,
                         const void *first,
                         size_t first_size,
                         const tl_buffer_name *buffers,
                         cl_uint buffer_count,
                         tl_work size,
                         double *ms,
                         tl_error *err);

/* The kernel `name` of culling; the buffers come last. */
#define TL_LAUNCH_CULL(context, name, size, ms, err, ...)                            \
    tl_launch(context, TL_PART_CULL, (context)->programs[TL_PART_CULL]->name, #name, \
              (tl_buffer_name[]){__VA_ARGS__},                                       \
              sizeof((tl_buffer_name[]){__VA_ARGS__}) / sizeof(tl_buffer_name), size, ms, err)

#endif
