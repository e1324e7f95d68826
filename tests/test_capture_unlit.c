/* Does an unlit material show exactly its base colour, whatever lights there are, in every layout that has a
 * place for it? */
#include "gltf_textures.h"

#include "tilelight/layouts.h"
#include "tilelight/lighting.h"

enum { SIZE = 32, CENTER = SIZE / 2 };

#define UNLIT "\"extensions\":{\"KHR_materials_unlit\":{}},"

/* The square of gltf_scene.h, whose base colour is 0.25 0.5 0.75, with this in its material. */
static char *unlit_scene(const char *material, const char *extra)
{
    char *text = square_scene(&square), part[512];
    snprintf(part, sizeof part, UNLIT "%s\"name\":\"paint\"", material);
    text = edited(text, "\"name\":\"paint\"", part);
    char *const before = malloc(strlen(extra) + 32);
    assert_non_null(before);
    sprintf(before, "%s\"materials\"", extra);
    text = edited(text, "\"materials\"", before);
    free(before);
    return text;
}

static void capture_ok(const char *text, enum tl_layout_name layout, shot *taken)
{
    const tl_capture_options options = {
        .width = SIZE, .height = SIZE, .layout = layout, .without_layers = true};
    ASSERT_OK(shoot_text("unlit", text, &options, taken), taken->err);
    ASSERT_OK(tl_gbuffer_repair(taken->gbuffer, "unlit", true, NULL, &taken->err), taken->err);
}

/* A lamp at the eye, a sun behind it and more ambient light than there is white. */
static void add_lights(tl_light_set *set)
{
    tl_light light = tl_light_default();
    tl_error err;
    light.position[2] = 4.0f;
    light.intensity = 1000.0f;
    ASSERT_OK(tl_light_set_add(set, &light, &err), err);
    light.type = TL_LIGHT_DIRECTIONAL;
    light.direction[0] = light.direction[1] = 0.0f;
    light.direction[2] = -1.0f;
    ASSERT_OK(tl_light_set_add(set, &light, &err), err);
    for (int c = 0; c < 3; c++)
        set->ambient[c] = 5.0f;
}

/* The caller destroys it. */
static tl_image *lit(const tl_gbuffer *gbuffer, tl_precision precision)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_light_set lights = {0};
    tl_lighting *lighting = NULL;
    tl_image *image = NULL;
    tl_error err;
    options.precision = precision;
    add_lights(&lights);
    ASSERT_OK(tl_image_create(SIZE, SIZE, &image, &err), err);
    ASSERT_OK(tl_lighting_create(NULL, &options, &lighting, &err), err);
    ASSERT_OK(tl_lighting_run(lighting, gbuffer, &lights, image, NULL, NULL, NULL, &err), err);
    tl_lighting_destroy(lighting);
    tl_light_set_clear(&lights);
    return image;
}

static void assert_shows(const char *name, const tl_image *image, const float want[3])
{
    for (unsigned c = 0; c < 3; c++) {
        const float got = tl_image_plane(image, c)[CENTER * image->pitch + CENTER];
        if (!same_bits(got, want[c]))
            fail_msg("%s: channel %u shows %.9g, not %.9g", name, c, (double)got,
                     (double)want[c]);
    }
}

static const float paint[3] = {0.25f, 0.5f, 0.75f};

/* All that a material may have besides; none of it counts. */
static const struct {
    const char *name, *material;
} cases[] = {
    {"alone", ""},
    {"with emission", "\"emissiveFactor\":[1,1,1],"},
    {"with an emissive texture",
     "\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0},"},
    {"with occlusion", "\"occlusionTexture\":{\"index\":0},"},
    {"with a normal map", "\"normalTexture\":{\"index\":0},"},
    {"with a texture that is not there", "\"normalTexture\":{\"index\":77},"},
};

static void base_colour_is_all_that_shows(void **state)
{
    static const uint8_t dark[4] = {10, 20, 30, 255};
    char *const json = texture_json(dark, 1, 1);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *const text = unlit_scene(cases[i].material, json);
        shot taken;
        capture_ok(text, TL_LAYOUT_FLOAT, &taken);
        assert_int_equal(taken.gbuffer->present,
                         TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE);
        for (int k = 0; k < 2; k++) {
            tl_image *const image =
                lit(taken.gbuffer, k ? TL_PRECISION_TWIN : TL_PRECISION_REFERENCE);
            assert_shows(cases[i].name, image, paint);
            tl_image_destroy(image);
        }
        shot_clear(&taken);
        free(text);
    }
    free(json);
}

/* What a layout's emission can say of the colour is what shows, to the bit: nothing is added. */
static void nothing_is_added_in_any_layout(void **state)
{
    char *const text = unlit_scene("", "");
    int tried = 0;
    (void)state;
    for (int i = 0; i < TL_LAYOUT_COUNT; i++) {
        const enum tl_layout_name layout = (enum tl_layout_name)i;
        tl_gbuffer *read = NULL;
        float want[3];
        shot taken;
        capture_ok(text, layout, &taken);
        const int is_told = strstr(taken.notices.text, "emi") != NULL;
        assert_int_equal(is_told, !(tl_layout_planes(layout) & TL_GROUP_EMISSIVE));
        ASSERT_OK(tl_gbuffer_unpack(taken.gbuffer, &read, &taken.err), taken.err);
        for (int c = 0; c < 3; c++) {
            const float *const plane =
                tl_gbuffer_plane(read, (enum tl_plane)(TL_EMISSIVE_R + c));
            want[c] = plane ? plane[CENTER * read->pitch + CENTER] : 0.0f;
            if (plane && !(fabsf(want[c] - paint[c]) < 0.01f))
                fail_msg("%s: emission %g, not %g", tl_layout_word(layout), (double)want[c],
                         (double)paint[c]);
            tried += plane != NULL;
        }
        for (int k = 0; k < 2; k++) {
            tl_image *const image =
                lit(taken.gbuffer, k ? TL_PRECISION_TWIN : TL_PRECISION_REFERENCE);
            assert_shows(tl_layout_word(layout), image, want);
            tl_image_destroy(image);
        }
        tl_gbuffer_destroy(read);
        shot_clear(&taken);
    }
    assert_true(tried >= 6);
    free(text);
}

/* Alpha has its modes as elsewhere, BLEND without layers: the picture's left half, of alpha 0.4, is a hole
 * unless it is opaque. */
static void alpha_modes_still_apply(void **state)
{
    static const uint8_t halves[8] = {255, 255, 255, 102, 255, 255, 255, 255};
    static const struct {
        const char *mode;
        int is_hole;
    } modes[] = {{"OPAQUE", 0}, {"MASK", 1}, {"BLEND", 1}};
    char *const json = texture_json(halves, 2, 1);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(modes); i++) {
        char material[64];
        shot taken;
        snprintf(material, sizeof material, "\"alphaMode\":\"%s\",", modes[i].mode);
        char *const text = edited(unlit_scene(material, json), "\"metallicFactor\"",
                                  "\"baseColorTexture\":{\"index\":0},\"metallicFactor\"");
        capture_ok(text, TL_LAYOUT_FLOAT, &taken);
        assert_int_equal(!isfinite(shown_at(&taken, TL_DEPTH, CENTER - 3, CENTER)),
                         modes[i].is_hole);
        assert_true(isfinite(shown_at(&taken, TL_DEPTH, CENTER + 3, CENTER)));
        assert_true(same_bits(shown_at(&taken, TL_EMISSIVE_R, CENTER + 3, CENTER), 0.25f));
        shot_clear(&taken);
        free(text);
    }
    free(json);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(base_colour_is_all_that_shows),
        cmocka_unit_test(nothing_is_added_in_any_layout),
        cmocka_unit_test(alpha_modes_still_apply),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
