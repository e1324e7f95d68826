/* Do nodes, cameras and lights stand where an animation puts them, at the times that matter? */
#include "gltf_builder.h"

#include "tilelight/layouts.h"

/* In a picture of 15 x 15 that sees x and y up to half of the depth. */
enum { SIZE = 15 };
/* Depth is rounded to float a few times; the shader's normals are normalised in float. */
static const double depth_within = 4e-6, normal_within = 2e-6;

/* Nodes: 0 the square, below 1; 2 the camera at z = 4, which carries a light; 3 a square that is scaled
 * down and far to the side. */
static const char rest[] =
    "\"scene\":0,\"scenes\":[{\"nodes\":[1,2,3]}],\n"
    "\"nodes\":[{\"name\":\"square\",\"mesh\":0},{\"children\":[0]},\n"
    " {\"name\":\"eye\",\"camera\":0,\"translation\":[0,0,4],\n"
    "  \"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},\n"
    " {\"mesh\":0,\"translation\":[0,0,-90],\"scale\":[0,0,0]}],\n"
    "\"extensionsUsed\":[\"KHR_lights_punctual\"],\n"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\"}]}},"
    "\n" SQUARE_CAMERA ",\n\"meshes\":[{\"primitives\":[{\"indices\":3,\"attributes\":{"
    "\"POSITION\":0,\"NORMAL\":1}}]}],\n"
    "\"animations\":[\n"
    " {\"name\":\"slide\",\"samplers\":[{\"input\":4,\"output\":5}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}]},\n"
    " {\"name\":\"2\",\"samplers\":[{\"input\":4,\"output\":5,\"interpolation\":\"STEP\"}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}]},\n"
    " {\"name\":\"ease\",\"samplers\":[{\"input\":6,\"output\":7,\"interpolation\":"
    "\"CUBICSPLINE\"}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}]},\n"
    " {\"name\":\"turn\",\"samplers\":[{\"input\":6,\"output\":8}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"rotation\"}}]},\n"
    " {\"name\":\"mirror\",\"samplers\":[{\"input\":6,\"output\":9}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}]},\n"
    " {\"name\":\"eye\",\"samplers\":[{\"input\":4,\"output\":10},{\"input\":4,\"output\":11}],"
    "\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"translation\"}},\n"
    "   {\"sampler\":1,\"target\":{\"node\":2,\"path\":\"rotation\"}},\n"
    "   {\"sampler\":1,\"target\":{\"path\":\"pointer\"}}]}]";

static char *moving_scene(void)
{
    /* 4: 0.1 is no float, so that a time of 0.1 s is the key's only when rounded as it is */
    static const float times[3] = {0.1f, 1.1f, 2.1f};
    static const float slide[3][3] = {{0, 0, -1}, {0, 0, 2}, {0, 0, -4}};
    static const float two_times[2] = {1, 3};
    /* Hermite: z from 0 to -8 in 2 s, leaving at 3 m/s, arriving at -5 m/s. */
    static const float ease[6][3] = {{9, 9, 9},  {0, 0, 0},  {0, 0, 3},
                                     {0, 0, -5}, {0, 0, -8}, {9, 9, 9}};
    /* About y, as normalised shorts: from 0 to a third of a turn, stored the long way. */
    static const int16_t turn[2][4] = {{0, 0, 0, 32767}, {0, -28377, 0, -16384}};
    static const float mirror[2][3] = {{1, 1, 1}, {-1, 1, 1}};
    static const float eye[3][3] = {{0, 0, 4}, {5, 0, 0}, {0, 0, -6}};
    static const float look[3][4] = {
        {0, 0, 0, 1}, {0, 0.70710678f, 0, 0.70710678f}, {0, 1, 0, 0}};
    builder b = {.size = 0};
    add_square(&b);
    assert_int_equal(ADD_REALS(&b, times, "SCALAR", 1), 4);
    ADD_REALS(&b, slide, "VEC3", 3);
    assert_int_equal(ADD_REALS(&b, two_times, "SCALAR", 1), 6);
    ADD_REALS(&b, ease, "VEC3", 3);
    add_accessor(&b, turn, sizeof turn, GL_SHORT, 2, "VEC4", ",\"normalized\":true");
    ADD_REALS(&b, mirror, "VEC3", 3);
    ADD_REALS(&b, eye, "VEC3", 3);
    ADD_REALS(&b, look, "VEC4", 4);
    return built_scene(&b, rest);
}

static tl_status shoot_at(const char *animation, double time, int has_time, shot *out)
{
    const tl_capture_options options = {.width = SIZE,
                                        .height = SIZE,
                                        .animation = animation,
                                        .time = time,
                                        .has_time = has_time != 0};
    char *const text = moving_scene();
    const tl_status status = shoot_text("moving", text, &options, out);
    free(text);
    return status;
}

/* z of the square; the camera is at 4. */
static void squares_are_where_their_curves_are(void **state)
{
    static const struct {
        const char *animation; /* NULL: none named */
        double time;
        int has_time;
        double z;
    } cases[] = {
        {NULL, 0, 0, 0},       /* the rest pose */
        {NULL, 0, 1, -1},      /* the first animation, before its first key */
        {NULL, 0.1, 1, -1},    /* on it */
        {NULL, 0.6, 1, 0.5},   /* between */
        {"slide", 1.1, 1, 2},  /* on the middle one */
        {"0", 1.6, 1, -1},     /* by index */
        {"slide", 2.1, 1, -4}, /* the end */
        {"slide", 50, 1, -4},  /* beyond it */
        {"slide", 0, 0, -1},   /* named without a time: 0 */
        {"2", 0.1, 1, -1},     /* a name before an index; steps, on a key that is no float */
        {"2", 1.0999, 1, -1},  /* right before a key */
        {"2", 1.1, 1, 2},      /* on it */
        {"2", 2.0999, 1, 2},   /* right before the last */
        {"2", 2.1, 1, -4},     /* on it */
        {"ease", 0.5, 1, 0},   /* clamped: its tangents do not lead on */
        {"ease", 1.5, 1, -1.25 + 2 * (0.140625 * 3 + 0.046875 * 5)}, /* t = 1/4 */
        {"ease", 2, 1, -2}, /* t = 1/2: -4 + 2 (3 + 5) / 8 */
        {"ease", 3, 1, -8},
        {"ease", 4, 1, -8},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char what[64];
        shot taken;
        snprintf(what, sizeof what, "case %zu, %s at %g s", i,
                 cases[i].animation ? cases[i].animation : "-", cases[i].time);
        ASSERT_OK(shoot_at(cases[i].animation, cases[i].time, cases[i].has_time, &taken),
                  taken.err);
        assert_near(what, depth_at_center(&taken), 4.0 - cases[i].z, depth_within);
        shot_clear(&taken);
    }
}

/* A third of a turn over 2 s, the short way, whichever of q and -q is stored. */
static void rotation_turns_normals(void **state)
{
    (void)state;
    for (int i = 0; i <= 4; i++) {
        const double angle = 2.0943951023931953 * 0.25 * i;
        shot taken;
        double normal[3];
        ASSERT_OK(shoot_at("turn", 1.0 + 0.5 * i, 1, &taken), taken.err);
        if (cos(angle) > 0.1) {
            normal_at(&taken, SIZE / 2, SIZE / 2, normal);
            assert_near("depth", depth_at_center(&taken), 4.0, depth_within);
            assert_near("x", normal[0], sin(angle), normal_within + 2.0 / 32767);
            assert_near("y", normal[1], 0, normal_within);
            assert_near("z", normal[2], cos(angle), normal_within + 2.0 / 32767);
        } else { /* its back: nothing */
            assert_true(isinf(depth_at_center(&taken)));
        }
        shot_clear(&taken);
    }
}

/* From x to -x: a front stays a front. In the middle it is scaled to nothing. */
static void mirrored_squares_keep_their_front(void **state)
{
    (void)state;
    for (int i = 0; i <= 4; i++) {
        shot taken;
        double normal[3];
        ASSERT_OK(shoot_at("mirror", 1.0 + 0.5 * i, 1, &taken), taken.err);
        if (i == 2) {
            assert_true(isinf(depth_at_center(&taken)));
        } else {
            normal_at(&taken, SIZE / 2, SIZE / 2, normal);
            assert_near("depth", depth_at_center(&taken), 4.0, depth_within);
            assert_near("z", normal[2], 1.0, normal_within);
        }
        shot_clear(&taken);
    }
}

/* The camera goes around to the square's back, which is not seen, and the light with it. */
static void cameras_and_lights_move(void **state)
{
    static const struct {
        double time, position[3];
        int sees;
    } cases[] = {
        {0.1, {0, 0, 4}, 1},
        {0.6,
         {2.5, 0, 2},
         1}, /* 45 degrees to the left: the square is to the left of the middle */
        {1.1, {5, 0, 0}, 0},
        {2.1, {0, 0, -6}, 0},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        shot taken;
        size_t seen = 0;
        ASSERT_OK(shoot_at("eye", cases[i].time, 1, &taken), taken.err);
        for (uint32_t k = 0; k < SIZE * SIZE; k++)
            seen += isfinite(shown_at(&taken, TL_DEPTH, k % SIZE, k / SIZE)) != 0;
        assert_int_equal(seen > 0, cases[i].sees);
        assert_int_equal(taken.lights.count, 1);
        for (int c = 0; c < 3; c++) {
            const double origin[3] = {0, 0, 0};
            double eye[3];
            tl_camera_world_point(&taken.gbuffer->camera, origin, eye);
            assert_near("camera", eye[c], cases[i].position[c], 1e-6);
            assert_near("light", (double)taken.lights.lights[0].position[c],
                        cases[i].position[c], 1e-6);
        }
        shot_clear(&taken);
    }
}

static void ends_are_told(void **state)
{
    shot taken;
    (void)state;
    ASSERT_OK(shoot_at("slide", 2.1, 1, &taken), taken.err);
    assert_string_equal(taken.notices.text, "");
    shot_clear(&taken);
    ASSERT_OK(shoot_at("slide", 2.5, 1, &taken), taken.err);
    assert_non_null(strstr(taken.notices.text,
                           "moving.gltf: animation 0 (\"slide\") ends at 2.1 s; its end is "
                           "shown for 2.5 s\n"));
    shot_clear(&taken);
}

/* What the moment is has nothing to do with how pixels are packed. */
static void layouts_show_the_same_moment(void **state)
{
    static const char *const words[] = {"float", "compact-16", "merlin", "ispc"};
    char *const text = moving_scene();
    (void)state;
    for (size_t i = 0; i < COUNT_OF(words); i++) {
        tl_capture_options options = {
            .width = SIZE, .height = SIZE, .animation = "slide", .time = 0.6, .has_time = true};
        tl_gbuffer *unpacked = NULL;
        shot taken;
        ASSERT_OK(tl_layout_find(words[i], &options.layout, &taken.err), taken.err);
        ASSERT_OK(shoot_text("moving", text, &options, &taken), taken.err);
        ASSERT_OK(tl_gbuffer_unpack(taken.gbuffer, &unpacked, &taken.err), taken.err);
        /* No layout's depth is coarser than 11 bits. */
        assert_near(words[i],
                    (double)tl_gbuffer_plane(unpacked,
                                             TL_DEPTH)[(SIZE / 2) * unpacked->pitch + SIZE / 2],
                    3.5, 3.5 / 2048);
        tl_gbuffer_destroy(unpacked);
        shot_clear(&taken);
    }
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_are_where_their_curves_are),
        cmocka_unit_test(rotation_turns_normals),
        cmocka_unit_test(mirrored_squares_keep_their_front),
        cmocka_unit_test(cameras_and_lights_move),
        cmocka_unit_test(ends_are_told),
        cmocka_unit_test(layouts_show_the_same_moment),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
