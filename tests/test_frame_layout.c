/* Do host and device agree on every offset of kernels/frame.h? */
#include "frames.h"

#include "frame.h"
#include "probe_program.h"

/* In the order in which probe_layout writes. */
#define FIELD(type, field)                              \
    {                                                   \
#        type "." #        field, offsetof(type, field) \
    }
static const struct {
    const char *name;
    size_t host;
} fields[] = {
    {"sizeof tl_frame", sizeof(tl_frame)},
    FIELD(tl_frame, rays),
    FIELD(tl_frame, view_from_world),
    FIELD(tl_frame, ambient),
    FIELD(tl_frame, tile_size),
    FIELD(tl_frame, sky),
    FIELD(tl_frame, box_count),
    FIELD(tl_frame, pitch),
    FIELD(tl_frame, rows),
    FIELD(tl_frame, tiles_x),
    FIELD(tl_frame, tiles_y),
    FIELD(tl_frame, box_pitch),
    FIELD(tl_frame, global_count),
    FIELD(tl_frame, light_count),
    FIELD(tl_frame, first_row),
    FIELD(tl_frame, buffer_row),
    FIELD(tl_frame, list_capacity),
    FIELD(tl_frame, cell_capacity),
    FIELD(tl_frame, has_cells),
    FIELD(tl_frame, depth_slope),
    FIELD(tl_frame, depth_offset),
    FIELD(tl_frame, slack_x),
    FIELD(tl_frame, slack_y),
    FIELD(tl_frame, brdfs_at),
    FIELD(tl_frame, shapes_at),
    FIELD(tl_frame, sky_at),
    FIELD(tl_frame, calls_at),
    FIELD(tl_frame, surroundings_at),
    FIELD(tl_frame, exponent),
    FIELD(tl_frame, is_layer),
    FIELD(tl_frame, sky_light_at),
    {"sizeof tl_view_light", sizeof(tl_view_light)},
    FIELD(tl_view_light, position),
    FIELD(tl_view_light, range2),
    FIELD(tl_view_light, diffuse),
    FIELD(tl_view_light, fade),
    FIELD(tl_view_light, specular),
    FIELD(tl_view_light, falloff),
    {"sizeof tl_view_spot", sizeof(tl_view_spot)},
    FIELD(tl_view_spot, axis),
    FIELD(tl_view_spot, least_cos),
    FIELD(tl_view_spot, least_cos2),
    FIELD(tl_view_spot, scale),
    FIELD(tl_view_spot, cull_cos),
    FIELD(tl_view_spot, cull_sin),
};

static void offsets_agree(void **state)
{
    static const tl_kernel_options options = {.width = 8, .present = TL_GROUP_BASE};
    static const size_t one = 1;
    tl_device *device = *state;
    cl_uint on_device[COUNT_OF(fields)] = {0};
    cl_int code;

    cl_program program = build_probe(device, &options, tl_probe_kernel);
    cl_kernel probe = clCreateKernel(program, "probe_layout", &code);
    assert_int_equal(code, CL_SUCCESS);
    cl_mem out =
        clCreateBuffer(device->context, CL_MEM_WRITE_ONLY, sizeof on_device, NULL, &code);
    assert_int_equal(code, CL_SUCCESS);
    assert_int_equal(clSetKernelArg(probe, 0, sizeof out, &out), CL_SUCCESS);
    assert_int_equal(
        clEnqueueNDRangeKernel(device->queue, probe, 1, NULL, &one, &one, 0, NULL, NULL),
        CL_SUCCESS);
    assert_int_equal(clEnqueueReadBuffer(device->queue, out, CL_TRUE, 0, sizeof on_device,
                                         on_device, 0, NULL, NULL),
                     CL_SUCCESS);

    for (size_t i = 0; i < COUNT_OF(fields); i++)
        if (on_device[i] != fields[i].host)
            fail_msg("%s: device %u, host %zu", fields[i].name, on_device[i], fields[i].host);

    clReleaseMemObject(out);
    clReleaseKernel(probe);
    clReleaseProgram(program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(offsets_agree)};
    return cmocka_run_group_tests(tests, open_device, close_device);
}
