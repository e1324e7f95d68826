/* Does the device read every layout to the same bits as the host?
 *
 * A kernel a layout, with its row and planes as constants, as shading has them; every number of every pixel
 * of hard frames is compared, in vectors and in single lanes, perspective and orthographic. */
#include "layout_frames.h"

#include "packing.h"
#include "probe_program.h"

enum { READ_COUNT = 19 };

/* Usage: PROBE(number); what each kernel does with a layout. Planes of the frame. Global size:
 * blocks across, blocks down. Writes [READ_COUNT][rows][pitch]. */
static const char probe_text[] =
    "#define STORE(v) store_block(v, out + size * n++ + at, frame->pitch)\n"
    "#define STORE_THREE(v) STORE((v).x); STORE((v).y); STORE((v).z)\n"
    "TL_INLINE void read_all(tl_layout layout, tl_needs needs, const tl_frame *frame,\n"
    "                        __global const uchar *planes, __global float *out)\n"
    "{\n"
    "    const uint column = get_global_id(0) * BLOCK_COLUMNS;\n"
    "    const uint row = get_global_id(1) * BLOCK_ROWS;\n"
    "    const size_t size = (size_t)frame->rows * frame->pitch;\n"
    "    const size_t at = (size_t)row * frame->pitch + column;\n"
    "    const tl_words words = load_words(&layout, planes, size, at, frame->pitch);\n"
    "    const vec3 p = position_of(frame, needs, &layout, &words,\n"
    "                               LANE_COLUMN + (scalar)column, LANE_ROW + (scalar)row);\n"
    "    const pixel in = pixel_of(needs, &layout, &words, -p.z);\n"
    "    uint n = 0;\n"
    "    STORE_THREE(p);\n"
    "    STORE_THREE(in.normal);\n"
    "    STORE_THREE(in.albedo);\n"
    "    STORE_THREE(in.specular);\n"
    "    STORE_THREE(in.emissive);\n"
    "    STORE(in.shininess);\n"
    "    STORE(in.metallic);\n"
    "    STORE(in.roughness);\n"
    "    STORE(in.occlusion);\n"
    "}\n"
    "#define PROBE(number)\\\n"
    "__kernel void probe_##number(const tl_frame frame, __global const uchar *planes,\\\n"
    "                             __global float *out)\\\n"
    "{\\\n"
    "    tl_needs needs = needs_of_build();\\\n"
    "    needs.layout = number;\\\n"
    "    read_all(tl_layouts[number], needs, &frame, planes, out);\\\n"
    "}\n";

typedef struct variant {
    uint32_t width, orthographic, present;
} variant;

static void run_probe(const tl_device *device,
                      cl_program program,
                      const variant *v,
                      const tl_gbuffer *g,
                      const tl_frame *frame,
                      float *out)
{
    const size_t pixels = (size_t)g->pitch * g->rows;
    const size_t out_size = READ_COUNT * pixels * sizeof *out;
    const size_t across = v->width == 1 ? 1 : 4, down = v->width == 16 ? 4 : 1;
    const size_t blocks[2] = {HARD_COLUMNS / across, HARD_ROWS / down};
    char name[32];
    cl_int code[3];
    snprintf(name, sizeof name, "probe_%d", (int)g->layout);
    cl_kernel probe = clCreateKernel(program, name, &code[0]);
    cl_mem planes = clCreateBuffer(device->context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                   pixels * tl_gbuffer_pixel_size(g), g->planes, &code[1]);
    cl_mem read = clCreateBuffer(device->context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                                 out_size, out, &code[2]);
    for (int i = 0; i < 3; i++)
        assert_int_equal(code[i], CL_SUCCESS);
    assert_int_equal(clSetKernelArg(probe, 0, sizeof *frame, frame), CL_SUCCESS);
    assert_int_equal(clSetKernelArg(probe, 1, sizeof planes, &planes), CL_SUCCESS);
    assert_int_equal(clSetKernelArg(probe, 2, sizeof read, &read), CL_SUCCESS);
    assert_int_equal(
        clEnqueueNDRangeKernel(device->queue, probe, 2, NULL, blocks, NULL, 0, NULL, NULL),
        CL_SUCCESS);
    assert_int_equal(
        clEnqueueReadBuffer(device->queue, read, CL_TRUE, 0, out_size, out, 0, NULL, NULL),
        CL_SUCCESS);
    clReleaseMemObject(read);
    clReleaseMemObject(planes);
    clReleaseKernel(probe);
}

/* In the order in which the kernel writes. */
static void read_on_host(const tl_gbuffer *g,
                         const tl_frame *frame,
                         tl_needs needs,
                         uint32_t column,
                         uint32_t row,
                         float out[READ_COUNT])
{
    const tl_word_planes planes = tl_word_planes_of(g);
    const tl_words words = tl_words_at(&planes, (size_t)row * g->pitch + column);
    const vec3 p = position_of(frame, needs, planes.layout, &words, (real)column, (real)row);
    const pixel in = pixel_of(needs, planes.layout, &words, -p.z);
    const vec3 threes[] = {p, in.normal, in.albedo, in.specular, in.emissive};
    const float ones[] = {in.shininess, in.metallic, in.roughness, in.occlusion};
    memcpy(out, threes, sizeof threes);
    memcpy(out + 15, ones, sizeof ones);
}

static void layout_agrees(const tl_device *device,
                          cl_program program,
                          const variant *v,
                          const tl_gbuffer *from,
                          enum tl_layout_name layout)
{
    static const char *const names[READ_COUNT] = {
        "x",          "y",          "z",          "normal.x",   "normal.y",
        "normal.z",   "albedo.R",   "albedo.G",   "albedo.B",   "specular.R",
        "specular.G", "specular.B", "emissive.R", "emissive.G", "emissive.B",
        "shininess",  "metallic",   "roughness",  "ao"};
    tl_gbuffer *g = NULL;
    tl_frame frame = {.tile_size = 0};
    tl_error err;
    ASSERT_OK(tl_gbuffer_pack(from, layout, &g, NULL, &err), err);
    tl_view_set(&g->camera, layout, &frame);
    frame.pitch = g->pitch;
    frame.rows = g->rows;
    const size_t pixels = (size_t)g->pitch * g->rows;
    const tl_needs needs = {.present = v->present & tl_layout_planes(layout),
                            .orthographic = v->orthographic,
                            .layout = layout};
    float *out = calloc(READ_COUNT * pixels, sizeof *out);
    assert_non_null(out);
    run_probe(device, program, v, g, &frame, out);
    for (uint32_t i = 0; i < HARD_PIXELS; i++) {
        const uint32_t column = i % HARD_COLUMNS, row = i / HARD_COLUMNS;
        float want[READ_COUNT];
        read_on_host(g, &frame, needs, column, row, want);
        for (size_t n = 0; n < READ_COUNT; n++) {
            const float got = out[n * pixels + (size_t)row * g->pitch + column];
            if (!same_bits(got, want[n]))
                fail_msg("%s, width %u, pixel (%u, %u): %s is %a, on the host %a",
                         tl_layout_word(layout), v->width, column, row, names[n], (double)got,
                         (double)want[n]);
        }
    }
    free(out);
    tl_gbuffer_destroy(g);
}

/* Those of a frame that a layout keeps; 0 where it has no place for such a frame. */
static uint32_t planes_in(const variant *v, int layout)
{
    if ((v->present & TL_GROUP_PHONG) && layout == TL_LAYOUT_DXR)
        return 0;
    return v->present & tl_layout_planes((enum tl_layout_name)layout);
}

/* Kernels for all layouts of these planes: one program, for most of what a build takes is the same for all. */
static cl_program build_probes(const tl_device *device, const variant *v, uint32_t planes)
{
    const tl_kernel_options options = {.width = v->width,
                                       .orthographic = v->orthographic,
                                       .present = planes,
                                       .models = 1,
                                       .falloffs = 1,
                                       .ambient = 1};
    char text[sizeof probe_text + TL_LAYOUT_COUNT * 16];
    size_t length = (size_t)snprintf(text, sizeof text, "%s", probe_text);
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        if (planes_in(v, layout) == planes)
            length +=
                (size_t)snprintf(text + length, sizeof text - length, "PROBE(%d)\n", layout);
    assert_true(length < sizeof text);
    return build_probe(device, &options, text);
}

/* Whether no layout before it has the same planes. */
static int is_first_of_its_planes(const variant *v, int layout)
{
    for (int other = 0; other < layout; other++)
        if (planes_in(v, other) == planes_in(v, layout))
            return 0;
    return 1;
}

static void every_layout_agrees(const tl_device *device, const variant *v, size_t hard)
{
    const tl_camera camera = hard_camera(hard);
    tl_gbuffer *from = hard_layout_frame(&camera, v->present, 42);
    for (int first = 0; first < TL_LAYOUT_COUNT; first++) {
        const uint32_t planes = planes_in(v, first);
        if (planes == 0 || !is_first_of_its_planes(v, first))
            continue;
        cl_program program = build_probes(device, v, planes);
        for (int layout = first; layout < TL_LAYOUT_COUNT; layout++)
            if (planes_in(v, layout) == planes)
                layout_agrees(device, program, v, from, (enum tl_layout_name)layout);
        clReleaseProgram(program);
    }
    tl_gbuffer_destroy(from);
}

/* Cameras of layout_frames.h: 1 has far/near = 1e7, 9 is orthographic with near behind the eye. */
static void vectors_agree_on_phong(void **state)
{
    const variant v = {16, 0,
                       TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE};
    every_layout_agrees(*state, &v, 1);
}

static void lanes_agree_on_metal(void **state)
{
    const variant v = {
        1, 1, TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE};
    every_layout_agrees(*state, &v, 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vectors_agree_on_phong),
        cmocka_unit_test(lanes_agree_on_metal),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
