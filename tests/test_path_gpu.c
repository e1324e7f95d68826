/* Does the path for GPUs make the lists and the pictures of the path for CPUs, bit for bit?
 *
 * On whatever device there is: PoCL runs work-groups with barriers as well. */
#include "packed_frames.h"

#include "kernel_program.h"
#include "passes.h"

/* Above 4096 lights the path for GPUs lists by cell first; a cell is 8 tiles wide and tall. Kernels of both
 * paths take seconds to build: parallel rays have spots among points as a rule, or stored positions. */
static const struct {
    const char *name;
    uint32_t width, height;
    tl_projection projection;
    uint32_t tile_size, light_count;
    float range;                /* m, at most */
    float sky;                  /* share of the columns that are all sky, from the left */
    enum tl_layout_name layout; /* of stored positions: they are off their rays */
    int spots;                  /* 1: all but every third light */
} cases[] = {
    {"no light", 40, 30, TL_PERSPECTIVE, 16, 0, 1.0f, 0.0f, TL_LAYOUT_FLOAT, 0},
    {"one pixel, one light", 1, 1, TL_PERSPECTIVE, 8, 1, 9.0f, 0.0f, TL_LAYOUT_FLOAT, 0},
    {"as many lights as a group has work-items", 40, 30, TL_PERSPECTIVE, 16, 64, 1.0f, 0.0f,
     TL_LAYOUT_FLOAT, 0},
    {"one more", 40, 30, TL_ORTHOGRAPHIC, 16, 65, 1.0f, 0.0f, TL_LAYOUT_FLOAT, 1},
    {"all lights on all tiles", 61, 40, TL_PERSPECTIVE, 32, 300, 30.0f, 0.0f, TL_LAYOUT_FLOAT,
     0},
    {"a column of pixels", 1, 130, TL_PERSPECTIVE, 8, 500, 1.0f, 0.0f, TL_LAYOUT_FLOAT, 0},
    {"a row of pixels", 300, 1, TL_ORTHOGRAPHIC, 8, 500, 1.0f, 0.0f, TL_LAYOUT_FLOAT, 1},
    {"tiles of nothing but sky", 130, 40, TL_PERSPECTIVE, 16, 500, 1.0f, 0.5f, TL_LAYOUT_FLOAT,
     0},
    {"nothing but sky", 40, 30, TL_PERSPECTIVE, 16, 100, 1.0f, 1.0f, TL_LAYOUT_FLOAT, 0},
    {"tiles larger than the image", 40, 30, TL_PERSPECTIVE, 64, 500, 1.0f, 0.0f,
     TL_LAYOUT_FLOAT, 0},
    {"cells, more than one in both ways", 140, 90, TL_PERSPECTIVE, 8, 5000, 0.3f, 0.2f,
     TL_LAYOUT_FLOAT, 0},
    {"cells, one", 40, 30, TL_ORTHOGRAPHIC, 16, 6000, 0.2f, 0.0f, TL_LAYOUT_FLOAT, 1},
    {"cells, long lists", 70, 70, TL_PERSPECTIVE, 8, 4500, 1.5f, 0.0f, TL_LAYOUT_FLOAT, 0},
    {"positions in world space", 61, 40, TL_ORTHOGRAPHIC, 8, 300, 1.0f, 0.0f,
     TL_LAYOUT_SHADERX2_96, 0},
    {"spots", 61, 40, TL_PERSPECTIVE, 16, 300, 3.0f, 0.1f, TL_LAYOUT_FLOAT, 1},
    {"spots, cells", 140, 90, TL_ORTHOGRAPHIC, 8, 5000, 0.8f, 0.2f, TL_LAYOUT_FLOAT, 1},
    {"spots, positions in view space", 61, 40, TL_PERSPECTIVE, 8, 300, 3.0f, 0.0f,
     TL_LAYOUT_MERLIN_POSITION, 1},
};

enum { WITH_CELLS = 10 }; /* the case of more than one cell */

/* Takes g. */
static tl_gbuffer *in_layout(tl_gbuffer *g, enum tl_layout_name layout)
{
    tl_gbuffer *packed = NULL;
    tl_error err;
    if (layout == TL_LAYOUT_FLOAT)
        return g;
    ASSERT_OK(tl_gbuffer_repair(g, "random", false, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_pack(g, layout, &packed, NULL, &err), err);
    tl_gbuffer_destroy(g);
    move_positions(packed, 5);
    return packed;
}

static tl_gbuffer *frame_of_case(size_t i)
{
    const tl_camera camera = camera_of(cases[i].width, cases[i].height, cases[i].projection);
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, 1977);
    float *depths = tl_gbuffer_plane(g, TL_DEPTH);
    for (uint32_t y = 0; y < cases[i].height; y++)
        for (uint32_t x = 0; x < cases[i].width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            if ((float)x < cases[i].sky * (float)cases[i].width)
                depths[at] = INFINITY;
            else if ((x + y) % 3 == 0)
                depths[at] *= 2.0f; /* tiles that two boxes bound */
        }
    return in_layout(g, cases[i].layout);
}

static void lights_of_case(size_t i, const tl_gbuffer *g, tl_light_set *lights)
{
    uint32_t seed = 1;
    tl_error err;
    tl_light lamp = tl_light_default();
    ASSERT_OK(tl_light_set_add(lights, &lamp, &err),
              err); /* reaches everything: is not listed */
    for (uint32_t k = 0; k < cases[i].light_count; k++) {
        tl_light light = random_light(&g->camera, &seed, 0.01f, cases[i].range);
        if (cases[i].spots && k % 3 != 0)
            aim_at_random(&light, &seed);
        ASSERT_OK(tl_light_set_add(lights, &light, &err), err);
    }
}

/* The lists of a frame: tile t has list[starts[t]] to list[ends[t] - 1]. */
typedef struct lists {
    uint32_t *starts, *ends, *list;
} lists;

static uint32_t *copy_of(tl_pass_context *c, tl_buffer_name name, size_t count)
{
    void *mapped = NULL;
    uint32_t *copy = malloc((count + 1) * sizeof *copy);
    tl_error err;
    assert_non_null(copy);
    if (count == 0)
        return copy;
    ASSERT_OK(tl_buffers_map(c->buffers, c->device, name, CL_MAP_READ, count * sizeof *copy,
                             &mapped, &err),
              err);
    memcpy(copy, mapped, count * sizeof *copy);
    ASSERT_OK(tl_buffers_unmap(c->buffers, c->device, name, mapped, &err), err);
    return copy;
}

static lists cull(const tl_device *device,
                  const tl_prepared *prepared,
                  tl_gbuffer *g,
                  const tl_program *program,
                  int by_pixel)
{
    const size_t tiles = tl_tile_count(&prepared->frame);
    tl_buffers buffers = {0};
    tl_pass_context c = {.device = device,
                         .programs = {[TL_PART_CULL] = program},
                         .buffers = &buffers,
                         .prepared = prepared,
                         .frame = prepared->frame,
                         .by_pixel = by_pixel};
    const size_t lights_size = tl_prepared_lights_size(prepared);
    const size_t planes_size = gbuffer_bytes(g);
    tl_list_lengths lengths;
    double ms = 0.0;
    tl_error err;
    ASSERT_OK(tl_buffers_reserve(&buffers, device, TL_BUFFER_PLANES, planes_size, &err), err);
    ASSERT_OK(
        tl_buffers_write(&buffers, device, TL_BUFFER_PLANES, g->planes, planes_size, &err),
        err);
    ASSERT_OK(tl_buffers_reserve(&buffers, device, TL_BUFFER_LIGHTS, lights_size, &err), err);
    ASSERT_OK(tl_buffers_write(&buffers, device, TL_BUFFER_LIGHTS, prepared->lights,
                               lights_size, &err),
              err);
    ASSERT_OK(tl_pass_cull(&c, &lengths, &ms, &err), err);
    while (!tl_lists_fit(&c, &lengths))
        ASSERT_OK(tl_pass_cull_again(&c, &lengths, &ms, &err), err);
    const lists made = {copy_of(&c, TL_BUFFER_STARTS, tiles),
                        copy_of(&c, TL_BUFFER_ENDS, tiles),
                        copy_of(&c, TL_BUFFER_LIST, lengths.tiles)};
    ASSERT_OK(tl_pass_finish(&c, &err), err);
    tl_buffers_release(&buffers);
    return made;
}

static void assert_same_lists(const lists *got,
                              const lists *want,
                              size_t tiles,
                              const char *what)
{
    for (size_t tile = 0; tile < tiles; tile++) {
        const uint32_t length = want->ends[tile] - want->starts[tile];
        if (got->ends[tile] - got->starts[tile] != length)
            fail_msg("%s: tile %zu lists %u lights, not %u", what, tile,
                     got->ends[tile] - got->starts[tile], length);
        assert_memory_equal(got->list + got->starts[tile], want->list + want->starts[tile],
                            length * sizeof(uint32_t));
    }
}

/* The first is the pattern of the others. */
static const struct {
    const char *name;
    int by_pixel, rects_on_host; /* the latter as on a device without double */
} ways[] = {{"cpu", 0, 0}, {"gpu", 1, 0}, {"gpu without double", 1, 1}};

static void lists_are_the_same(void **state)
{
    tl_device *device = *state;
    const uint32_t widest = tl_device_describe(device).vector_width;
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        for (uint32_t box_count = 0; box_count <= 2 && cases[i].light_count > 0; box_count++) {
            tl_gbuffer *g = frame_of_case(i);
            tl_light_set lights = {0};
            tl_prepared prepared = {0};
            lists made[COUNT_OF(ways)];
            tl_error err;
            lights_of_case(i, g, &lights);
            ASSERT_OK(tl_prepare(g, &lights,
                                 &(tl_prepare_options){.tile_size = cases[i].tile_size,
                                                       .box_count = box_count},
                                 NULL, &prepared, &err),
                      err);
            for (size_t way = 0; way < COUNT_OF(ways); way++) {
                const uint32_t width = ways[way].by_pixel ? 1 : widest;
                const tl_kernel_options options = {.width = width,
                                                   .by_pixel = (uint32_t)ways[way].by_pixel,
                                                   .orthographic = prepared.needs.orthographic,
                                                   .layout = prepared.needs.layout,
                                                   .present = prepared.needs.present,
                                                   .spots = prepared.needs.spots};
                const tl_program *found = NULL;
                ASSERT_OK(tl_program_find(device, TL_PART_CULL, &options, NULL, &found, &err),
                          err);
                tl_program program = *found;
                if (ways[way].rects_on_host)
                    program.light_rects = NULL;
                made[way] = cull(device, &prepared, g, &program, ways[way].by_pixel);
            }
            for (size_t way = 0; way < COUNT_OF(ways); way++) {
                char what[160];
                snprintf(what, sizeof what, "%s, %u boxes, %s", cases[i].name, box_count,
                         ways[way].name);
                assert_same_lists(&made[way], &made[0], tl_tile_count(&prepared.frame), what);
            }
            for (size_t way = 0; way < COUNT_OF(ways); way++) {
                free(made[way].starts);
                free(made[way].ends);
                free(made[way].list);
            }
            tl_prepared_clear(&prepared);
            tl_light_set_clear(&lights);
            tl_gbuffer_destroy(g);
        }
}

/* In float the twin stands for the path for CPUs, whose lists are seen to be the same above: that they agree
 * is what tests/test_same_bits.c asks, and a program of it takes seconds to build. */
static void same_picture(tl_device *device, size_t i, tl_precision precision)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *g = frame_of_case(i);
    tl_image *want = image_like(g), *got = image_like(g);
    tl_light_set lights = {0};
    lights_of_case(i, g, &lights);
    options.precision = precision == TL_PRECISION_FLOAT ? TL_PRECISION_TWIN : precision;
    options.tile_size = cases[i].tile_size;
    options.path = TL_PATH_CPU;
    light_frame(device, &options, g, &lights, want);
    options.precision = precision;
    options.path = TL_PATH_GPU;
    light_frame(device, &options, g, &lights, got);
    assert_same_image(got, want, cases[i].name);
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

static void pictures_are_the_same(void **state)
{
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        same_picture(*state, i, TL_PRECISION_FLOAT);
    same_picture(*state, WITH_CELLS, TL_PRECISION_DOUBLE);
}

static void bands_do_not_show(void **state)
{
    tl_gbuffer *g = frame_of_case(WITH_CELLS);
    tl_image *want = image_like(g), *got = image_like(g);
    tl_light_set lights = {0};
    tl_lighting_options options = tl_lighting_options_default();
    lights_of_case(WITH_CELLS, g, &lights);
    options.tile_size = cases[WITH_CELLS].tile_size;
    options.path = TL_PATH_GPU;
    const tl_lighting_counts whole = light_frame(*state, &options, g, &lights, want);
    options.memory_limit = whole.device_bytes * 15 / 16; /* most of it is lights */
    const tl_lighting_counts parts = light_frame(*state, &options, g, &lights, got);
    assert_same_image(got, want, "bands");
    assert_in_range(parts.band_count, 2, 12);
    assert_in_range(parts.device_bytes, 1, options.memory_limit);
    assert_int_equal(parts.list_length, whole.list_length);
    tl_light_set_clear(&lights);
    tl_image_destroy(want);
    tl_image_destroy(got);
    tl_gbuffer_destroy(g);
}

static void vectors_are_refused(void **state)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_lighting *lighting = NULL;
    tl_error err;
    options.path = TL_PATH_GPU;
    options.vector_width = 8;
    assert_int_equal(tl_lighting_create(*state, &options, &lighting, &err), TL_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "--path"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_are_the_same),
        cmocka_unit_test(pictures_are_the_same),
        cmocka_unit_test(bands_do_not_show),
        cmocka_unit_test(vectors_are_refused),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
