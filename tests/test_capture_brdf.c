/* Does a capture with materials say of each pixel which one it has, and which way its tangent points, in
 * every layout that has a place for it; and one without them nothing? */
#include "gltf_textures.h"

#include "tilelight/layouts.h"

enum { SIZE = 16, CENTER = SIZE / 2 };

/* The square of gltf_scene.h with material `which` of three; or of none where it is "". The first is paint,
 * the second has no name, the third is unlit. A node turned by a quarter about z has u along +y. */
enum tangents { NO_TANGENTS, OF_FILE, OF_MAP };

static char *scene_of(const char *which, enum tangents tangents, bool is_turned)
{
    static const uint8_t flat[] = {128, 128, 255, 255};
    char *text = square_scene(&square), part[64] = "";
    if (which[0])
        snprintf(part, sizeof part, "\"material\":%s,", which);
    text = edited(text, "\"material\":0,", part);
    text = edited(text, "\"roughnessFactor\":0.625}}]",
                  "\"roughnessFactor\":0.625}},{\"alphaCutoff\":0.5},"
                  "{\"name\":\"lamp\",\"extensions\":{\"KHR_materials_unlit\":{}}}]");
    if (tangents == OF_FILE)
        text = with_tangents(text, 1.0f, 1.0f);
    if (tangents == OF_MAP) {
        char *const texture = texture_json(flat, 1, 1);
        char *const before = malloc(strlen(texture) + 32);
        assert_non_null(before);
        sprintf(before, "%s\"materials\"", texture);
        text = edited(text, "\"name\":\"paint\"",
                      "\"normalTexture\":{\"index\":0},\"name\":\"paint\"");
        text = edited(text, "\"materials\"", before);
        free(texture);
        free(before);
    }
    return is_turned
               ? edited(text, "\"mesh\":0",
                        "\"rotation\":[0,0,0.70710678118654752,0.70710678118654752],\"mesh\":0")
               : text;
}

static void shoot_scene(char *text, enum tl_layout_name layout, bool materials, shot *taken)
{
    const tl_capture_options options = {
        .width = SIZE, .height = SIZE, .layout = layout, .materials = materials};
    tl_gbuffer *unpacked = NULL;
    ASSERT_OK(shoot_text("square", text, &options, taken), taken->err);
    free(text);
    if (layout == TL_LAYOUT_FLOAT)
        return;
    ASSERT_OK(tl_gbuffer_unpack(taken->gbuffer, &unpacked, &taken->err), taken->err);
    tl_gbuffer_destroy(taken->gbuffer);
    taken->gbuffer = unpacked;
}

static const struct {
    const char *material;
    float index;
} indices[] = {{"0", 1.0f}, {"1", 2.0f}, {"2", 0.0f}, {"", 0.0f}};

static void every_layout_with_a_place_has_the_index(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++) {
        const bool has_place = tl_layout_planes((enum tl_layout_name)layout) & TL_GROUP_BRDF;
        for (size_t i = 0; i < (has_place ? COUNT_OF(indices) : 1); i++) {
            shot taken;
            shoot_scene(scene_of(indices[i].material, NO_TANGENTS, false),
                        (enum tl_layout_name)layout, true, &taken);
            assert_int_equal((taken.gbuffer->present & TL_GROUP_BRDF) != 0, has_place);
            assert_int_equal(strstr(taken.notices.text, "brdf") == NULL, has_place);
            assert_int_equal(taken.gbuffer->present & TL_GROUP_TANGENT, 0);
            assert_int_equal(taken.gbuffer->materials.count, has_place ? 3 : 0);
            if (has_place) {
                const float got = shown_at(&taken, TL_BRDF, CENTER, CENTER);
                if (!same_bits(got, indices[i].index))
                    fail_msg("%s, material \"%s\": index %g, want %g",
                             tl_layout_word((enum tl_layout_name)layout), indices[i].material,
                             (double)got, (double)indices[i].index);
                assert_true(same_bits(shown_at(&taken, TL_BRDF, 0, 0), 0.0f));
                assert_string_equal(taken.gbuffer->materials.of[0], "paint");
                assert_string_equal(taken.gbuffer->materials.of[1], "");
                assert_string_equal(taken.gbuffer->materials.of[2], "lamp");
            }
            shot_clear(&taken);
        }
    }
}

/* Along u; within half a step of 12 bits where they are packed. */
static void tangents_are_those_of_the_world(void **state)
{
    static const enum tl_layout_name layouts[] = {TL_LAYOUT_FLOAT, TL_LAYOUT_FLOAT_POSITION,
                                                  TL_LAYOUT_COMPACT_16, TL_LAYOUT_COMPACT_12};
    (void)state;
    for (size_t l = 0; l < COUNT_OF(layouts); l++)
        for (int i = 0; i < 4; i++) {
            const int turned = i & 1;
            shot taken;
            shoot_scene(scene_of("0", i & 2 ? OF_MAP : OF_FILE, turned), layouts[l], true,
                        &taken);
            assert_true(taken.gbuffer->present & TL_GROUP_TANGENT);
            for (int axis = 0; axis < 3; axis++) {
                const float want = axis == turned ? 1.0f : 0.0f;
                const enum tl_plane plane = (enum tl_plane)(TL_TANGENT_X + axis);
                if (!(fabsf(shown_at(&taken, plane, CENTER, CENTER) - want) <= 1.0f / 4094.0f))
                    fail_msg("%s: tangent %d is %g, want %g", tl_layout_word(layouts[l]), axis,
                             (double)shown_at(&taken, plane, CENTER, CENTER), (double)want);
                assert_true(shown_at(&taken, plane, 0, 0) == 0.0f);
            }
            shot_clear(&taken);
        }
}

static void without_the_option_nothing_is_stored(void **state)
{
    shot taken;
    (void)state;
    shoot_scene(scene_of("0", OF_MAP, false), TL_LAYOUT_FLOAT, false, &taken);
    assert_int_equal(taken.gbuffer->present & (TL_GROUP_BRDF | TL_GROUP_TANGENT), 0);
    assert_int_equal(taken.gbuffer->materials.count, 0);
    shot_clear(&taken);
}

/* 255 materials are told apart, by 8 bits that OpenGL converts; 256 are not. */
static void more_materials_than_indices_are_refused(void **state)
{
    (void)state;
    for (int count = 255; count <= 256; count++) {
        char *text = square_scene(&square), *list = malloc(4096), *end = list;
        const tl_capture_options options = {
            .width = SIZE, .height = SIZE, .layout = TL_LAYOUT_MERLIN, .materials = true};
        shot taken;
        assert_non_null(list);
        end += sprintf(end, "\"roughnessFactor\":0.625}}");
        for (int i = 1; i < count; i++)
            end += sprintf(end, ",{}");
        sprintf(end, "]");
        text = edited(text, "\"roughnessFactor\":0.625}}]", list);
        text = edited(text, "\"material\":0", "\"material\":254");
        if (count == 255) {
            shoot_scene(text, TL_LAYOUT_MERLIN, true, &taken);
            text = NULL;
            assert_true(same_bits(shown_at(&taken, TL_BRDF, CENTER, CENTER), 255.0f));
        } else {
            assert_int_equal(shoot_text("many", text, &options, &taken), TL_ERR_UNSUPPORTED);
            assert_non_null(strstr(taken.err.message, "has 256 materials"));
        }
        shot_clear(&taken);
        free(list);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_with_a_place_has_the_index),
        cmocka_unit_test(tangents_are_those_of_the_world),
        cmocka_unit_test(without_the_option_nothing_is_stored),
        cmocka_unit_test(more_materials_than_indices_are_refused),
    };
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
