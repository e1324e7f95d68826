/* Do layers come back from a G-buffer's file as they went in, in every layout, and are damaged ones refused
 * or repaired? */
#include "layered_frames.h"

#include "camera_attributes.h"
#include "exr_writer.h"
#include "layer_parts.h"

#include "tilelight/gbuffer_file.h"

enum { WIDTH = 70, HEIGHT = 37, LAYERS = 3, LEFT = 29 };

static tl_gbuffer *frame(void)
{
    const tl_camera camera = camera_of(WIDTH, HEIGHT, TL_PERSPECTIVE);
    tl_gbuffer *g =
        layered_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_EMISSIVE, LAYERS, 3);
    g->layers.left = LEFT;
    return g;
}

static void assert_same_surface(const tl_gbuffer *a, const tl_gbuffer *b, const char *what)
{
    const size_t size = (size_t)b->pitch * b->rows * tl_gbuffer_pixel_size(b);
    assert_int_equal(a->layout, b->layout);
    assert_int_equal(a->present, b->present);
    assert_int_equal(a->samples, b->samples);
    assert_memory_equal(&a->camera, &b->camera, sizeof a->camera);
    if (memcmp(a->planes, b->planes, size) != 0)
        fail_msg("%s: words differ", what);
}

static void assert_same_layers(const tl_gbuffer *got, const tl_gbuffer *want, const char *what)
{
    assert_int_equal(got->layers.count, want->layers.count);
    assert_int_equal(got->layers.left, want->layers.left);
    for (uint32_t i = 0; i < want->layers.count; i++) {
        const tl_gbuffer *a = got->layers.of[i], *b = want->layers.of[i];
        assert_same_surface(a, b, what);
        assert_ptr_equal(a->layer_of, got);
        assert_memory_equal(a->opacity, b->opacity, (size_t)b->pitch * b->rows * sizeof(float));
    }
}

static void they_come_back_in_every_layout(void **state)
{
    char path[512];
    tl_error err;
    tl_gbuffer *full = frame();
    (void)state;
    scratch_path(path, sizeof path, "layers.exr");
    for (int i = 0; i < TL_LAYOUT_COUNT; i++) {
        const enum tl_layout_name layout = (enum tl_layout_name)i;
        tl_gbuffer *packed = NULL, *back = NULL;
        if (tl_gbuffer_pack(full, layout, &packed, NULL, &err) != TL_OK)
            continue; /* holds no Phong material */
        packed->samples = 1;
        ASSERT_OK(tl_gbuffer_write_compressed(path, packed, NULL,
                                              i % 2 ? TL_COMPRESSION_ZIP : TL_COMPRESSION_NONE,
                                              &err),
                  err);
        ASSERT_OK(tl_gbuffer_read(path, &back, NULL, NULL, &err), err);
        assert_same_surface(back, packed, tl_layout_word(layout));
        assert_same_layers(back, packed, tl_layout_word(layout));
        tl_gbuffer_destroy(back);
        tl_gbuffer_destroy(packed);
    }
    tl_gbuffer_destroy(full);
}

/* Beside shadow maps, whose parts come between. */
static void they_share_a_file_with_shadow_maps(void **state)
{
    char path[512];
    tl_error err;
    tl_gbuffer *g = frame(), *back = NULL;
    const float axis[3] = {0, 0, -1};
    tl_shadow_map map = {.kind = TL_SHADOW_SPOT, .size = 64, .direction = {0, 0, -1}};
    (void)state;
    tl_shadow_views_from(&map, axis, 0.7, 1e-4);
    ASSERT_OK(tl_shadow_maps_add(&g->shadows, &map, &err), err);
    scratch_path(path, sizeof path, "layers-and-shadows.exr");
    ASSERT_OK(tl_gbuffer_write(path, g, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_read(path, &back, NULL, NULL, &err), err);
    assert_same_layers(back, g, "beside shadow maps");
    assert_int_equal(back->shadows.count, 1);
    tl_gbuffer_destroy(back);
    tl_gbuffer_destroy(g);
}

/* --- damaged ones ------------------------------------------------------------------------------------ */

/* What is wrong with the file of one layer of 8 x 8 pixels that is written here part by part. */
typedef enum fault {
    NONE,
    TOO_FEW,
    TOO_MANY,
    BEYOND_ALL,
    WRONG_INDEX,
    INDEX_OF_TEXT,
    COUNT_OF_TEXT,
    LEFT_BELOW_0,
    OTHER_EXTENT,
    NO_OPACITY,
    HALF_OPACITY,
    NO_NORMAL
} fault;

static const struct {
    fault what;
    const char *words[2];
} faults[] = {
    {NONE, {"", ""}},
    {TOO_FEW, {"has 1 layers", "says 2"}},
    {TOO_MANY, {"layer.0", "too many"}},
    {BEYOND_ALL, {"tilelight:layers", "65"}},
    {WRONG_INDEX, {"layer.0", "is layer 1, where layer 0"}},
    {INDEX_OF_TEXT, {"layer.0", "\"tilelight:layer\" of type int"}},
    {COUNT_OF_TEXT, {"\"tilelight:layers\"", "type int"}},
    {LEFT_BELOW_0, {"tilelight:layersLeft", "-1"}},
    {OTHER_EXTENT, {"layer.0", "8 x 7"}},
    {NO_OPACITY, {"layer.0", "\"opacity\" of type float"}},
    {HALF_OPACITY, {"layer.0", "\"opacity\" of type float"}},
    {NO_NORMAL, {"layer.0", "\"N.Y\" of type float"}},
};

enum { SIDE = 8, CHANNELS = 8 };
static const char *const channel_names[CHANNELS] = {
    "Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B", TL_OPACITY_CHANNEL};

/* The channels of a part, of which one may be left out or be of halves. */
static tl_exr_picture picture(
    tl_exr_channel channels[CHANNELS], size_t count, int without, int half, uint32_t height)
{
    static const float ones[SIDE * SIDE] = {1.0f};
    size_t used = 0;
    for (size_t i = 0; i < count; i++)
        if ((int)i != without)
            channels[used++] =
                (tl_exr_channel){.name = channel_names[i],
                                 .type = (int)i == half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                                 .held = EXR_PIXEL_FLOAT,
                                 .plane = ones};
    return (tl_exr_picture){.width = SIDE,
                            .height = height,
                            .pitch = SIDE,
                            .channel_count = used,
                            .channels = channels};
}

static void set_attributes(tl_exr_writer *writer, fault what, const tl_camera *camera)
{
    const exr_context_t file = writer->stream.context;
    const int count = what == TOO_FEW ? 2 : what == TOO_MANY ? 0 : what == BEYOND_ALL ? 65 : 1;
    tl_error err;
    exr_attr_set_int(file, 0, "tilelight:version", 1);
    exr_attr_set_string(file, 0, "tilelight:layout", "float");
    ASSERT_OK(tl_camera_attributes_write(&writer->stream, 0, camera, &err), err);
    if (what == COUNT_OF_TEXT)
        exr_attr_set_string(file, 0, "tilelight:layers", "1");
    else
        exr_attr_set_int(file, 0, "tilelight:layers", count);
    exr_attr_set_int(file, 0, "tilelight:layersLeft", what == LEFT_BELOW_0 ? -1 : 0);
    if (what == INDEX_OF_TEXT)
        exr_attr_set_string(file, 1, "tilelight:layer", "0");
    else
        exr_attr_set_int(file, 1, "tilelight:layer", what == WRONG_INDEX);
}

static void write_faulty(const char *path, fault what)
{
    const tl_camera camera = camera_of(SIDE, SIDE, TL_PERSPECTIVE);
    const uint32_t height = what == OTHER_EXTENT ? SIDE - 1 : SIDE;
    tl_exr_writer writer = {.stream.context = NULL};
    tl_exr_channel channels[2][CHANNELS];
    tl_error err;
    const int without = what == NO_OPACITY ? CHANNELS - 1 : what == NO_NORMAL ? 2 : -1;
    const tl_exr_picture pictures[2] = {picture(channels[0], CHANNELS - 1, -1, -1, SIDE),
                                        picture(channels[1], CHANNELS, without,
                                                what == HALF_OPACITY ? CHANNELS - 1 : -1,
                                                height)};
    ASSERT_OK(tl_exr_writer_open(&writer, path, &err), err);
    ASSERT_OK(tl_exr_writer_add(&writer, "surface", SIDE, SIDE, EXR_COMPRESSION_NONE, &err),
              err);
    ASSERT_OK(tl_exr_writer_add(&writer, "layer.0", SIDE, height, EXR_COMPRESSION_NONE, &err),
              err);
    set_attributes(&writer, what, &camera);
    ASSERT_OK(tl_exr_writer_parts(&writer, pictures, 2, &err), err);
    ASSERT_OK(tl_exr_writer_commit(&writer, &err), err);
}

static void damaged_ones_are_refused(void **state)
{
    char path[512];
    (void)state;
    scratch_path(path, sizeof path, "damaged-layers.exr");
    for (size_t i = 0; i < COUNT_OF(faults); i++) {
        tl_gbuffer *back = NULL;
        tl_error err = {.status = TL_OK};
        write_faulty(path, faults[i].what);
        const tl_status status = tl_gbuffer_read(path, &back, NULL, NULL, &err);
        if (faults[i].what == NONE) {
            ASSERT_OK(status, err);
            assert_int_equal(back->layers.count, 1);
            tl_gbuffer_destroy(back);
            continue;
        }
        assert_int_equal(status, TL_ERR_FORMAT);
        assert_null(back);
        for (int w = 0; w < 2; w++)
            if (!strstr(err.message, faults[i].words[w]))
                fail_msg("\"%s\" does not say \"%s\"", err.message, faults[i].words[w]);
    }
}

/* Opacities that are none are repaired and counted, or refused by name; where there is sky they are 0. */
static void opacities_are_repaired(void **state)
{
    static const float bad[] = {NAN, -0.25f, INFINITY, 1.5f}, good[] = {0.0f, 0.0f, 0.0f, 1.0f};
    tl_error err;
    tl_repairs repairs;
    tl_gbuffer *g = frame();
    (void)state;
    float *opacity = g->layers.of[1]->opacity + g->pitch;
    float *depth = tl_gbuffer_plane(g->layers.of[1], TL_DEPTH) + g->pitch;
    float *normal = tl_gbuffer_plane(g->layers.of[1], TL_NORMAL_Z);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        depth[i] = 4.5f;
        normal[g->pitch + i] = 1.0f;
    }
    normal[9 * g->pitch + 3] = 1.0f;
    opacity[COUNT_OF(bad)] = 0.5f;
    depth[COUNT_OF(bad)] = INFINITY;
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        opacity[i] = bad[i];
    assert_int_equal(tl_gbuffer_repair(g, "G.exr", true, NULL, &err), TL_ERR_FORMAT);
    assert_non_null(strstr(err.message, "G.exr: layer 1: pixel (0, 1), channel opacity"));
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        opacity[i] = bad[i];
    ASSERT_OK(tl_gbuffer_repair(g, "G.exr", false, &repairs, &err), err);
    assert_int_equal(repairs.value, COUNT_OF(bad));
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_true(same_bits(opacity[i], good[i]));
    assert_true(same_bits(opacity[COUNT_OF(bad)], 0.0f));
    /* Rows that show nothing are known. */
    memset(g->layers.of[1]->opacity, 0, (size_t)g->pitch * g->rows * sizeof(float));
    g->layers.of[1]->opacity[9 * g->pitch + 3] = 0.5f;
    tl_gbuffer_plane(g->layers.of[1], TL_DEPTH)[9 * g->pitch + 3] = 4.5f;
    ASSERT_OK(tl_gbuffer_repair(g, "G.exr", true, &repairs, &err), err);
    assert_int_equal(g->layers.of[1]->shown_from, 9);
    assert_int_equal(g->layers.of[1]->shown_to, 10);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(they_come_back_in_every_layout),
        cmocka_unit_test(they_share_a_file_with_shadow_maps),
        cmocka_unit_test(damaged_ones_are_refused),
        cmocka_unit_test(opacities_are_repaired),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
