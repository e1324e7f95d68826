#include "candidates.h"

#include "falloff.h"

#include <stdio.h>
#include <string.h>

#define BY(power, root, arithmetic)                                                           \
    {                                                                                         \
        {                                                                                     \
            [TL_KNOB_POWER] = power, [TL_KNOB_ROOT] = root, [TL_KNOB_ARITHMETIC] = arithmetic \
        }                                                                                     \
    }

/* As written, and four steps of giving accuracy away; what GPUs have instructions for, whose bounds nobody
 * states, and checks do not ask for any. CPUs have none, and their libraries take longer than we do. */
#define EXACT BY(TL_POWER_POLYNOMIAL, TL_ROOT_EXACT, TL_ARITHMETIC_STRICT)
#define RELAXED BY(TL_POWER_POLYNOMIAL, TL_ROOT_EXACT, TL_ARITHMETIC_RELAXED)
#define CLOSE BY(TL_POWER_DEGREE_5, TL_ROOT_EXACT, TL_ARITHMETIC_RELAXED)
#define ROUGH BY(TL_POWER_DEGREE_3, TL_ROOT_EXACT, TL_ARITHMETIC_RELAXED)
#define ROUGHEST BY(TL_POWER_DEGREE_2, TL_ROOT_NEWTON_1, TL_ARITHMETIC_RELAXED)
#define NATIVE BY(TL_POWER_NATIVE, TL_ROOT_NATIVE, TL_ARITHMETIC_RELAXED)

/* Every row is compiled by a pilot, so there are few. Not double with a cut-off or an approximation: what
 * these leave out is far above the rounding of float, so that would be slower and no closer. */
const tl_candidate tl_candidates[] = {
    {TL_PRECISION_FLOAT, 0.0f, EXACT},    {TL_PRECISION_FLOAT, 0.0f, RELAXED},
    {TL_PRECISION_FLOAT, 0.0f, CLOSE},    {TL_PRECISION_FLOAT, 0.0f, ROUGH},
    {TL_PRECISION_FLOAT, 0.0f, ROUGHEST}, {TL_PRECISION_FLOAT, 0.0f, NATIVE},
    {TL_PRECISION_FLOAT, 1e-4f, EXACT},   {TL_PRECISION_FLOAT, 1e-3f, EXACT},
    {TL_PRECISION_FLOAT, 1e-2f, EXACT},   {TL_PRECISION_FLOAT, 1e-1f, EXACT},
    {TL_PRECISION_FLOAT, 1.0f, EXACT},    {TL_PRECISION_FLOAT, 1e-2f, ROUGH},
    {TL_PRECISION_FLOAT, 1e-1f, ROUGH},   {TL_PRECISION_FLOAT, 1.0f, ROUGH},
    {TL_PRECISION_DOUBLE, 0.0f, EXACT},   {TL_PRECISION_REFERENCE, 0.0f, EXACT},
};

const uint32_t tl_candidate_count = sizeof tl_candidates / sizeof tl_candidates[0];

/* Returns where the text ends. */
static size_t add(char *text, size_t size, size_t used, const char *option, const char *value)
{
    const int count =
        used < size ? snprintf(text + used, size - used, "%s%s", option, value) : 0;
    return used + (count > 0 ? (size_t)count : 0);
}

void tl_candidate_name(uint32_t candidate, char *text, size_t size)
{
    static const char *const words[TL_PRECISION_COUNT] = {
#define WORD(name, word, meaning) [name] = word,
        TL_PRECISIONS(WORD)
#undef WORD
    };
    const tl_candidate *c = &tl_candidates[candidate];
    size_t used = add(text, size, 0, "--precision ", words[c->precision]);
    for (int knob = 0; knob < TL_KNOB_COUNT; knob++)
        if (c->approximations.of[knob] != 0) {
            char option[32];
            snprintf(option, sizeof option, " --%s ", tl_knobs[knob].word);
            used = add(text, size, used, option,
                       tl_knobs[knob].rows[c->approximations.of[knob]].word);
        }
    if (c->light_cutoff > 0.0f) {
        char lux[32];
        snprintf(lux, sizeof lux, "%g", (double)c->light_cutoff);
        add(text, size, used, " --light-cutoff ", lux);
    }
}

tl_lighting_options tl_candidate_options(uint32_t candidate, const tl_lighting_options *base)
{
    tl_lighting_options options = *base;
    options.precision = tl_candidates[candidate].precision;
    options.light_cutoff = tl_candidates[candidate].light_cutoff;
    options.approximations = tl_candidates[candidate].approximations;
    return options;
}

/* A cut-off changes point and spot lights without a range. */
static int has_endless_light(const tl_prepared *prepared)
{
    for (uint32_t i = 0; i < prepared->frame.global_count; i++)
        if (prepared->lights[i].falloff != TL_FADE_NONE)
            return 1;
    return 0;
}

/* Highlights that are powers of a cosine. */
static int has_powers(const tl_prepared *prepared)
{
    const tl_u32 powers = 1u << TL_MODEL_PHONG | 1u << TL_MODEL_BLINN_PHONG_NORMALIZED |
                          1u << TL_MODEL_PHONG_REFLECTION;
    return prepared->needs.specular && (prepared->needs.models & powers) != 0;
}

int tl_candidate_suits(uint32_t candidate,
                       const tl_device_info *device,
                       const tl_prepared *prepared)
{
    const tl_candidate *c = &tl_candidates[candidate];
    if (c->precision == TL_PRECISION_DOUBLE && !device->has_double)
        return 0;
    if (c->approximations.of[TL_KNOB_POWER] == TL_POWER_NATIVE &&
        strcmp(device->kind, "gpu") != 0)
        return 0;
    if (c->approximations.of[TL_KNOB_POWER] != 0 && !has_powers(prepared))
        return 0;
    return !(c->light_cutoff > 0.0f) || has_endless_light(prepared);
}
