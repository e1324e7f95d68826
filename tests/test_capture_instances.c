/* Does EXT_mesh_gpu_instancing show a mesh at each of its instances, and nowhere else? By hand, and a scene
 * made by others against rays through its numbers. */
#include "assets.h"
#include "gltf_builder.h"
#include "pixel_rays.h"

enum { SIZE = 15 };
static const double depth_within = 4e-6, normal_within = 2e-6;

/* --- by hand ----------------------------------------------------------------------------------- */

/* A square at the left, one turned about y and one mirrored at the right, all within a node that is moved
 * back by 4 m; that one moves on. Rotations as normalised bytes. */
static char *instanced_scene(const char *attributes)
{
    static const float translations[3][3] = {
        {-2.6666667f, 0, 0}, {0, 0, 1}, {2.6666667f, 0, -1}};
    static const int8_t rotations[3][4] = {{0, 0, 0, 127}, {0, 39, 0, 121}, {0, 0, 0, 127}};
    static const float scales[3][3] = {{0.5f, 0.5f, 1}, {0.5f, 0.5f, 1}, {-0.5f, 0.5f, 1}};
    static const float times[2] = {0, 1}, places[2][3] = {{0, 0, -4}, {0, 0, -3.5f}};
    static const char rest[] =
        "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\n"
        "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],\n"
        "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0,\"translation\":[0,0,-4],\n"
        " \"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{%s}}}},\n"
        "{\"camera\":0,\"translation\":[0,0,4]}],\n" SQUARE_CAMERA
        ",\n\"meshes\":[{\"primitives\":[{\"indices\":3,\"attributes\":{\"POSITION\":0,"
        "\"NORMAL\":1}}]}],\n"
        "\"animations\":[{\"samplers\":[{\"input\":7,\"output\":8}],\"channels\":[{\"sampler\":"
        "0,"
        "\"target\":{\"node\":0,\"path\":\"translation\"}}]}]";
    char text[4096];
    builder b = {.size = 0};
    add_square(&b);
    assert_int_equal(ADD_REALS(&b, translations, "VEC3", 3), 4);
    add_accessor(&b, rotations, sizeof rotations, GL_BYTE, 3, "VEC4", ",\"normalized\":true");
    ADD_REALS(&b, scales, "VEC3", 3);
    assert_int_equal(ADD_REALS(&b, times, "SCALAR", 1), 7);
    ADD_REALS(&b, places, "VEC3", 3);
    snprintf(text, sizeof text, rest, attributes);
    return built_scene(&b, text);
}

#define ALL "\"TRANSLATION\":4,\"ROTATION\":5,\"SCALE\":6"

static void squares_are_at_their_instances(void **state)
{
    static const struct {
        const char *attributes;
        double time;
        double depths[3],
            x; /* at the left, in the middle, at the right; normal in the middle */
    } cases[] = {
        {ALL, 0, {8, 7, 9}, 0.5855},
        {ALL, 1, {7.5, 6.5, 8.5}, 0.5855},
        {ALL ",\"_ID\":3", 0, {8, 7, 9}, 0.5855}, /* what is not known is nothing */
        {"\"TRANSLATION\":4,\"SCALE\":6", 0, {8, 7, 9}, 0},
        {"\"ROTATION\":5", 0, {INFINITY, 8, INFINITY}, 0},
        {"\"_ID\":3", 0, {INFINITY, 8, INFINITY}, 0},
        {"", 0, {INFINITY, 8, INFINITY}, 0},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_capture_options options = {
            .width = SIZE, .height = SIZE, .time = cases[i].time, .has_time = true};
        char *const text = instanced_scene(cases[i].attributes);
        double normal[3];
        shot taken;
        ASSERT_OK(shoot_text("instanced", text, &options, &taken), taken.err);
        assert_string_equal(taken.notices.text, "");
        for (uint32_t k = 0; k < 3; k++)
            assert_near(cases[i].attributes,
                        (double)shown_at(&taken, TL_DEPTH, 2 + 5 * k, SIZE / 2),
                        cases[i].depths[k], depth_within);
        normal_at(&taken, SIZE / 2, SIZE / 2, normal);
        if (cases[i].x > 0) { /* the angle that the bytes say: 2 atan(39 / 121) */
            assert_near("normal", normal[0], sin(2 * atan2(39, 121)), normal_within);
            assert_near("normal", normal[2], cos(2 * atan2(39, 121)), normal_within);
        }
        shot_clear(&taken);
        free(text);
    }
}

/* --- SimpleInstancing -------------------------------------------------------------------------- */

enum { INSTANCES = 125 };

/* Cubes from 0 to 1, by the offsets in its .gltf. */
typedef struct cubes {
    float translations[INSTANCES][3], rotations[INSTANCES][4], scales[INSTANCES][3];
} cubes;

#define FOLDER "SimpleInstancing/glTF/"

static int read_cubes(cubes *c)
{
    static const char file[] = FOLDER "SimpleInstancing_data.bin";
    return read_asset(file, 720, c->translations, sizeof c->translations) &&
           read_asset(file, 2220, c->rotations, sizeof c->rotations) &&
           read_asset(file, 4220, c->scales, sizeof c->scales);
}

/* v turned back by q, which need not be of length 1: v + 2 u x (u x v - w v), u the vector part. */
static void turn_back(const float *q, const double v[3], double out[3])
{
    const double length2 = (double)q[0] * (double)q[0] + (double)q[1] * (double)q[1] +
                           (double)q[2] * (double)q[2] + (double)q[3] * (double)q[3];
    double inner[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        inner[i] = (double)q[j] * v[k] - (double)q[k] * v[j] - (double)q[3] * v[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = v[i] + 2.0 / length2 * ((double)q[j] * inner[k] - (double)q[k] * inner[j]);
    }
}

/* In the instance's own space its cube is a box of slabs; fronts alone are seen, from outside. */
static double hit_cube(const cubes *c, int i, const pixel_ray *ray)
{
    double moved[3], from[3], along[3], enter = -INFINITY, leave = INFINITY;
    for (int k = 0; k < 3; k++)
        moved[k] = ray->from[k] - (double)c->translations[i][k];
    turn_back(c->rotations[i], moved, from);
    turn_back(c->rotations[i], ray->along, along);
    for (int k = 0; k < 3; k++) {
        const double scale = (double)c->scales[i][k];
        const double a = (0.0 - from[k] / scale) / (along[k] / scale);
        const double b = (1.0 - from[k] / scale) / (along[k] / scale);
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    return enter > 0 && enter < leave ? enter : HUGE_VAL;
}

static double hit_cubes(const void *scene, const pixel_ray *ray)
{
    double nearest = INFINITY;
    for (int i = 0; i < INSTANCES; i++)
        nearest = fmin(nearest, hit_cube(scene, i, ray));
    return nearest;
}

static void the_cubes_of_others_are_where_their_numbers_say(void **state)
{
    const tl_capture_options options = {.width = 160, .height = 120};
    size_t surface_count;
    cubes c;
    shot taken;
    (void)state;
    if (!read_cubes(&c))
        skip();
    char *const path = asset_path(FOLDER "SimpleInstancing.gltf");
    ASSERT_OK(shoot(path, &options, &taken), taken.err);
    assert_null(strstr(taken.notices.text, "EXT_mesh_gpu_instancing"));
    assert_depths(&taken, hit_cubes, &c, 1e-6, &surface_count);
    assert_in_range(surface_count, 3000, 160 * 120);
    shot_clear(&taken);
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_are_at_their_instances),
        cmocka_unit_test(the_cubes_of_others_are_where_their_numbers_say),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
