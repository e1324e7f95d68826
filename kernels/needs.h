/* What a scene calls for. On the device these are constants of the build, so that what a scene
 * lacks is compiled out; on the host they are variables of the same names. */
#ifndef TL_NEEDS_H
#define TL_NEEDS_H

#include "aovs.h"
#include "dialect.h"
#include "models.h"

/* What the shapes of lights (shape.h) have: bits of tl_needs.shapes. */
#define TL_SHAPE_TABLE 1u
#define TL_SHAPE_PROJECTED 2u
#define TL_SHAPE_AROUND 4u
#define TL_SHAPE_AMBIENT 8u
#define TL_SHAPE_SHADOW 16u
#define TL_SHAPE_PROFILE 64u
#define TL_SHAPE_LINK 128u
#define TL_SHAPE_BARE 32u /* lights have shapes, of which nothing is computed */

/* Skies that are not of one colour (sky.h): values of tl_needs.sky. */
#define TL_GRADIENT_SKY 1u
#define TL_IMAGE_SKY 2u

/* What surfaces have of the sky's light (sky_light.h): bits of tl_needs.sky_light. */
#define TL_SKY_DIFFUSE 1u
#define TL_SKY_MIRRORED 2u

typedef struct tl_needs {
    tl_u32 present;      /* planes of the frame, bits 1 << plane */
    tl_u32 falloffs;     /* rows of falloff.h in use, bits 1 << row */
    tl_u32 specular;     /* 1: some light and some material have a specular lobe */
    tl_u32 orthographic; /* 1: parallel rays */
    tl_u32 layout;       /* how pixels are packed: a row of layout.h */
    tl_u32 model;        /* how surfaces reflect that do not say: a row of models.h */
    tl_u32 spots;        /* 1: some light has a cone */
    /* 1: the lobe is diffuse light times one number a pixel, for the model tints it, specular colours
     * are grey, and both lobes of every light have one colour */
    tl_u32 one_color;
    tl_u32 ambient; /* 1: there is ambient light */
    /* planes of `present` that change nothing here, bits 1 << plane: they are not read, and have the
     * value that planes.h gives what was not hit */
    tl_u32 idle;
    tl_u32 models; /* rows of models.h in use, bits 1 << row: `model`, and those of materials */
    tl_u32 choices; /* what tiles choose for themselves, bits of choices.h */
    /* 1: all surfaces have the exponent of the frame, in place of their own */
    tl_u32 fixed_exponent;
    tl_u32 shapes;       /* what some light has of it; 0: lights have no shapes */
    tl_u32 sky;          /* 0: of one colour, frame.sky */
    tl_u32 surroundings; /* 1: what stands around pixels keeps ambient light from them */
    tl_u32 split;     /* terms that are written by themselves, bits 1 << tl_aov; 0: none is */
    tl_u32 sky_light; /* 0: the sky lights nothing */
    tl_u32 window;    /* 1: the first pixel is not that of the picture: tl_rays.column0, row0 */
} tl_needs;

#ifdef __OPENCL_C_VERSION__
TL_INLINE tl_needs needs_of_build(void)
{
    const tl_needs needs = {
        TL_PRESENT,      TL_FALLOFFS_USED, TL_SPECULAR,       TL_ORTHOGRAPHIC, TL_LAYOUT,
        TL_MODEL,        TL_SPOTS,         TL_ONE_COLOR,      TL_AMBIENT,      TL_IDLE,
        TL_MODELS_USED,  TL_CHOICES,       TL_FIXED_EXPONENT, TL_SHAPES,       TL_SKY,
        TL_SURROUNDINGS, TL_SPLIT,         TL_SKY_LIGHT,      TL_WINDOW};
    return needs;
}
#endif

/* What a model is made of: bits of tl_model_trait. */
TL_INLINE tl_u32 traits_of(tl_u32 model)
{
#define TL_MODEL_TRAITS(name, word, traits, parameters, source) \
    if (model == (tl_u32)name)                                  \
        return (traits);
    TL_MODELS(TL_MODEL_TRAITS)
#undef TL_MODEL_TRAITS
    return 0;
}

/* What any of these models, bits 1 << row, is made of. */
TL_INLINE tl_u32 traits_of_any(tl_u32 models)
{
    tl_u32 all = 0;
#define TL_MODEL_TRAITS(name, word, traits, parameters, source) \
    if (models >> name & 1u)                                    \
        all |= (traits);
    TL_MODELS(TL_MODEL_TRAITS)
#undef TL_MODEL_TRAITS
    return all;
}

/* OF_NEEDS(needs, value, value in the build). What follows asks by it: on the device the answers are
 * constant expressions, so that the compiler's front end leaves out what a scene lacks before anything
 * optimises it. Without that the kernels of a plain scene take three times as long to compile. */
#ifdef __OPENCL_C_VERSION__
#    define OF_NEEDS(needs, value, of_build) (sizeof(needs) != 0 ? (tl_u32)(of_build) : 0u)
#    define TL_OWN_TRAITS(name, word, traits, parameters, source) \
        | (TL_MODEL == (int)name ? (traits) : 0)
#    define TL_ANY_TRAITS(name, word, traits, parameters, source) \
        | (TL_MODELS_USED >> (int)name & 1u ? (traits) : 0)
enum {
    TL_TRAITS_OF_OWN = 0 TL_MODELS(TL_OWN_TRAITS), /* traits_of(TL_MODEL) */
    TL_TRAITS_OF_ANY = 0 TL_MODELS(TL_ANY_TRAITS)  /* traits_of_any(TL_MODELS_USED) */
};
#    undef TL_OWN_TRAITS
#    undef TL_ANY_TRAITS
#else
#    define OF_NEEDS(needs, value, of_build) (value)
#endif

/* Whether one of these planes is there and read. */
#define reads_planes(needs, planes) \
    ((OF_NEEDS(needs, (needs).present & ~(needs).idle, TL_PRESENT & ~TL_IDLE) & (planes)) != 0)

/* Whether the frame's own model has this trait. */
#define lobe_has(needs, trait) \
    ((OF_NEEDS(needs, traits_of((needs).model), TL_TRAITS_OF_OWN) & (tl_u32)(trait)) != 0)

/* Whether some surface may reflect by one of these models, bits 1 << row. */
#define uses_models(needs, which) \
    ((OF_NEEDS(needs, (needs).models, TL_MODELS_USED) & (which)) != 0)

/* Whether some surface may reflect by a model that has this trait. */
#define some_lobe_has(needs, trait) \
    ((OF_NEEDS(needs, traits_of_any((needs).models), TL_TRAITS_OF_ANY) & (tl_u32)(trait)) != 0)

/* Whether all surfaces reflect by one model. */
#define has_one_model(needs)                            \
    (OF_NEEDS(needs, (needs).models, TL_MODELS_USED) == \
     1u << OF_NEEDS(needs, (needs).model, TL_MODEL))

/* Whether the short code of light.h does: all surfaces reflect by one model, which has plain lobes. */
#define is_plain(needs) (has_one_model(needs) && lobe_has(needs, TL_LOBE_PLAIN))

/* Whether a light may have a shape (shape.h). A tile may do without those of the build. */
#define has_shapes(needs) (OF_NEEDS(needs, 1, TL_SHAPES) != 0 && (needs).shapes != 0)

/* Whether the sky is not of one colour (sky.h). */
#define paints_sky(needs) (OF_NEEDS(needs, (needs).sky, TL_SKY) != 0)

/* Whether the sky lights surfaces, and whether some mirror it (sky_light.h). */
#define lit_by_sky(needs) (OF_NEEDS(needs, (needs).sky_light, TL_SKY_LIGHT) != 0)
#define mirrors_sky(needs) \
    ((OF_NEEDS(needs, (needs).sky_light, TL_SKY_LIGHT) & TL_SKY_MIRRORED) != 0)

#endif
