/* Are cameras and lights that make no sense refused, by name, and is a sound one placed rightly? */
#include "testing.h"

#include "tilelight/lights.h"

static tl_camera good_camera(void)
{
    static const double eye[3] = {1, 2, 3}, target[3] = {1, 2, -7}, up[3] = {0, 1, 0};
    return tl_camera_look_at(eye, target, up, 1.0, 64, 48, 0.1, 100.0);
}

static void points_land_where_they_are_seen(void **state)
{
    const tl_camera camera = good_camera();
    const double world[3] = {1.5, 2.25, -1};
    double view[3], back[3];
    (void)state;
    tl_camera_view_point(&camera, world, view);
    assert_true(fabs(view[0] - 0.5) < 1e-6 && fabs(view[1] - 0.25) < 1e-6 &&
                fabs(view[2] + 4) < 1e-6);
    tl_camera_world_point(&camera, view, back);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(back[i] - world[i]) < 1e-6);
}

#define CAMERA_CASE(name, word, statement)  \
    static void camera_##name(tl_camera *c) \
    {                                       \
        statement;                          \
    }
#define CAMERA_CASES(X)                                                                      \
    X(no_width, "0 x 48", c->width = 0)                                                      \
    X(too_wide, "16385", c->width = 16385)                                                   \
    X(empty, "empty", c->left = c->right)                                                    \
    X(not_finite, "has top at nan", c->top = NAN)                                            \
    X(too_far_left, "has left at -2e+18: it must be from -1e+18 to 1e+18", c->left = -2e18f) \
    X(near_zero, "above 0", c->near = 0.0f)                                                  \
    X(far_before_near, "near plane", c->far = 0.05f)                                         \
    X(sheared, "no rotation", c->view_from_world[0][1] = 0.1f)                               \
    X(turned_nowhere, "row 2 of the camera's matrix is not finite",                          \
      c->view_from_world[2][0] = NAN)                                                        \
    X(near_nowhere, "near plane (nan m)", c->near = NAN)                                     \
    X(far_nowhere, "far plane (nan m)", c->far = NAN)                                        \
    X(too_far, "row 0 of the camera's matrix shifts by 2e+18 m: it must be from",            \
      c->view_from_world[0][3] = 2e18f)                                                      \
    X(nowhere, "row 1 of the camera's matrix shifts by nan m", c->view_from_world[1][3] = NAN)
CAMERA_CASES(CAMERA_CASE)

static void senseless_cameras_are_refused(void **state)
{
    static const struct {
        void (*spoil)(tl_camera *c);
        const char *word;
    } cases[] = {
#define CAMERA_ROW(name, word, statement) {camera_##name, word},
        CAMERA_CASES(CAMERA_ROW)};
    tl_camera good = good_camera();
    (void)state;
    assert_int_equal(tl_camera_check(&good, NULL), TL_OK);
    good.far = INFINITY;
    assert_int_equal(tl_camera_check(&good, NULL), TL_OK);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_camera camera = good_camera();
        tl_error err = {.message = ""};
        cases[i].spoil(&camera);
        assert_int_equal(tl_camera_check(&camera, &err), TL_ERR_ARGUMENT);
        if (!strstr(err.message, cases[i].word))
            fail_msg("\"%s\" does not say \"%s\"", err.message, cases[i].word);
    }
}

#define LIGHT_CASE(name, word, statement) \
    static void light_##name(tl_light *l) \
    {                                     \
        statement;                        \
    }
#define LIGHT_CASES(X)                                                     \
    X(position, "position[1]", l->position[1] = NAN)                       \
    X(far_away, "position[0]", l->position[0] = 1e30f)                     \
    X(color, "color[2]", l->color[2] = -1.0f)                              \
    X(intensity, "intensity", l->intensity = INFINITY)                     \
    X(range, "range", l->range = 0.0f)                                     \
    X(range_nan, "range", l->range = NAN)                                  \
    X(linear, "linear", l->falloff = TL_FALLOFF_LINEAR)                    \
    X(cone, "outerConeAngle", l->outer_cone = 4.0f)                        \
    X(inner, "innerConeAngle", l->inner_cone = 1.5f)                       \
    X(length, "length 1", l->type = TL_LIGHT_SPOT; l->direction[0] = 1.0f) \
    X(specular, "specular", l->specular = -0.1f)
LIGHT_CASES(LIGHT_CASE)

static void senseless_lights_are_refused(void **state)
{
    static const struct {
        void (*spoil)(tl_light *l);
        const char *word;
    } cases[] = {
#define LIGHT_ROW(name, word, statement) {light_##name, word},
        LIGHT_CASES(LIGHT_ROW)};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        tl_light_set set = {0};
        tl_light light = tl_light_default();
        tl_error err = {.message = ""};
        strcpy(light.name, "lamp");
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
        ASSERT_OK(tl_light_set_check(&set, "test", &err), err);
        cases[i].spoil(&light);
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
        assert_int_equal(tl_light_set_check(&set, "set.json", &err), TL_ERR_FORMAT);
        if (!strstr(err.message, cases[i].word) || !strstr(err.message, "lights[1] \"lamp\"") ||
            !strstr(err.message, "set.json"))
            fail_msg("\"%s\" does not name the file, the light and \"%s\"", err.message,
                     cases[i].word);
        tl_light_set_clear(&set);
    }
}

/* The key light comes over the viewer's left shoulder, wherever the camera stands. */
static void the_rig_follows_the_camera(void **state)
{
    const tl_camera camera = good_camera();
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    ASSERT_OK(tl_light_set_add_rig(&set, &camera, &err), err);
    ASSERT_OK(tl_light_set_check(&set, "rig", &err), err);
    assert_int_equal(set.count, 2);
    assert_true(set.ambient[0] > 0.0f);
    double view[3];
    const double world[3] = {(double)set.lights[0].direction[0],
                             (double)set.lights[0].direction[1],
                             (double)set.lights[0].direction[2]};
    tl_camera_view_direction(&camera, world, view);
    assert_true(view[0] > 0.0 && view[1] < 0.0 && view[2] < 0.0);
    tl_light_set_clear(&set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_land_where_they_are_seen),
        cmocka_unit_test(senseless_cameras_are_refused),
        cmocka_unit_test(senseless_lights_are_refused),
        cmocka_unit_test(the_rig_follows_the_camera),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
