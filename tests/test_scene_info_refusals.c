/* Does what a capture refuses end a description in the same status and sentence, and does a fault that
 * only a choice would meet stand beside that choice, in the sentence that a capture with it gives? */
#include "gltf_textures.h"

#include "tilelight/scene_info.h"

static const char *scene_path(void)
{
    static char path[512];
    return scratch_path(path, sizeof path, "scene_info_refusals.gltf");
}

static void write_scene(char *text)
{
    write_file(scene_path(), text, strlen(text));
    free(text);
}

static void expect_same_end(const char *name, tl_status expected, const char *path)
{
    shot taken;
    tl_scene_info info = {0};
    tl_error err;
    const tl_status captured =
        shoot(path, &(tl_capture_options){.width = 8, .height = 8}, &taken);
    const tl_status described = tl_scene_describe(path, NULL, &info, &err);
    if (captured != expected || described != captured ||
        strcmp(err.message, taken.err.message) != 0)
        fail_msg("%s: captured with %d, described with %d, wanted %d\n%s\n%s", name, captured,
                 described, expected, taken.err.message, err.message);
    assert_null(info.source);
    shot_clear(&taken);
}

static void both_refuse_alike(void **state)
{
    /* A PNG whose header is whole, and nothing behind it. */
    static const char cut_image[] =
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0k\"}],\"materials\":";
    static const struct {
        const char *name, *old, *new;
        tl_status expected;
    } cases[] = {
        {"no JSON", "{\"asset\"", "\"asset\"", TL_ERR_FORMAT},
        {"another version", "\"2.0\"", "\"1.0\"", TL_ERR_UNSUPPORTED},
        {"a required extension", "\"scene\":0,",
         "\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],\"extensionsRequired\":["
         "\"KHR_draco_mesh_compression\"],\"scene\":0,",
         TL_ERR_UNSUPPORTED},
        {"an unknown scene", "\"scene\":0", "\"scene\":3", TL_ERR_FORMAT},
        {"a node that is its own child", "\"name\":\"quad\"", "\"children\":[0]",
         TL_ERR_FORMAT},
        {"an unknown mesh", "\"mesh\":0", "\"mesh\":5", TL_ERR_FORMAT},
        {"an index behind the vertices", "\"count\":4,\"type\":\"VEC3\"},\n {\"bufferView\":1",
         "\"count\":2,\"type\":\"VEC3\"},\n {\"bufferView\":1", TL_ERR_FORMAT},
        {"an accessor behind its view", "\"count\":6", "\"count\":7", TL_ERR_FORMAT},
        {"an unknown material", "\"material\":0", "\"material\":4", TL_ERR_FORMAT},
        {"an unknown mode of alpha", "\"name\":\"paint\"", "\"alphaMode\":\"CUT\"",
         TL_ERR_FORMAT},
        {"a light of no type", "\"scene\":0,",
         "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":"
         "{\"lights\":[{\"type\":\"area\"}]}},\"scene\":0,",
         TL_ERR_FORMAT},
        {"a default camera that sees nothing", "\"yfov\":1.0", "\"yfov\":4.0", TL_ERR_FORMAT},
        {"an image without its end", "\"materials\":", cut_image, TL_ERR_FORMAT},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *text = edited(square_scene(&square), cases[i].old, cases[i].new);
        if (strstr(cases[i].new, "lights"))
            text =
                edited(text, "\"camera\":0,",
                       "\"camera\":0,\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}},");
        if (cases[i].new == cut_image)
            text = edited(text, "\"metallicFactor\":0.125",
                          "\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0.125");
        write_scene(text);
        expect_same_end(cases[i].name, cases[i].expected, scene_path());
    }
    write_file(scene_path(), "", 0);
    expect_same_end("empty", TL_ERR_READ, scene_path());
    expect_same_end("no file", TL_ERR_READ, "/nonexistent/scene.gltf");
}

/* Ends early everywhere: every 16th byte, as test_gltf_truncations.c tries all of them on the reader. */
static void both_refuse_truncations_alike(void **state)
{
    char *const text = square_scene(&square);
    const size_t size = strlen(text) - 2; /* the last brace is needed */
    (void)state;
    for (size_t length = 16; length < size; length += 16) {
        write_file(scene_path(), text, length);
        expect_same_end("truncated", TL_ERR_FORMAT, scene_path());
    }
    free(text);
}

/* What a capture with these options says of the scene. */
static void expect_refusal(const char *refusal, const tl_capture_options *options)
{
    shot taken;
    assert_int_equal(shoot(scene_path(), options, &taken), TL_ERR_FORMAT);
    assert_non_null(refusal);
    assert_string_equal(refusal, taken.err.message);
    shot_clear(&taken);
}

static void a_choice_that_fails_says_why(void **state)
{
    tl_scene_info info;
    tl_error err;
    char *text = edited(square_scene(&square), "\"nodes\":[0,1]}", "\"nodes\":[0,1,2]}");
    text = edited(text, "\"translation\":[0,0,4]}]",
                  "\"translation\":[0,0,4]},{\"name\":\"blind\",\"camera\":1}]");
    text =
        edited(text, "\"zfar\":100}}]",
               "\"zfar\":100}},{\"type\":\"perspective\",\"perspective\":{\"yfov\":4,"
               "\"znear\":1}}],\"animations\":[{\"name\":\"lame\",\"samplers\":[{\"input\":3,"
               "\"output\":0}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
               "\"translation\"}}]}]");
    (void)state;
    write_scene(text);
    ASSERT_OK(tl_scene_describe(scene_path(), NULL, &info, &err), err);
    assert_int_equal(info.camera_count, 2);
    assert_null(info.cameras[0].refusal);
    expect_refusal(info.cameras[1].refusal, &(tl_capture_options){.camera = "blind"});
    assert_int_equal(info.animation_count, 1);
    assert_int_equal(info.animations[0].curve_count, 1);
    expect_refusal(info.animations[0].refusal, &(tl_capture_options){.animation = "lame"});
    tl_scene_info_clear(&info);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_refuse_alike),
        cmocka_unit_test(both_refuse_truncations_alike),
        cmocka_unit_test(a_choice_that_fails_says_why),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
