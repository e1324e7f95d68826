/* Is a picture the same bit for bit whether only what a frame calls for is computed, or all of it? */
#include "frames.h"
#include "golden_scenes.h"
#include "rich_lights.h"

#include "choices.h"
#include "prepared.h"

#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"

typedef struct way {
    tl_precision precision;
    tl_path path;
} way;

/* The twin reads and computes what the kernels do; a build of theirs takes a second. */
static const way by_twin[] = {{TL_PRECISION_TWIN, TL_PATH_AUTO}};
static const way by_tiles[] = {{TL_PRECISION_TWIN, TL_PATH_AUTO},
                               {TL_PRECISION_FLOAT, TL_PATH_CPU}};
static const way by_both[] = {{TL_PRECISION_TWIN, TL_PATH_AUTO},
                              {TL_PRECISION_FLOAT, TL_PATH_CPU},
                              {TL_PRECISION_FLOAT, TL_PATH_GPU}};

/* In each way, with all effects and with those that the frame calls for: as the twin has all. */
static void expect_one_picture(tl_device *device,
                               const way *ways,
                               size_t way_count,
                               const tl_gbuffer *g,
                               const tl_light_set *lights,
                               const char *what)
{
    tl_image *want = image_like(g), *got = image_like(g);
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = TL_PRECISION_TWIN;
    options.effects = TL_EFFECTS_ALL;
    light_frame(NULL, &options, g, lights, want);
    for (size_t i = 0; i < way_count; i++)
        for (int mode = 0; mode < TL_EFFECTS_MODE_COUNT; mode++) {
            const int is_twin = ways[i].precision == TL_PRECISION_TWIN;
            char name[192];
            snprintf(name, sizeof name, "%s, way %zu, mode %d", what, i, mode);
            options.precision = ways[i].precision;
            options.path = ways[i].path;
            options.effects = (tl_effects_mode)mode;
            light_frame(is_twin ? NULL : device, &options, g, lights, got);
            assert_same_image(got, want, name);
        }
    tl_image_destroy(got);
    tl_image_destroy(want);
}

static void scenes_keep_their_bits(void **state)
{
    for (size_t i = 0; i < COUNT_OF(golden_scenes); i++) {
        char path[4096];
        tl_gbuffer *g = NULL;
        tl_light_set lights = {0};
        bool has_lights = false;
        tl_error err;
        source_path(path, sizeof path, "tests/golden", golden_scenes[i].name, ".gbuffer.exr");
        ASSERT_OK(tl_gbuffer_read(path, &g, &lights, &has_lights, &err), err);
        ASSERT_OK(tl_gbuffer_repair(g, path, false, NULL, &err), err);
        expect_one_picture(*state, by_twin, COUNT_OF(by_twin), g, &lights,
                           golden_scenes[i].name);
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* What absence means, in every pixel that shows a surface. */
static void make_neutral(tl_gbuffer *g, uint32_t planes)
{
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        for (uint32_t i = 0; i < g->camera.width * g->camera.height; i++)
            if (planes >> p & 1)
                set_pixel(g, (enum tl_plane)p,
                          (size_t)(i / g->camera.width) * g->pitch + i % g->camera.width,
                          p == TL_OCCLUSION ? 1.0f : 0.0f);
}

static void add_lights(tl_light_set *set, const tl_camera *camera, float specular)
{
    uint32_t seed = 7;
    tl_error err;
    for (int i = 0; i < 24; i++) {
        tl_light light = random_light(camera, &seed, 2.0f, 6.0f);
        light.specular *= specular;
        if (i % 4 == 0)
            light.intensity = 0.0f;
        else if (i % 4 == 1)
            light.range = 1e-30f;
        else if (i % 7 == 2)
            light.diffuse = 0.0f;
        ASSERT_OK(tl_light_set_add(set, &light, &err), err);
    }
}

#define ALL_METAL (1u << 31) /* beside planes: metallic is 1 in every pixel */

/* Each part of a frame that may be left out, one after another and all at once. */
static void what_is_left_out_adds_nothing(void **state)
{
    static const struct {
        const char *name;
        uint32_t present, neutral;
        float ambient, specular;
    } cases[] = {
        {"no ambient light", TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, 0, 0, 1},
        {"neutral occlusion", TL_GROUP_PHONG | TL_GROUP_OCCLUSION, TL_GROUP_OCCLUSION, 1, 1},
        {"neutral emission", TL_GROUP_PHONG | TL_GROUP_EMISSIVE, TL_GROUP_EMISSIVE, 1, 1},
        {"black specular colours", TL_GROUP_PHONG, TL_THREE(TL_SPECULAR_R), 1, 1},
        {"no lobes", TL_GROUP_PHONG, 0, 1, 0},
        {"no lobes on metal", TL_GROUP_METAL_ROUGH, 0, 1, 0},
        {"dielectrics", TL_GROUP_METAL_ROUGH, TL_HAS(TL_METALLIC), 1, 1},
        {"mirrors", TL_GROUP_METAL_ROUGH, TL_HAS(TL_ROUGHNESS), 1, 1},
        {"no material", 0, 0, 0, 1},
        {"metals without colour, as unlit surfaces are",
         TL_GROUP_METAL_ROUGH | TL_GROUP_EMISSIVE, TL_THREE(TL_ALBEDO_R) | ALL_METAL, 1, 1},
        {"black dielectrics", TL_GROUP_METAL_ROUGH, TL_THREE(TL_ALBEDO_R), 1, 1},
        {"black all over", TL_GROUP_PHONG | TL_GROUP_EMISSIVE,
         TL_THREE(TL_ALBEDO_R) | TL_THREE(TL_SPECULAR_R), 1, 1},
        {"nothing but diffuse light",
         TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
         TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE, 0, 0},
    };
    static const enum tl_layout_name layouts[] = {TL_LAYOUT_FLOAT, TL_LAYOUT_COMPACT_16,
                                                  TL_LAYOUT_DXR};
    const uint32_t black = TL_THREE(TL_ALBEDO_R) | TL_THREE(TL_SPECULAR_R);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const tl_camera camera = camera_of(70, 40, TL_PERSPECTIVE);
        tl_light_set lights = {
            .ambient = {0.1f * cases[i].ambient, 0.2f * cases[i].ambient, 0}};
        tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | cases[i].present, 3);
        tl_error err;
        make_neutral(g, cases[i].neutral);
        for (size_t p = 0; (cases[i].neutral & ALL_METAL) && p < (size_t)g->pitch * g->rows;
             p++)
            set_pixel(g, TL_METALLIC, p, 1.0f);
        ASSERT_OK(tl_gbuffer_repair(g, cases[i].name, false, NULL, &err), err);
        assert_int_equal(g->neutral, cases[i].neutral & ~(TL_THREE(TL_ALBEDO_R) | ALL_METAL));
        assert_int_equal(g->is_dark,
                         (cases[i].neutral & ALL_METAL) || (cases[i].neutral & black) == black);
        add_lights(&lights, &camera, cases[i].specular);
        for (size_t l = 0; l < COUNT_OF(layouts); l++) {
            tl_gbuffer *packed = NULL;
            char what[128];
            if (cases[i].present & ~tl_layout_planes(layouts[l]))
                continue;
            ASSERT_OK(tl_gbuffer_pack(g, layouts[l], &packed, NULL, &err), err);
            ASSERT_OK(tl_gbuffer_repair(packed, cases[i].name, false, NULL, &err), err);
            assert_int_equal(packed->neutral,
                             cases[i].neutral & ~(TL_THREE(TL_ALBEDO_R) | ALL_METAL));
            assert_int_equal(packed->is_dark, g->is_dark);
            snprintf(what, sizeof what, "%s, %s", cases[i].name, tl_layout_word(layouts[l]));
            if (i == COUNT_OF(cases) - 1 && layouts[l] == TL_LAYOUT_COMPACT_16)
                expect_one_picture(*state, by_both, COUNT_OF(by_both), packed, &lights, what);
            else
                expect_one_picture(*state, by_twin, COUNT_OF(by_twin), packed, &lights, what);
            tl_gbuffer_destroy(packed);
        }
        tl_light_set_clear(&lights);
        tl_gbuffer_destroy(g);
    }
}

/* Small lamps in turn plain, with a cone, with a lobe, and with both: on tiles of every mixture. */
static void add_mixed_lights(tl_light_set *set, const tl_camera *camera)
{
    uint32_t seed = 11;
    tl_error err;
    for (int i = 0; i < 40; i++) {
        tl_light light = random_light(camera, &seed, 0.5f, 2.0f);
        light.type = i & 1 ? TL_LIGHT_SPOT : TL_LIGHT_POINT;
        light.direction[0] = light.direction[1] = 0.0f;
        light.direction[2] = -1.0f;
        light.inner_cone = 0.2f;
        light.outer_cone = 0.9f;
        light.specular = i & 2 ? 1.0f : 0.0f;
        ASSERT_OK(tl_light_set_add(set, &light, &err), err);
    }
}

static tl_u32 open_choices(const tl_gbuffer *g,
                           const tl_light_set *lights,
                           tl_effects_mode mode)
{
    tl_prepared prepared = {0};
    const tl_prepare_options options = {.tile_size = 8, .box_count = 1, .effects = mode};
    tl_error err;
    ASSERT_OK(tl_prepare(g, lights, &options, NULL, &prepared, &err), err);
    const tl_u32 open = prepared.needs.choices;
    tl_prepared_clear(&prepared);
    return open;
}

/* A tile that does without cones, or lobes, gives the bits of one that has them. */
static void what_tiles_choose_does_not_show(void **state)
{
    const tl_camera camera = camera_of(70, 40, TL_PERSPECTIVE);
    tl_lighting_options options = tl_lighting_options_default();
    tl_light_set lights = {0};
    tl_gbuffer *g = random_gbuffer(&camera, TL_GROUP_BASE | TL_GROUP_PHONG, 5);
    tl_image *want = image_like(g), *got = image_like(g);
    tl_error err;
    ASSERT_OK(tl_gbuffer_repair(g, "mixed", false, NULL, &err), err);
    add_mixed_lights(&lights, &camera);
    assert_int_equal(open_choices(g, &lights, TL_EFFECTS_AUTO),
                     TL_CHOICE_CONES | TL_CHOICE_LOBES);
    assert_int_equal(open_choices(g, &lights, TL_EFFECTS_ALL), 0);
    options.tile_size = 8;
    options.precision = TL_PRECISION_TWIN;
    light_frame(NULL, &options, g, &lights, want);
    options.precision = TL_PRECISION_FLOAT;
    light_frame(*state, &options, g, &lights, got);
    assert_same_image(got, want, "tiles choose");
    for (size_t i = 0; i < lights.count; i++) {
        lights.lights[i].type = TL_LIGHT_SPOT;
        lights.lights[i].specular = 1.0f;
    }
    assert_int_equal(open_choices(g, &lights, TL_EFFECTS_AUTO), 0);
    tl_image_destroy(got);
    tl_image_destroy(want);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

/* A gradient, lights of every kind of shape, and of them some that give nothing: the twin, and one build. */
static void shapes_keep_their_bits(void **state)
{
    const tl_camera camera = camera_of(70, 40, TL_PERSPECTIVE);
    const uint32_t present = TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION;
    tl_light_set lights = {0};
    tl_gbuffer *g = random_gbuffer(&camera, present, 3);
    tl_error err;
    ASSERT_OK(tl_gbuffer_repair(g, "random", false, NULL, &err), err);
    add_lights(&lights, &camera, 1.0f);
    make_rich(&lights);
    make_gradient_sky(&lights);
    expect_one_picture(*state, by_tiles, COUNT_OF(by_tiles), g, &lights, "shapes");
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_keep_their_bits),
        cmocka_unit_test(what_is_left_out_adds_nothing),
        cmocka_unit_test(what_tiles_choose_does_not_show),
        cmocka_unit_test(shapes_keep_their_bits),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
