/* What a scene calls for. On the device these are constants of the build, so that what a scene
 * lacks is compiled out; on the host they are variables of the same names. */
#ifndef TL_NEEDS_H
#define TL_NEEDS_H

#include "dialect.h"
#include "models.h"

typedef struct tl_needs {
    tl_u32 present;      /* planes of the frame, bits 1 << plane */
    tl_u32 falloffs;     /* rows of falloff.h in use, bits 1 << row */
    tl_u32 specular;     /* 1: some light and some material have a specular lobe */
    tl_u32 orthographic; /* 1: parallel rays */
    tl_u32 layout;       /* how pixels are packed: a row of layout.h */
    tl_u32 model;        /* how surfaces reflect: a row of models.h */
    tl_u32 spots;        /* 1: some light has a cone */
    /* 1: the lobe is diffuse light times one number a pixel, for the model tints it, specular colours
     * are grey, and both lobes of every light have one colour */
    tl_u32 one_color;
    tl_u32 ambient; /* 1: there is ambient light */
    /* planes of `present` that change nothing here, bits 1 << plane: they are not read, and have the
     * value that planes.h gives what was not hit */
    tl_u32 idle;
} tl_needs;

#ifdef __OPENCL_C_VERSION__
TL_INLINE tl_needs needs_of_build(void)
{
    const tl_needs needs = {TL_PRESENT, TL_FALLOFFS_USED, TL_SPECULAR, TL_ORTHOGRAPHIC,
                            TL_LAYOUT,  TL_MODEL,         TL_SPOTS,    TL_ONE_COLOR,
                            TL_AMBIENT, TL_IDLE};
    return needs;
}
#endif

/* Whether one of these planes is there and read. */
TL_INLINE int reads_planes(tl_needs needs, tl_u32 planes)
{
    return (needs.present & ~needs.idle & planes) != 0;
}

/* Whether the lobe of the scene's model is multiplied by this. */
TL_INLINE int lobe_has(tl_needs needs, enum tl_lobe_factor factor)
{
#define TL_MODEL_FACTORS(name, word, factors, source) \
    if (needs.model == name)                          \
        return ((factors)&factor) != 0;
    TL_MODELS(TL_MODEL_FACTORS)
#undef TL_MODEL_FACTORS
    return 0;
}

#endif
