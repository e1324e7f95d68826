/* Does a capture do with a file's extensions what it says: choose materials by variant, tell once by name
 * what it leaves out, refuse what it cannot do without? */
#include "gltf_scene.h"

enum { SIZE = 8 };

static const tl_capture_options plain = {.width = SIZE, .height = SIZE};

/* The square of gltf_scene.h with these members before its scene. */
static char *scene_with(const char *members)
{
    char *const part = malloc(strlen(members) + 64);
    assert_non_null(part);
    sprintf(part, "%s\"scene\":0", members);
    char *const text = edited(square_scene(&square), "\"scene\":0", part);
    free(part);
    return text;
}

/* --- variants ---------------------------------------------------------------------------------- */

/* Materials: paint (red 0.25), and of red 0.5, 0.75. The square is the second in "night", the third in
 * "snow" and "fog"; "day" does not map it. */
static char *scene_of_variants(void)
{
    char *text = scene_with(
        "\"extensionsUsed\":[\"KHR_materials_variants\"],\"extensions\":{"
        "\"KHR_materials_variants\":{\"variants\":[{\"name\":\"day\"},{\"name\":\"night\"},"
        "{\"name\":\"snow\"},{\"name\":\"fog\"}]}},");
    text = edited(text, "\"material\":0,",
                  "\"material\":0,\"extensions\":{\"KHR_materials_variants\":{\"mappings\":["
                  "{\"material\":1,\"variants\":[1]},{\"material\":2,\"variants\":[2,3]}]}},");
    return edited(text, "\"roughnessFactor\":0.625}}",
                  "\"roughnessFactor\":0.625}},"
                  "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0,0,1]}},"
                  "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.75,0,0,1]}}");
}

static const struct {
    const char *wanted;
    float red;
} variants[] = {
    {NULL, 0.25f},  {"day", 0.25f}, {"night", 0.5f}, {"snow", 0.75f},
    {"fog", 0.75f}, {"0", 0.25f},   {"1", 0.5f},     {"3", 0.75f},
};

static void variants_choose_materials(void **state)
{
    char *const text = scene_of_variants();
    (void)state;
    for (size_t i = 0; i < COUNT_OF(variants); i++) {
        tl_capture_options options = plain;
        shot taken;
        options.variant = variants[i].wanted;
        ASSERT_OK(shoot_text("extensions", text, &options, &taken), taken.err);
        assert_int_equal(taken.notices.count, 0);
        if (shown_at(&taken, TL_ALBEDO_R, SIZE / 2, SIZE / 2) != variants[i].red)
            fail_msg("variant %s: red %g, not %g",
                     variants[i].wanted ? variants[i].wanted : "none",
                     (double)shown_at(&taken, TL_ALBEDO_R, SIZE / 2, SIZE / 2),
                     (double)variants[i].red);
        shot_clear(&taken);
    }
    free(text);
}

static const struct {
    const char *name, *old, *new, *wanted;
    tl_status status;
    const char *words;
} refused[] = {
    {"unknown name", "", "", "dusk", TL_ERR_ARGUMENT,
     "no variant \"dusk\"; it has: 0 (\"day\"), 1 (\"night\"), 2 (\"snow\"), 3 (\"fog\")"},
    {"index beyond the last", "", "", "4", TL_ERR_ARGUMENT, "no variant \"4\""},
    {"negative index", "", "", "-1", TL_ERR_ARGUMENT, "no variant \"-1\""},
    {"empty name", "", "", "", TL_ERR_ARGUMENT, "no variant \"\""},
    {"no variants", "\"KHR_materials_variants\":{\"variants\"", "\"X_other\":{\"variants\"",
     "day", TL_ERR_ARGUMENT, "no variants of materials"},
    {"material that is none", "\"material\":1", "\"material\":7", "night", TL_ERR_FORMAT,
     "mesh 0 (\"square\"), primitive 0 refers to material 7"},
    {"mapping without a material", "\"material\":1,", "", "night", TL_ERR_FORMAT,
     "refers to material -1"},
    {"variant that is none", "[2,3]", "[2,4]", "night", TL_ERR_FORMAT, "refers to variant 4"},
    {"variant that is no index", "[2,3]", "[2,\"x\"]", "night", TL_ERR_FORMAT,
     "refers to variant"},
};

static void unknown_variants_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(refused); i++) {
        tl_capture_options options = plain;
        char *const text = edited(scene_of_variants(), refused[i].old, refused[i].new);
        shot taken;
        options.variant = refused[i].wanted;
        const tl_status status = shoot_text("extensions", text, &options, &taken);
        if (status != refused[i].status || !strstr(taken.err.message, refused[i].words))
            fail_msg("%s: status %d, %s", refused[i].name, (int)status, taken.err.message);
        shot_clear(&taken);
        free(text);
    }
}

/* As many as fit a sentence, and that there are more. */
static void long_lists_of_variants_are_cut(void **state)
{
    tl_capture_options options = plain;
    char many[8192] = "\"fog\"}";
    shot taken;
    (void)state;
    for (size_t i = 4; i < 200; i++)
        sprintf(many + strlen(many), ",{\"name\":\"a name of some length %zu\"}", i);
    char *const text = edited(scene_of_variants(), "\"fog\"}", many);
    options.variant = "dusk";
    assert_int_equal(shoot_text("extensions", text, &options, &taken), TL_ERR_ARGUMENT);
    assert_non_null(
        strstr(taken.err.message, "it has: 0 (\"day\"), 1 (\"night\"), 2 (\"snow\"), "));
    const char *const last = strrchr(taken.err.message, ',');
    assert_non_null(last);
    assert_memory_equal(last + strlen(last) - 6, "\") ...", 7);
    assert_in_range(strlen(taken.err.message), 900, 1200);
    shot_clear(&taken);
    free(text);
}

/* --- extensions that are left out -------------------------------------------------------------- */

/* words: what the notice must have besides the name; NULL: none is due, and the file may require it. */
static const struct {
    const char *name, *words;
} left_out[] = {
    {"KHR_materials_clearcoat", "coat"},
    {"KHR_materials_transmission", "opaque"},
    {"KHR_materials_volume", "light"},
    {"KHR_materials_sheen", "sheen"},
    {"KHR_materials_ior", "1.5"},
    {"KHR_materials_specular", "highlights"},
    {"KHR_materials_iridescence", "thin films"},
    {"KHR_materials_anisotropy", "round"},
    {"KHR_materials_dispersion", "colours"},
    {"KHR_materials_diffuse_transmission", "behind"},
    {"KHR_materials_pbrSpecularGlossiness", "metal-rough"},
    {"KHR_animation_pointer", "nodes alone"},
    {"KHR_node_visibility", "hides"},
    {"EXT_texture_webp", "WebP"},
    {"KHR_texture_basisu", "KTX2"},
    {"EXT_lights_image_based", "surroundings"},
    {"X_of_nobody", "nothing is known"},
    {"KHR_xmp_json_ld", NULL},
    {"EXT_mesh_features", NULL},
    {"KHR_materials_unlit", NULL},
    {"KHR_materials_variants", NULL},
    {"EXT_mesh_gpu_instancing", NULL},
};

static void what_is_left_out_is_told_once(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(left_out); i++) {
        char members[256];
        shot taken;
        snprintf(members, sizeof members, "\"extensionsUsed\":[\"%s\",\"%s\"],",
                 left_out[i].name, left_out[i].name);
        char *const text = scene_with(members);
        ASSERT_OK(shoot_text("extensions", text, &plain, &taken), taken.err);
        if (taken.notices.count != (left_out[i].words != NULL) ||
            (left_out[i].words && (!strstr(taken.notices.text, left_out[i].name) ||
                                   !strstr(taken.notices.text, left_out[i].words))))
            fail_msg("%s: %d notices: %s", left_out[i].name, taken.notices.count,
                     taken.notices.text);
        shot_clear(&taken);
        free(text);
    }
}

static void what_is_required_is_had_or_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(left_out); i++) {
        char members[256];
        shot taken;
        snprintf(members, sizeof members,
                 "\"extensionsUsed\":[\"%s\"],\"extensionsRequired\":[\"%s\"],",
                 left_out[i].name, left_out[i].name);
        char *const text = scene_with(members);
        const tl_status status = shoot_text("extensions", text, &plain, &taken);
        if (status != (left_out[i].words ? TL_ERR_UNSUPPORTED : TL_OK) ||
            (left_out[i].words && !strstr(taken.err.message, left_out[i].name)))
            fail_msg("%s: status %d, %s", left_out[i].name, (int)status, taken.err.message);
        shot_clear(&taken);
        free(text);
    }
}

/* --- texture coordinates ----------------------------------------------------------------------- */

static void missing_coordinates_are_told(void **state)
{
    shot taken;
    (void)state;
    char *text = scene_with(
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLv"
        "AAAAAElFTkSuQmCC\"}],");
    text = edited(text, "\"metallicFactor\":0.125",
                  "\"baseColorTexture\":{\"index\":0,\"texCoord\":3},\"metallicFactor\":0.125");
    ASSERT_OK(shoot_text("extensions", text, &plain, &taken), taken.err);
    assert_int_equal(taken.notices.count, 1);
    assert_non_null(strstr(taken.notices.text, "1 primitives lack texture coordinates"));
    shot_clear(&taken);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(variants_choose_materials),
        cmocka_unit_test(unknown_variants_are_refused),
        cmocka_unit_test(long_lists_of_variants_are_cut),
        cmocka_unit_test(what_is_left_out_is_told_once),
        cmocka_unit_test(what_is_required_is_had_or_refused),
        cmocka_unit_test(missing_coordinates_are_told),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
