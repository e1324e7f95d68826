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

static uint64_t causes_of_lights(void)
{
    uint64_t causes = 0;
    for (int i = 0; i < TL_CAUSE_COUNT; i++)
        if (tl_cause_rows[i].kind == TL_CAUSE_OF_LIGHTS)
            causes |= TL_BY(i);
    return causes;
}

/* Without a cause of lights an effect is called for by no light. */
uint64_t tl_effects_of_light(uint64_t all_causes, uint64_t light_causes)
{
    const uint64_t of_lights = causes_of_lights();
    uint64_t effects = tl_effects_of((all_causes & ~of_lights) | light_causes);
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        if (!(tl_effect_rows[i].causes & of_lights))
            effects &= ~TL_ON(i);
    return effects;
}

bool tl_effect_is_by_tile(tl_effect effect)
{
    static const uint64_t by_tile = TL_ON(TL_EFFECT_RANGED) | TL_ON(TL_EFFECT_SPOTS) |
                                    TL_ON(TL_EFFECT_SPECULAR) | TL_ON(TL_EFFECT_TABLE) |
                                    TL_ON(TL_EFFECT_PROJECTED) | TL_ON(TL_EFFECT_AROUND) |
                                    TL_ON(TL_EFFECT_AMBIENT_LOBE) | TL_ON(TL_EFFECT_SHADOWS) |
                                    TL_ON(TL_EFFECT_PROFILES) | TL_ON(TL_EFFECT_LINKS);
    return (by_tile >> effect & 1u) != 0;
}

#define NO_FALLOFF "its lights would have no falloff"
static const char *const bound_by[TL_EFFECT_COUNT] = {
    [TL_EFFECT_DIRECTIONAL] = NO_FALLOFF,
    [TL_EFFECT_INVERSE_SQUARE] = NO_FALLOFF,
    [TL_EFFECT_LINEAR] = NO_FALLOFF,
    [TL_EFFECT_LINEAR_FROM] = NO_FALLOFF,
    [TL_EFFECT_TABLE] = NO_FALLOFF,
    [TL_EFFECT_METAL_ROUGH] = "surfaces would have no material",
    [TL_EFFECT_EXPONENT] = "the pixels' own would stand in for it",
    [TL_EFFECT_WIDTH] = "its shading model is made of it",
    [TL_EFFECT_FRESNEL] = "its shading model is made of it",
    [TL_EFFECT_MODEL] = "another model would stand in for it",
    [TL_EFFECT_ONE_COLOR] = "two sums would stand in for one",
    [TL_EFFECT_SKY] = "black is a colour too",
    [TL_EFFECT_TRANSLUCENCY] = "its layers are frames of their own; --layers lights fewer",
    [TL_EFFECT_PARALLEL] = "other rays would stand in for it",
    [TL_EFFECT_WINDOW] = "rays of another part would stand in for its own",
};

const char *tl_effect_bound(tl_effect effect)
{
    return bound_by[effect];
}

uint64_t tl_effects_of(uint64_t causes)
{
    uint64_t on = 0;
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        if ((tl_effect_rows[i].causes & ~causes) == 0)
            on |= TL_ON(i);
    return on;
}
