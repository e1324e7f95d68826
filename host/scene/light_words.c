#include "light_words.h"

#define WORD(name, word) [name] = word,
const char *const tl_light_type_words[TL_LIGHT_TYPE_COUNT] = {TL_LIGHT_TYPES(WORD)};
const char *const tl_falloff_words[TL_FALLOFF_COUNT] = {TL_FALLOFFS(WORD)};
const char *const tl_profile_scale_words[TL_PROFILE_SCALE_COUNT] = {TL_PROFILE_SCALES(WORD)};
const char *const tl_sky_type_words[TL_SKY_COUNT] = {TL_SKIES(WORD)};

#define MODEL_WORD(name, word, traits, parameters, source) [name] = word,
const char *const tl_model_words[TL_MODEL_COUNT] = {TL_MODELS(MODEL_WORD)};
