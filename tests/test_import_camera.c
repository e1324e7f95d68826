/* Does a camera file say the camera that it describes, is a wrong one refused by a sentence that names the
 * field, and is a camera that nobody described asked for? */
#include "testing.h"

#include "foreign_exr.h"
#include "foreign_frame.h"
#include "plan.h"

enum { WIDTH = 200, HEIGHT = 100 };

/* Worked out by hand: tan(45/2 degrees) = sqrt(2) - 1; a sensor of 36 x 18 behind 24 mm: 9/24; pixels are
 * square, the frame twice as wide as high. */
static const struct {
    const char *name, *json;
    tl_projection projection;
    double top, right;
    double rows[3][4]; /* of view_from_world */
    double near, far;
} good[] = {
    {"vertical angle, matrix",
     "{\"tilelight\":1,\"verticalFov\":45,\"worldFromView\":[[1,0,0,2],[0,1,0,3],[0,0,1,4]]}",
     TL_PERSPECTIVE,
     0.41421356237309503,
     0.8284271247461901,
     {{1, 0, 0, -2}, {0, 1, 0, -3}, {0, 0, 1, -4}},
     0,
     0},
    /* Blender's axes: looking along +y, z up. */
    {"horizontal angle, four rows, near and far",
     "{\"tilelight\":1,\"horizontalFov\":90,\"near\":0.5,\"far\":80,"
     "\"worldFromView\":[[1,0,0,1],[0,0,-1,2],[0,1,0,3],[0,0,0,1]]}",
     TL_PERSPECTIVE,
     0.5,
     1.0,
     {{1, 0, 0, -1}, {0, 0, 1, -3}, {0, -1, 0, 2}},
     0.5,
     80},
    {"sensor width, points",
     "{\"tilelight\":1,\"focalLength\":24,\"sensorWidth\":36,\"position\":[0,0,5],"
     "\"target\":[0,0,1]}",
     TL_PERSPECTIVE,
     0.375,
     0.75,
     {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -5}},
     0,
     0},
    {"sensor height, another up",
     "{\"tilelight\":1,\"focalLength\":24,\"sensorHeight\":18,\"position\":[0,-5,0],"
     "\"target\":[0,0,0],\"up\":[0,0,2]}",
     TL_PERSPECTIVE,
     0.375,
     0.75,
     {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, -5}},
     0,
     0},
    {"orthographic",
     "{\"tilelight\":1,\"orthographicHeight\":6,\"position\":[0,0,5],\"target\":[0,0,1]}",
     TL_ORTHOGRAPHIC,
     3.0,
     6.0,
     {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -5}},
     0,
     0},
};

#define PLACE "\"position\":[0,0,5],\"target\":[0,0,1]"
#define LENS "\"verticalFov\":45"
static const struct {
    const char *json, *words[3];
} bad[] = {
    {"", {"line 1", NULL}},
    {"[]", {"object", NULL}},
    {"{}", {"no camera file", "\"tilelight\": 1", NULL}},
    {"{\"tilelight\":\"1\"," PLACE "," LENS "}", {"no camera file", NULL}},
    {"{\"tilelight\":2," PLACE "," LENS "}", {"version 2", "version 1", NULL}},
    {"{\"tilelight\":1," PLACE ",\"verticalfov\":45}", {"verticalfov", "verticalFov", NULL}},
    {"{\"tilelight\":1," PLACE "," LENS ",\"tilt\":0}", {"unknown field \"tilt\"", NULL}},
    {"{\"tilelight\":1," PLACE "}", {"verticalFov", "must say what the camera sees", NULL}},
    {"{\"tilelight\":1," PLACE "," LENS ",\"horizontalFov\":50}", {"only one", NULL}},
    {"{\"tilelight\":1," PLACE "," LENS ",\"orthographicHeight\":5}", {"only one", NULL}},
    {"{\"tilelight\":1," PLACE ",\"focalLength\":50}", {"sensorWidth", NULL}},
    {"{\"tilelight\":1," PLACE ",\"focalLength\":50,\"sensorWidth\":3,\"sensorHeight\":2}",
     {"sensorWidth", NULL}},
    {"{\"tilelight\":1," PLACE "," LENS ",\"sensorWidth\":3}", {"focalLength", NULL}},
    {"{\"tilelight\":1," PLACE ",\"verticalFov\":180}", {"below 180", NULL}},
    {"{\"tilelight\":1," PLACE ",\"verticalFov\":0}", {"verticalFov", "above 0", NULL}},
    {"{\"tilelight\":1," PLACE ",\"verticalFov\":\"45\"}", {"verticalFov", "number", NULL}},
    {"{\"tilelight\":1," LENS "}", {"worldFromView", "where the camera stands", NULL}},
    {"{\"tilelight\":1," LENS ",\"position\":[0,0,1]}", {"target", NULL}},
    {"{\"tilelight\":1," LENS ",\"position\":[0,0],\"target\":[0,0,1]}",
     {"position", "3 numbers", NULL}},
    {"{\"tilelight\":1," LENS ",\"position\":[0,0,1e39],\"target\":[0,0,1]}",
     {"position", "1e30", NULL}},
    {"{\"tilelight\":1," LENS ",\"position\":[1,1,1],\"target\":[1,1,1]}",
     {"span no plane", NULL}},
    {"{\"tilelight\":1," LENS ",\"position\":[1,1,1],\"target\":[1,2,1]}",
     {"span no plane", NULL}},
    {"{\"tilelight\":1," LENS "," PLACE ",\"worldFromView\":[[1,0,0,0],[0,1,0,0],[0,0,1,0]]}",
     {"either \"worldFromView\"", NULL}},
    {"{\"tilelight\":1," LENS ",\"worldFromView\":[[1,0,0,0],[0,1,0,0]]}",
     {"3 or 4 rows", NULL}},
    {"{\"tilelight\":1," LENS ",\"worldFromView\":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[1,2,3,1]]}",
     {"last row", NULL}},
    {"{\"tilelight\":1," LENS ",\"worldFromView\":[[2,0,0,0],[0,2,0,0],[0,0,2,0]]}",
     {"no rotation", NULL}},
    {"{\"tilelight\":1," LENS "," PLACE ",\"near\":5,\"far\":5}", {"near plane", NULL}},
};

static void good_files_are_read(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "camera.json");
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        tl_error err;
        tl_camera c;
        save_bytes(path, good[i].json, strlen(good[i].json));
        if (tl_camera_file_read(path, WIDTH, HEIGHT, 1.0, &c, &err) != TL_OK)
            fail_msg("%s: %s", good[i].name, err.message);
        assert_int_equal(c.projection, good[i].projection);
        const double got[] = {(double)c.top,  (double)c.right, (double)c.bottom,
                              (double)c.left, (double)c.near,  (double)c.far};
        const double wanted[] = {good[i].top,    good[i].right, -good[i].top,
                                 -good[i].right, good[i].near,  good[i].far};
        for (int k = 0; k < 6; k++)
            if (fabs(got[k] - wanted[k]) > 0x1p-23 * fabs(wanted[k]))
                fail_msg("%s: number %d is %.9g, not %.9g", good[i].name, k, got[k], wanted[k]);
        for (int k = 0; k < 12; k++)
            if (fabs((double)c.view_from_world[k / 4][k % 4] - good[i].rows[k / 4][k % 4]) >
                1e-6)
                fail_msg("%s: entry %d of the matrix is %g", good[i].name, k,
                         (double)c.view_from_world[k / 4][k % 4]);
    }
    remove(path);
}

static void bad_files_are_refused(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "camera.json");
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        tl_error err;
        tl_camera c;
        save_bytes(path, bad[i].json, strlen(bad[i].json));
        const tl_status status = tl_camera_file_read(path, WIDTH, HEIGHT, 1.0, &c, &err);
        if (status != TL_ERR_FORMAT && status != TL_ERR_UNSUPPORTED)
            fail_msg("%s: status %d", bad[i].json, status);
        assert_refused(bad[i].json, status, status, &err, bad[i].words);
        if (!strstr(err.message, path))
            fail_msg("%s: \"%s\" does not name the file", bad[i].json, err.message);
    }
    remove(path);
}

/* Every prefix of a good file is no file. */
static void truncations_are_refused(void **state)
{
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "camera.json");
    for (size_t i = 0; i < COUNT_OF(good); i++)
        for (size_t length = 0; length < strlen(good[i].json); length++) {
            tl_error err;
            tl_camera c;
            save_bytes(path, good[i].json, length);
            if (tl_camera_file_read(path, WIDTH, HEIGHT, 1.0, &c, &err) != TL_ERR_FORMAT)
                fail_msg("%s: cut to %zu bytes it is read", good[i].name, length);
        }
    remove(path);
}

/* What attributes say for sure, and what they leave open. */
typedef struct attribute_case {
    const char *name;
    void (*write)(exr_context_t file, void *context);
    const char *missing; /* NULL: a camera is found */
    int is_placed;
} attribute_case;

/* A camera at the origin in a left-handed world (x right, y up, looking along +z), as NDC. */
static void left_handed(exr_context_t file, void *context)
{
    static const exr_attr_m44f_t ndc = {
        {1, 0, 0, 0, 0, -1, 0, 0, 0.5f, 0.5f, 1, 1, 0, 0, -1, 0}};
    static const exr_attr_m44f_t camera = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    (void)context;
    foreign_must(exr_attr_set_m44f(file, 0, "worldToNDC", &ndc), "ndc");
    foreign_must(exr_attr_set_m44f(file, 0, "worldToCamera", &camera), "camera");
}

/* As OpenEXR defines it: mirrored, so that the world is right-handed. */
static void place_alone(exr_context_t file, void *context)
{
    static const exr_attr_m44f_t camera = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 4, 1}};
    (void)context;
    foreign_must(exr_attr_set_m44f(file, 0, "worldToCamera", &camera), "camera");
}

static void vray(exr_context_t file, void *context)
{
    (void)context;
    foreign_must(exr_attr_set_float(file, 0, "cameraFov", 90.0f), "fov");
    foreign_must(exr_attr_set_int(file, 0, "cameraProjection", 0), "projection");
}

static void vray_panorama(exr_context_t file, void *context)
{
    (void)context;
    foreign_must(exr_attr_set_float(file, 0, "cameraFov", 90.0f), "fov");
    foreign_must(exr_attr_set_int(file, 0, "cameraProjection", 1), "projection");
}

static void of_no_use(exr_context_t file, void *context)
{
    static const exr_attr_m44f_t zero = {{0}};
    (void)context;
    foreign_must(exr_attr_set_m44f(file, 0, "worldToNDC", &zero), "ndc");
    foreign_must(exr_attr_set_float(file, 0, "worldToCamera", 1.0f), "camera");
}

static const attribute_case attributes[] = {
    {"none", NULL, "--fov", 0},
    {"left-handed", left_handed, "left-handed", 0},
    {"a place without a lens", place_alone, "--fov", 1},
    {"V-Ray", vray, NULL, 0},
    {"V-Ray, no perspective", vray_panorama, "--fov", 0},
    {"a matrix of zeros", of_no_use, "--fov", 0},
};

static void attributes_say_what_they_can(void **state)
{
    static foreign_file file;
    static foreign_frame frame;
    (void)state;
    char path[512];
    scratch_path(path, sizeof path, "attributes.exr");
    foreign_fill(&frame);
    for (size_t i = 0; i < COUNT_OF(attributes); i++)
        for (int with_fov = 0; with_fov < 2; with_fov++) {
            tl_error err;
            tl_import_plan plan = {0};
            tl_import_options options = tl_import_options_default();
            if (with_fov)
                options.camera.vertical_fov = 60.0;
            foreign_describe(&file, &frame, EXR_PIXEL_HALF);
            file.attributes = attributes[i].write;
            foreign_write(&file, path);
            ASSERT_OK(tl_import_plan_open(&plan, path, &options, NULL, &err), err);
            const char *missing = with_fov ? NULL : attributes[i].missing;
            if (missing ? !strstr(plan.missing, missing) : plan.missing[0] != '\0')
                fail_msg("%s: missing is \"%s\", not %s", attributes[i].name, plan.missing,
                         missing ? missing : "nothing");
            if (!missing && plan.camera.is_placed != (attributes[i].is_placed != 0))
                fail_msg("%s: is%s placed", attributes[i].name,
                         plan.camera.is_placed ? "" : " not");
            if (!missing && attributes[i].write == place_alone)
                assert_true(same_bits(plan.camera.camera.view_from_world[2][3], -4.0f));
            if (!missing && attributes[i].write == vray && !with_fov)
                assert_true(same_bits(plan.camera.camera.right, 1.0f));
            tl_import_plan_close(&plan);
        }
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_files_are_read),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(truncations_are_refused),
        cmocka_unit_test(attributes_say_what_they_can),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
