/* Is every scene whose animation, morph targets, skin or instances cannot be shown refused, in these very
 * words? And does any digit of such a scene, changed, end in a refusal or in a scene? */
#include "gltf_builder.h"

/* Nodes: 0 skinned and morphed, 1 and 2 its joints, 3 instances, 4 a matrix, 5 not in the scene. */
static const char rest[] =
    "\"scene\":0,\"scenes\":[{\"nodes\":[0,1,3,4]}],\n"
    "\"nodes\":[{\"mesh\":0,\"skin\":0,\"weights\":[0.5,0]},{\"children\":[2]},{},\n"
    " {\"mesh\":1,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":"
    "{\"TRANSLATION\":1,\"ROTATION\":9}}}},\n"
    " {\"mesh\":1,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{\"name\":\"lost\"}],\n"
    "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],\n"
    "\"skins\":[{\"name\":\"bones\",\"inverseBindMatrices\":6,\"joints\":[1,2]}],\n"
    "\"meshes\":[{\"name\":\"body\",\"weights\":[0,1],\"primitives\":[{\"indices\":3,\n"
    "  \"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":4,\"WEIGHTS_0\":5},\n"
    "  \"targets\":[{\"POSITION\":0,\"NORMAL\":1},{\"POSITION\":1}]}]},\n"
    " {\"primitives\":[{\"indices\":3,\"attributes\":{\"POSITION\":0}}]}],\n"
    "\"animations\":[{\"name\":\"walk\",\"samplers\":[\n"
    "  "
    "{\"input\":7,\"output\":8,\"interpolation\":\"CUBICSPLINE\"},{\"input\":7,\"output\":9},\n"
    "  {\"input\":7,\"output\":10,\"interpolation\":\"STEP\"}],\"channels\":[\n"
    "  {\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}},\n"
    "  {\"sampler\":1,\"target\":{\"node\":2,\"path\":\"rotation\"}},\n"
    "  {\"sampler\":2,\"target\":{\"node\":0,\"path\":\"weights\"}}]},\n"
    " {\"channels\":[],\"samplers\":[]}]";

/* The numbers behind it, for cases to spoil. */
typedef struct motion_data {
    uint8_t joints[4][4];
    float weights[4][4], binds[2][16];
    float times[4], splines[12][3], rotations[4][4], targets[8];
} motion_data;

static const motion_data good = {
    .joints = {{0, 1, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}},
    .weights = {{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}},
    .binds = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
              {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    .times = {0, 1, 2, 3},
    .rotations = {{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}},
};

static char *motion_scene(const motion_data *data)
{
    builder b = {.size = 0};
    add_square(&b);
    add_accessor(&b, data->joints, sizeof data->joints, GL_UBYTE, 4, "VEC4", "");
    ADD_REALS(&b, data->weights, "VEC4", 4);
    ADD_REALS(&b, data->binds, "MAT4", 16);
    ADD_REALS(&b, data->times, "SCALAR", 1);
    ADD_REALS(&b, data->splines, "VEC3", 3);
    assert_int_equal(ADD_REALS(&b, data->rotations, "VEC4", 4), 9);
    ADD_REALS(&b, data->targets, "SCALAR", 1);
    return built_scene(&b, rest);
}

static const tl_capture_options walking = {
    .width = 8, .height = 8, .animation = "walk", .time = 0.5, .has_time = true};

/* What it says, behind the file's name. */
static void assert_refused(const char *text,
                           const tl_capture_options *options,
                           tl_status want,
                           const char *sentence)
{
    shot taken;
    char path[512], whole[1024];
    const tl_status status = shoot_text("motion", text, options, &taken);
    snprintf(whole, sizeof whole, "%s: %s", scratch_path(path, sizeof path, "motion.gltf"),
             sentence);
    if (status != want || strcmp(taken.err.message, whole) != 0)
        fail_msg("status %d, want %d:\n  \"%s\", want\n  \"%s\"", (int)status, (int)want,
                 status == TL_OK ? "" : taken.err.message, whole);
    shot_clear(&taken);
}

static const struct {
    const char *old, *new;
    tl_status status;
    const char *sentence;
} cases[] = {
    /* animations */
    {"\"node\":2", "\"node\":9", TL_ERR_FORMAT,
     "animation 0 (\"walk\") refers to node 9, but the file has 6"},
    {"\"sampler\":1", "\"sampler\":3", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the rotation of node 2 refers to sampler 3, but the file has 3"},
    {"\"rotation\"}", "\"tint\"}", TL_ERR_FORMAT,
     "animation 0 (\"walk\") moves the \"tint\" of node 2, which nodes have not"},
    {"CUBICSPLINE", "CATMULLROM", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the translation of node 1: the interpolation \"CATMULLROM\" is "
     "none; there "
     "are LINEAR, STEP and CUBICSPLINE"},
    {"\"node\":2,\"path\":\"rotation\"", "\"node\":4,\"path\":\"rotation\"", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the rotation of node 4: it has a matrix, and only what has none "
     "can move"},
    {"{\"sampler\":1,\"target\":{\"node\":2,\"path\":\"rotation\"}}",
     "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the translation of node 1 is moved by two channels"},
    {"\"node\":0,\"path\":\"weights\"", "\"node\":2,\"path\":\"weights\"", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the weights of node 2: it has no mesh with morph targets"},
    {"\"node\":0,\"path\":\"weights\"", "\"node\":3,\"path\":\"weights\"", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the weights of node 3: it has no mesh with morph targets"},
    {"\"output\":8", "\"output\":9", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the translation of node 1: output cannot be accessor 9 with 4 "
     "components of "
     "type 5126"},
    {"\"output\":8", "\"output\":0", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the translation of node 1 has 4 elements for 4 keys, where "
     "CUBICSPLINE needs "
     "3 each"},
    {"\"input\":7,\"output\":9", "\"input\":10,\"output\":9", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the rotation of node 2: its key 1 at 0 s is not after the one at "
     "0 s"},
    {"\"STEP\"", "\"CUBICSPLINE\"", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the weights of node 0 has 8 elements for 4 keys, where "
     "CUBICSPLINE needs 6 "
     "each"},
    {"\"input\":7,\"output\":8", "\"input\":77,\"output\":8", TL_ERR_FORMAT,
     "animation 0 (\"walk\"): the translation of node 1 refers to accessor 77, but the file "
     "has 11"},
    {"{\"input\":7,\"output\":9}", "{\"output\":9}", TL_ERR_FORMAT,
     "is not valid glTF: 'input' property is missing. `input` field is missing in "
     "animation.sampler"},
    {"\"node\":2,\"path\":\"rotation\"", "\"node\":2", TL_ERR_FORMAT,
     "is not valid glTF: 'path' property is missing. `path` field is missing in "
     "animation.channels.target"},

    /* morph targets */
    {"\"weights\":[0,1]", "\"weights\":[0]", TL_ERR_FORMAT,
     "mesh 0 (\"body\") has 1 weights for 2 morph targets"},
    {"\"weights\":[0.5,0]", "\"weights\":[0.5,0,1]", TL_ERR_FORMAT,
     "node 0 has 3 weights for 2 morph targets"},
    {"\"mesh\":1,\"matrix\"", "\"mesh\":1,\"weights\":[1],\"matrix\"", TL_ERR_FORMAT,
     "node 4 has 1 weights for 0 morph targets"},
    {"{\"POSITION\":1}]}]", "{\"POSITION\":1}]},{\"attributes\":{\"POSITION\":0}}]",
     TL_ERR_FORMAT,
     "mesh 0 (\"body\"): its primitives have 2 and 0 morph targets; all need the same"},
    {"{\"POSITION\":1}]", "{\"POSITION\":3}]", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0, morph target 1: POSITION cannot be accessor 3 with 1 "
     "components of "
     "type 5123"},
    {"{\"POSITION\":1}]", "{\"POSITION\":8}]", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0, morph target 1 has 12 displacements of POSITION for 4 "
     "vertices"},
    {"{\"POSITION\":1}]", "{\"TANGENT\":1}]", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0, morph target 1 displaces TANGENT, which the primitive "
     "has not"},
    /* skins */
    {"\"skin\":0", "\"skin\":1", TL_ERR_FORMAT, "node 0 refers to skin 1, but the file has 1"},
    {"\"joints\":[1,2]", "\"joints\":[1,7]", TL_ERR_FORMAT,
     "skin 0 (\"bones\") refers to node 7, but the file has 6"},
    {"\"joints\":[1,2]", "\"joints\":[1,5]", TL_ERR_FORMAT,
     "skin 0 (\"bones\"): its joint 1, node 5, is not in the scene"},
    {"\"joints\":[1,2]", "\"joints\":[]", TL_ERR_FORMAT, "skin 0 (\"bones\") has no joints"},
    {"\"joints\":[1,2]", "\"joints\":[1,2,1]", TL_ERR_FORMAT,
     "skin 0 (\"bones\") has 2 inverse bind matrices for 3 joints"},
    {"\"joints\":[1,2]", "\"skeleton\":6,\"joints\":[1,2]", TL_ERR_FORMAT,
     "skin 0 (\"bones\") refers to node 6, but the file has 6"},
    {"\"joints\":[1,2]", "\"joints\":[1]", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0: vertex 2 is moved by joint 1, but its skin has 1"},
    {"\"inverseBindMatrices\":6", "\"inverseBindMatrices\":5", TL_ERR_FORMAT,
     "skin 0 (\"bones\"): inverseBindMatrices cannot be accessor 5 with 4 components of type "
     "5126"},
    {",\"JOINTS_0\":4,\"WEIGHTS_0\":5", "", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0 has no JOINTS_0, which its skin needs"},
    {",\"WEIGHTS_0\":5", "", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0 has no WEIGHTS_0, which its skin needs"},
    {"\"WEIGHTS_0\":5", "\"WEIGHTS_0\":5,\"JOINTS_1\":4", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0 has no WEIGHTS_1, which its skin needs"},
    {"\"JOINTS_0\":4", "\"JOINTS_0\":5", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0: JOINTS cannot be accessor 5 with 4 components of type "
     "5126"},
    {"\"WEIGHTS_0\":5", "\"WEIGHTS_0\":4", TL_ERR_FORMAT,
     "mesh 0 (\"body\"), primitive 0: WEIGHTS cannot be accessor 4 with 4 components of type "
     "5121"},

    /* instances */
    {"\"TRANSLATION\":1", "\"TRANSLATION\":11", TL_ERR_FORMAT,
     "node 3 refers to accessor 11, but the file has 11"},
    {"\"TRANSLATION\":1", "\"TRANSLATION\":8", TL_ERR_FORMAT,
     "node 3 has instances whose attributes are 12 and 4 elements"},
    {"\"TRANSLATION\":1", "\"TRANSLATION\":5", TL_ERR_FORMAT,
     "node 3: TRANSLATION cannot be accessor 5 with 4 components of type 5126"},
    {"\"ROTATION\":9", "\"SCALE\":0.5", TL_ERR_FORMAT,
     "node 3 refers to accessor -2, but the file has 11"},
    {"\"mesh\":1,\"extensions\"", "\"mesh\":0,\"skin\":0,\"extensions\"", TL_ERR_UNSUPPORTED,
     "node 3 has a skin and instances, which glTF gives no meaning together"},
};

static void refuses_with_the_sentence(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *const text = edited(motion_scene(&good), cases[i].old, cases[i].new);
        assert_refused(text, &walking, cases[i].status, cases[i].sentence);
        free(text);
    }
}

/* Numbers in buffers. */
static void refuses_numbers(void **state)
{
    motion_data bad[] = {good, good, good, good, good, good, good, good, good, good};
    static const char *const sentences[] = {
        "animation 0 (\"walk\"): the translation of node 1: its key 2 at 1 s is not after the "
        "one at 1 s",
        "animation 0 (\"walk\"): the translation of node 1 begins at -0.5 s, before 0",
        "accessor 7: element 3 is not finite",
        "accessor 8: element 0 is not finite",
        "animation 0 (\"walk\"): the rotation of node 2: its key 3 is a rotation of length 0",
        "mesh 0 (\"body\"), primitive 0: vertex 1 has the weight -0.25 for a joint",
        "mesh 0 (\"body\"), primitive 0: no joint moves its vertex 3",
        "skin 0 (\"bones\"): its inverse bind matrix 1 has a last row that is not 0 0 0 1",
        "mesh 0 (\"body\"), primitive 0: vertex 1 is not finite where its skin puts it",
        "mesh 0 (\"body\"), primitive 0: vertex 0 is moved by joint 2, but its skin has 2",
    };
    (void)state;
    bad[0].times[2] = 1;
    bad[1].times[0] = -0.5f;
    bad[2].times[3] = INFINITY;
    bad[3].splines[0][2] = NAN;
    memset(bad[4].rotations[3], 0, sizeof bad[4].rotations[3]);
    bad[5].weights[1][3] = -0.25f;
    memset(bad[6].weights[3], 0, sizeof bad[6].weights[3]);
    bad[7].binds[1][15] = 0.5f;
    bad[8].binds[0][0] = bad[8].binds[0][12] = -3e38f;
    bad[9].joints[0][0] = 2;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        char *const text = motion_scene(&bad[i]);
        assert_refused(text, &walking, TL_ERR_FORMAT, sentences[i]);
        free(text);
    }
}

/* Each number is a good one; what becomes of them is not. */
static void refuses_sums(void **state)
{
    const tl_capture_options resting = {.width = 8, .height = 8};
    char *const text =
        edited(motion_scene(&good), "\"weights\":[0.5,0]", "\"weights\":[1e300,0]");
    (void)state;
    assert_refused(
        text, &resting, TL_ERR_FORMAT,
        "mesh 0 (\"body\"), primitive 0: the POSITION of vertex 0 is not finite once "
        "it is morphed");
    free(text);
}

/* A few bytes that ask for much: an accessor without a view is as many zeros as it says. */
static void refuses_hordes(void **state)
{
    static const struct {
        const char *count, *sentence;
    } hordes[] = {
        {"2000000", "node 3: its scene shows meshes at more than 1048576 places"},
        {"4611686018427387904",
         "node 3: the scene's geometry comes to more memory than it may take"},
    };
    const tl_capture_options resting = {.width = 8, .height = 8};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(hordes); i++) {
        char accessor[128];
        char *text = edited(motion_scene(&good), "\"TRANSLATION\":1,\"ROTATION\":9",
                            "\"TRANSLATION\":11");
        snprintf(accessor, sizeof accessor,
                 ",{\"componentType\":5126,\"count\":%s,\"type\":\"VEC3\"}],\n\"bufferViews\"",
                 hordes[i].count);
        text = edited(text, "],\n\"bufferViews\"", accessor);
        assert_refused(text, &resting, TL_ERR_UNSUPPORTED, hordes[i].sentence);
        free(text);
    }
}

/* Nothing is wrong with the scene, but with what is asked of it. */
static void refuses_moments(void **state)
{
    static const struct {
        const char *animation;
        double time;
        const char *sentence;
    } moments[] = {
        {"run", 1, "has no animation \"run\"; it has: 0 (\"walk\"), 1"},
        {"2", 1, "has no animation \"2\"; it has: 0 (\"walk\"), 1"},
        {"-1", 1, "has no animation \"-1\"; it has: 0 (\"walk\"), 1"},
        {"", 1, "has no animation \"\"; it has: 0 (\"walk\"), 1"},
        {"walk", -1, "cannot be shown at -1 s: times start at 0"},
        {"walk", (double)NAN, "cannot be shown at nan s: times start at 0"},
        {NULL, (double)INFINITY, "cannot be shown at inf s: times start at 0"},
    };
    tl_capture_options options = walking;
    char *text = motion_scene(&good);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(moments); i++) {
        options.animation = moments[i].animation;
        options.time = moments[i].time;
        assert_refused(text, &options, TL_ERR_ARGUMENT, moments[i].sentence);
    }
    text = edited(text, "\"animations\"", "\"extras\"");
    options = walking;
    assert_refused(text, &options, TL_ERR_ARGUMENT,
                   "has no animations, so it can only be shown without a time");
    options.animation = NULL;
    assert_refused(text, &options, TL_ERR_ARGUMENT,
                   "has no animations, so it can only be shown without a time");
    free(text);
}

/* What the specification allows, though parsers or habits do not. */
static void accepts_the_unusual(void **state)
{
    static const struct {
        const char *name, *old, *new;
    } unusual[] = {
        {"as it is", "", ""},
        {"no inverse bind matrices", "\"inverseBindMatrices\":6,", ""},
        {"more inverse bind matrices than joints", "\"joints\":[1,2]", "\"joints\":[2]"},
        {"a channel of an extension", "\"node\":2,\"path\":\"rotation\"",
         "\"path\":\"pointer\""},
        {"a target without attributes", "{\"POSITION\":1}]", "{}]"},
        {"joints without a skin", "\"skin\":0,", ""},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(unusual); i++) {
        motion_data data = good;
        shot taken;
        if (i == 2)
            data.weights[2][1] = 0;
        char *const text = edited(motion_scene(&data), unusual[i].old, unusual[i].new);
        if (shoot_text("motion", text, &walking, &taken) != TL_OK)
            fail_msg("%s: %s", unusual[i].name, taken.err.message);
        shot_clear(&taken);
        free(text);
    }
}

/* Another animation than the one that is shown is not looked at. */
static void what_is_not_shown_is_not_judged(void **state)
{
    tl_capture_options options = walking;
    char *const text = edited(motion_scene(&good), "\"node\":2", "\"node\":9");
    shot taken;
    (void)state;
    options.animation = "1";
    ASSERT_OK(shoot_text("motion", text, &options, &taken), taken.err);
    shot_clear(&taken);
    options = (tl_capture_options){.width = 8, .height = 8};
    ASSERT_OK(shoot_text("motion", text, &options, &taken), taken.err);
    shot_clear(&taken);
    free(text);
}

/* The bytes of the buffer aside, which are no digits of ours. To ask for a camera that is not there ends
 * what has been loaded before time is spent on pictures. */
static void every_digit_ends_in_a_refusal_or_a_scene(void **state)
{
    tl_capture_options unseen = walking;
    char *const text = motion_scene(&good);
    const size_t end = (size_t)(strstr(text, "\"buffers\"") - text);
    size_t loaded = 0, refused = 0;
    (void)state;
    unseen.camera = "none";
    for (size_t i = 0; i < end; i++) {
        const char digit = text[i];
        shot taken;
        if (digit < '0' || digit > '9')
            continue;
        text[i] = digit == '9' ? '0' : (char)(digit + 1 + (char)(i % 2));
        if (text[i] > '9')
            text[i] = '9';
        const tl_status status = shoot_text("digit", text, &unseen, &taken);
        const int is_loaded = status == TL_ERR_ARGUMENT && strstr(taken.err.message, "camera");
        if (!is_loaded && status != TL_ERR_FORMAT && status != TL_ERR_UNSUPPORTED)
            fail_msg("%.60s: status %d: %s", text + i, (int)status, taken.err.message);
        loaded += (size_t)is_loaded;
        refused += !is_loaded;
        shot_clear(&taken);
        text[i] = digit;
    }
    assert_in_range(loaded, 20, 400);
    assert_in_range(refused, 50, 400);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_with_the_sentence),
        cmocka_unit_test(refuses_numbers),
        cmocka_unit_test(refuses_sums),
        cmocka_unit_test(refuses_hordes),
        cmocka_unit_test(refuses_moments),
        cmocka_unit_test(accepts_the_unusual),
        cmocka_unit_test(what_is_not_shown_is_not_judged),
        cmocka_unit_test(every_digit_ends_in_a_refusal_or_a_scene),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
