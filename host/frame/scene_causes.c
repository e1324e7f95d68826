#include "scene_causes.h"

#include "falloff.h"
#include "shapes.h"
#include "spot_cone.h"

static int is_lit_by(const float color[3])
{
    return color[0] > 0.0f || color[1] > 0.0f || color[2] > 0.0f;
}

static uint64_t causes_of_planes(uint32_t planes)
{
    uint64_t causes = 0;
    if (planes & TL_HAS(TL_SPECULAR_R))
        causes |= TL_BY(TL_CAUSE_GLOSS);
    if (planes & TL_GROUP_OCCLUSION)
        causes |= TL_BY(TL_CAUSE_OCCLUSION);
    if (planes & TL_GROUP_EMISSIVE)
        causes |= TL_BY(TL_CAUSE_EMISSION);
    if (planes & TL_GROUP_TANGENT)
        causes |= TL_BY(TL_CAUSE_TANGENT);
    return causes;
}

/* Metal-rough planes say something where they are neutral too: a smooth dielectric. */
static uint64_t causes_of_material(uint32_t present)
{
    return present & TL_GROUP_METAL_ROUGH ? TL_BY(TL_CAUSE_GLOSS) | TL_BY(TL_CAUSE_METAL_ROUGH)
                                          : 0;
}

/* Of the surfaces' models, and of rows that they have. */
static uint64_t causes_of_rows(const tl_brdf_table *table)
{
    uint64_t causes = table->selects ? TL_BY(TL_CAUSE_ROWS) : 0;
    for (tl_u32 model = 0; model < TL_MODEL_COUNT; model++) {
        if (!(table->models >> model & 1u))
            continue;
        if (model != TL_MODEL_PHONG)
            causes |= TL_BY(TL_CAUSE_MODEL);
        if (traits_of(model) & TL_LOBE_SPECULAR)
            causes |= TL_BY(TL_CAUSE_SHINY);
        if (traits_of(model) & TL_LOBE_WIDTH)
            causes |= TL_BY(TL_CAUSE_WIDTH);
        if (traits_of(model) & TL_LOBE_TANGENT)
            causes |= TL_BY(TL_CAUSE_GRAIN);
        if (traits_of(model) & TL_LOBE_GRAZING)
            causes |= TL_BY(TL_CAUSE_FRESNEL);
    }
    for (int i = 0; i < TL_BRDF_COUNT; i++)
        if (table->occurs[i] && (table->rows[i].given & TL_TAKES_SPECULAR) &&
            is_lit_by(table->rows[i].specular))
            causes |= TL_BY(TL_CAUSE_GLOSS);
    return causes;
}

/* One-colour is no effect to assume: it is another order of rounding. */
static const uint64_t assumable =
    TL_BY(TL_CAUSE_TABLE) | TL_BY(TL_CAUSE_PROJECTED) | TL_BY(TL_CAUSE_AROUND) |
    TL_BY(TL_CAUSE_PROFILE) | TL_BY(TL_CAUSE_AMBIENT_LOBE) | TL_BY(TL_CAUSE_SHADOW) |
    TL_BY(TL_CAUSE_LINK) | TL_BY(TL_CAUSE_DIRECTIONAL) | TL_BY(TL_CAUSE_INVERSE_SQUARE) |
    TL_BY(TL_CAUSE_LINEAR) | TL_BY(TL_CAUSE_LINEAR_FROM) | TL_BY(TL_CAUSE_HIGHLIGHT) |
    TL_BY(TL_CAUSE_CONE) | TL_BY(TL_CAUSE_AMBIENT);

static const tl_cause sky_causes[TL_SKY_COUNT] = {
    [TL_SKY_CONSTANT] = TL_CAUSE_SKY,
    [TL_SKY_GRADIENT] = TL_CAUSE_SKY_GRADIENT,
    [TL_SKY_IMAGE] = TL_CAUSE_SKY_IMAGE,
};

tl_explanation tl_causes_of_frame(const tl_gbuffer *gbuffer,
                                  const tl_light_set *lights,
                                  const tl_brdf_table *table,
                                  tl_effects_mode mode)
{
    tl_explanation e = {.present = gbuffer->present, .neutral = gbuffer->neutral};
    e.causes = causes_of_planes(e.present & ~e.neutral) | causes_of_material(e.present);
    if (mode == TL_EFFECTS_ALL)
        e.assumed = assumable | causes_of_planes(e.present);
    e.is_dark = gbuffer->is_dark && !table->selects;
    if (is_lit_by(lights->ambient) && !e.is_dark)
        e.causes |= TL_BY(TL_CAUSE_AMBIENT);
    if (tl_light_set_is_lit_by_sky(lights) &&
        !e.is_dark) /* what dims ambient light, dims it too */
        e.causes |= TL_BY(TL_CAUSE_SKY_LIGHT) | TL_BY(TL_CAUSE_AMBIENT);
    if (lights->occlusion_radius > 0.0f && !gbuffer->opacity)
        e.causes |= TL_BY(TL_CAUSE_RADIUS);
    if (tl_light_set_has_sky(lights) && !gbuffer->opacity)
        e.causes |= TL_BY(sky_causes[lights->sky_type]);
    if (lights->has_shininess)
        e.causes |= TL_BY(TL_CAUSE_EXPONENT);
    e.causes |= causes_of_rows(table);
    if (gbuffer->camera.projection == TL_ORTHOGRAPHIC)
        e.causes |= TL_BY(TL_CAUSE_PARALLEL);
    if (tl_camera_is_moved(&gbuffer->camera))
        e.causes |= TL_BY(TL_CAUSE_WINDOW);
    return e;
}

static void note(tl_some_lights *some, uint32_t index)
{
    if (some->count++ == 0)
        some->first = index;
}

/* Adding 0 to a sum that is not negative leaves its bits, and no term of a sum is ever negative. */
int tl_light_is_idle(tl_explanation *explanation,
                     const tl_light *from,
                     const tl_view_light *light,
                     const tl_view_spot *spot,
                     uint32_t index,
                     int is_global)
{
    const uint64_t highlights = TL_BY(TL_CAUSE_GLOSS) | TL_BY(TL_CAUSE_SHINY);
    const int has_gloss = (explanation->causes & highlights) == highlights;
    tl_idle_light why;
    const int has_ambient =
        from->ambient > 0.0f && from->intensity > 0.0f && is_lit_by(from->color);
    if (!has_ambient && !is_lit_by(light->diffuse) && !is_lit_by(light->specular))
        why = TL_IDLE_BLACK;
    else if (!is_global && light->range2 == 0.0f)
        why = TL_IDLE_SHORT;
    else if (spot->least_cos > 1.0f)
        why = TL_IDLE_NARROW;
    else if (explanation->is_dark)
        why = TL_IDLE_DARK;
    else if (!has_ambient && !is_lit_by(light->diffuse) && !has_gloss)
        why = TL_IDLE_NO_GLOSS;
    else
        return 0;
    note(&explanation->idle_lights[why], index);
    return 1;
}

/* By rows of falloff.h. */
static const tl_cause falloff_causes[TL_FADE_COUNT] = {
    [TL_FADE_LINEAR] = TL_CAUSE_LINEAR,    [TL_FADE_INVERSE_SQUARE] = TL_CAUSE_INVERSE_SQUARE,
    [TL_FADE_NONE] = TL_CAUSE_DIRECTIONAL, [TL_FADE_LINEAR_FROM] = TL_CAUSE_LINEAR_FROM,
    [TL_FADE_TABLE] = TL_CAUSE_TABLE,
};
static const tl_effect falloff_effects[TL_FADE_COUNT] = {
    [TL_FADE_LINEAR] = TL_EFFECT_LINEAR,    [TL_FADE_INVERSE_SQUARE] = TL_EFFECT_INVERSE_SQUARE,
    [TL_FADE_NONE] = TL_EFFECT_DIRECTIONAL, [TL_FADE_LINEAR_FROM] = TL_EFFECT_LINEAR_FROM,
    [TL_FADE_TABLE] = TL_EFFECT_TABLE,
};

void tl_cause_found(tl_explanation *explanation, tl_cause cause, uint32_t index)
{
    explanation->causes |= TL_BY(cause);
    note(&explanation->lights[cause], index);
}

void tl_causes_of_light(tl_explanation *explanation,
                        const tl_light *from,
                        const tl_view_light *light,
                        uint32_t index,
                        int is_global)
{
    tl_cause_found(explanation, is_global ? TL_CAUSE_GLOBAL : TL_CAUSE_RANGED, index);
    tl_cause_found(explanation, falloff_causes[falloff_row(light->falloff)], index);
    if (is_lit_by(light->specular))
        tl_cause_found(explanation, TL_CAUSE_HIGHLIGHT, index);
    if (tl_spot_has_edge(from))
        tl_cause_found(explanation, TL_CAUSE_CONE, index);
    if (from->texture > 0)
        tl_cause_found(explanation,
                       from->type == TL_LIGHT_SPOT ? TL_CAUSE_PROJECTED : TL_CAUSE_AROUND,
                       index);
    if (from->profile > 0)
        tl_cause_found(explanation, TL_CAUSE_PROFILE, index);
    if (from->ambient > 0.0f) {
        tl_cause_found(explanation, TL_CAUSE_AMBIENT_LOBE, index);
        explanation->causes |= TL_BY(TL_CAUSE_AMBIENT); /* what it dims, occlusion dims too */
    }
}

static int is_on(const tl_explanation *explanation, tl_effect effect)
{
    return (explanation->effects >> effect & 1u) != 0;
}

/* A plane is read by the effects that are on, unless it says nothing. */
static uint32_t idle_planes(const tl_explanation *e)
{
    uint32_t read = TL_GROUP_BASE;
    for (int i = 0; i < TL_EFFECT_COUNT; i++)
        if (is_on(e, (tl_effect)i))
            read |= tl_effect_rows[i].planes;
    if (is_on(e, TL_EFFECT_EXPONENT)) /* in place of what they say */
        read &= ~(TL_HAS(TL_SHININESS) | TL_HAS(TL_ROUGHNESS));
    return e->present & ~(e->assumed ? read : read & ~e->neutral);
}

/* That of all surfaces, where they have one; else the frame's, which those without a row have. */
static tl_u32 model_of(const tl_brdf_table *table)
{
    for (tl_u32 model = 0; model < TL_MODEL_COUNT; model++)
        if (table->models == 1u << model)
            return model;
    return table->rows[0].model;
}

tl_needs tl_needs_of_surfaces(const tl_gbuffer *gbuffer, const tl_brdf_table *table)
{
    return (tl_needs){.present = gbuffer->present,
                      .layout = gbuffer->layout,
                      .model = model_of(table),
                      .models = table->models};
}

static const struct {
    tl_effect effect;
    tl_u32 shape;
} shapes[] = {
    {TL_EFFECT_TABLE, TL_SHAPE_TABLE},    {TL_EFFECT_PROJECTED, TL_SHAPE_PROJECTED},
    {TL_EFFECT_AROUND, TL_SHAPE_AROUND},  {TL_EFFECT_AMBIENT_LOBE, TL_SHAPE_AMBIENT},
    {TL_EFFECT_SHADOWS, TL_SHAPE_SHADOW}, {TL_EFFECT_PROFILES, TL_SHAPE_PROFILE},
    {TL_EFFECT_LINKS, TL_SHAPE_LINK},
};

/* Lights keep their shapes when all of their effects are taken out. */
static tl_u32 shapes_of(const tl_explanation *e)
{
    tl_u32 on = 0, taken_out = 0;
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        on |= is_on(e, shapes[i].effect) ? shapes[i].shape : 0;
        taken_out |= (tl_u32)(e->without >> shapes[i].effect & 1u);
    }
    return on == 0 && taken_out ? TL_SHAPE_BARE : on;
}

/* Of a light set, what is there of each cause: once more where more lights do something. */
static void join_lights(tl_some_lights *some, const tl_some_lights *more)
{
    if (more->count > some->count)
        *some = *more;
}

/* Idle is a light that is so on every surface. */
static void join_idle(tl_some_lights *some, const tl_some_lights *other)
{
    if (other->count < some->count)
        *some = *other;
}

void tl_causes_of_layer(tl_explanation *e, const tl_explanation *layer)
{
    e->causes |= layer->causes;
    e->assumed |= layer->assumed;
    e->effects |= layer->effects;
    e->neutral &= layer->neutral;
    e->idle &= layer->idle;
    e->is_dark &= layer->is_dark;
    for (int i = 0; i < TL_CAUSE_COUNT; i++)
        join_lights(&e->lights[i], &layer->lights[i]);
    for (int i = 0; i < TL_IDLE_LIGHT_COUNT; i++)
        join_idle(&e->idle_lights[i], &layer->idle_lights[i]);
}

void tl_needs_by_causes(tl_explanation *e, tl_needs *needs)
{
    e->effects = tl_effects_of(e->causes | e->assumed) & ~e->without;
    e->idle = idle_planes(e);
    needs->idle = e->idle;
    needs->orthographic = (tl_u32)is_on(e, TL_EFFECT_PARALLEL);
    needs->window = (tl_u32)is_on(e, TL_EFFECT_WINDOW);
    needs->specular = (tl_u32)is_on(e, TL_EFFECT_SPECULAR);
    needs->spots = (tl_u32)is_on(e, TL_EFFECT_SPOTS);
    needs->one_color = (tl_u32)is_on(e, TL_EFFECT_ONE_COLOR);
    needs->ambient = (tl_u32)is_on(e, TL_EFFECT_AMBIENT);
    needs->surroundings = (tl_u32)is_on(e, TL_EFFECT_SURROUNDINGS);
    needs->fixed_exponent = (tl_u32)is_on(e, TL_EFFECT_EXPONENT);
    needs->shapes = shapes_of(e);
    needs->sky = is_on(e, TL_EFFECT_SKY_GRADIENT) ? TL_GRADIENT_SKY
                 : is_on(e, TL_EFFECT_SKY_IMAGE)  ? TL_IMAGE_SKY
                                                  : 0;
    needs->sky_light = (is_on(e, TL_EFFECT_SKY_LIGHT) ? TL_SKY_DIFFUSE : 0u) |
                       (is_on(e, TL_EFFECT_SKY_MIRRORED) ? TL_SKY_MIRRORED : 0u);
    needs->falloffs = 0;
    for (int row = 0; row < TL_FADE_COUNT; row++)
        if (is_on(e, falloff_effects[row]))
            needs->falloffs |= 1u << row;
}
