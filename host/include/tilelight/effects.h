/* The effects that lighting computes, each with what calls for it: one table, which decides for every
 * frame (host/frame/effects.c) and is what `tilelight effects` prints.
 *
 * An effect is on where all its causes are there, and off effects are compiled out of the kernels,
 * their planes not read. Only what adds exactly nothing may be left out, so the picture is the same bit
 * for bit whether or not it is (--effects). */
#ifndef TL_EFFECTS_H
#define TL_EFFECTS_H

#include "planes.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Whose a cause is: lights of the set, planes of the G-buffer, or a setting of the frame. */
typedef enum tl_cause_kind {
    TL_CAUSE_OF_LIGHTS,
    TL_CAUSE_OF_PLANES,
    TL_CAUSE_OF_FRAME
} tl_cause_kind;

/* X(name, kind, what it is, after "no" where it is lacking) */
#define TL_CAUSES(X)                                                                       \
    X(TL_CAUSE_GLOBAL, TL_CAUSE_OF_LIGHTS, "light that reaches everything")                \
    X(TL_CAUSE_RANGED, TL_CAUSE_OF_LIGHTS, "light with a range")                           \
    X(TL_CAUSE_DIRECTIONAL, TL_CAUSE_OF_LIGHTS, "directional light")                       \
    X(TL_CAUSE_INVERSE_SQUARE, TL_CAUSE_OF_LIGHTS, "light with an inverse-square falloff") \
    X(TL_CAUSE_LINEAR, TL_CAUSE_OF_LIGHTS, "light with a linear falloff")                  \
    X(TL_CAUSE_LINEAR_FROM, TL_CAUSE_OF_LIGHTS,                                            \
      "light with a linear falloff that begins at a distance")                             \
    X(TL_CAUSE_TABLE, TL_CAUSE_OF_LIGHTS, "light with a falloff table")                    \
    X(TL_CAUSE_PROJECTED, TL_CAUSE_OF_LIGHTS, "spot light with a texture")                 \
    X(TL_CAUSE_AROUND, TL_CAUSE_OF_LIGHTS, "point light with a texture")                   \
    X(TL_CAUSE_PROFILE, TL_CAUSE_OF_LIGHTS, "light with a profile")                        \
    X(TL_CAUSE_AMBIENT_LOBE, TL_CAUSE_OF_LIGHTS, "light with an ambient lobe")             \
    X(TL_CAUSE_SHADOW, TL_CAUSE_OF_LIGHTS, "light with a shadow map")                      \
    X(TL_CAUSE_LINK, TL_CAUSE_OF_LIGHTS, "light linked to objects")                        \
    X(TL_CAUSE_HIGHLIGHT, TL_CAUSE_OF_LIGHTS, "light with a specular lobe")                \
    X(TL_CAUSE_CONE, TL_CAUSE_OF_LIGHTS, "spot light")                                     \
    X(TL_CAUSE_GLOSS, TL_CAUSE_OF_PLANES, "specular or metal-rough material")              \
    X(TL_CAUSE_METAL_ROUGH, TL_CAUSE_OF_PLANES, "metal-rough material")                    \
    X(TL_CAUSE_OCCLUSION, TL_CAUSE_OF_PLANES, "occlusion")                                 \
    X(TL_CAUSE_EMISSION, TL_CAUSE_OF_PLANES, "emission")                                   \
    X(TL_CAUSE_AMBIENT, TL_CAUSE_OF_FRAME, "ambient light")                                \
    X(TL_CAUSE_RADIUS, TL_CAUSE_OF_FRAME, "radius of ambient occlusion")                   \
    X(TL_CAUSE_SKY, TL_CAUSE_OF_FRAME, "colour of the sky")                                \
    X(TL_CAUSE_SKY_GRADIENT, TL_CAUSE_OF_FRAME, "gradient of the sky")                     \
    X(TL_CAUSE_SKY_IMAGE, TL_CAUSE_OF_FRAME, "image of the sky")                           \
    X(TL_CAUSE_SKY_LIGHT, TL_CAUSE_OF_FRAME, "light of the sky on surfaces")               \
    X(TL_CAUSE_MODEL, TL_CAUSE_OF_FRAME, "shading model other than phong")                 \
    X(TL_CAUSE_ROWS, TL_CAUSE_OF_FRAME, "row of materials for an index of the capture")    \
    X(TL_CAUSE_SHINY, TL_CAUSE_OF_FRAME, "shading model with highlights")                  \
    X(TL_CAUSE_WIDTH, TL_CAUSE_OF_FRAME, "shading model of rough surfaces")                \
    X(TL_CAUSE_GRAIN, TL_CAUSE_OF_FRAME, "shading model that follows a direction")         \
    X(TL_CAUSE_TANGENT, TL_CAUSE_OF_PLANES, "tangent")                                     \
    X(TL_CAUSE_FRESNEL, TL_CAUSE_OF_FRAME, "shading model with Fresnel's reflectance")     \
    X(TL_CAUSE_EXPONENT, TL_CAUSE_OF_FRAME, "shininess for all surfaces")                  \
    X(TL_CAUSE_ONE_COLOR, TL_CAUSE_OF_FRAME,                                               \
      "model that tints grey highlights, and lights of one colour each")                   \
    X(TL_CAUSE_PARALLEL, TL_CAUSE_OF_FRAME, "orthographic camera")                         \
    X(TL_CAUSE_WINDOW, TL_CAUSE_OF_FRAME, "part that begins inside the picture")           \
    X(TL_CAUSE_BLENDED, TL_CAUSE_OF_FRAME, "blended surface in a layer")

typedef enum tl_cause {
#define TL_CAUSE_NAME(name, kind, what) name,
    TL_CAUSES(TL_CAUSE_NAME)
#undef TL_CAUSE_NAME
        TL_CAUSE_COUNT
} tl_cause;

/* One bit each. */
typedef char tl_causes_fit[TL_CAUSE_COUNT <= 64 ? 1 : -1];

#define TL_BY(cause) ((uint64_t)1 << (cause))

/* X(name, word, what it computes, causes it takes: all of them, planes it reads beside TL_GROUP_BASE,
 *   what switches it: a macro of kernels/options.h, a number of the frame, or a kernel of its own) */
#define TL_EFFECTS(X)                                                                          \
    X(TL_EFFECT_GLOBAL, "global-lights", "lights that reach everything, for every pixel",      \
      TL_BY(TL_CAUSE_GLOBAL), 0, "frame.global_count")                                         \
    X(TL_EFFECT_RANGED, "ranged-lights", "lights that end, listed for the tiles they reach",   \
      TL_BY(TL_CAUSE_RANGED), 0, "frame.light_count")                                          \
    X(TL_EFFECT_DIRECTIONAL, "directional", "light from one direction, without falloff",       \
      TL_BY(TL_CAUSE_DIRECTIONAL), 0, "TL_FALLOFFS_USED")                                      \
    X(TL_EFFECT_INVERSE_SQUARE, "inverse-square", "falloff with the square of the distance",   \
      TL_BY(TL_CAUSE_INVERSE_SQUARE), 0, "TL_FALLOFFS_USED")                                   \
    X(TL_EFFECT_LINEAR, "linear", "falloff from the light to its range",                       \
      TL_BY(TL_CAUSE_LINEAR), 0, "TL_FALLOFFS_USED")                                           \
    X(TL_EFFECT_LINEAR_FROM, "linear-from", "falloff from a distance on to the range",         \
      TL_BY(TL_CAUSE_LINEAR_FROM), 0, "TL_FALLOFFS_USED")                                      \
    X(TL_EFFECT_TABLE, "falloff-table", "falloff by a table of the light's own",               \
      TL_BY(TL_CAUSE_TABLE), 0, "TL_SHAPES")                                                   \
    X(TL_EFFECT_PROJECTED, "spot-textures", "pictures that spots project",                     \
      TL_BY(TL_CAUSE_PROJECTED), 0, "TL_SHAPES")                                               \
    X(TL_EFFECT_AROUND, "point-textures", "pictures all around lamps", TL_BY(TL_CAUSE_AROUND), \
      0, "TL_SHAPES")                                                                          \
    X(TL_EFFECT_PROFILES, "profiles", "intensities of lights by direction, from IES files",    \
      TL_BY(TL_CAUSE_PROFILE), 0, "TL_SHAPES")                                                 \
    X(TL_EFFECT_AMBIENT_LOBE, "light-ambient",                                                 \
      "a share of lights on the albedo, whatever the normal", TL_BY(TL_CAUSE_AMBIENT_LOBE), 0, \
      "TL_SHAPES")                                                                             \
    X(TL_EFFECT_SHADOWS, "shadows", "the share of a light that nothing stands before",         \
      TL_BY(TL_CAUSE_SHADOW), 0, "TL_SHAPES")                                                  \
    X(TL_EFFECT_LINKS, "links", "lights that some objects alone have", TL_BY(TL_CAUSE_LINK),   \
      0, "TL_SHAPES")                                                                          \
    X(TL_EFFECT_SPOTS, "spots", "cones of light", TL_BY(TL_CAUSE_CONE), 0, "TL_SPOTS")         \
    X(TL_EFFECT_SPECULAR, "specular", "highlights",                                            \
      TL_BY(TL_CAUSE_HIGHLIGHT) | TL_BY(TL_CAUSE_GLOSS) | TL_BY(TL_CAUSE_SHINY),               \
      TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH, "TL_SPECULAR")                                    \
    X(TL_EFFECT_METAL_ROUGH, "metal-rough", "Phong material from metallic and roughness",      \
      TL_BY(TL_CAUSE_METAL_ROUGH), TL_HAS(TL_METALLIC), "TL_PRESENT")                          \
    X(TL_EFFECT_MODEL, "model", "how surfaces reflect, by another shading model",              \
      TL_BY(TL_CAUSE_MODEL), 0, "TL_MODEL")                                                    \
    X(TL_EFFECT_WIDTH, "roughness", "lobes as wide as a surface is rough",                     \
      TL_BY(TL_CAUSE_WIDTH), TL_HAS(TL_SHININESS) | TL_HAS(TL_ROUGHNESS), "TL_MODEL")          \
    X(TL_EFFECT_TANGENT, "tangents", "lobes that follow each pixel's tangent",                 \
      TL_BY(TL_CAUSE_GRAIN) | TL_BY(TL_CAUSE_TANGENT), TL_GROUP_TANGENT, "TL_IDLE")            \
    X(TL_EFFECT_FRESNEL, "fresnel", "more reflection at grazing angles, and less from below",  \
      TL_BY(TL_CAUSE_FRESNEL) | TL_BY(TL_CAUSE_GLOSS),                                         \
      TL_THREE(TL_SPECULAR_R) | TL_HAS(TL_METALLIC), "TL_MODEL")                               \
    X(TL_EFFECT_ROWS, "materials", "models and materials by the index of each pixel",          \
      TL_BY(TL_CAUSE_ROWS), TL_GROUP_BRDF, "TL_IDLE")                                          \
    X(TL_EFFECT_EXPONENT, "fixed-exponent", "one exponent in place of each pixel's own",       \
      TL_BY(TL_CAUSE_EXPONENT), 0, "TL_FIXED_EXPONENT")                                        \
    X(TL_EFFECT_ONE_COLOR, "one-color", "both lobes in one sum", TL_BY(TL_CAUSE_ONE_COLOR), 0, \
      "TL_ONE_COLOR")                                                                          \
    X(TL_EFFECT_AMBIENT, "ambient", "ambient light on the albedo", TL_BY(TL_CAUSE_AMBIENT), 0, \
      "TL_AMBIENT")                                                                            \
    X(TL_EFFECT_OCCLUSION, "occlusion", "the share of ambient light that arrives",             \
      TL_BY(TL_CAUSE_AMBIENT) | TL_BY(TL_CAUSE_OCCLUSION), TL_GROUP_OCCLUSION, "TL_IDLE")      \
    X(TL_EFFECT_SURROUNDINGS, "ambient-occlusion",                                             \
      "the share of ambient light that what stands around lets through",                       \
      TL_BY(TL_CAUSE_AMBIENT) | TL_BY(TL_CAUSE_RADIUS), 0, "TL_SURROUNDINGS")                  \
    X(TL_EFFECT_EMISSION, "emission", "what surfaces send out by themselves",                  \
      TL_BY(TL_CAUSE_EMISSION), TL_GROUP_EMISSIVE, "TL_IDLE")                                  \
    X(TL_EFFECT_SKY, "sky", "a colour where nothing was hit", TL_BY(TL_CAUSE_SKY), 0,          \
      "frame.sky")                                                                             \
    X(TL_EFFECT_SKY_GRADIENT, "sky-gradient", "colours by the elevation of a pixel's ray",     \
      TL_BY(TL_CAUSE_SKY_GRADIENT), 0, "TL_SKY")                                               \
    X(TL_EFFECT_SKY_IMAGE, "sky-image", "a map of the whole sky", TL_BY(TL_CAUSE_SKY_IMAGE),   \
      0, "TL_SKY")                                                                             \
    X(TL_EFFECT_SKY_LIGHT, "sky-light", "the sky's light on surfaces, diffuse",                \
      TL_BY(TL_CAUSE_SKY_LIGHT), 0, "TL_SKY_LIGHT")                                            \
    X(TL_EFFECT_SKY_MIRRORED, "sky-reflection",                                                \
      "the sky, mirrored by surfaces that are glossy",                                         \
      TL_BY(TL_CAUSE_SKY_LIGHT) | TL_BY(TL_CAUSE_GLOSS) | TL_BY(TL_CAUSE_SHINY),               \
      TL_GROUP_PHONG | TL_GROUP_METAL_ROUGH, "TL_SKY_LIGHT")                                   \
    X(TL_EFFECT_TRANSLUCENCY, "translucency",                                                  \
      "layers that blend, each lit as the surfaces behind them are", TL_BY(TL_CAUSE_BLENDED),  \
      0, "blend_layer")                                                                        \
    X(TL_EFFECT_PARALLEL, "orthographic", "parallel rays", TL_BY(TL_CAUSE_PARALLEL), 0,        \
      "TL_ORTHOGRAPHIC")                                                                       \
    X(TL_EFFECT_WINDOW, "region", "rays from where a part of the picture begins",              \
      TL_BY(TL_CAUSE_WINDOW), 0, "TL_WINDOW")

typedef enum tl_effect {
#define TL_EFFECT_NAME(name, word, computes, causes, planes, option) name,
    TL_EFFECTS(TL_EFFECT_NAME)
#undef TL_EFFECT_NAME
        TL_EFFECT_COUNT
} tl_effect;

typedef struct tl_effect_row {
    const char *word, *computes;
    uint64_t causes; /* bits TL_BY(cause) */
    uint32_t planes; /* bits 1 << plane */
    const char *option;
} tl_effect_row;

typedef struct tl_cause_row {
    tl_cause_kind kind;
    const char *what;
} tl_cause_row;

extern const tl_effect_row tl_effect_rows[TL_EFFECT_COUNT];
extern const tl_cause_row tl_cause_rows[TL_CAUSE_COUNT];

/* One bit each. */
typedef char tl_effects_fit[TL_EFFECT_COUNT <= 64 ? 1 : -1];

#define TL_ON(effect) ((uint64_t)1 << (effect))

/* The effects whose causes are all among `causes`: bits TL_ON(effect). */
uint64_t tl_effects_of(uint64_t causes);

/* Those of the effects, given all causes there are, that a light with these causes among them calls for. */
uint64_t tl_effects_of_light(uint64_t all_causes, uint64_t light_causes);

/* Whether each tile computes it only where one of its own lights calls for it (kernels/choices.h; ranged
 * lights, by its list). */
bool tl_effect_is_by_tile(tl_effect effect);

/* Why an effect cannot be taken out by itself, after "it cannot be taken out alone: "; NULL: it can. */
const char *tl_effect_bound(tl_effect effect);

/* X(name, word on the command line, meaning) */
#define TL_EFFECTS_MODES(X)                                                                  \
    X(TL_EFFECTS_AUTO, "auto", "what the frame calls for")                                   \
    X(TL_EFFECTS_ALL, "all",                                                                 \
      "also what adds nothing: every falloff, cones, textures, profiles, ambient lobes and " \
      "shadows "                                                                             \
      "of lights, ambient light, highlights, "                                               \
      "occlusion and emission as far as the frame has planes for them, lights that give "    \
      "nothing")

typedef enum tl_effects_mode {
#define TL_EFFECTS_MODE_NAME(name, word, meaning) name,
    TL_EFFECTS_MODES(TL_EFFECTS_MODE_NAME)
#undef TL_EFFECTS_MODE_NAME
        TL_EFFECTS_MODE_COUNT
} tl_effects_mode;

/* Why a light adds exactly nothing, whatever it shines on.
 * X(name, word, "it ...") */
#define TL_IDLE_LIGHTS(X)                                                   \
    X(TL_IDLE_BLACK, "black", "has no colour or no intensity")              \
    X(TL_IDLE_SHORT, "too-short", "has a range whose square is 0 in float") \
    X(TL_IDLE_NARROW, "too-narrow", "has a cone without width")             \
    X(TL_IDLE_DARK, "no-reflection", "shines where nothing reflects light") \
    X(TL_IDLE_NO_GLOSS, "no-gloss", "has a specular lobe alone, and nothing has highlights")

typedef enum tl_idle_light {
#define TL_IDLE_LIGHT_NAME(name, word, why) name,
    TL_IDLE_LIGHTS(TL_IDLE_LIGHT_NAME)
#undef TL_IDLE_LIGHT_NAME
        TL_IDLE_LIGHT_COUNT
} tl_idle_light;

/* Some lights of a set. */
typedef struct tl_some_lights {
    uint32_t count, first; /* first: its index in the set, of no meaning where there are none */
} tl_some_lights;

/* What was decided for a frame, and by what. */
typedef struct tl_explanation {
    uint64_t effects; /* that are on, bits TL_ON(effect) */
    uint64_t causes;  /* that the frame has, bits TL_BY(cause) */
    uint64_t assumed; /* causes that TL_EFFECTS_ALL takes for there beside them */
    /* effects taken out all the same, to see what they cost: another picture */
    uint64_t without;
    uint32_t present; /* planes of the frame, bits 1 << plane */
    uint32_t neutral; /* those that say nothing: tl_gbuffer.neutral */
    /* 1: no surface reflects light: tl_gbuffer.is_dark, and no row of materials in use */
    uint32_t is_dark;
    uint32_t idle;                                   /* those that are not read */
    tl_some_lights lights[TL_CAUSE_COUNT];           /* of causes of lights */
    tl_some_lights idle_lights[TL_IDLE_LIGHT_COUNT]; /* add nothing; left out with AUTO */
} tl_explanation;

#ifdef __cplusplus
}
#endif

#endif
