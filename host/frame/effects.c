#include "tilelight/effects.h"

const tl_effect_row tl_effect_rows[TL_EFFECT_COUNT] = {
#define ROW(name, word, computes, causes, planes, option) \
    [name] = {word, computes, causes, planes, option},
    TL_EFFECTS(ROW)
#undef ROW
};

const tl_cause_row tl_cause_rows[TL_CAUSE_COUNT] = {
#define ROW(name, kind, what) [name] = {kind, what},
    TL_CAUSES(ROW)
#undef ROW
};

uint32_t tl_effects_of(uint32_t causes)
{
    uint32_t on = 0;
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        if ((tl_effect_rows[i].causes & ~causes) == 0)
            on |= 1u << i;
    return on;
}
