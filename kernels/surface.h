/* What lobes take and give: a surface, a light that meets it, and what is reflected. */
#ifndef TL_SURFACE_H
#define TL_SURFACE_H

#include "needs.h"
#include "vec3.h"

/* What every model takes of a pixel. */
typedef struct surface {
    vec3 position, normal, to_eye; /* view space, m; the last two unit, or normal 0 */
    real shininess;
    real lobe_scale; /* with one colour: what the lobe adds, as a share of diffuse light */
} surface;

/* What models other than the plain ones take of it beside that, the same for all lights: finish.h. */
typedef struct finish {
    integer model;    /* a row of models.h; reflects_by is what to ask */
    real n_dot_v;     /* below 0 where the normal is turned from the eye */
    real alpha2;      /* square of the lobe's width: metal-rough, Cook-Torrance */
    real half_alpha2; /* metal-rough */
    real masking;     /* smith_root of n_dot_v: metal-rough */
    real f90;         /* reflectance at grazing angles: metal-rough */
    real flat, bent;  /* A and B: Oren-Nayar */
    real k;           /* Minnaert */
    real per_wide2;   /* 1/alpha^2, of the wider axis: Ward */
    real per_area;    /* 1/(4 ax ay): Ward */
    vec3 sharp;       /* sharp_axis: Ward, where it is anisotropic */
    size_t
        at; /* first pixel of the lanes' block in the planes that are there: for links alone (link.h) */
} finish;

/* A light, as a surface meets it. */
typedef struct meeting {
    vec3 l;                  /* from the surface to the light, m */
    real length, per_length; /* |l|, 1/|l| */
    real cosine;             /* n.l, of unit vectors: 0 to 1, 0 in lanes that are not lit */
    real weight; /* what comes, of what the light's colour says; 0 in lanes that are not lit */
    real arriving; /* weight n.l */
} meeting;

/* What the sums of a pixel receive of a light, before its colours and the surface's. Never negative. */
typedef struct reflection {
    real diffuse, specular;
    real grazing; /* the specular lobe times Schlick's (1 - v.h)^5 */
} reflection;

/* Light received, per lobe: the surface's colours multiply after the last light. */
typedef struct received {
    vec3 diffuse, specular;
    vec3 grazing; /* of no matter where no model in use has Fresnel's reflectance */
    vec3 ambient; /* whatever the normal; of no matter where no light has an ambient lobe */
    vec3
        apart; /* where `diffuse` is of both lobes and terms are split: that of diffuse light alone */
    /* Of the sky (sky_light.h), of no matter where it lights nothing: diffuse light; what is mirrored; and
     * the shares of that which the specular colour multiplies, and Fresnel's rest. */
    vec3 sky, mirrored;
    real mirrored_base, mirrored_grazing;
} received;

TL_INLINE received nothing_received(void)
{
    const vec3 none = {R(0.0), R(0.0), R(0.0)};
    const received sum = {none, none, none, none, none, none, none, R(0.0), R(0.0)};
    return sum;
}

/* Lanes whose model is this one: all or none where all surfaces have one. */
TL_INLINE mask reflects_by(tl_needs needs, integer model, tl_u32 which)
{
    if (has_one_model(needs)) /* a constant */
        return needs.model == which ? EVERY_LANE : NO_LANE;
    return model == (integer)which;
}

/* Lanes whose model is one of these, bits 1 << row. */
TL_INLINE mask reflects_by_one_of(tl_needs needs, integer model, tl_u32 which)
{
    mask lanes = NO_LANE;
#define TL_LANE_IS(name, word, traits, parameters, source) \
    if (needs.models & which & 1u << name)                 \
        lanes = lanes | reflects_by(needs, model, name);
    TL_MODELS(TL_LANE_IS)
#undef TL_LANE_IS
    return lanes;
}

/* Lanes whose model has this. */
TL_INLINE mask lane_has(tl_needs needs, integer model, enum tl_model_trait trait)
{
    mask lanes = NO_LANE;
#define TL_LANE_HAS(name, word, traits, parameters, source)     \
    if ((needs.models >> name & 1u) && ((traits) & (int)trait)) \
        lanes = lanes | reflects_by(needs, model, name);
    TL_MODELS(TL_LANE_HAS)
#undef TL_LANE_HAS
    return lanes;
}

#endif
