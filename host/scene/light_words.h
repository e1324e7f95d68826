/* The words that lights files and sentences have for kinds of lights, skies and surfaces. */
#ifndef TL_LIGHT_WORDS_H
#define TL_LIGHT_WORDS_H

#include "tilelight/lights.h"

extern const char *const tl_light_type_words[TL_LIGHT_TYPE_COUNT];
extern const char *const tl_falloff_words[TL_FALLOFF_COUNT];
extern const char *const tl_profile_scale_words[TL_PROFILE_SCALE_COUNT];
extern const char *const tl_sky_type_words[TL_SKY_COUNT];
extern const char *const tl_model_words[TL_MODEL_COUNT];

#endif
