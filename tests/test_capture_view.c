#define _GNU_SOURCE
/* Which camera does a capture use, and which lights does it bring along? */
#include "gltf_scene.h"

enum { WIDTH = 80, HEIGHT = 40 };

static const char perspective[] =
    "\"perspective\",\n \"perspective\":{\"yfov\":1.0,\"znear\":0.1,\"zfar\":100}";

/* A second camera, orthographic, on the other side; its node is called like the first's index. */
static char *scene_of_two_cameras(void)
{
    char *text = square_scene(&square);
    text = edited(text, "[0,1]}]", "[0,1,2]}]");
    text = edited(text, "\"translation\":[0,0,4]}]",
                  "\"translation\":[0,0,4]},{\"name\":\"0\",\"camera\":1,"
                  "\"rotation\":[0,1,0,0],\"translation\":[0,0,-3]}]");
    return edited(text, "\"zfar\":100}}]",
                  "\"zfar\":100}},{\"name\":\"flat\",\"type\":\"orthographic\","
                  "\"orthographic\":{\"xmag\":5,\"ymag\":2,\"znear\":0,\"zfar\":10}}]");
}

static const struct {
    const char *wanted;
    tl_projection projection;
} choices[] = {
    {NULL, TL_PERSPECTIVE},   {"eye", TL_PERSPECTIVE},
    {"wide", TL_PERSPECTIVE}, {"flat", TL_ORTHOGRAPHIC},
    {"1", TL_ORTHOGRAPHIC},   {"0", TL_ORTHOGRAPHIC /* a name first */},
};

static void cameras_are_found(void **state)
{
    char *const text = scene_of_two_cameras();
    (void)state;
    for (size_t i = 0; i < COUNT_OF(choices); i++) {
        const tl_capture_options options = {
            .width = WIDTH, .height = HEIGHT, .camera = choices[i].wanted};
        shot taken;
        ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
        const tl_camera *const camera = &taken.gbuffer->camera;
        if (camera->projection != choices[i].projection)
            fail_msg("camera %s is the other one", choices[i].wanted ? choices[i].wanted : "");
        /* The height is the file's, the width follows the picture. */
        const float half = camera->projection == TL_PERSPECTIVE ? (float)tan(0.5) : 2.0f;
        assert_true(same_bits(camera->top, half) && same_bits(camera->bottom, -half));
        assert_true(same_bits(camera->right, 2 * half) && same_bits(camera->left, -2 * half));
        assert_int_equal(taken.notices.count, 0);
        shot_clear(&taken);
    }
    free(text);
}

static void far_may_be_infinite(void **state)
{
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    shot taken;
    (void)state;
    char *text = edited(square_scene(&square), ",\"zfar\":100", "");
    text = edited(text, "[0,0,4]", "[0,0,20000]");
    text = edited(text, "\"mesh\":0", "\"mesh\":0,\"scale\":[10000,10000,1]");
    ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
    assert_true(isinf(taken.gbuffer->camera.far));
    assert_true(fabsf(shown_at(&taken, TL_DEPTH, WIDTH / 2, HEIGHT / 2) - 20000.0f) < 0.01f);
    shot_clear(&taken);
    free(text);
}

/* Scales of mirrored and tiny things, and one that is no bigger than a point. */
static const struct {
    const char *name, *node;
    int is_point;
} framed[] = {
    {"as it is", "", 0},
    {"tiny", "\"scale\":[1e-5,1e-5,1e-5],", 0},
    {"huge", "\"scale\":[1e6,1e6,1e6],", 0},
    {"far away", "\"translation\":[-4096,512,65536],", 0},
    {"thin", "\"scale\":[0.5,10,1],", 0},
    {"a point", "\"scale\":[0,0,0],", 1},
};

/* Nothing is cut off: the outermost pixels are sky, and the square's rim is in the picture. */
static void a_framed_view_shows_all(void **state)
{
    static const uint32_t sizes[][2] = {{80, 40}, {40, 80}};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(framed) * COUNT_OF(sizes); i++) {
        const size_t which = i / COUNT_OF(sizes);
        const uint32_t width = sizes[i % COUNT_OF(sizes)][0], height = 120 - width;
        const tl_capture_options options = {.width = width, .height = height};
        uint32_t covered = 0, rim = 0;
        char part[128];
        shot taken;
        snprintf(part, sizeof part, "%s\"mesh\":0", framed[which].node);
        char *text = edited(square_scene(&square), "\"camera\":0,", "");
        text = edited(text, "\"mesh\":0", part);
        ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++) {
                const int hit = isfinite(shown_at(&taken, TL_DEPTH, x, y)) != 0;
                covered += (uint32_t)hit;
                rim += hit && (x == 0 || y == 0 || x == width - 1 || y == height - 1);
            }
        if (rim != 0 || (covered > 0) == framed[which].is_point)
            fail_msg("%s: %u pixels covered, %u of them on the rim", framed[which].name,
                     covered, rim);
        assert_non_null(strstr(taken.notices.text, "no camera"));
        shot_clear(&taken);
        free(text);
    }
}

static void nothing_to_draw_is_sky(void **state)
{
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    shot taken;
    (void)state;
    char *const text =
        edited(square_scene(&square), "\"scenes\":[{\"nodes\":[0,1]}]", "\"scenes\":[{}]");
    ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            assert_true(isinf(shown_at(&taken, TL_DEPTH, x, y)));
            assert_true(same_bits(shown_at(&taken, TL_ROUGHNESS, x, y), 0.0f));
            assert_true(same_bits(shown_at(&taken, TL_NORMAL_Z, x, y), 0.0f));
        }
    shot_clear(&taken);
    free(text);
}

/* Higher than one band of targets: rows on both sides of every seam hold their depth. */
static void bands_join(void **state)
{
    enum { WIDE = 16384, HIGH = 1040 }; /* a band is 1024 rows */
    const tl_capture_options options = {.width = WIDE, .height = HIGH};
    shot taken;
    (void)state;
    char *text = edited(square_scene(&square), perspective,
                        "\"orthographic\",\n \"orthographic\":{\"xmag\":1,\"ymag\":1,"
                        "\"znear\":0,\"zfar\":10}");
    /* Around x by 0.5, so that depth grows from row to row. */
    text = edited(text, "\"mesh\":0",
                  "\"mesh\":0,\"scale\":[20,2,1],\"rotation\":[0.24740395925452294,0,0,"
                  "0.9689124217106447]");
    ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
    for (uint32_t y = 1000; y < HIGH; y++)
        for (uint32_t x = 0; x < WIDE; x += 911) {
            const double up = 1 - 2 * (y + 0.5) / HIGH, want = 4 - up * tan(0.5);
            const float got = shown_at(&taken, TL_DEPTH, x, y);
            if (!(fabs((double)got / want - 1) <= 16 * 0x1p-24))
                fail_msg("row %u: depth %.9g, want %.9g", y, (double)got, want);
        }
    shot_clear(&taken);
    free(text);
}

/* --- lights ------------------------------------------------------------------------------------ */

/* Node 2, turned so that its -z is +x, and scaled, which changes nothing. */
static char *scene_of_light(const char *light)
{
    char part[512];
    char *text = edited(square_scene(&square), "[0,1]}]", "[0,1,2]}]");
    snprintf(part, sizeof part,
             "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{"
             "\"KHR_lights_punctual\":{\"lights\":[%s]}},\"scene\"",
             light);
    text = edited(text, "\"scene\"", part);
    return edited(text, "\"translation\":[0,0,4]}]",
                  "\"translation\":[0,0,4]},{\"name\":\"lamp\",\"translation\":[1,2,3],"
                  "\"scale\":[5,5,5],\"rotation\":[0,-0.7071067811865476,0,0.7071067811865476],"
                  "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]");
}

static void lights_come_along(void **state)
{
    static const struct {
        const char *json;
        tl_light want; /* position and direction are those of the node */
    } lights[] = {
        {"{\"type\":\"point\"}",
         {.type = TL_LIGHT_POINT, .color = {1, 1, 1}, .intensity = 1, .range = INFINITY}},
        {"{\"type\":\"point\",\"color\":[1,0.5,0.25],\"intensity\":20,\"range\":7}",
         {.type = TL_LIGHT_POINT, .color = {1, 0.5f, 0.25f}, .intensity = 20, .range = 7}},
        {"{\"type\":\"directional\",\"intensity\":3}",
         {.type = TL_LIGHT_DIRECTIONAL, .color = {1, 1, 1}, .intensity = 3, .range = INFINITY}},
        {"{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.25,\"outerConeAngle\":0.5}}",
         {.type = TL_LIGHT_SPOT,
          .color = {1, 1, 1},
          .intensity = 1,
          .range = INFINITY,
          .inner_cone = 0.25f,
          .outer_cone = 0.5f}},
        {"{\"type\":\"point\",\"extras\":{\"group\":\"key\",\"other\":1}}",
         {.color = {1, 1, 1}, .intensity = 1, .range = INFINITY, .group = "key"}},
        {"{\"type\":\"point\",\"extras\":{\"group\":3}}",
         {.color = {1, 1, 1}, .intensity = 1, .range = INFINITY}},
        {"{\"type\":\"point\",\"extras\":\"group\"}",
         {.color = {1, 1, 1}, .intensity = 1, .range = INFINITY}},
    };
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(lights); i++) {
        char *const text = scene_of_light(lights[i].json);
        const tl_light *const want = &lights[i].want;
        shot taken;
        ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
        assert_int_equal(taken.lights.count, 1);
        const tl_light *const got = &taken.lights.lights[0];
        assert_string_equal(got->name, "lamp");
        assert_string_equal(got->group, want->group);
        assert_int_equal(got->type, want->type);
        assert_int_equal(got->falloff, TL_FALLOFF_INVERSE_SQUARE);
        assert_memory_equal(got->color, want->color, sizeof want->color);
        assert_true(same_bits(got->intensity, want->intensity));
        assert_true(same_bits(got->range, want->range));
        assert_true(got->direction[0] > 0.9999999f && got->position[1] == 2.0f);
        if (want->type == TL_LIGHT_SPOT)
            assert_true(same_bits(got->inner_cone, want->inner_cone) &&
                        same_bits(got->outer_cone, want->outer_cone));
        assert_int_equal(taken.notices.count, 0);
        shot_clear(&taken);
        free(text);
    }
}

/* A light that several nodes have is in the group of each, where that says one. */
static void a_node_says_the_group_first(void **state)
{
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    char *const text =
        edited(scene_of_light("{\"type\":\"point\",\"extras\":{\"group\":\"key\"}}"),
               "\"name\":\"lamp\"", "\"name\":\"lamp\",\"extras\":{\"group\":\"left\"}");
    shot taken;
    (void)state;
    ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
    assert_string_equal(taken.lights.lights[0].group, "left");
    shot_clear(&taken);
    free(text);
}

static void bad_lights_are_refused(void **state)
{
    static const char *const lights[][2] = {
        {"{\"type\":\"area\"}", "area"},
        {"{\"type\":\"point\",\"intensity\":-1}", "intensity"},
        {"{\"type\":\"point\",\"range\":-1}", "range"},
        {"{\"type\":\"point\",\"color\":[1,1]}", "color"},
        {"{\"type\":\"spot\"}", "spot"},
    };
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(lights); i++) {
        char *const text = scene_of_light(lights[i][0]);
        shot taken;
        if (shoot_text("view", text, &options, &taken) != TL_ERR_FORMAT ||
            !strcasestr(taken.err.message, lights[i][1]))
            fail_msg("%s: says \"%s\"", lights[i][0], taken.err.message);
        shot_clear(&taken);
        free(text);
    }
}

static void unknown_extensions_are_told_once(void **state)
{
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    shot taken;
    (void)state;
    char *const text = edited(square_scene(&square), "\"scene\"",
                              "\"extensionsUsed\":[\"X_one\",\"KHR_texture_transform\","
                              "\"X_two\"],\"scene\"");
    ASSERT_OK(shoot_text("view", text, &options, &taken), taken.err);
    assert_int_equal(taken.notices.count, 2);
    assert_non_null(strstr(taken.notices.text, "X_one"));
    assert_non_null(strstr(taken.notices.text, "X_two"));
    shot_clear(&taken);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_are_found),
        cmocka_unit_test(far_may_be_infinite),
        cmocka_unit_test(a_framed_view_shows_all),
        cmocka_unit_test(nothing_to_draw_is_sky),
        cmocka_unit_test(bands_join),
        cmocka_unit_test(lights_come_along),
        cmocka_unit_test(a_node_says_the_group_first),
        cmocka_unit_test(bad_lights_are_refused),
        cmocka_unit_test(unknown_extensions_are_told_once),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
