/* Does a G-buffer come back from its file bit for bit, and is the file the same for any number of
 * threads? */
#define _POSIX_C_SOURCE 200809L /* setenv */
#include "file_cases.h"

#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"

static const struct {
    uint32_t width, height;
} sizes[] = {{1, 1}, {1, 77}, {130, 1}, {65, 33}, {64, 64}, {257, 40}};

static const uint32_t plane_sets[] = {
    TL_GROUP_BASE,
    TL_GROUP_BASE | TL_GROUP_PHONG,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH,
    TL_GROUP_BASE | TL_GROUP_OCCLUSION,
    TL_GROUP_BASE | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
    TL_GROUP_BASE | TL_GROUP_BRDF,
    TL_GROUP_BASE | TL_HAS(TL_SHININESS) | TL_GROUP_BRDF | TL_GROUP_TANGENT,
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_BRDF | TL_GROUP_TANGENT,
};

static void assert_round_trip_of(const char *name,
                                 const tl_camera *camera,
                                 uint32_t present,
                                 uint32_t samples)
{
    char path[512];
    tl_error err;
    tl_gbuffer *written = NULL, *read = NULL;
    tl_light_set lights = {0};
    bool has_lights = true;
    scratch_path(path, sizeof path, "round_trip.exr");
    ASSERT_OK(tl_gbuffer_create(camera, present, &written, &err), err);
    fill_awkward(written, present + camera->width);
    written->samples = samples;
    ASSERT_OK(tl_gbuffer_write(path, written, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_read(path, &read, &lights, &has_lights, &err), err);
    assert_same_gbuffer(name, read, written);
    assert_false(has_lights);
    assert_int_equal(lights.count, 0);
    tl_gbuffer_destroy(read);
    tl_gbuffer_destroy(written);
    remove(path);
}

static void assert_round_trip(const char *name, const tl_camera *camera, uint32_t present)
{
    assert_round_trip_of(name, camera, present, 1);
}

static void samples_of_a_pixel(void **state)
{
    (void)state;
    for (uint32_t side = 1; side <= 8; side++) {
        const tl_camera camera = awkward_camera(3 * side, 2 * side);
        assert_round_trip_of("samples", &camera, TL_GROUP_BASE, side * side);
    }
}

static void sizes_and_planes(void **state)
{
    (void)state;
    for (size_t s = 0; s < COUNT_OF(sizes); s++)
        for (size_t p = 0; p < COUNT_OF(plane_sets); p++) {
            char name[64];
            const tl_camera camera = awkward_camera(sizes[s].width, sizes[s].height);
            snprintf(name, sizeof name, "%u x %u, planes %x", sizes[s].width, sizes[s].height,
                     plane_sets[p]);
            assert_round_trip(name, &camera, plane_sets[p]);
        }
}

/* An attribute of the header: its name, its type, its size, and the number that OpenEXR gives the kind. */
static int compression_of(const char *path)
{
    static const char name[] = "compression\0compression\0\1\0\0\0";
    static char text[8192];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    for (size_t i = 0; i + sizeof name < size; i++)
        if (memcmp(text + i, name, sizeof name - 1) == 0)
            return text[i + sizeof name - 1];
    fail_msg("%s says no compression", path);
    return -1;
}

/* OpenEXR's numbers are in the order of the table. Packed halves are what b44 and b44a lose bits of, floats
 * pxr24. */
static void compressions_keep_what_they_say(void **state)
{
    static const bool is_exact[] = {
#define IS_EXACT(name, word, exact, meaning) [name] = exact,
        TL_COMPRESSIONS(IS_EXACT)
#undef IS_EXACT
    };
    tl_camera camera = awkward_camera(65, 77);
    char path[512];
    tl_error err;
    tl_gbuffer *full = NULL, *packed = NULL;
    (void)state;
    scratch_path(path, sizeof path, "compressed.exr");
    camera.far = 1e4f; /* of a depth that the layout can say */
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, &full, &err), err);
    fill_awkward(full, 1);
    ASSERT_OK(tl_gbuffer_repair(full, "full", false, NULL, &err), err);
    ASSERT_OK(tl_gbuffer_pack(full, TL_LAYOUT_ISPC, &packed, NULL, &err), err);
    for (int c = 0; c < TL_COMPRESSION_COUNT; c++) {
        const tl_gbuffer *written = c == TL_COMPRESSION_PXR24 ? full : packed;
        const size_t size =
            (size_t)written->rows * written->pitch * tl_gbuffer_pixel_size(written);
        tl_gbuffer *read = NULL;
        ASSERT_OK(tl_gbuffer_write_compressed(path, written, NULL, (tl_compression)c, &err),
                  err);
        ASSERT_OK(tl_gbuffer_read(path, &read, NULL, NULL, &err), err);
        assert_int_equal(compression_of(path), c);
        if ((memcmp(read->planes, written->planes, size) == 0) != is_exact[c])
            fail_msg("compression %d: bits %s", c, is_exact[c] ? "are lost" : "are kept");
        tl_gbuffer_destroy(read);
    }
    remove(path);
    tl_gbuffer_destroy(packed);
    tl_gbuffer_destroy(full);
}

/* Names of any bytes that text can hold; none where there are none. */
static void names_of_materials(void **state)
{
    (void)state;
    static const char *const names[] = {"Gold", "", "\"quoted\", [1]", "B\xc3\xa4umchen"};
    char path[512];
    tl_error err;
    tl_gbuffer *written = NULL, *read = NULL;
    const tl_camera camera = awkward_camera(3, 2);
    scratch_path(path, sizeof path, "names.exr");
    for (size_t count = 0; count <= COUNT_OF(names); count += COUNT_OF(names)) {
        ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &written, &err), err);
        for (size_t i = 0; i < count; i++)
            ASSERT_OK(tl_material_names_add(&written->materials, names[i], &err), err);
        ASSERT_OK(tl_gbuffer_write(path, written, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_read(path, &read, NULL, NULL, &err), err);
        assert_int_equal(read->materials.count, count);
        for (size_t i = 0; i < count; i++)
            assert_string_equal(read->materials.of[i], names[i]);
        tl_gbuffer_destroy(written);
        tl_gbuffer_destroy(read);
    }
    remove(path);
}

/* Its channel is the last of those in ASCII's order: the last word of a pixel. */
static void an_index_is_a_whole_number_in_the_file(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *written = NULL;
    size_t size = 0;
    const tl_camera camera = awkward_camera(1, 1);
    scratch_path(path, sizeof path, "index.exr");
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE | TL_GROUP_BRDF, &written, &err), err);
    tl_gbuffer_plane(written, TL_BRDF)[0] = 200.0f;
    ASSERT_OK(tl_gbuffer_write(path, written, NULL, &err), err);
    unsigned char *bytes = load_bytes(path, &size);
    static const unsigned char wanted[] = {200, 0, 0, 0};
    assert_memory_equal(bytes + size - 4, wanted, 4);
    free(bytes);
    tl_gbuffer_destroy(written);
    remove(path);
}

static void cameras(void **state)
{
    (void)state;
    tl_camera camera = awkward_camera(5, 4);
    camera.far = INFINITY;
    camera.near = 0x1.fffffep-100f;
    assert_round_trip("infinite far plane", &camera, TL_GROUP_BASE);
    camera.view_from_world[0][3] = -0.0f;
    camera.view_from_world[1][3] = 0x1p-149f;
    assert_round_trip("placed at -0 and a denormal", &camera, TL_GROUP_BASE);
    camera.projection = TL_ORTHOGRAPHIC;
    camera.near = -3.0f;
    camera.left = -100.5f;
    assert_round_trip("orthographic from behind", &camera, TL_GROUP_BASE);
}

static void lights_go_along(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *written = NULL, *read = NULL;
    tl_light_set lights = {.ambient = {0.1f, 0.2f, 0.3f}}, back = {0};
    bool has_lights = false;
    const tl_camera camera = awkward_camera(3, 2);
    tl_light light = tl_light_default();
    light.intensity = 1.0f / 3.0f;
    strcpy(light.name, "one \"third\"");
    ASSERT_OK(tl_light_set_add(&lights, &light, &err), err);
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &written, &err), err);
    scratch_path(path, sizeof path, "lights.exr");
    ASSERT_OK(tl_gbuffer_write(path, written, &lights, &err), err);

    ASSERT_OK(tl_gbuffer_read(path, &read, NULL, NULL, &err), err);
    tl_gbuffer_destroy(read);
    ASSERT_OK(tl_gbuffer_read(path, &read, &back, &has_lights, &err), err);
    assert_true(has_lights);
    assert_int_equal(back.count, 1);
    assert_memory_equal(back.ambient, lights.ambient, sizeof back.ambient);
    assert_true(same_bits(back.lights[0].intensity, light.intensity));
    assert_string_equal(back.lights[0].name, light.name);

    tl_light_set_clear(&back);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(read);
    tl_gbuffer_destroy(written);
    remove(path);
}

/* 300 rows are more than any number of threads takes at once. */
static void threads_change_nothing(void **state)
{
    static const char *const threads[] = {"1", "2", "7"};
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *gbuffer = NULL;
    unsigned char *first = NULL;
    size_t first_size = 0;
    const tl_camera camera = awkward_camera(33, 300);
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE | TL_GROUP_EMISSIVE, &gbuffer, &err),
              err);
    fill_awkward(gbuffer, 3);
    scratch_path(path, sizeof path, "threads.exr");
    for (size_t i = 0; i < COUNT_OF(threads); i++) {
        tl_gbuffer *read = NULL;
        size_t size = 0;
        setenv("TILELIGHT_THREADS", threads[i], 1);
        ASSERT_OK(tl_gbuffer_write(path, gbuffer, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_read(path, &read, NULL, NULL, &err), err);
        assert_same_gbuffer(threads[i], read, gbuffer);
        unsigned char *bytes = load_bytes(path, &size);
        if (first) {
            assert_int_equal(size, first_size);
            assert_memory_equal(bytes, first, size);
            free(bytes);
        } else {
            first = bytes;
            first_size = size;
        }
        tl_gbuffer_destroy(read);
    }
    unsetenv("TILELIGHT_THREADS");
    free(first);
    tl_gbuffer_destroy(gbuffer);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_and_planes),
        cmocka_unit_test(compressions_keep_what_they_say),
        cmocka_unit_test(samples_of_a_pixel),
        cmocka_unit_test(names_of_materials),
        cmocka_unit_test(an_index_is_a_whole_number_in_the_file),
        cmocka_unit_test(cameras),
        cmocka_unit_test(lights_go_along),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
