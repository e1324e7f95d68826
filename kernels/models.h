/* Shading models, by name: one row each. A row says what the model's lobes take; how they reflect stands in
 * kernels/lobe_*.h, one file a model or a family, with the equations.
 *
 *   phong                   received = weight (diffuse n.l + specular (n.h)^e). Policarpo and Fonseca,
 *                           "Deferred Shading Tutorial" (2005), equations 1 to 4.
 *   blinn-phong-normalized  received = weight n.l diffuse (1 + specular (e + 2)/8 (n.h)^e). The ISPC
 *                           project's example examples/cpu/deferred, after A. Lauritzen, "Deferred
 *                           Rendering for Current and Future Rendering Pipelines", SIGGRAPH 2010. The
 *                           factor keeps a lobe's energy the same, near enough, whatever its exponent.
 *   lambert                 received = weight diffuse n.l. Lambert, "Photometria" (1760).
 *
 * Every formula is pi times the reflectance function, so that a white surface that faces 1 lx has the
 * value 1. Read by the public headers too: constants alone. */
#ifndef TL_MODELS_H
#define TL_MODELS_H

/* What a model is made of. The first three are what its specular lobe is multiplied by, beside weight,
 * light and specular colour. PLAIN: diffuse light is n.l, a specular lobe a power of n.h, for which light.h
 * has short code. */
enum tl_model_trait {
    TL_LOBE_COSINE = 1,  /* n.l, as diffuse light is */
    TL_LOBE_ENERGY = 2,  /* (exponent + 2)/8 */
    TL_LOBE_DIFFUSE = 4, /* the surface's diffuse colour */
    TL_LOBE_SPECULAR = 8,
    TL_LOBE_PLAIN = 16
};

/* What a surface may have a model take in place of its pixel's own: bits of tl_brdf.given, and what a row
 * of the table says its model takes. Roughness is 0 to 1, as artists see it: alpha is its square. */
enum tl_brdf_parameter {
    TL_TAKES_DIFFUSE = 1,    /* colour */
    TL_TAKES_SPECULAR = 2,   /* colour; where there is Fresnel's reflectance, that at normal incidence */
    TL_TAKES_EXPONENT = 4,   /* 0 to 10000, of a power of a cosine */
    TL_TAKES_ROUGHNESS = 8,  /* along the direction, where there are two */
    TL_TAKES_ACROSS = 16,    /* roughness across it */
    TL_TAKES_DIRECTION = 32, /* in world space, where a frame has no tangents */
    TL_TAKES_K = 64          /* Minnaert's exponent, 0 and above */
};

/* X(name, word in files, traits, parameters, source) */
#define TL_MODELS(X)                                                                        \
    X(TL_MODEL_PHONG, "phong", TL_LOBE_PLAIN | TL_LOBE_SPECULAR,                            \
      TL_TAKES_DIFFUSE | TL_TAKES_SPECULAR | TL_TAKES_EXPONENT,                             \
      "Policarpo and Fonseca 2005, equations 1 to 4")                                       \
    X(TL_MODEL_BLINN_PHONG_NORMALIZED, "blinn-phong-normalized",                            \
      TL_LOBE_PLAIN | TL_LOBE_SPECULAR | TL_LOBE_COSINE | TL_LOBE_ENERGY | TL_LOBE_DIFFUSE, \
      TL_TAKES_DIFFUSE | TL_TAKES_SPECULAR | TL_TAKES_EXPONENT,                             \
      "ISPC, examples/cpu/deferred, after Lauritzen 2010")                                  \
    X(TL_MODEL_LAMBERT, "lambert", TL_LOBE_PLAIN, TL_TAKES_DIFFUSE, "Lambert 1760")

#define TL_MODEL_NAME(name, word, traits, parameters, source) name,
enum tl_shading_model { TL_MODELS(TL_MODEL_NAME) TL_MODEL_COUNT };
#undef TL_MODEL_NAME

#endif
