/* The classic GPU kernel, classic.cl: built, fed and read back.
 *
 * Tolerance. The cosine carries some 4 roundings, and its power multiplies them by e: at 256, the
 * largest exponent of the bench scenes, the lobe is off by 256 4u = 6e-5 of itself (u = 2^-24), in
 * highlights. Half of that is allowed for the RMS of a frame. Lights of a tile add up in the order
 * in which they were listed, which changes from run to run by as little as rounding does. */
#include "baseline_tables.h"
#include "buffers.h"
#include "classic_program.h"
#include "prepared.h"
#include "try.h"

#include <stdlib.h>

enum { TILE = 16 }; /* CLASSIC_TILE */

typedef struct classic {
    tl_device *device;
    const tl_gbuffer *gbuffer;
    tl_prepared prepared;
    classic_program program;
    tl_buffers buffers; /* planes, lights, radiance */
    cl_mem longest;     /* [2] uint, as the kernel describes it */
} classic;

void classic_destroy(void *state)
{
    classic *c = state;
    if (!c)
        return;
    if (c->longest)
        clReleaseMemObject(c->longest);
    tl_classic_program_clear(&c->program);
    tl_buffers_release(&c->buffers);
    tl_prepared_clear(&c->prepared);
    free(c);
}

static size_t plane_size(const classic *c)
{
    return (size_t)c->gbuffer->rows * c->gbuffer->pitch * sizeof(float);
}

static tl_status upload(classic *c, tl_error *err)
{
    const size_t planes = (size_t)__builtin_popcount(c->gbuffer->present) * plane_size(c);
    const size_t lights = c->prepared.frame.light_count * sizeof(tl_view_light);
    cl_uint nothing_listed[2] = {0, 0};
    tl_status status = TL_OK;
    cl_int code;
    if (c->device->shares_memory) {
        TRY(tl_buffers_share(&c->buffers, c->device, TL_BUFFER_PLANES, c->gbuffer->planes,
                             planes, err));
    } else {
        TRY(tl_buffers_reserve(&c->buffers, c->device, TL_BUFFER_PLANES, planes, err));
        TRY(tl_buffers_write(&c->buffers, c->device, TL_BUFFER_PLANES, c->gbuffer->planes,
                             planes, err));
    }
    TRY(tl_buffers_reserve(&c->buffers, c->device, TL_BUFFER_RADIANCE, 3 * plane_size(c), err));
    TRY(tl_buffers_reserve(&c->buffers, c->device, TL_BUFFER_LIGHTS, lights, err));
    TRY(tl_buffers_write(&c->buffers, c->device, TL_BUFFER_LIGHTS, c->prepared.lights, lights,
                         err));
    c->longest = clCreateBuffer(c->device->context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                                sizeof nothing_listed, nothing_listed, &code);
    TRY(tl_cl(code, "clCreateBuffer", err));
done:
    return status;
}

/* Launches the kernel over the frame, and waits. */
static tl_status launch(classic *c, cl_int shades, tl_error *err)
{
    static const size_t group[2] = {TILE, TILE};
    const tl_frame *frame = &c->prepared.frame;
    const size_t items[2] = {(size_t)frame->tiles_x * TILE, (size_t)frame->tiles_y * TILE};
    const cl_mem buffers[] = {c->buffers.of[TL_BUFFER_PLANES].memory,
                              c->buffers.of[TL_BUFFER_LIGHTS].memory,
                              c->buffers.of[TL_BUFFER_RADIANCE].memory, c->longest};
    enum { BUFFER_COUNT = sizeof buffers / sizeof buffers[0] };
    const cl_kernel kernel = c->program.kernel;
    tl_status status = TL_OK;
    TRY(tl_cl(clSetKernelArg(kernel, 0, sizeof *frame, frame), "clSetKernelArg", err));
    for (cl_uint i = 0; i < BUFFER_COUNT; i++)
        TRY(tl_cl(clSetKernelArg(kernel, i + 1, sizeof buffers[i], &buffers[i]),
                  "clSetKernelArg", err));
    TRY(tl_cl(clSetKernelArg(kernel, BUFFER_COUNT + 1, sizeof shades, &shades),
              "clSetKernelArg", err));
    TRY(tl_cl(
        clEnqueueNDRangeKernel(c->device->queue, kernel, 2, NULL, items, group, 0, NULL, NULL),
        "light_tiles_classic", err));
    TRY(tl_cl(clFinish(c->device->queue), "light_tiles_classic", err));
done:
    return status;
}

static tl_status bind_radiance(classic *c, float *planes, tl_error *err)
{
    const size_t size = 3 * plane_size(c);
    return c->device->shares_memory
               ? tl_buffers_share(&c->buffers, c->device, TL_BUFFER_RADIANCE, planes, size, err)
               : tl_buffers_reserve(&c->buffers, c->device, TL_BUFFER_RADIANCE, size, err);
}

static tl_status make_program(classic *c, tl_error *err)
{
    const tl_needs *needs = &c->prepared.needs;
    const tl_frame *frame = &c->prepared.frame;
    const tl_kernel_options options = {.width = 1,
                                       .orthographic = needs->orthographic,
                                       .present = needs->present,
                                       .specular = needs->specular,
                                       .falloffs = needs->falloffs,
                                       .ambient = needs->ambient,
                                       .idle = needs->idle};
    const size_t items = (size_t)frame->tiles_x * frame->tiles_y * TILE * TILE;
    tl_status status = TL_OK;
    TRY(tl_classic_program_make(c->device, &options, items, &c->program, err));
    /* Drivers compile a kernel in full when it is first launched, for the size of work-groups and
     * of the grid. */
    TRY(launch(c, 0, err));
    tl_classic_program_keep(&c->program, items, TILE * TILE);
done:
    return status;
}

/* After a launch: whether every list held its lights. */
static tl_status check_lists(const classic *c, tl_error *err)
{
    cl_uint longest[2] = {0, 0};
    tl_status status = TL_OK;
    TRY(tl_cl(clEnqueueReadBuffer(c->device->queue, c->longest, CL_TRUE, 0, sizeof longest,
                                  longest, 0, NULL, NULL),
              "clEnqueueReadBuffer", err));
    if (longest[0] > longest[1])
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "a tile meets %u lights, and the classic kernel's lists hold %u: light "
                    "fewer, or with shorter ranges",
                    longest[0], longest[1]));
done:
    return status;
}

tl_status classic_create(const tl_baseline_input *input, void **out, tl_error *err)
{
    tl_status status = TL_OK;
    classic *c = calloc(1, sizeof *c);
    if (!c)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a baseline");
    c->device = input->device;
    c->gbuffer = input->gbuffer;
    TRY(tl_prepare(input->gbuffer, input->lights,
                   &(tl_prepare_options){.tile_size = TILE, .box_count = 1}, NULL, &c->prepared,
                   err));
    TRY(tl_baseline_check(&c->prepared.needs, 1u << TL_MODEL_PHONG, ~0u, err));
    TRY(upload(c, err));
    TRY(make_program(c, err));
    TRY(check_lists(c, err));
    *out = c;
    c = NULL;
done:
    classic_destroy(c);
    return status;
}

static tl_status read_back(classic *c, tl_image *image, tl_error *err)
{
    const size_t size = 3 * plane_size(c);
    void *mapped = NULL;
    tl_status status = TL_OK;
    if (c->device->shares_memory) {
        TRY(tl_buffers_map(&c->buffers, c->device, TL_BUFFER_RADIANCE, CL_MAP_READ, size,
                           &mapped, err));
        TRY(tl_buffers_unmap(&c->buffers, c->device, TL_BUFFER_RADIANCE, mapped, err));
    } else {
        TRY(tl_cl(clEnqueueReadBuffer(c->device->queue,
                                      c->buffers.of[TL_BUFFER_RADIANCE].memory, CL_TRUE, 0,
                                      size, image->planes, 0, NULL, NULL),
                  "clEnqueueReadBuffer", err));
    }
done:
    return status;
}

tl_status classic_run(void *state, tl_image *image, tl_timings *timings, tl_error *err)
{
    classic *c = state;
    tl_status status = TL_OK;
    double clock = tl_seconds();
    TRY(bind_radiance(c, image->planes, err));
    TRY(tl_buffers_write(&c->buffers, c->device, TL_BUFFER_LIGHTS, c->prepared.lights,
                         c->prepared.frame.light_count * sizeof(tl_view_light), err));
    clock = tl_timings_end(timings, "upload", clock);
    TRY(launch(c, 1, err));
    clock = tl_timings_end(timings, "tiles", clock);
    TRY(read_back(c, image, err));
    tl_timings_end(timings, "readback", clock);
done:
    return status;
}
