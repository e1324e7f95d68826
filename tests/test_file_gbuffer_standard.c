/* Do the parts of a G-buffer file that other programs read say what OpenEXR defines: the two
 * matrices, the windows, the preview? */
#include "file_cases.h"

#include "tilelight/gbuffer_file.h"
#include "tilelight/image.h"

#include <openexr.h>

enum { WIDTH = 4, HEIGHT = 2 };

/* At (1, 2, 3), looking along world +x with +z above: right is -y. */
static tl_camera sideways_camera(void)
{
    return (tl_camera){.projection = TL_PERSPECTIVE,
                       .width = WIDTH,
                       .height = HEIGHT,
                       .left = -1.0f,
                       .right = 3.0f,
                       .bottom = -0.5f,
                       .top = 1.5f,
                       .near = 0.5f,
                       .far = 8.0f,
                       .view_from_world = {{0.0f, -1.0f, 0.0f, 2.0f},
                                           {0.0f, 0.0f, 1.0f, -3.0f},
                                           {-1.0f, 0.0f, 0.0f, 1.0f}}};
}

/* Worked out by hand from the camera above. camera: x right, y up, z forward from (1, 2, 3).
 * ndc in perspective: x = (x/z - left) / 4, y = (top - y/z) / 2; orthographic without "/z". */
static const struct {
    const char *name;
    double world[3], camera[3], perspective[2], orthographic[2];
} points[] = {
    {"straight ahead", {5, 2, 3}, {0, 0, 4}, {0.25, 0.75}, {0.25, 0.75}},
    {"right", {3, 0, 3}, {2, 0, 2}, {0.5, 0.75}, {0.75, 0.75}},
    {"up", {3, 2, 4}, {0, 1, 2}, {0.25, 0.5}, {0.25, 0.25}},
    {"upper left corner of the image", {2, 3, 4.5}, {-1, 1.5, 1}, {0, 0}, {0, 0}},
    {"lower right corner of the image", {2, -1, 2.5}, {3, -0.5, 1}, {1, 1}, {1, 1}},
};

static exr_context_t open_header(const char *path)
{
    exr_context_t context = NULL;
    assert_int_equal(exr_start_read(&context, path, NULL), EXR_ERR_SUCCESS);
    return context;
}

/* Row vector times matrix, divided by w, as OpenEXR and Imath have it. */
static void apply(const exr_attr_m44f_t *matrix, const double in[3], double out[3])
{
    double sums[4];
    for (int column = 0; column < 4; column++) {
        sums[column] = (double)matrix->m[12 + column];
        for (int row = 0; row < 3; row++)
            sums[column] += in[row] * (double)matrix->m[4 * row + column];
    }
    for (int i = 0; i < 3; i++)
        out[i] = sums[i] / sums[3];
}

static void assert_matrices(const tl_camera *camera, const char *path)
{
    tl_error err;
    tl_gbuffer *gbuffer = NULL;
    exr_attr_m44f_t to_camera, to_ndc;
    ASSERT_OK(tl_gbuffer_create(camera, TL_GROUP_BASE, &gbuffer, &err), err);
    ASSERT_OK(tl_gbuffer_write(path, gbuffer, NULL, &err), err);
    tl_gbuffer_destroy(gbuffer);
    exr_context_t file = open_header(path);
    assert_int_equal(exr_attr_get_m44f(file, 0, "worldToCamera", &to_camera), EXR_ERR_SUCCESS);
    assert_int_equal(exr_attr_get_m44f(file, 0, "worldToNDC", &to_ndc), EXR_ERR_SUCCESS);
    exr_finish(&file);
    remove(path);

    for (size_t i = 0; i < COUNT_OF(points); i++) {
        const double *ndc = camera->projection == TL_PERSPECTIVE ? points[i].perspective
                                                                 : points[i].orthographic;
        double got[3];
        apply(&to_camera, points[i].world, got);
        for (int axis = 0; axis < 3; axis++)
            if (fabs(got[axis] - points[i].camera[axis]) > 0.0)
                fail_msg("%s: camera axis %d is %g, not %g", points[i].name, axis, got[axis],
                         points[i].camera[axis]);
        apply(&to_ndc, points[i].world, got);
        for (int axis = 0; axis < 2; axis++)
            if (fabs(got[axis] - ndc[axis]) > 0x1p-22) /* entries near 1, rounded to float */
                fail_msg("%s: NDC axis %d is %g, not %g", points[i].name, axis, got[axis],
                         ndc[axis]);
        const double depth = points[i].camera[2];
        const double z = camera->projection == TL_PERSPECTIVE
                             ? (depth - 0.5) * 8.0 / (7.5 * depth)
                             : (depth - 0.5) / 7.5;
        if (fabs(got[2] - z) > 0x1p-21)
            fail_msg("%s: NDC depth is %g, not %g", points[i].name, got[2], z);
    }
}

static void matrices(void **state)
{
    (void)state;
    char path[512];
    tl_camera camera = sideways_camera();
    scratch_path(path, sizeof path, "matrices.exr");
    assert_matrices(&camera, path);
    camera.projection = TL_ORTHOGRAPHIC;
    assert_matrices(&camera, path);
}

static void windows_and_types(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *gbuffer = NULL;
    exr_attr_box2i_t data, display;
    exr_compression_t compression;
    const exr_attr_chlist_t *channels;
    const tl_camera camera = sideways_camera();
    scratch_path(path, sizeof path, "windows.exr");
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &gbuffer, &err), err);
    ASSERT_OK(tl_gbuffer_write(path, gbuffer, NULL, &err), err);
    exr_context_t file = open_header(path);
    assert_int_equal(exr_get_data_window(file, 0, &data), EXR_ERR_SUCCESS);
    assert_int_equal(exr_get_display_window(file, 0, &display), EXR_ERR_SUCCESS);
    assert_memory_equal(&data, &display, sizeof data);
    assert_int_equal(data.min.x, 0);
    assert_int_equal(data.min.y, 0);
    assert_int_equal(data.max.x, WIDTH - 1);
    assert_int_equal(data.max.y, HEIGHT - 1);
    assert_int_equal(exr_get_compression(file, 0, &compression), EXR_ERR_SUCCESS);
    assert_int_equal(compression, EXR_COMPRESSION_NONE);
    assert_int_equal(exr_get_channels(file, 0, &channels), EXR_ERR_SUCCESS);
    assert_int_equal(channels->num_channels, 11);
    for (int i = 0; i < channels->num_channels; i++) {
        const int is_preview = strchr("RGBA", channels->entries[i].name.str[0]) &&
                               channels->entries[i].name.str[1] == '\0';
        assert_int_equal(channels->entries[i].pixel_type,
                         is_preview ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT);
    }
    exr_finish(&file);
    tl_gbuffer_destroy(gbuffer);
    remove(path);
}

/* Pixel (0, 0) of the camera above sees along x = -0.5, y = 1 at depth 1, so V in the camera is
 * (0.5, -1, 1) / 1.5 with z backwards, and its share along the view axis is 2/3. */
static void preview(void **state)
{
    (void)state;
    char path[512];
    tl_error err;
    tl_gbuffer *gbuffer = NULL;
    tl_image *image = NULL;
    const tl_camera camera = sideways_camera();
    scratch_path(path, sizeof path, "preview.exr");
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE | TL_GROUP_EMISSIVE, &gbuffer, &err),
              err);
    tl_gbuffer_plane(gbuffer, TL_DEPTH)[0] = 1.0f;
    tl_gbuffer_plane(gbuffer, TL_NORMAL_X)[0] = 1.0f; /* along the view axis, facing away */
    tl_gbuffer_plane(gbuffer, TL_ALBEDO_R)[0] = 0.75f;
    tl_gbuffer_plane(gbuffer, TL_ALBEDO_G)[0] = 0.375f;
    tl_gbuffer_plane(gbuffer, TL_EMISSIVE_G)[0] = 2.0f;
    tl_gbuffer_plane(gbuffer, TL_EMISSIVE_B)[0] = 1e6f;
    tl_gbuffer_plane(gbuffer, TL_EMISSIVE_R)[1] = 5.0f; /* of a sky pixel: not shown */
    ASSERT_OK(tl_gbuffer_write(path, gbuffer, NULL, &err), err);
    ASSERT_OK(tl_image_read(path, &image, NULL, &err), err);
    /* Half has 11 bits: rounding moves a value by 2^-12 of it at most; 2^-20 for the float. */
    assert_true(fabs((double)tl_image_plane(image, 0)[0] - 0.5) <= 0.5 * (0x1p-12 + 0x1p-20));
    assert_true(fabs((double)tl_image_plane(image, 1)[0] - 2.25) <= 2.25 * (0x1p-12 + 0x1p-20));
    assert_true(same_bits(tl_image_plane(image, 2)[0], 65504.0f));
    assert_true(same_bits(tl_image_plane(image, 0)[1], 0.0f));
    tl_image_destroy(image);
    tl_gbuffer_destroy(gbuffer);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrices),
        cmocka_unit_test(windows_and_types),
        cmocka_unit_test(preview),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
