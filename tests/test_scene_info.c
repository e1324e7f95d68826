/* Does a description hold the numbers that the scene has? Those of our own scenes by an independent reader
 * (tests/tools/make_scene_cases.py), those of hard cases by hand. */
#include "gltf_builder.h"
#include "gltf_textures.h"
#include "scene_cases.h"

#include "tilelight/scene_info.h"

static tl_status describe(const char *path, tl_scene_info *out, heard *notices, tl_error *err)
{
    const tl_notices hearing = {hear, notices};
    memset(notices, 0, sizeof *notices);
    return tl_scene_describe(path, &hearing, out, err);
}

/* Writes the text to a file and describes it; frees the text. */
static tl_scene_info describe_text(char *text, heard *notices)
{
    char path[512];
    tl_scene_info info = {0};
    tl_error err;
    scratch_path(path, sizeof path, "scene_info.gltf");
    write_file(path, text, strlen(text));
    free(text);
    ASSERT_OK(describe(path, &info, notices, &err), err);
    return info;
}

static void same_meshes(const tl_scene_meshes *a, const tl_scene_meshes *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->shown_count, b->shown_count);
    assert_int_equal(a->primitive_count, b->primitive_count);
    assert_int_equal(a->triangle_count, b->triangle_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->place_count, b->place_count);
    assert_int_equal(a->drawn_triangle_count, b->drawn_triangle_count);
    assert_int_equal(a->instanced_node_count, b->instanced_node_count);
    assert_int_equal(a->instance_count, b->instance_count);
    assert_int_equal(a->morphed_count, b->morphed_count);
    assert_int_equal(a->target_count, b->target_count);
    assert_int_equal(a->skin_count, b->skin_count);
    assert_int_equal(a->joint_count, b->joint_count);
}

static void same_materials(const tl_scene_materials *a, const tl_scene_materials *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->shown_count, b->shown_count);
    assert_int_equal(a->shows_default, b->shows_default);
    for (int i = 0; i < TL_MATERIAL_TRAIT_COUNT; i++)
        assert_int_equal(a->trait_counts[i], b->trait_counts[i]);
}

static void same_images(const tl_scene_images *a, const tl_scene_images *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->shown_count, b->shown_count);
    assert_int_equal(a->largest_width, b->largest_width);
    assert_int_equal(a->largest_height, b->largest_height);
    assert_int_equal(a->pixel_count, b->pixel_count);
}

/* Positions are moved as floats here and there, by products and sums of numbers below 100: a few of their
 * roundings, 2^-24 each, of the largest. */
static void same_bounds(const tl_scene_info *info, const double low[3], const double high[3])
{
    assert_true(info->has_bounds);
    for (int c = 0; c < 3; c++) {
        assert_near("low", info->low[c], low[c], 16 * 100 * ldexp(1, -24));
        assert_near("high", info->high[c], high[c], 16 * 100 * ldexp(1, -24));
    }
}

static void our_scenes_are_what_another_reader_finds(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(scene_cases); i++) {
        char path[4096];
        tl_scene_info info;
        heard notices;
        tl_error err;
        size_t curves = 0;
        snprintf(path, sizeof path, "%s/data/%s", getenv("TILELIGHT_SOURCE"),
                 scene_cases[i].file);
        ASSERT_OK(describe(path, &info, &notices, &err), err);
        print_message("%s\n", scene_cases[i].file);
        same_meshes(&info.meshes, &scene_cases[i].meshes);
        same_materials(&info.materials, &scene_cases[i].materials);
        same_images(&info.images, &scene_cases[i].images);
        same_bounds(&info, scene_cases[i].low, scene_cases[i].high);
        assert_int_equal(info.camera_count, scene_cases[i].camera_count);
        assert_int_equal(info.camera_count + info.unplaced_camera_count,
                         scene_cases[i].file_camera_count);
        assert_int_equal(info.lights.count, scene_cases[i].light_count);
        assert_int_equal(info.animation_count, scene_cases[i].animation_count);
        for (size_t k = 0; k < info.animation_count; k++) {
            curves += info.animations[k].curve_count;
            assert_true(info.animations[k].seconds == scene_cases[i].longest);
            assert_null(info.animations[k].refusal);
        }
        assert_int_equal(curves, scene_cases[i].curve_count);
        assert_int_equal(notices.count, 0);
        tl_scene_info_clear(&info);
    }
}

/* A mesh of three primitives that are shown, at three places, two of them instances, and one of a single
 * primitive at two instances; what shares vertices is counted once, what is not shown not at all. */
static void what_is_shared_is_counted_once(void **state)
{
    static const float offsets[2][3] = {{10, 0, 0}, {0, 20, 0}};
    static const float targets[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    static const tl_scene_meshes expected = {.count = 4,
                                             .shown_count = 2,
                                             .primitive_count = 4,
                                             .triangle_count = 2 + 2 + 2 + 2,
                                             .vertex_count = 4,
                                             .place_count = 3 + 2,
                                             .drawn_triangle_count = 3 * 6 + 2 * 2,
                                             .instanced_node_count = 2,
                                             .instance_count = 4,
                                             .morphed_count = 1,
                                             .target_count = 2};
    static const double low[3] = {-1, -1, 0}, high[3] = {11, 21, 0.5};
    builder *const made = calloc(1, sizeof *made);
    heard notices;
    (void)state;
    assert_non_null(made);
    add_square(made);
    ADD_REALS(made, offsets, "VEC3", 3); /* 4 */
    ADD_REALS(made, targets, "VEC3", 3); /* 5 */
    tl_scene_info info = describe_text(
        built_scene(
            made,
            "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],"
            "\"scene\":1,\"scenes\":[{\"nodes\":[3]},{\"name\":\"shown\",\"nodes\":[0,1,2]}],"
            "\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":"
            "{\"attributes\":{\"TRANSLATION\":4}}}},{\"mesh\":1,\"extensions\":{"
            "\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":4}}}},{\"mesh\":2}],"
            "\"materials\":[{},{},{\"doubleSided\":true}],"
            "\"meshes\":[{\"primitives\":["
            "{\"material\":1,\"indices\":3,\"attributes\":{\"POSITION\":0,\"NORMAL\":1}},"
            "{\"material\":1,\"indices\":3,\"attributes\":{\"POSITION\":0,\"NORMAL\":1}},"
            "{\"mode\":1,\"material\":2,\"indices\":3,\"attributes\":{\"POSITION\":0}},"
            "{\"material\":0,\"indices\":3,\"attributes\":{\"POSITION\":0}}]},"
            "{\"weights\":[0.5,0],\"primitives\":[{\"indices\":3,\"attributes\":{"
            "\"POSITION\":0,\"NORMAL\":1},\"targets\":[{\"POSITION\":5},{\"POSITION\":5}]}]},"
            "{\"primitives\":[{\"indices\":3,\"attributes\":{\"POSITION\":0}}]},"
            "{\"primitives\":[{\"indices\":3,\"attributes\":{\"POSITION\":0}}]}]"),
        &notices);
    free(made);
    assert_string_equal(info.scene_name, "shown");
    assert_int_equal(info.scene_index, 1);
    assert_int_equal(info.scene_count, 2);
    same_meshes(&info.meshes, &expected);
    same_materials(&info.materials,
                   &(tl_scene_materials){.count = 3, .shown_count = 2, .shows_default = true});
    same_bounds(&info, low, high);
    assert_int_equal(info.camera_count, 0);
    assert_non_null(strstr(notices.text, "1 primitives are points or lines"));
    assert_null(strstr(notices.text, "camera"));
    tl_scene_info_clear(&info);
}

static void nothing_to_show_has_no_bounds(void **state)
{
    heard notices;
    tl_scene_info info =
        describe_text(edited(square_scene(&square), "\"mesh\":0", "\"mesh\":-1"), &notices);
    (void)state;
    assert_false(info.has_bounds);
    assert_int_equal(info.meshes.shown_count, 0);
    assert_int_equal(info.meshes.count, 1);
    assert_int_equal(info.materials.shown_count, 0);
    tl_scene_info_clear(&info);
}

/* Each trait of a material alone; edits of the one that the square has. */
static void traits_are_told_apart(void **state)
{
    static const struct {
        const char *members;
        tl_material_trait trait;
    } cases[] = {
        {"\"extensions\":{\"KHR_materials_unlit\":{}},", TL_MATERIAL_UNLIT},
        {"\"alphaMode\":\"MASK\",", TL_MATERIAL_MASKED},
        {"\"alphaMode\":\"BLEND\",", TL_MATERIAL_BLENDED},
        {"\"doubleSided\":true,", TL_MATERIAL_DOUBLE_SIDED},
        {"\"emissiveFactor\":[0,0.5,0],", TL_MATERIAL_EMISSIVE},
        {"\"normalTexture\":{\"index\":0},", TL_MATERIAL_NORMAL_MAPPED},
    };
    static const uint8_t pixels[2 * 4] = {128, 128, 255, 255, 128, 128, 255, 255};
    (void)state;
    assert_int_equal(COUNT_OF(cases), TL_MATERIAL_TRAIT_COUNT);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const bool has_texture = cases[i].trait == TL_MATERIAL_NORMAL_MAPPED;
        tl_scene_materials expected = {.count = 1, .shown_count = 1};
        char members[256], *const texture = texture_json(pixels, 2, 1);
        heard notices;
        snprintf(members, sizeof members, "%s\"name\":\"paint\"", cases[i].members);
        char *text = edited(square_scene(&square), "\"name\":\"paint\"", members);
        text = edited(text, "\"materials\":", "@\"materials\":");
        text = edited(text, "@", texture);
        free(texture);
        tl_scene_info info = describe_text(text, &notices);
        expected.trait_counts[cases[i].trait] = 1;
        same_materials(&info.materials, &expected);
        same_images(&info.images, has_texture ? &(tl_scene_images){1, 1, 2, 1, 2}
                                              : &(tl_scene_images){.count = 1});
        tl_scene_info_clear(&info);
    }
}

/* Cameras by where they stand in the scene, with what the file says of them. */
static void cameras_are_those_of_the_scene(void **state)
{
    heard notices;
    char *text = edited(square_scene(&square), "\"nodes\":[0,1]}", "\"nodes\":[0,2,1,3]}");
    text = edited(text, "\"translation\":[0,0,4]}]",
                  "\"translation\":[0,0,4]},{\"name\":\"over\",\"camera\":1,"
                  "\"translation\":[0,0,4]},{\"camera\":0}]");
    text = edited(text, "\"zfar\":100}}]",
                  "\"zfar\":100}},{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":9,"
                  "\"ymag\":1.5,\"znear\":0,\"zfar\":7}},{\"type\":\"perspective\","
                  "\"perspective\":{\"yfov\":0.5,\"znear\":0.25}}]");
    tl_scene_info info = describe_text(text, &notices);
    (void)state;
    assert_int_equal(info.camera_count, 3);
    assert_int_equal(info.unplaced_camera_count, 1);
    static const size_t indices[3] = {1, 0, 0}, nodes[3] = {2, 1, 3};
    static const char *const names[3] = {"", "wide", "wide"}, *const node_names[3] = {
                                                                  "over", "eye", ""};
    static const double numbers[3][3] = {{3, 0, 7}, {1, 0.1, 100}, {1, 0.1, 100}};
    for (int i = 0; i < 3; i++) {
        const tl_scene_camera *const one = &info.cameras[i];
        assert_int_equal(one->index, indices[i]);
        assert_int_equal(one->node, nodes[i]);
        assert_string_equal(one->name, names[i]);
        assert_string_equal(one->node_name, node_names[i]);
        assert_int_equal(one->projection, i == 0 ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE);
        assert_true(one->extent == numbers[i][0]);
        assert_true(one->near == numbers[i][1]);
        assert_true(one->far == numbers[i][2]);
        assert_null(one->refusal);
    }
    tl_scene_info_clear(&info);
}

/* An extension of each fate, one of them required, one listed twice, one that nobody knows. */
static void extensions_say_what_becomes_of_them(void **state)
{
    static const struct {
        const char *name, *effect;
        tl_extension_fate fate;
        bool is_required;
    } expected[] = {
        {"KHR_texture_transform", "texture coordinates", TL_EXTENSION_SUPPORTED, false},
        {"KHR_materials_sheen", "no sheen", TL_EXTENSION_LEFT_OUT, false},
        {"KHR_xmp_json_ld", "nothing", TL_EXTENSION_HARMLESS, false},
        {"ACME_unheard", "nothing is known", TL_EXTENSION_LEFT_OUT, false},
        {"EXT_mesh_features", "nothing", TL_EXTENSION_HARMLESS, true},
        {"KHR_mesh_quantization", "integer", TL_EXTENSION_SUPPORTED, true},
    };
    heard notices;
    char *text = edited(
        square_scene(&square), "\"scene\":0,",
        "\"extensionsUsed\":[\"KHR_texture_transform\",\"KHR_materials_sheen\","
        "\"KHR_xmp_json_ld\",\"ACME_unheard\",\"KHR_texture_transform\",\"EXT_mesh_features\"],"
        "\"extensionsRequired\":[\"EXT_mesh_features\",\"KHR_mesh_quantization\"],\"scene\":"
        "0,");
    tl_scene_info info = describe_text(text, &notices);
    (void)state;
    assert_int_equal(info.extension_count, COUNT_OF(expected));
    for (size_t i = 0; i < COUNT_OF(expected); i++) {
        assert_string_equal(info.extensions[i].name, expected[i].name);
        assert_non_null(strstr(info.extensions[i].effect, expected[i].effect));
        assert_int_equal(info.extensions[i].fate, expected[i].fate);
        assert_int_equal(info.extensions[i].is_required, expected[i].is_required);
    }
    assert_int_equal(notices.count, 2); /* as a capture tells: what is left out */
    tl_scene_info_clear(&info);
}

static void variants_have_their_names(void **state)
{
    heard notices;
    char *text =
        edited(square_scene(&square), "\"scene\":0,",
               "\"extensionsUsed\":[\"KHR_materials_variants\"],\"extensions\":{"
               "\"KHR_materials_variants\":{\"variants\":[{\"name\":\"day\"},{\"name\":"
               "\"n\\u00e4chtlich \\\"2\\\"\"}]}},\"scene\":0,");
    tl_scene_info info = describe_text(text, &notices);
    (void)state;
    assert_int_equal(info.variant_count, 2);
    assert_string_equal(info.variants[0], "day");
    assert_string_equal(info.variants[1], "n\xc3\xa4"
                                          "chtlich \"2\"");
    tl_scene_info_clear(&info);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(our_scenes_are_what_another_reader_finds),
        cmocka_unit_test(what_is_shared_is_counted_once),
        cmocka_unit_test(nothing_to_show_has_no_bounds),
        cmocka_unit_test(traits_are_told_apart),
        cmocka_unit_test(cameras_are_those_of_the_scene),
        cmocka_unit_test(extensions_say_what_becomes_of_them),
        cmocka_unit_test(variants_have_their_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
