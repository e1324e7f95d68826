/* Do morph targets move surfaces, normals and tangents by their weights, whoever gives these, and do
 * normals and tangents that the file lacks come from the moved surface? */
#include "gltf_builder.h"
#include "gltf_textures.h"

enum { SIZE = 15 };
/* Roundings of depth and of unit vectors in float, a few each. */
static const double depth_within = 4e-6, normal_within = 2e-6;

/* A unit vector of these components. */
static void unit_of(const double from[3], double to[3])
{
    const double length = sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
    for (int c = 0; c < 3; c++)
        to[c] = from[c] / length;
}

static void assert_normal(const char *what,
                          const shot *taken,
                          uint32_t x,
                          uint32_t y,
                          const double expected[3],
                          double within)
{
    double normal[3], want[3];
    unit_of(expected, want);
    normal_at(taken, x, y, normal);
    for (int c = 0; c < 3; c++)
        assert_near(what, normal[c], want[c], within);
}

/* --- weights ----------------------------------------------------------------------------------- */

/* Of the square: 4 and 5 move z by 1 and tilt normals, as floats; 6 moves two corners by -2, sparse,
 * which is -1 in the middle; 7 moves z by 1, as normalised bytes. */
static void add_targets(builder *to)
{
    static const float up[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    static const float tilt[4][3] = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    static const struct {
        uint16_t indices[2];
        float values[2][3];
    } corners = {{0, 1}, {{0, 0, -2}, {0, 0, -2}}};
    static const int8_t bytes[4][4] = {
        {0, 0, 127, 0}, {0, 0, 127, 0}, {0, 0, 127, 0}, {0, 0, 127, 0}};
    ADD_REALS(to, up, "VEC3", 3);
    ADD_REALS(to, tilt, "VEC3", 3);
    const int sparse = add_accessor(
        to, &corners, sizeof corners, GL_REAL, 4, "VEC3",
        ",\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":6,\"componentType\":5123},"
        "\"values\":{\"bufferView\":6,\"byteOffset\":4}}");
    assert_int_equal(sparse, 6);
    to->stride = 4;
    add_accessor(to, bytes, sizeof bytes, GL_BYTE, 4, "VEC3", ",\"normalized\":true");
    to->stride = 0;
}

/* Where the sparse accessor has its changes it must not have its elements too. */
static char *without_dense(char *text)
{
    return edited(text, "{\"bufferView\":6,\"componentType\":5126", "{\"componentType\":5126");
}

static void add_weight_keys(builder *to)
{
    static const float times[2] = {1, 2};
    static const float linear[2][3] = {{1, 0, 0}, {0, 1, 1}};
    /* per key: tangents before, values, tangents behind, of three weights each */
    static const float cubic[2][3][3] = {{{9, 9, 9}, {0, 0, 0}, {0, 0, 0}},
                                         {{0, 0, 0}, {1, 0, 2}, {9, 9, 9}}};
    assert_int_equal(ADD_REALS(to, times, "SCALAR", 1), 8);
    ADD_REALS(to, linear, "SCALAR", 1);
    ADD_REALS(to, cubic, "SCALAR", 1);
}

static const char weighted[] =
    "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0%s},"
    "{\"camera\":0,\"translation\":[0,0,4]}],\n" SQUARE_CAMERA
    ",\n\"meshes\":[{%s\"primitives\":[{\"indices\":3,\"attributes\":{\"POSITION\":0,"
    "\"NORMAL\":1},\n"
    " \"targets\":[{\"POSITION\":4,\"NORMAL\":5},{\"POSITION\":6},{\"POSITION\":7}]}]}],\n"
    "\"animations\":[\n"
    " {\"samplers\":[{\"input\":8,\"output\":9}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}}]},\n"
    " {\"samplers\":[{\"input\":8,\"output\":10,\"interpolation\":\"CUBICSPLINE\"}],\n"
    "  \"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}}]}]";

static void weights_are_the_animations_else_the_nodes_else_the_meshs(void **state)
{
    static const struct {
        const char *mesh, *node, *animation; /* weights; NULL: no animation */
        double time, weights[3];
    } cases[] = {
        {"", "", NULL, 0, {0, 0, 0}},
        {"\"weights\":[0.5,0,0],", "", NULL, 0, {0.5, 0, 0}},
        {"\"weights\":[0,0.25,0],", "", NULL, 0, {0, 0.25, 0}},
        {"\"weights\":[0,0,0.75],", "", NULL, 0, {0, 0, 0.75}},
        {"\"weights\":[2,-1,0.5],", "", NULL, 0, {2, -1, 0.5}}, /* beyond 0 to 1 is allowed */
        {"\"weights\":[0.5,0,0],", ",\"weights\":[0,0.5,0.125]", NULL, 0, {0, 0.5, 0.125}},
        {"\"weights\":[0.5,0,0],", ",\"weights\":[0,0,0]", NULL, 0, {0, 0, 0}},
        {"\"weights\":[0.5,0,0],", ",\"weights\":[0,0.5,0.25]", "0", 0, {1, 0, 0}},
        {"\"weights\":[0.5,0,0],", ",\"weights\":[0,0.5,0.25]", "0", 1.25, {0.75, 0.25, 0.25}},
        {"", "", "0", 3, {0, 1, 1}},
        {"", "", "1", 1.25, {0.15625, 0, 0.3125}}, /* 3 t^2 - 2 t^3 */
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_capture_options options = {.width = SIZE,
                                            .height = SIZE,
                                            .animation = cases[i].animation,
                                            .time = cases[i].time,
                                            .has_time = cases[i].animation != NULL};
        const double *const w = cases[i].weights;
        builder b = {.size = 0};
        char rest[2048], what[32];
        shot taken;
        add_square(&b);
        add_targets(&b);
        add_weight_keys(&b);
        snprintf(rest, sizeof rest, weighted, cases[i].node, cases[i].mesh);
        char *const text = without_dense(built_scene(&b, rest));
        snprintf(what, sizeof what, "case %zu", i);
        ASSERT_OK(shoot_text("morph", text, &options, &taken), taken.err);
        assert_near(what, depth_at_center(&taken), 4.0 - (w[0] - w[1] + w[2]), depth_within);
        assert_normal(what, &taken, SIZE / 2, SIZE / 2, (const double[3]){w[0], 0, 1},
                      normal_within);
        shot_clear(&taken);
        free(text);
    }
}

/* Four nodes side by side show one mesh: the first and the last alike. */
static void nodes_have_their_own_weights(void **state)
{
    static const char rest[] =
        "\"scenes\":[{\"nodes\":[0,1,2,3,4]}],\"nodes\":[\n"
        "{\"mesh\":0,\"scale\":[0.3,0.3,1],\"translation\":[-1.3333333,0,0],\"weights\":[0.5,0,"
        "0]},\n"
        "{\"mesh\":0,\"scale\":[0.3,0.3,1],\"weights\":[0,0.25,0]},\n"
        "{\"mesh\":0,\"scale\":[0.3,0.3,1],\"translation\":[1.3333333,0,0]},\n"
        "{\"mesh\":0,\"scale\":[0.3,0.3,1],\"translation\":[0,1.3333333,0],\"weights\":[0.5,0,"
        "0]},\n"
        "{\"camera\":0,\"translation\":[0,0,4]}],\n" SQUARE_CAMERA
        ",\n\"meshes\":[{\"weights\":[0,0,-0.5],\"primitives\":[{\"indices\":3,"
        "\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\n"
        " \"targets\":[{\"POSITION\":4,\"NORMAL\":5},{\"POSITION\":6},{\"POSITION\":7}]}]}]";
    static const struct {
        uint32_t x, y;
        double depth;
    } places[] = {{2, 7, 3.5}, {7, 7, 4.25}, {12, 7, 4.5}, {7, 2, 3.5}};
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    builder b = {.size = 0};
    shot taken;
    (void)state;
    add_square(&b);
    add_targets(&b);
    char *const text = without_dense(built_scene(&b, rest));
    ASSERT_OK(shoot_text("morphs", text, &options, &taken), taken.err);
    for (size_t i = 0; i < COUNT_OF(places); i++)
        assert_near("depth", (double)shown_at(&taken, TL_DEPTH, places[i].x, places[i].y),
                    places[i].depth, depth_within);
    shot_clear(&taken);
    free(text);
}

/* --- what the file lacks ----------------------------------------------------------------------- */

/* Only the corner that both triangles share is lifted: their normals part. */
static void flat_normals_are_those_of_the_moved_triangles(void **state)
{
    static const float lift[4][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    static const char rest[] =
        "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
        "{\"camera\":0,\"translation\":[0,0,4]}],\n" SQUARE_CAMERA
        ",\n\"meshes\":[{\"weights\":[0.5],\"primitives\":[{\"indices\":3,"
        "\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":4}]}]}]";
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    builder b = {.size = 0};
    shot taken;
    (void)state;
    add_square(&b);
    ADD_REALS(&b, lift, "VEC3", 3);
    char *const text = built_scene(&b, rest);
    ASSERT_OK(shoot_text("lifted", text, &options, &taken), taken.err);
    assert_normal("below the diagonal", &taken, 9, 8, (const double[3]){0, -0.25, 1},
                  normal_within);
    assert_normal("above it", &taken, 6, 5, (const double[3]){-0.25, 0, 1}, normal_within);
    shot_clear(&taken);
    free(text);
}

/* A normal map that is the tangent everywhere, but for 1/255 of the other two. */
static const uint8_t along_tangent[4] = {255, 128, 128, 255};
static const double map_within = 0.006;

static const char mapped[] =
    "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"
    "{\"camera\":0,\"translation\":[0,0,4]}],\n" SQUARE_CAMERA
    ",\n%s\"materials\":[{\"normalTexture\":{\"index\":0}}],\n"
    "\"meshes\":[{\"weights\":[1],\"primitives\":[{\"material\":0,\"indices\":3,"
    "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2%s},\"targets\":[{%s}]}]}]";

static void tangents_are_moved_or_made_of_what_is(void **state)
{
    static const float tangents[4][4] = {
        {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
    static const float aside[4][3] = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    static const float shear[4][3] = {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    static const struct {
        const char *name, *attributes, *target;
        double expected[3];
    } cases[] = {
        {"a file's tangents", ",\"TANGENT\":4", "\"TANGENT\":5", {1, 1, 0}},
        {"tangents are not made again", ",\"TANGENT\":4", "\"POSITION\":6", {1, 0, 0}},
        {"tangents made, of a sheared square", "", "\"POSITION\":6", {2, 1, 0}},
    };
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    char *const texture = texture_json(along_tangent, 1, 1);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        builder b = {.size = 0};
        char rest[4096];
        shot taken;
        add_square(&b);
        ADD_REALS(&b, tangents, "VEC4", 4);
        ADD_REALS(&b, aside, "VEC3", 3);
        ADD_REALS(&b, shear, "VEC3", 3);
        snprintf(rest, sizeof rest, mapped, texture, cases[i].attributes, cases[i].target);
        char *const text = built_scene(&b, rest);
        ASSERT_OK(shoot_text("tangents", text, &options, &taken), taken.err);
        assert_normal(cases[i].name, &taken, SIZE / 2, SIZE / 2, cases[i].expected, map_within);
        shot_clear(&taken);
        free(text);
    }
    free(texture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_are_the_animations_else_the_nodes_else_the_meshs),
        cmocka_unit_test(nodes_have_their_own_weights),
        cmocka_unit_test(flat_normals_are_those_of_the_moved_triangles),
        cmocka_unit_test(tangents_are_moved_or_made_of_what_is),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
