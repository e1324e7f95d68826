/* How radiance becomes the codes of a screen, by name: tone curves, transfer curves, dithers; one row each.
 * Formulas: tone.h. Read by the public headers too: constants alone. */
#ifndef TL_TONES_H
#define TL_TONES_H

/* From exposed linear radiance to display-linear [0, 1]. A curve that mixes channels takes all three to say
 * what becomes of one; the others take each by itself.
 * X(name, word on the command line, whether it mixes channels, its function, source) */
#define TL_TONE_CURVES(X)                                                                    \
    X(TL_TONE_ACES, "aces", 0, tone_aces,                                                    \
      "Narkowicz 2015, fit of the ACES reference transform")                                 \
    X(TL_TONE_REINHARD, "reinhard", 0, tone_reinhard,                                        \
      "Reinhard et al. 2002, equation 3: x / (1 + x)")                                       \
    X(TL_TONE_NONE, "none", 0, tone_none, "cut at 1")                                        \
    X(TL_TONE_REINHARD_EXTENDED, "reinhard-extended", 0, tone_reinhard_extended,             \
      "the same, equation 4: white at --white")                                              \
    X(TL_TONE_HABLE, "hable", 0, tone_hable, "Hable 2010, of Uncharted 2: white at 5.6")     \
    X(TL_TONE_ACES_HILL, "aces-hill", 1, tone_aces_hill,                                     \
      "Hill 2016, fit of the ACES reference transform and the output transform of a screen") \
    X(TL_TONE_AGX, "agx", 1, tone_agx, "Sobotka's AgX, fit of Wrensch 2023")                 \
    X(TL_TONE_NEUTRAL, "neutral", 1, tone_neutral,                                           \
      "Khronos PBR Neutral 2024: colours of glTF as they are, up to 0.8")

enum tl_tone_name {
#define TL_TONE_NAME(name, word, mixes, function, source) name,
    TL_TONE_CURVES(TL_TONE_NAME)
#undef TL_TONE_NAME
        TL_TONE_COUNT
};

/* Curves from display-linear [0, 1] to the codes of a PNG, and how what lies between codes is rounded: 0.5
 * to the nearest, 0 down.
 * X(name, word on the command line, rounding, source) */
#define TL_CURVES(X)                                                            \
    X(TL_CURVE_SRGB, "srgb", 0.5, "IEC 61966-2-1, rounded to the nearest code") \
    X(TL_CURVE_GAMMA_22, "gamma-2.2", 0.0,                                      \
      "x^(1/2.2), cut down to a code: that of the "                             \
      "ISPC project's deferred shading example")

enum tl_curve_name {
#define TL_CURVE_NAME(name, word, rounding, source) name,
    TL_CURVES(TL_CURVE_NAME)
#undef TL_CURVE_NAME
        TL_CURVE_COUNT
};

/* What is added before a value is cut to a code, by the place of its pixel alone: the mean over any
 * TL_DITHER_SIDE x TL_DITHER_SIDE pixels is the value. All channels of a pixel have the same: gray stays
 * gray.
 * X(name, word on the command line, source) */
#define TL_DITHERS(X)                                                             \
    X(TL_DITHER_NONE, "none", "what the curve of the codes rounds by")            \
    X(TL_DITHER_ORDERED, "ordered", "Bayer 1973, 8 x 8 pixels: a regular screen") \
    X(TL_DITHER_BLUE_NOISE, "blue-noise",                                         \
      "Ulichney 1993, void and cluster, 64 x 64 pixels: fine grain without a pattern")

enum tl_dither_name {
#define TL_DITHER_NAME(name, word, source) name,
    TL_DITHERS(TL_DITHER_NAME)
#undef TL_DITHER_NAME
        TL_DITHER_COUNT
};

enum { TL_DITHER_SIDE = 64 }; /* px, of what is repeated */

#endif
