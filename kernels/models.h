/* Shading models, by name: one row each. How a light is reflected is light.h's and pixel.h's affair; a
 * row says what it takes of it.
 *
 *   phong                   received = weight (diffuse n.l + specular (n.h)^e). Policarpo and Fonseca,
 *                           "Deferred Shading Tutorial" (2005), equations 1 to 4.
 *   blinn-phong-normalized  received = weight n.l diffuse (1 + specular (e + 2)/8 (n.h)^e). The ISPC
 *                           project's example examples/cpu/deferred, after A. Lauritzen, "Deferred
 *                           Rendering for Current and Future Rendering Pipelines", SIGGRAPH 2010. The
 *                           factor keeps a lobe's energy the same, near enough, whatever its exponent.
 *
 * Read by the public headers too: constants alone. */
#ifndef TL_MODELS_H
#define TL_MODELS_H

/* What the specular lobe is multiplied by, beside weight, light and specular colour. */
enum tl_lobe_factor {
    TL_LOBE_COSINE = 1, /* n.l, as diffuse light is */
    TL_LOBE_ENERGY = 2, /* (exponent + 2)/8 */
    TL_LOBE_DIFFUSE = 4 /* the surface's diffuse colour */
};

/* X(name, word in files, factors of the lobe, source) */
#define TL_MODELS(X)                                                              \
    X(TL_MODEL_PHONG, "phong", 0, "Policarpo and Fonseca 2005, equations 1 to 4") \
    X(TL_MODEL_BLINN_PHONG_NORMALIZED, "blinn-phong-normalized",                  \
      TL_LOBE_COSINE | TL_LOBE_ENERGY | TL_LOBE_DIFFUSE,                          \
      "ISPC, examples/cpu/deferred, after Lauritzen 2010")

#define TL_MODEL_NAME(name, word, factors, source) name,
enum tl_shading_model { TL_MODELS(TL_MODEL_NAME) TL_MODEL_COUNT };
#undef TL_MODEL_NAME

#endif
