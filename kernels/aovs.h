/* What the radiance of a pixel is the sum of, each of which may be written as a picture by itself
 * (docs/compositing.md), as renderers write "AOVs". Read by the public headers too: constants alone. */
#ifndef TL_AOVS_H
#define TL_AOVS_H

/* In the order in which they are added.
 * X(name, word in options and files, what it is) */
#define TL_AOVS(X)                                                                 \
    X(TL_AOV_DIFFUSE, "diffuse", "light of lamps that surfaces scatter")           \
    X(TL_AOV_SPECULAR, "specular", "highlights of lamps")                          \
    X(TL_AOV_AMBIENT, "ambient",                                                   \
      "ambient light and ambient lobes, less what is kept "                        \
      "from a surface")                                                            \
    X(TL_AOV_SKY_DIFFUSE, "sky-diffuse", "light of the sky that surfaces scatter") \
    X(TL_AOV_SKY_SPECULAR, "sky-specular", "the sky, as surfaces mirror it")       \
    X(TL_AOV_EMISSIVE, "emissive", "what surfaces send out by themselves")         \
    X(TL_AOV_BACKGROUND, "background", "the sky, where nothing was hit")

#define TL_AOV_NAME(name, word, meaning) name,
enum tl_aov { TL_AOVS(TL_AOV_NAME) TL_AOV_COUNT };
#undef TL_AOV_NAME

#define TL_ALL_AOVS ((1u << TL_AOV_COUNT) - 1u)

/* Of a set of terms, bits 1 << term, those before `term`; planes of the picture and of all of the set, and
 * the first of the three that are a term's own. */
#define TL_AOVS_BEFORE(split, term) ((split) & ((1u << (term)) - 1u))
#ifdef __OPENCL_C_VERSION__
#    define TL_AOVS_IN(split) popcount(split)
#else
#    define TL_AOVS_IN(split) ((unsigned)__builtin_popcount(split))
#endif
#define TL_PICTURE_PLANES(split) (3u + 3u * TL_AOVS_IN(split))
#define TL_AOV_PLANE(split, term) TL_PICTURE_PLANES(TL_AOVS_BEFORE(split, term))

#endif
