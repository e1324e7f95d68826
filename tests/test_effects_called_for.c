/* Does a scene switch on the effects that it calls for, by the table, and no others?
 *
 * What is expected is written out here, scene by scene, beside the table: the kernel's switches too. */
#include "testing.h"

#include "falloff.h"
#include "prepared.h"

#include <string.h>

#define ON(effect) TL_ON(TL_EFFECT_##effect)
#define FADE(row) (1u << TL_FADE_##row)
#define PHONG (TL_GROUP_BASE | TL_GROUP_PHONG)
#define METAL (TL_GROUP_BASE | TL_GROUP_METAL_ROUGH)
#define OCCLUSION (TL_GROUP_BASE | TL_GROUP_OCCLUSION)
#define EMISSION (TL_GROUP_BASE | TL_GROUP_EMISSIVE)
#define INDEXED (TL_GROUP_BASE | TL_GROUP_BRDF)
#define SHAPES                                                                                \
    (ON(TABLE) | ON(PROJECTED) | ON(AROUND) | ON(PROFILES) | ON(AMBIENT_LOBE) | ON(SHADOWS) | \
     ON(LINKS))
#define ANY_LIGHT .intensity = 1.0f, .diffuse = 1.0f

typedef struct lamp {
    int is_directional;
    tl_falloff falloff;
    float range, begin; /* range 0: none */
    int has_cone;
    float cone; /* outer half-angle */
    float intensity, diffuse, specular, ambient;
    int has_texture, has_profile;
    int casts_shadow, has_map, is_linked;
} lamp;

typedef struct scene {
    const char *name;
    uint32_t present, neutral;
    lamp lamps[2]; /* intensity 0 and no diffuse: no lamp */
    float ambient, radius, sky, sky_light;
    int has_shininess;
    tl_sky sky_type;
    enum tl_shading_model model;
    /* index that has a row of materials, of this model; 0: none */
    uint32_t row;
    enum tl_shading_model row_model;
    uint32_t row_given; /* bits of tl_brdf_parameter */
    float row_specular;
    int is_dark; /* tl_gbuffer.is_dark */
    tl_projection projection;
    uint32_t window[2], whole[2]; /* of the camera */
    uint32_t layers;
    int without_layers; /* though it has some */
    enum tl_layout_name layout;
    tl_effects_mode mode;
    uint64_t effects; /* expected: all of them */
    struct {
        tl_u32 falloffs, spots, specular, ambient, orthographic, one_color, idle,
            fixed_exponent, shapes, sky, surroundings, sky_light, window;
    } needs;                                         /* expected */
    uint32_t light_count, idle[TL_IDLE_LIGHT_COUNT]; /* expected */
} scene;

/* One for each effect, in the order of the table: with what it cannot be without, and nothing more. */
static const scene minimal[TL_EFFECT_COUNT] = {
    [TL_EFFECT_GLOBAL] = {"a light without a range", TL_GROUP_BASE, .lamps = {{ANY_LIGHT}},
                          .effects = ON(GLOBAL) | ON(INVERSE_SQUARE),
                          .needs = {.falloffs = FADE(INVERSE_SQUARE)}, .light_count = 1},
    [TL_EFFECT_RANGED] = {"a light with a range", TL_GROUP_BASE,
                          .lamps = {{ANY_LIGHT, .range = 2.0f}},
                          .effects = ON(RANGED) | ON(INVERSE_SQUARE),
                          .needs = {.falloffs = FADE(INVERSE_SQUARE)}, .light_count = 1},
    [TL_EFFECT_DIRECTIONAL] = {"a directional light", TL_GROUP_BASE,
                               .lamps = {{ANY_LIGHT, .is_directional = 1}},
                               .effects = ON(GLOBAL) | ON(DIRECTIONAL),
                               .needs = {.falloffs = FADE(NONE)}, .light_count = 1},
    [TL_EFFECT_INVERSE_SQUARE] = {"two lights, inverse square", TL_GROUP_BASE,
                                  .lamps = {{ANY_LIGHT, .range = 2.0f},
                                            {ANY_LIGHT, .range = 1.0f}},
                                  .effects = ON(RANGED) | ON(INVERSE_SQUARE),
                                  .needs = {.falloffs = FADE(INVERSE_SQUARE)},
                                  .light_count = 2},
    [TL_EFFECT_LINEAR] = {"a linear light", TL_GROUP_BASE,
                          .lamps = {{ANY_LIGHT, .range = 2.0f, .falloff = TL_FALLOFF_LINEAR}},
                          .effects = ON(RANGED) | ON(LINEAR),
                          .needs = {.falloffs = FADE(LINEAR)}, .light_count = 1},
    [TL_EFFECT_LINEAR_FROM] = {"a linear light with begin", TL_GROUP_BASE,
                               .lamps = {{ANY_LIGHT, .range = 2.0f, .begin = 1.0f,
                                          .falloff = TL_FALLOFF_LINEAR}},
                               .effects = ON(RANGED) | ON(LINEAR_FROM),
                               .needs = {.falloffs = FADE(LINEAR_FROM)}, .light_count = 1},
    [TL_EFFECT_TABLE] = {"a falloff table", TL_GROUP_BASE,
                         .lamps = {{ANY_LIGHT, .range = 2.0f, .falloff = TL_FALLOFF_TABLE}},
                         .effects = ON(RANGED) | ON(TABLE),
                         .needs = {.falloffs = FADE(TABLE), .shapes = TL_SHAPE_TABLE},
                         .light_count = 1},
    [TL_EFFECT_PROJECTED] =
        {"a spot with a texture", TL_GROUP_BASE,
         .lamps = {{ANY_LIGHT, .has_cone = 1, .cone = 0.5f, .has_texture = 1}},
         .effects = ON(GLOBAL) | ON(INVERSE_SQUARE) | ON(SPOTS) | ON(PROJECTED),
         .needs = {.falloffs = FADE(INVERSE_SQUARE), .spots = 1, .shapes = TL_SHAPE_PROJECTED},
         .light_count = 1},
    [TL_EFFECT_AROUND] = {"a point light with a texture", TL_GROUP_BASE,
                          .lamps = {{ANY_LIGHT, .has_texture = 1}},
                          .effects = ON(GLOBAL) | ON(INVERSE_SQUARE) | ON(AROUND),
                          .needs = {.falloffs = FADE(INVERSE_SQUARE),
                                    .shapes = TL_SHAPE_AROUND},
                          .light_count = 1},
    [TL_EFFECT_PROFILES] = {"a light with a profile", TL_GROUP_BASE,
                            .lamps = {{ANY_LIGHT, .has_profile = 1}},
                            .effects = ON(GLOBAL) | ON(INVERSE_SQUARE) | ON(PROFILES),
                            .needs = {.falloffs = FADE(INVERSE_SQUARE),
                                      .shapes = TL_SHAPE_PROFILE},
                            .light_count = 1},
    [TL_EFFECT_AMBIENT_LOBE] =
        {"a light with an ambient lobe alone", TL_GROUP_BASE,
         .lamps = {{.intensity = 1.0f, .ambient = 0.5f, .is_directional = 1}},
         .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(AMBIENT_LOBE) | ON(AMBIENT),
         .needs = {.falloffs = FADE(NONE), .ambient = 1, .shapes = TL_SHAPE_AMBIENT},
         .light_count = 1},
    [TL_EFFECT_SHADOWS] = {"a light that casts shadows, and its map", TL_GROUP_BASE,
                           .lamps = {{ANY_LIGHT, .casts_shadow = 1, .has_map = 1}},
                           .effects = ON(GLOBAL) | ON(INVERSE_SQUARE) | ON(SHADOWS),
                           .needs = {.falloffs = FADE(INVERSE_SQUARE),
                                     .shapes = TL_SHAPE_SHADOW},
                           .light_count = 1},
    [TL_EFFECT_LINKS] = {"a light that is linked to an object", TL_GROUP_BASE,
                         .lamps = {{ANY_LIGHT, .is_linked = 1}},
                         .effects = ON(GLOBAL) | ON(INVERSE_SQUARE) | ON(LINKS),
                         .needs = {.falloffs = FADE(INVERSE_SQUARE), .shapes = TL_SHAPE_LINK},
                         .light_count = 1},
    [TL_EFFECT_SKY_GRADIENT] = {"a gradient", TL_GROUP_BASE, .sky = 0.5f,
                                .sky_type = TL_SKY_GRADIENT, .effects = ON(SKY_GRADIENT),
                                .needs = {.sky = TL_GRADIENT_SKY}},
    [TL_EFFECT_SKY_IMAGE] = {"an image", TL_GROUP_BASE, .sky = 0.5f, .sky_type = TL_SKY_IMAGE,
                             .effects = ON(SKY_IMAGE), .needs = {.sky = TL_IMAGE_SKY}},
    [TL_EFFECT_SPOTS] = {"a spot light", TL_GROUP_BASE,
                         .lamps = {{ANY_LIGHT, .has_cone = 1, .cone = 0.5f}},
                         .effects = ON(GLOBAL) | ON(INVERSE_SQUARE) | ON(SPOTS),
                         .needs = {.falloffs = FADE(INVERSE_SQUARE), .spots = 1},
                         .light_count = 1},
    [TL_EFFECT_SPECULAR] = {"a light with a lobe on a Phong material", PHONG,
                            .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
                            .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR),
                            .needs = {.falloffs = FADE(NONE), .specular = 1}, .light_count = 1},
    [TL_EFFECT_METAL_ROUGH] = {"metal-rough planes", METAL, .effects = ON(METAL_ROUGH),
                               .needs = {.idle = TL_HAS(TL_ROUGHNESS)}},
    [TL_EFFECT_MODEL] = {"another model", TL_GROUP_BASE,
                         .model = TL_MODEL_BLINN_PHONG_NORMALIZED, .effects = ON(MODEL)},
    [TL_EFFECT_WIDTH] = {"a model of rough surfaces", METAL, .model = TL_MODEL_OREN_NAYAR,
                         .effects = ON(METAL_ROUGH) | ON(MODEL) | ON(WIDTH)},
    [TL_EFFECT_TANGENT] = {"tangents and a lobe with a direction",
                           TL_GROUP_BASE | TL_GROUP_TANGENT, .model = TL_MODEL_WARD_ANISOTROPIC,
                           .effects = ON(MODEL) | ON(WIDTH) | ON(TANGENT)},
    [TL_EFFECT_FRESNEL] = {"a model with Fresnel's reflectance, on metal", METAL,
                           .model = TL_MODEL_COOK_TORRANCE,
                           .effects = ON(METAL_ROUGH) | ON(MODEL) | ON(WIDTH) | ON(FRESNEL)},
    [TL_EFFECT_ROWS] = {"a row of materials", INDEXED, .row = 3, .effects = ON(ROWS)},
    [TL_EFFECT_EXPONENT] = {"an exponent for all surfaces", PHONG, .has_shininess = 1,
                            .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
                            .effects =
                                ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR) | ON(EXPONENT),
                            .needs = {.falloffs = FADE(NONE),
                                      .specular = 1,
                                      .fixed_exponent = 1,
                                      .idle = TL_HAS(TL_SHININESS)},
                            .light_count = 1},
    [TL_EFFECT_ONE_COLOR] = {"a white light, grey specular colours and a model that tints",
                             PHONG, .layout = TL_LAYOUT_ISPC,
                             .model = TL_MODEL_BLINN_PHONG_NORMALIZED,
                             .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
                             .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR) |
                                        ON(MODEL) | ON(ONE_COLOR),
                             .needs = {.falloffs = FADE(NONE), .specular = 1, .one_color = 1},
                             .light_count = 1},
    [TL_EFFECT_AMBIENT] = {"ambient light", TL_GROUP_BASE, .ambient = 0.1f,
                           .effects = ON(AMBIENT), .needs = {.ambient = 1}},
    [TL_EFFECT_OCCLUSION] = {"occlusion and ambient light", OCCLUSION, .ambient = 0.1f,
                             .effects = ON(AMBIENT) | ON(OCCLUSION), .needs = {.ambient = 1}},
    [TL_EFFECT_SURROUNDINGS] = {"a radius and ambient light", TL_GROUP_BASE, .ambient = 0.1f,
                                .radius = 0.5f, .effects = ON(AMBIENT) | ON(SURROUNDINGS),
                                .needs = {.ambient = 1, .surroundings = 1}},
    [TL_EFFECT_EMISSION] = {"emission", EMISSION, .effects = ON(EMISSION)},
    [TL_EFFECT_SKY] = {"a sky", TL_GROUP_BASE, .sky = 0.5f, .effects = ON(SKY)},
    [TL_EFFECT_SKY_LIGHT] = {"a sky that lights", TL_GROUP_BASE, .sky = 0.5f, .sky_light = 1.0f,
                             .effects = ON(SKY) | ON(SKY_LIGHT) | ON(AMBIENT),
                             .needs = {.ambient = 1, .sky_light = TL_SKY_DIFFUSE}},
    [TL_EFFECT_SKY_MIRRORED] =
        {"specular colours under a sky that lights", PHONG, .sky = 0.5f, .sky_light = 1.0f,
         .effects = ON(SKY) | ON(SKY_LIGHT) | ON(SKY_MIRRORED) | ON(AMBIENT),
         .needs = {.ambient = 1, .sky_light = TL_SKY_DIFFUSE | TL_SKY_MIRRORED}},
    [TL_EFFECT_TRANSLUCENCY] = {"a layer", TL_GROUP_BASE, .layers = 1,
                                .effects = ON(TRANSLUCENCY)},
    [TL_EFFECT_PARALLEL] = {"parallel rays", TL_GROUP_BASE, .projection = TL_ORTHOGRAPHIC,
                            .effects = ON(PARALLEL), .needs = {.orthographic = 1}},
    [TL_EFFECT_WINDOW] = {"a part that begins inside", TL_GROUP_BASE, .window = {2, 0},
                          .whole = {64, 48}, .effects = ON(WINDOW), .needs = {.window = 1}},
};

/* What might be taken for a cause, and is none. */
static const scene others[] = {
    {"a layer that is not lit", TL_GROUP_BASE, .layers = 1, .without_layers = 1},
    {"nothing at all", TL_GROUP_BASE, .effects = 0},
    {"a part that begins below", TL_GROUP_BASE, .window = {0, 8}, .whole = {64, 48},
     .effects = ON(WINDOW), .needs = {.window = 1}},
    {"a part that begins where the picture does", TL_GROUP_BASE, .whole = {64, 48},
     .effects = 0},
    {"a radius without ambient light", TL_GROUP_BASE, .radius = 0.5f, .effects = 0},
    {"a sky that would light, and is black", TL_GROUP_BASE, .sky_light = 1.0f, .effects = 0},
    {"a sky that lights what reflects nothing", TL_GROUP_BASE, .is_dark = 1, .sky = 0.5f,
     .sky_light = 1.0f, .effects = ON(SKY)},
    {"a radius where nothing reflects", TL_GROUP_BASE, .is_dark = 1, .ambient = 0.1f,
     .radius = 0.5f, .effects = 0},
    {"a model without highlights", PHONG, .model = TL_MODEL_LAMBERT,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(MODEL),
     .needs = {.falloffs = FADE(NONE), .idle = TL_GROUP_PHONG}, .light_count = 1},
    {"tangents and lobes that are round", TL_GROUP_BASE | TL_GROUP_TANGENT,
     .model = TL_MODEL_WARD, .effects = ON(MODEL) | ON(WIDTH),
     .needs = {.idle = TL_GROUP_TANGENT}},
    {"a lobe with a direction, and no tangents", TL_GROUP_BASE,
     .model = TL_MODEL_WARD_ANISOTROPIC, .effects = ON(MODEL) | ON(WIDTH)},
    {"indices without a row", INDEXED, .needs = {.idle = TL_GROUP_BRDF}},
    {"a row without indices", TL_GROUP_BASE, .row = 3, .row_model = TL_MODEL_LAMBERT},
    {"a row and indices of 0", INDEXED, .neutral = TL_GROUP_BRDF, .row = 3,
     .row_model = TL_MODEL_LAMBERT, .needs = {.idle = TL_GROUP_BRDF}},
    {"a row of another model", INDEXED, .row = 3, .row_model = TL_MODEL_LAMBERT,
     .effects = ON(ROWS) | ON(MODEL)},
    {"a row with a black specular colour", INDEXED, .row = 3, .row_given = TL_TAKES_SPECULAR,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(ROWS), .needs = {.falloffs = FADE(NONE)},
     .light_count = 1},
    {"a specular colour that its row does not give", INDEXED, .row = 3, .row_specular = 0.5f,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(ROWS), .needs = {.falloffs = FADE(NONE)},
     .light_count = 1},
    {"a row with a specular colour", INDEXED, .row = 3, .row_given = TL_TAKES_SPECULAR,
     .row_specular = 0.5f, .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR) | ON(ROWS),
     .needs = {.falloffs = FADE(NONE), .specular = 1}, .light_count = 1},
    {"rows, and a model that tints grey highlights", PHONG | TL_GROUP_BRDF,
     .layout = TL_LAYOUT_COMPACT_12, .row = 3, .row_model = TL_MODEL_BLINN_PHONG_NORMALIZED,
     .model = TL_MODEL_BLINN_PHONG_NORMALIZED,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR) | ON(MODEL) | ON(ROWS),
     .needs = {.falloffs = FADE(NONE), .specular = 1}, .light_count = 1},
    {"a model that tints grey highlights, which are black", PHONG, .layout = TL_LAYOUT_ISPC,
     .neutral = TL_THREE(TL_SPECULAR_R), .model = TL_MODEL_BLINN_PHONG_NORMALIZED,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(MODEL),
     .needs = {.falloffs = FADE(NONE), .idle = TL_GROUP_PHONG}, .light_count = 1},
    {"grey highlights that their model does not tint", PHONG, .layout = TL_LAYOUT_ISPC,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR),
     .needs = {.falloffs = FADE(NONE), .specular = 1}, .light_count = 1},
    {"a lobe alone, under a model without highlights", PHONG, .model = TL_MODEL_LAMBERT,
     .lamps = {{.intensity = 1.0f, .specular = 1.0f, .range = 1.0f}}, .effects = ON(MODEL),
     .needs = {.idle = TL_GROUP_PHONG}, .idle = {[TL_IDLE_NO_GLOSS] = 1}},
    {"light where nothing reflects it", PHONG, .is_dark = 1, .ambient = 0.1f,
     .lamps = {{ANY_LIGHT, .is_directional = 1}}, .needs = {.idle = TL_GROUP_PHONG},
     .idle = {[TL_IDLE_DARK] = 1}},
    {"light where a row alone reflects it", INDEXED, .is_dark = 1, .ambient = 0.1f, .row = 3,
     .lamps = {{ANY_LIGHT, .is_directional = 1}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(AMBIENT) | ON(ROWS),
     .needs = {.falloffs = FADE(NONE), .ambient = 1}, .light_count = 1},
    {"occlusion of an ambient lobe", OCCLUSION,
     .lamps = {{.intensity = 1.0f, .ambient = 0.5f, .is_directional = 1}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(AMBIENT_LOBE) | ON(AMBIENT) | ON(OCCLUSION),
     .needs = {.falloffs = FADE(NONE), .ambient = 1, .shapes = TL_SHAPE_AMBIENT},
     .light_count = 1},
    {"an ambient lobe of no intensity", OCCLUSION,
     .lamps = {{.ambient = 0.5f, .diffuse = 1.0f}}, .needs = {.idle = TL_GROUP_OCCLUSION},
     .idle = {[TL_IDLE_BLACK] = 1}},
    {"a light that casts shadows, without a map", TL_GROUP_BASE,
     .lamps = {{ANY_LIGHT, .casts_shadow = 1}}, .effects = ON(GLOBAL) | ON(INVERSE_SQUARE),
     .needs = {.falloffs = FADE(INVERSE_SQUARE)}, .light_count = 1},
    {"a map of a light that casts no shadows", TL_GROUP_BASE,
     .lamps = {{ANY_LIGHT, .has_map = 1}}, .effects = ON(GLOBAL) | ON(INVERSE_SQUARE),
     .needs = {.falloffs = FADE(INVERSE_SQUARE)}, .light_count = 1},
    {"a light of no intensity that casts shadows", TL_GROUP_BASE,
     .lamps = {{.diffuse = 1.0f, .casts_shadow = 1, .has_map = 1}},
     .idle = {[TL_IDLE_BLACK] = 1}},
    {"a black gradient", TL_GROUP_BASE, .sky_type = TL_SKY_GRADIENT},
    {"an image that is shown black", TL_GROUP_BASE, .sky_type = TL_SKY_IMAGE},
    {"occlusion without ambient light", OCCLUSION, .needs = {.idle = TL_GROUP_OCCLUSION}},
    {"neutral occlusion", OCCLUSION, .neutral = TL_GROUP_OCCLUSION, .ambient = 0.1f,
     .effects = ON(AMBIENT), .needs = {.ambient = 1, .idle = TL_GROUP_OCCLUSION}},
    {"neutral emission", EMISSION, .neutral = TL_GROUP_EMISSIVE,
     .needs = {.idle = TL_GROUP_EMISSIVE}},
    {"a lobe and no material for it", TL_GROUP_BASE,
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL), .needs = {.falloffs = FADE(NONE)},
     .light_count = 1},
    {"a material and no lobe for it", PHONG, .lamps = {{ANY_LIGHT, .is_directional = 1}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL),
     .needs = {.falloffs = FADE(NONE), .idle = TL_GROUP_PHONG}, .light_count = 1},
    {"a lobe on black specular colours", PHONG, .neutral = TL_THREE(TL_SPECULAR_R),
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL),
     .needs = {.falloffs = FADE(NONE), .idle = TL_GROUP_PHONG}, .light_count = 1},
    {"a lobe on a dielectric", METAL, .neutral = TL_HAS(TL_METALLIC),
     .lamps = {{ANY_LIGHT, .is_directional = 1, .specular = 1.0f}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL) | ON(SPECULAR) | ON(METAL_ROUGH),
     .needs = {.falloffs = FADE(NONE), .specular = 1, .idle = TL_HAS(TL_METALLIC)},
     .light_count = 1},
    {"a light of no intensity beside one that shines", PHONG,
     .lamps = {{.range = 1.0f, .falloff = TL_FALLOFF_LINEAR, .diffuse = 1.0f, .specular = 1.0f},
               {ANY_LIGHT, .is_directional = 1}},
     .effects = ON(GLOBAL) | ON(DIRECTIONAL),
     .needs = {.falloffs = FADE(NONE), .idle = TL_GROUP_PHONG}, .light_count = 1,
     .idle = {[TL_IDLE_BLACK] = 1}},
    {"a range that no distance is below", TL_GROUP_BASE,
     .lamps = {{ANY_LIGHT, .range = 1e-30f}}, .idle = {[TL_IDLE_SHORT] = 1}},
    {"a spot of no width", TL_GROUP_BASE, .lamps = {{ANY_LIGHT, .has_cone = 1, .cone = 0.0f}},
     .idle = {[TL_IDLE_NARROW] = 1}},
    {"a spot of all of space, as hard as can be", TL_GROUP_BASE,
     .lamps = {{ANY_LIGHT, .has_cone = 1, .cone = 3.14159274f}},
     .effects = ON(GLOBAL) | ON(INVERSE_SQUARE), .needs = {.falloffs = FADE(INVERSE_SQUARE)},
     .light_count = 1},
    {"a lobe alone, and nothing to show it", TL_GROUP_BASE,
     .lamps = {{.intensity = 1.0f, .specular = 1.0f, .range = 1.0f}},
     .idle = {[TL_IDLE_NO_GLOSS] = 1}},
    {"all effects of a bare frame", TL_GROUP_BASE, .mode = TL_EFFECTS_ALL,
     .lamps = {{.diffuse = 1.0f, .range = 1.0f}},
     .effects = ON(RANGED) | ON(DIRECTIONAL) | ON(INVERSE_SQUARE) | ON(LINEAR) |
                ON(LINEAR_FROM) | ON(SPOTS) | ON(AMBIENT) | SHAPES,
     .needs = {.falloffs = (1u << TL_FADE_COUNT) - 1u,
               .spots = 1,
               .ambient = 1,
               .shapes = 95 | TL_SHAPE_LINK},
     .light_count = 1, .idle = {[TL_IDLE_BLACK] = 1}},
    {"all effects of a frame with every plane", PHONG | OCCLUSION | EMISSION,
     .neutral = TL_THREE(TL_SPECULAR_R) | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE,
     .mode = TL_EFFECTS_ALL,
     .effects = ON(DIRECTIONAL) | ON(INVERSE_SQUARE) | ON(LINEAR) | ON(LINEAR_FROM) |
                ON(SPOTS) | ON(SPECULAR) | ON(AMBIENT) | ON(OCCLUSION) | ON(EMISSION) | SHAPES,
     .needs = {.falloffs = (1u << TL_FADE_COUNT) - 1u,
               .spots = 1,
               .specular = 1,
               .ambient = 1,
               .shapes = 95 | TL_SHAPE_LINK}},
};

/* An image of one pixel. */
static uint32_t add_pixel(tl_light_set *set)
{
    float *pixels = calloc(3, sizeof *pixels);
    uint32_t image = 0;
    tl_error err;
    assert_non_null(pixels);
    ASSERT_OK(tl_light_set_add_image(set, "one pixel", 1, 1, pixels, &image, &err), err);
    return image;
}

/* A profile that is alike in all directions. */
static uint32_t add_alike(tl_light_set *set)
{
    tl_light_profile profile = {
        .columns = 1, .rows = 2, .rows_of_half_turn = 1, .peak = 1.0, .shares = malloc(8)};
    uint32_t number = 0;
    tl_error err;
    assert_non_null(profile.shares);
    profile.shares[0] = profile.shares[1] = 1.0f;
    ASSERT_OK(tl_light_set_add_profile(set, "alike", &profile, &number, &err), err);
    return number;
}

/* Of a point light in the camera's place. */
static void add_map(tl_gbuffer *g)
{
    tl_shadow_map map = {.kind = TL_SHADOW_CUBE, .size = TL_LEAST_SHADOW_SIZE};
    tl_error err;
    tl_shadow_views_from(&map, NULL, 0.0, 0.1);
    ASSERT_OK(tl_shadow_maps_add(&g->shadows, &map, &err), err);
}

static void add_lamp(tl_light_set *set, const lamp *from)
{
    tl_light light = tl_light_default();
    tl_error err;
    if (from->intensity == 0.0f && from->diffuse == 0.0f)
        return;
    light.type = from->is_directional ? TL_LIGHT_DIRECTIONAL : TL_LIGHT_POINT;
    if (from->has_cone) {
        light.type = TL_LIGHT_SPOT;
        light.inner_cone = light.outer_cone = from->cone;
    }
    light.direction[2] = -1.0f;
    light.falloff = from->falloff;
    light.range = from->range > 0.0f ? from->range : INFINITY;
    light.begin = from->begin;
    light.intensity = from->intensity;
    light.diffuse = from->diffuse;
    light.specular = from->specular;
    light.ambient = from->ambient;
    light.casts_shadow = (uint32_t)from->casts_shadow;
    if (from->falloff == TL_FALLOFF_TABLE)
        ASSERT_OK(tl_light_set_add_table(set, (float[]){1.0f, 0.0f}, 2, &light.table, &err),
                  err);
    if (from->is_linked)
        ASSERT_OK(tl_light_set_add_link(set, &(tl_light_link){0, 1, &(tl_link_object){1, ""}},
                                        &light.link, &err),
                  err);
    if (from->has_texture)
        light.texture = add_pixel(set);
    if (from->has_profile)
        light.profile = add_alike(set);
    ASSERT_OK(tl_light_set_add(set, &light, &err), err);
}

static tl_prepared prepared_of(const scene *s)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    tl_camera camera = tl_camera_look_at(eye, target, up, 1.0, 8, 8, 0.1, 100.0);
    tl_light_set lights = {.model = s->model, .has_shininess = s->has_shininess};
    tl_prepared prepared = {0};
    tl_gbuffer *g = NULL;
    tl_error err;
    camera.projection = s->projection;
    camera.window_x = s->window[0];
    camera.window_y = s->window[1];
    camera.whole_width = s->whole[0];
    camera.whole_height = s->whole[1];
    ASSERT_OK(tl_gbuffer_create_packed(&camera, s->layout, s->present, &g, &err), err);
    for (uint32_t i = 0; i < s->layers; i++)
        ASSERT_OK(tl_layers_add(g, NULL, &err), err);
    g->neutral = s->neutral;
    g->is_dark = s->is_dark;
    lights.ambient[1] = s->ambient;
    lights.occlusion_radius = s->radius;
    lights.sky_type = s->sky_type;
    lights.sky_light = s->sky_light;
    lights.sky[2] = s->sky_type == TL_SKY_IMAGE ? 0.0f : s->sky;
    lights.sky_intensity = s->sky_type == TL_SKY_IMAGE ? s->sky : 0.0f;
    if (s->sky_type == TL_SKY_IMAGE)
        lights.sky_image = add_pixel(&lights);
    for (size_t i = 0; i < COUNT_OF(s->lamps); i++) {
        add_lamp(&lights, &s->lamps[i]);
        if (s->lamps[i].has_map)
            add_map(g);
        if (s->lamps[i].is_linked)
            ASSERT_OK(tl_ids_add(g, &err), err);
    }
    if (s->row > 0) {
        tl_material_row row = tl_material_row_default();
        row.index = s->row;
        row.model = s->row_model;
        row.given = s->row_given;
        row.specular[1] = s->row_specular;
        ASSERT_OK(tl_light_set_add_material(&lights, &row, &err), err);
    }
    ASSERT_OK(tl_prepare(g, &lights,
                         &(tl_prepare_options){.tile_size = 16,
                                               .effects = s->mode,
                                               .layers = s->without_layers ? 0 : s->layers},
                         NULL, &prepared, &err),
              err);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(g);
    return prepared;
}

static void expect_effects(const scene *s, uint64_t got)
{
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        if ((got >> i & 1) != (s->effects >> i & 1))
            fail_msg("%s: %s is %s", s->name, tl_effect_rows[i].word,
                     got >> i & 1 ? "on" : "off");
}

static void expect(const scene *s)
{
    tl_prepared p = prepared_of(s);
    const tl_needs needs = {.present = s->present,
                            .models = 1u << s->model |
                                      (s->effects & ON(ROWS) ? 1u << s->row_model : 0u),
                            .layout = s->layout,
                            .model = s->model,
                            .falloffs = s->needs.falloffs,
                            .spots = s->needs.spots,
                            .specular = s->needs.specular,
                            .ambient = s->needs.ambient,
                            .orthographic = s->needs.orthographic,
                            .one_color = s->needs.one_color,
                            .fixed_exponent = s->needs.fixed_exponent,
                            .idle = s->needs.idle,
                            .shapes = s->needs.shapes,
                            .sky = s->needs.sky,
                            .surroundings = s->needs.surroundings,
                            .sky_light = s->needs.sky_light,
                            .window = s->needs.window};
    expect_effects(s, p.explanation.effects);
    if (memcmp(&p.needs, &needs, sizeof needs) != 0)
        fail_msg(
            "%s: kernels are built for something else: falloffs %x, spots %u, specular %u, "
            "ambient %u, orthographic %u, one_color %u, idle %x, shapes %x, sky %u, "
            "surroundings %u, sky_light %u, window %u",
            s->name, p.needs.falloffs, p.needs.spots, p.needs.specular, p.needs.ambient,
            p.needs.orthographic, p.needs.one_color, p.needs.idle, p.needs.shapes, p.needs.sky,
            p.needs.surroundings, p.needs.sky_light, p.needs.window);
    if (p.frame.light_count != s->light_count)
        fail_msg("%s: %u lights", s->name, p.frame.light_count);
    for (int i = 0; i < TL_IDLE_LIGHT_COUNT; i++)
        if (p.explanation.idle_lights[i].count != s->idle[i])
            fail_msg("%s: %u lights are idle by reason %d", s->name,
                     p.explanation.idle_lights[i].count, i);
    tl_prepared_clear(&p);
}

static void each_effect_has_a_scene_of_its_own(void **state)
{
    (void)state;
    for (int i = 0; i < TL_EFFECT_COUNT; i++) {
        if (!(minimal[i].effects >> i & 1))
            fail_msg("%s has no scene", tl_effect_rows[i].word);
        expect(&minimal[i]);
    }
}

static void what_changes_nothing_calls_for_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(others); i++)
        expect(&others[i]);
}

static void each_cause_is_needed(void **state)
{
    uint64_t used = 0;
    (void)state;
    for (int i = 0; i < TL_EFFECT_COUNT; i++) {
        const uint64_t causes = tl_effect_rows[i].causes;
        assert_true(tl_effects_of(causes) >> i & 1);
        for (int c = 0; c < TL_CAUSE_COUNT; c++)
            if (causes >> c & 1)
                assert_false(tl_effects_of(~TL_BY(c)) >> i & 1);
        used |= causes;
    }
    assert_int_equal(used, UINT64_MAX >> (64 - TL_CAUSE_COUNT));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_effect_has_a_scene_of_its_own),
        cmocka_unit_test(what_changes_nothing_calls_for_nothing),
        cmocka_unit_test(each_cause_is_needed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
