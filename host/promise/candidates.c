#include "candidates.h"

#include "falloff.h"

#include <stdio.h>

/* Not double with a cut-off: what a cut-off leaves out is far above the rounding of float, so that would be slower
 * and no closer. */
const tl_candidate tl_candidates[] = {
    {TL_PRECISION_FLOAT, 0.0f},  {TL_PRECISION_FLOAT, 1e-4f},    {TL_PRECISION_FLOAT, 1e-3f},
    {TL_PRECISION_FLOAT, 1e-2f}, {TL_PRECISION_FLOAT, 1e-1f},    {TL_PRECISION_FLOAT, 1.0f},
    {TL_PRECISION_DOUBLE, 0.0f}, {TL_PRECISION_REFERENCE, 0.0f},
};

const uint32_t tl_candidate_count = sizeof tl_candidates / sizeof tl_candidates[0];

void tl_candidate_name(uint32_t candidate, char *text, size_t size)
{
    static const char *const words[TL_PRECISION_COUNT] = {
#define WORD(name, word, meaning) [name] = word,
        TL_PRECISIONS(WORD)
#undef WORD
    };
    const tl_candidate *c = &tl_candidates[candidate];
    const int used = snprintf(text, size, "--precision %s", words[c->precision]);
    if (c->light_cutoff > 0.0f && used >= 0 && (size_t)used < size)
        snprintf(text + used, size - (size_t)used, " --light-cutoff %g",
                 (double)c->light_cutoff);
}

tl_lighting_options tl_candidate_options(uint32_t candidate, const tl_lighting_options *base)
{
    tl_lighting_options options = *base;
    options.precision = tl_candidates[candidate].precision;
    options.light_cutoff = tl_candidates[candidate].light_cutoff;
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

int tl_candidate_suits(uint32_t candidate,
                       const tl_device_info *device,
                       const tl_prepared *prepared)
{
    const tl_candidate *c = &tl_candidates[candidate];
    if (c->precision == TL_PRECISION_DOUBLE && !device->has_double)
        return 0;
    return !(c->light_cutoff > 0.0f) || has_endless_light(prepared);
}
