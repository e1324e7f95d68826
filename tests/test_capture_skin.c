/* Do skins put vertices, normals and tangents where the joints of glTF 2.0, section 3.7.3, put them? Small
 * scenes by hand, and one made by others against a skinning of our own of its files' numbers. */
#include "assets.h"
#include "gltf_builder.h"
#include "gltf_textures.h"
#include "pixel_rays.h"

enum { SIZE = 15 };
/* Roundings of depth and of unit vectors in float, a few each. */
static const double depth_within = 4e-6, normal_within = 2e-6;

/* --- the square by hand ------------------------------------------------------------------------ */

/* The square with all that a skin may want. Accessors by number: */
enum {
    JOINTS_01 = 4, /* joints 0 and 1 */
    JOINTS_10,     /* joints 1 and 0, as bytes */
    QUARTERS,      /* 0.5 and 1.5, which is a quarter and three */
    HALF,          /* 0.5 and 0 */
    BYTES,         /* 0.2 and 0.8 of normalised bytes */
    SLANTED,       /* normals (0.48, 0.6, 0.64) */
    TANGENTS,      /* (0.6, 0.8, 0, 1) */
    LAST_LIFTED,   /* the corner that both triangles share goes by joint 1, the others by 0 */
    BINDS,         /* of joint 0: 3 m down; of joint 1: none */
    UP,            /* displacements of 1 in z */
};

#define FOUR(...)                                \
    {__VA_ARGS__}, {__VA_ARGS__}, {__VA_ARGS__}, \
    {                                            \
        __VA_ARGS__                              \
    }

static void add_skin(builder *to)
{
    /* joints beyond the skin's where weights are 0 do not count */
    static const uint16_t joints_01[4][4] = {FOUR(0, 1, 900, 900)};
    static const uint8_t joints_10[4][4] = {FOUR(1, 0, 0, 0)};
    static const float quarters[4][4] = {FOUR(0.5f, 1.5f, 0, 0)},
                       half[4][4] = {FOUR(0.5f, 0, 0, 0)};
    static const uint8_t bytes[4][4] = {FOUR(51, 204, 0, 0)};
    static const float slanted[4][3] = {FOUR(0.48f, 0.6f, 0.64f)},
                       tangents[4][4] = {FOUR(0.6f, 0.8f, 0, 1)};
    static const float lifted[4][4] = {{1, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
    static const float binds[2][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -3, 1},
                                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    static const float up[4][3] = {FOUR(0, 0, 1)};
    add_square(to);
    assert_int_equal(add_accessor(to, joints_01, sizeof joints_01, GL_USHORT, 4, "VEC4", ""),
                     JOINTS_01);
    add_accessor(to, joints_10, sizeof joints_10, GL_UBYTE, 4, "VEC4", "");
    ADD_REALS(to, quarters, "VEC4", 4);
    ADD_REALS(to, half, "VEC4", 4);
    add_accessor(to, bytes, sizeof bytes, GL_UBYTE, 4, "VEC4", ",\"normalized\":true");
    ADD_REALS(to, slanted, "VEC3", 3);
    ADD_REALS(to, tangents, "VEC4", 4);
    ADD_REALS(to, lifted, "VEC4", 4);
    ADD_REALS(to, binds, "MAT4", 16);
    assert_int_equal(ADD_REALS(to, up, "VEC3", 3), UP);
}

/* Further members of the skin; textures; nodes 1 and 2, which are the joints; attributes; targets. The
 * square's own node is far off, which must not matter. */
static const char skinned[] =
    "\"scenes\":[{\"nodes\":[0,1,2,3]}],\"nodes\":[\n"
    "{\"mesh\":0,\"skin\":0,\"translation\":[50,60,70],\"scale\":[-7,1,1]},\n{%s},\n{%s},\n"
    "{\"camera\":0,\"translation\":[0,0,4]}],\n\"skins\":[{%s\"joints\":[1,2]}],"
    "\n" SQUARE_CAMERA ",\n%s\"materials\":[{},{\"normalTexture\":{\"index\":0}}],\n"
    "\"meshes\":[{%s\"primitives\":[{%s,\"indices\":3,\"attributes\":{\"POSITION\":0%s}}]}]";

#define N "\"NORMAL\":1"
#define BY_01 ",\"JOINTS_0\":4"
#define PLAIN "\"material\":0"

static const uint8_t along_bitangent[4] = {128, 255, 128, 255};
static const uint8_t along_tangent[4] = {255, 128, 128, 255};

static const struct {
    const char *name, *joints[2], *skin, *material, *mesh, *attributes;
    const uint8_t *map; /* NULL: none */
    double depth, normal[3];
} cases[] = {
    {"weights of sum 2",
     {"\"translation\":[0,0,1]", "\"translation\":[0,0,-1]"},
     "",
     PLAIN,
     "",
     "," N BY_01 ",\"WEIGHTS_0\":6",
     NULL,
     4.5,
     {0, 0, 1}},
    {"joints and weights as bytes",
     {"\"translation\":[0,0,1]", "\"translation\":[0,0,-1]"},
     "",
     PLAIN,
     "",
     "," N ",\"JOINTS_0\":5,\"WEIGHTS_0\":8",
     NULL,
     4 + 0.2 - 0.8,
     {0, 0, 1}},
    {"two sets",
     {"\"translation\":[0,0,1]", "\"translation\":[0,0,-1]"},
     "",
     PLAIN,
     "",
     "," N BY_01 ",\"WEIGHTS_0\":6,\"JOINTS_1\":5,\"WEIGHTS_1\":7",
     NULL,
     4 + 0.6,
     {0, 0, 1}},
    {"inverse bind matrices",
     {"\"translation\":[0,0,1]", "\"translation\":[0,0,-1]"},
     "\"inverseBindMatrices\":12,\"skeleton\":1,",
     PLAIN,
     "",
     "," N BY_01 ",\"WEIGHTS_0\":7",
     NULL,
     6,
     {0, 0, 1}},
    {"normals by the inverse transpose",
     {"\"scale\":[2,1,1]", ""},
     "",
     PLAIN,
     "",
     ",\"NORMAL\":9" BY_01 ",\"WEIGHTS_0\":7",
     NULL,
     4,
     {0.24, 0.6, 0.64}},
    {"a joint that mirrors",
     {"\"scale\":[-1,1,1]", ""},
     "",
     PLAIN,
     "",
     ",\"NORMAL\":9" BY_01 ",\"WEIGHTS_0\":7",
     NULL,
     4,
     {-0.48, 0.6, 0.64}},
    {"a joint that turns tangents",
     {"\"rotation\":[0,0,0.70710678,0.70710678]", ""},
     "",
     "\"material\":1",
     "",
     "," N BY_01 ",\"WEIGHTS_0\":7,\"TEXCOORD_0\":2,\"TANGENT\":10",
     along_tangent,
     4,
     {-0.8, 0.6, 0}},
    {"tangents by the matrix, not as normals",
     {"\"scale\":[2,1,1]", ""},
     "",
     "\"material\":1",
     "",
     "," N BY_01 ",\"WEIGHTS_0\":7,\"TEXCOORD_0\":2,\"TANGENT\":10",
     along_tangent,
     4,
     {1.2, 0.8, 0}},
    {"a mirror's bitangent",
     {"\"scale\":[-1,1,1]", ""},
     "",
     "\"material\":1",
     "",
     "," N BY_01 ",\"WEIGHTS_0\":7,\"TEXCOORD_0\":2,\"TANGENT\":10",
     along_bitangent,
     4,
     {0.8, 0.6, 0}},
    /* e - n (e.n), times 3 in y: made of what was moved it would be another */
    {"tangents are made before",
     {"\"scale\":[1,3,1]", ""},
     "",
     "\"material\":1",
     "",
     ",\"NORMAL\":9" BY_01 ",\"WEIGHTS_0\":7,\"TEXCOORD_0\":2",
     along_tangent,
     4,
     {0.7696, -0.864, -0.3072}},
    {"morphed before",
     {"\"scale\":[1,1,2]", ""},
     "",
     PLAIN,
     "\"weights\":[0.5],",
     "," N BY_01 ",\"WEIGHTS_0\":7},\"targets\":[{\"POSITION\":13}],\"extras\":{",
     NULL,
     3,
     {0, 0, 1}},
};

static char *skin_scene(size_t i)
{
    char *const texture = texture_json(cases[i].map ? cases[i].map : along_tangent, 1, 1);
    builder b = {.size = 0};
    char rest[8192];
    add_skin(&b);
    snprintf(rest, sizeof rest, skinned, cases[i].joints[0], cases[i].joints[1], cases[i].skin,
             texture, cases[i].mesh, cases[i].material, cases[i].attributes);
    free(texture);
    return built_scene(&b, rest);
}

static void squares_are_where_their_joints_are(void **state)
{
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        /* A texel of 128 is 1/255 off the middle. */
        const double within = cases[i].map ? 0.006 : normal_within;
        const double *const n = cases[i].normal;
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        char *const text = skin_scene(i);
        double normal[3];
        shot taken;
        ASSERT_OK(shoot_text("skin", text, &options, &taken), taken.err);
        assert_near(cases[i].name, depth_at_center(&taken), cases[i].depth, depth_within);
        normal_at(&taken, SIZE / 2, SIZE / 2, normal);
        for (int c = 0; c < 3; c++)
            assert_near(cases[i].name, normal[c], n[c] / length, within);
        assert_null(strstr(taken.notices.text, "skin"));
        shot_clear(&taken);
        free(text);
    }
}

/* A flat triangle is flat where it stands, however its corners were moved. */
static void flat_normals_are_those_of_the_moved_triangles(void **state)
{
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    builder b = {.size = 0};
    char rest[2048];
    double normal[3];
    shot taken;
    (void)state;
    add_skin(&b);
    snprintf(rest, sizeof rest, skinned, "", "\"translation\":[0,0,0.5]", "", "", "", PLAIN,
             BY_01 ",\"WEIGHTS_0\":11");
    char *const text = built_scene(&b, rest);
    ASSERT_OK(shoot_text("flat", text, &options, &taken), taken.err);
    normal_at(&taken, 9, 8, normal);
    assert_near("below the diagonal", normal[1], -0.25 / sqrt(1.0625), normal_within);
    assert_near("below the diagonal", normal[2], 1 / sqrt(1.0625), normal_within);
    normal_at(&taken, 6, 5, normal);
    assert_near("above it", normal[0], -0.25 / sqrt(1.0625), normal_within);
    assert_near("above it", normal[2], 1 / sqrt(1.0625), normal_within);
    shot_clear(&taken);
    free(text);
}

/* A vertex that is taken apart, for its normal or its tangents, goes by its own joints on every side. */
static void parted_vertices_keep_their_joints(void **state)
{
    static const struct {
        const char *material, *attributes;
    } ways[] = {
        {PLAIN, "," N BY_01 ",\"WEIGHTS_0\":11"},                             /* shared */
        {PLAIN, BY_01 ",\"WEIGHTS_0\":11"},                                   /* flat */
        {"\"material\":1", "," N BY_01 ",\"WEIGHTS_0\":11,\"TEXCOORD_0\":2"}, /* tangents */
        {"\"material\":1", BY_01 ",\"WEIGHTS_0\":11,\"TEXCOORD_0\":2"},       /* both */
    };
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    char *const texture = texture_json(along_tangent, 1, 1);
    shot taken[COUNT_OF(ways)];
    (void)state;
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        builder b = {.size = 0};
        char rest[4096];
        add_skin(&b);
        snprintf(rest, sizeof rest, skinned, "", "\"translation\":[0,0,0.5]", "", texture, "",
                 ways[i].material, ways[i].attributes);
        char *const text = built_scene(&b, rest);
        ASSERT_OK(shoot_text("parted", text, &options, &taken[i]), taken[i].err);
        free(text);
        for (uint32_t k = 0; k < SIZE * SIZE;
             k++) /* a diagonal has two sides, as rounding goes */
            assert_near("depth", (double)shown_at(&taken[i], TL_DEPTH, k % SIZE, k / SIZE),
                        (double)shown_at(&taken[0], TL_DEPTH, k % SIZE, k / SIZE),
                        depth_within);
    }
    for (size_t i = 0; i < COUNT_OF(ways); i++)
        shot_clear(&taken[i]);
    free(texture);
}

/* At 10,000 km floats are 1 m apart; a square of 0.6 m is the same there as at home. */
static void far_from_home_all_is_the_same(void **state)
{
    static const char *const joints[2] = {
        "\"scale\":[0.3,0.3,0.3],\"translation\":[0,0,1]",
        "\"scale\":[0.3,0.3,0.3],\"translation\":[10000000,0,1]"};
    const tl_capture_options options = {.width = SIZE, .height = SIZE};
    shot taken[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        builder b = {.size = 0};
        char rest[2048];
        add_skin(&b);
        snprintf(rest, sizeof rest, skinned, joints[i], "", "", "", "", PLAIN,
                 "," N BY_01 ",\"WEIGHTS_0\":7");
        char *text = built_scene(&b, rest);
        if (i == 1)
            text = edited(text, "\"camera\":0,\"translation\":[0,0,4]",
                          "\"camera\":0,\"translation\":[10000000,0,4]");
        ASSERT_OK(shoot_text("far", text, &options, &taken[i]), taken[i].err);
        free(text);
    }
    for (uint32_t k = 0; k < SIZE * SIZE; k++)
        assert_true(same_bits(shown_at(&taken[0], TL_DEPTH, k % SIZE, k / SIZE),
                              shown_at(&taken[1], TL_DEPTH, k % SIZE, k / SIZE)));
    shot_clear(&taken[0]);
    shot_clear(&taken[1]);
}

/* --- SimpleSkin -------------------------------------------------------------------------------- */

enum { VERTICES = 10, INDICES = 24, KEYS = 12 };

/* What its files say, by the offsets in its .gltf: nodes 1 and 2 are the joints, the second 1 m above
 * the first and turned about z by the animation. */
typedef struct simple_skin {
    float positions[VERTICES][3], weights[VERTICES][4], times[KEYS], rotations[KEYS][4];
    float binds[2][16];
    uint16_t indices[INDICES], joints[VERTICES][8];
    double moved[VERTICES][2]; /* in the plane z = 0 */
} simple_skin;

#define FOLDER "SimpleSkin/glTF/"

static int read_simple_skin(simple_skin *s)
{
    return read_asset(FOLDER "skinGeometry.bin", 0, s->indices, sizeof s->indices) &&
           read_asset(FOLDER "skinGeometry.bin", 48, s->positions, sizeof s->positions) &&
           read_asset(FOLDER "skinningData.bin", 0, s->joints, sizeof s->joints) &&
           read_asset(FOLDER "skinningData.bin", 160, s->weights, sizeof s->weights) &&
           read_asset(FOLDER "inverseBindMatrices.bin", 0, s->binds, sizeof s->binds) &&
           read_asset(FOLDER "skinAnimation.bin", 0, s->times, sizeof s->times) &&
           read_asset(FOLDER "skinAnimation.bin", 48, s->rotations, sizeof s->rotations);
}

/* All turns are about z, where the short way between two is a straight line between angles. */
static double angle_at(const simple_skin *s, double time)
{
    double angles[2];
    int k = 0;
    while (k < KEYS - 1 && (double)s->times[k + 1] <= time)
        k++;
    const int next = k < KEYS - 1 ? k + 1 : k;
    const double span = (double)s->times[next] - (double)s->times[k];
    const double t =
        span > 0 && time > (double)s->times[k] ? (time - (double)s->times[k]) / span : 0;
    for (int i = 0; i < 2; i++) {
        const float *const q = s->rotations[i ? next : k];
        angles[i] = 2.0 * atan2((double)q[2], (double)q[3]);
    }
    return angles[0] + t * (angles[1] - angles[0]);
}

static void move_vertices(simple_skin *s, double angle)
{
    for (int v = 0; v < VERTICES; v++) {
        double sum[2] = {0, 0}, total = 0;
        for (int k = 0; k < 4; k++) {
            const int joint = s->joints[v][k];
            const float *const m = s->binds[joint]; /* columns */
            const double x = (double)m[0] * (double)s->positions[v][0] +
                             (double)m[4] * (double)s->positions[v][1] + (double)m[12];
            const double y = (double)m[1] * (double)s->positions[v][0] +
                             (double)m[5] * (double)s->positions[v][1] + (double)m[13];
            const double turn = joint == 1 ? angle : 0.0, weight = (double)s->weights[v][k];
            sum[0] += weight * (cos(turn) * x - sin(turn) * y);
            sum[1] += weight * (sin(turn) * x + cos(turn) * y + (joint == 1 ? 1.0 : 0.0));
            total += weight;
        }
        s->moved[v][0] = sum[0] / total;
        s->moved[v][1] = sum[1] / total;
    }
}

static double side(const double a[2], const double b[2], const double p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Only fronts are seen. */
static double hit_skin(const void *scene, const pixel_ray *ray)
{
    const simple_skin *const s = scene;
    const double depth = -ray->from[2] / ray->along[2];
    const double p[2] = {ray->from[0] + depth * ray->along[0],
                         ray->from[1] + depth * ray->along[1]};
    for (int i = 0; i < INDICES; i += 3) {
        const double *const a = s->moved[s->indices[i]], *const b = s->moved[s->indices[i + 1]],
                            *const c = s->moved[s->indices[i + 2]];
        if (side(a, b, p) > 0 && side(b, c, p) > 0 && side(c, a, p) > 0)
            return depth;
    }
    return INFINITY;
}

static void the_skin_of_others_moves_as_its_numbers_say(void **state)
{
    static const double times[] = {0,   0.25, 0.5, 1,    1.3, 1.75, 2.2,
                                   3.1, 3.5,  4.4, 5.25, 5.5, 9};
    simple_skin s;
    (void)state;
    if (!read_simple_skin(&s))
        skip();
    char *const path = asset_path(FOLDER "SimpleSkin.gltf");
    for (size_t i = 0; i < COUNT_OF(times); i++) {
        const tl_capture_options options = {
            .width = 96, .height = 96, .time = times[i], .has_time = true};
        size_t surface_count;
        shot taken;
        ASSERT_OK(shoot(path, &options, &taken), taken.err);
        move_vertices(&s, angle_at(&s, times[i]));
        assert_depths(&taken, hit_skin, &s, 1e-6, &surface_count);
        assert_in_range(surface_count, 1000, 96 * 96);
        shot_clear(&taken);
    }
    free(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_are_where_their_joints_are),
        cmocka_unit_test(flat_normals_are_those_of_the_moved_triangles),
        cmocka_unit_test(parted_vertices_keep_their_joints),
        cmocka_unit_test(far_from_home_all_is_the_same),
        cmocka_unit_test(the_skin_of_others_moves_as_its_numbers_say),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
