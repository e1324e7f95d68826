#include "prepared.h"

#include "brdf_table.h"
#include "falloff.h"
#include "largest.h"
#include "layout.h"
#include "links.h"
#include "map.h"
#include "ranges.h"
#include "scene_causes.h"
#include "sections.h"
#include "shadow_sections.h"
#include "shapes.h"
#include "sky_light_section.h"
#include "spot_cone.h"
#include "surroundings.h"
#include "tile_choices.h"
#include "try.h"
#include "view.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t box_granule = 16; /* the widest vector of tiles */

static float finite_square(double x)
{
    const double square = x * x;
    return square < (double)FLT_MAX ? (float)square : FLT_MAX;
}

static float finite_reciprocal(double x)
{
    return x > 1.0 / (double)FLT_MAX ? (float)(1.0 / x) : 0.0f;
}

static tl_view_light common(const tl_light_set *set, const tl_light *light, tl_u32 falloff)
{
    tl_view_light v = {.falloff = falloff};
    tl_lobe_color(set, light, light->diffuse, v.diffuse);
    tl_lobe_color(set, light, light->specular, v.specular);
    return v;
}

static tl_view_light directional(const tl_camera *camera,
                                 const tl_light_set *set,
                                 const tl_light *light)
{
    tl_view_light v = common(set, light, TL_FADE_NONE);
    tl_against_rays(camera, light, v.position);
    return v;
}

/* Where the light gives less than `cutoff` (lx) on a surface that faces it. */
static double cutoff_range(const tl_light_set *set, const tl_light *light, float cutoff)
{
    double most = 0.0;
    for (int i = 0; i < 3; i++)
        most = light->color[i] > (float)most ? (double)light->color[i] : most;
    return sqrt(most * tl_light_candela(set, light) / (double)cutoff);
}

/* Between begin and range, kernels/falloff.h's linear-from. Its offset is 2^24 at most, for both are
 * floats; a fade beyond floats is a step, as where they are the same. */
static void fade_from(const tl_light *light, tl_view_light *v)
{
    const double range = (double)light->range, width = range - (double)light->begin;
    const int is_step = !(width > 1.0 / (double)FLT_MAX);
    const float offset = is_step ? 1.0f : (float)(range / width);
    v->fade = is_step ? 0.0f : (float)(1.0 / width);
    memcpy(&v->falloff, &offset, sizeof v->falloff);
}

static const tl_u32 falloff_rows[TL_FALLOFF_COUNT] = {
    [TL_FALLOFF_INVERSE_SQUARE] = TL_FADE_INVERSE_SQUARE,
    [TL_FALLOFF_LINEAR] = TL_FADE_LINEAR,
    [TL_FALLOFF_TABLE] = TL_FADE_TABLE,
};

/* What a light with this range fades by, but for a linear falloff that begins later. */
static float fade_of(const tl_light_set *set, const tl_light *light)
{
    const double range = (double)light->range;
    if (light->falloff == TL_FALLOFF_TABLE)
        return finite_reciprocal(range / (set->tables[light->table - 1].count - 1));
    return finite_reciprocal(light->falloff == TL_FALLOFF_LINEAR ? range : range * range);
}

static tl_view_light point(const tl_camera *camera,
                           const tl_light_set *set,
                           const tl_light *light,
                           float cutoff)
{
    tl_view_light v = common(set, light, falloff_rows[light->falloff]);
    double world[3], view[3];
    for (int i = 0; i < 3; i++)
        world[i] = (double)light->position[i];
    tl_camera_view_point(camera, world, view);
    for (int i = 0; i < 3; i++)
        v.position[i] = (float)view[i];
    if (!isinf(light->range)) {
        v.range2 = finite_square((double)light->range);
        v.fade = fade_of(set, light);
        if (light->falloff == TL_FALLOFF_LINEAR && light->begin > 0.0f)
            fade_from(light, &v);
    } else if (cutoff > 0.0f) {
        v.range2 = finite_square(cutoff_range(set, light, cutoff));
    }
    return v;
}

static int is_global(const tl_light *light, float cutoff)
{
    return light->type == TL_LIGHT_DIRECTIONAL || (isinf(light->range) && !(cutoff > 0.0f));
}

/* tl_needs.one_color. */
static int has_one_color(const tl_prepared *prepared)
{
    const tl_needs *needs = &prepared->needs;
    if (reads_planes(*needs, TL_GROUP_BRDF) || !needs->specular ||
        !lobe_has(*needs, TL_LOBE_DIFFUSE) || !lobe_has(*needs, TL_LOBE_COSINE) ||
        tl_layouts[needs->layout].specular.code != TL_COLOR_GRAY ||
        !(needs->present & TL_GROUP_PHONG))
        return 0;
    return prepared->two_colored_count == 0;
}

static int has_two_colors(const tl_view_light *light)
{
    return memcmp(light->diffuse, light->specular, sizeof light->diffuse) != 0;
}

/* The largest number among its colours. */
static double brightness_of(const tl_light_set *set,
                            const tl_light *light,
                            const tl_view_light *v)
{
    float ambient[3], most = 0.0f;
    tl_lobe_color(set, light, light->ambient, ambient);
    for (int i = 0; i < 3; i++)
        most = fmaxf(most, fmaxf(ambient[i], fmaxf(v->diffuse[i], v->specular[i])));
    return (double)most;
}

/* Light `source` of the set, unless it adds nothing. */
static void add(const tl_gbuffer *gbuffer,
                const tl_light_set *set,
                uint32_t source,
                const tl_prepare_options *options,
                tl_prepared *prepared)
{
    const tl_camera *camera = &gbuffer->camera;
    tl_explanation *explanation = &prepared->explanation;
    const tl_light *light = &set->lights[source];
    const int global = is_global(light, options->light_cutoff);
    const tl_view_light v = light->type == TL_LIGHT_DIRECTIONAL
                                ? directional(camera, set, light)
                                : point(camera, set, light, options->light_cutoff);
    const tl_view_spot spot = tl_spot_cone(camera, light);
    const int is_idle = tl_light_is_idle(explanation, light, &v, &spot, source, global);
    if (is_idle && options->effects != TL_EFFECTS_ALL)
        return;
    const uint64_t before = explanation->causes;
    explanation->causes = 0;
    tl_causes_of_light(explanation, light, &v, source, global);
    if (tl_shadow_of(gbuffer, light))
        tl_cause_found(explanation, TL_CAUSE_SHADOW, source);
    if (light->link > 0)
        tl_cause_found(explanation, TL_CAUSE_LINK, source);
    prepared->two_colored_count += !is_idle && has_two_colors(&v);
    tl_choices_note(prepared, &v, &spot, tl_light_has_shape(gbuffer, light));
    if (options->lit && !options->lit[source]) {
        explanation->causes |= before;
        return;
    }
    const uint32_t i = prepared->frame.light_count++;
    prepared->sources[i] = source;
    prepared->light_causes[i] = explanation->causes;
    explanation->causes |= before;
    prepared->lights[i] = v;
    prepared->brightness += brightness_of(set, light, &v);
    prepared->spots[i] = spot;
}

/* Lights in the order of the set, first the global ones, then the others. */
static void collect(const tl_gbuffer *gbuffer,
                    const tl_light_set *lights,
                    const tl_prepare_options *options,
                    int global,
                    tl_prepared *prepared)
{
    for (size_t i = 0; i < lights->count; i++)
        if (is_global(&lights->lights[i], options->light_cutoff) == global)
            add(gbuffer, lights, (uint32_t)i, options, prepared);
    if (global)
        prepared->frame.global_count = prepared->frame.light_count;
}

/* The cones directly behind the lights, however few of the set's there are. */
static void close_up(tl_prepared *prepared)
{
    const uint32_t count = prepared->frame.light_count;
    tl_view_spot *behind = (tl_view_spot *)(prepared->lights + count);
    if (count > 0)
        memmove(behind, prepared->spots, count * sizeof *behind);
    prepared->spots = behind;
}

static void name_empty_cones(const tl_light_set *lights, const tl_notices *notices)
{
    char names[512] = "";
    size_t length = 0, count = 0;
    for (size_t i = 0; i < lights->count; i++) {
        const tl_light *light = &lights->lights[i];
        if (!tl_spot_is_empty(light))
            continue;
        count++;
        if (length >= sizeof names - 80)
            continue;
        if (length > 0)
            length += (size_t)snprintf(names + length, sizeof names - length, ", ");
        length +=
            light->name[0]
                ? (size_t)snprintf(names + length, sizeof names - length, "%s", light->name)
                : (size_t)snprintf(names + length, sizeof names - length, "lights[%zu]", i);
    }
    if (count > 0)
        tl_notice(notices, "%zu spot light%s nothing, the outer cone being too narrow: %s%s",
                  count, count == 1 ? " lights" : "s light", names,
                  length >= sizeof names - 80 ? ", ..." : "");
}

static tl_frame frame_of(const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         const tl_prepare_options *options)
{
    const tl_camera *camera = &gbuffer->camera;
    const uint32_t tile_size = options->tile_size;
    tl_frame frame = {.tile_size = tile_size,
                      .box_count = options->box_count,
                      .pitch = gbuffer->pitch,
                      .rows = gbuffer->rows,
                      .tiles_x = (camera->width + tile_size - 1) / tile_size,
                      .tiles_y = (camera->height + tile_size - 1) / tile_size};
    frame.box_pitch = (frame.tiles_x + box_granule - 1) / box_granule * box_granule;
    tl_view_set(camera, gbuffer->layout, &frame);
    frame.slack_x = gbuffer->slack_x;
    frame.slack_y = gbuffer->slack_y;
    frame.exponent = lights->has_shininess ? lights->shininess : 0.0f;
    memcpy(frame.ambient, lights->ambient, sizeof frame.ambient);
    frame.is_layer = gbuffer->opacity != NULL;
    if (!frame.is_layer) /* behind a layer is no sky of its own */
        memcpy(frame.sky, lights->sky, sizeof frame.sky);
    return frame;
}

/* Room for one at least: what stands behind the lights needs a place even where there are none. */
static tl_status reserve_lights(tl_prepared *prepared, size_t wanted, tl_error *err)
{
    const size_t count = wanted > 0 ? wanted : 1;
    if (count > INT32_MAX)
        return tl_fail(err, TL_ERR_ARGUMENT, "%zu lights: at most 2^31 are lit", count);
    if (count <= prepared->capacity)
        return TL_OK;
    uint32_t *sources = realloc(prepared->sources, count * sizeof *sources);
    if (!sources)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu lights", count);
    prepared->sources = sources;
    uint64_t *causes = realloc(prepared->light_causes, count * sizeof *causes);
    if (!causes)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu lights", count);
    prepared->light_causes = causes;
    const tl_status status = tl_sections_reserve(prepared, count * TL_LIGHT_AND_CONE, err);
    if (status == TL_OK)
        prepared->capacity = count;
    return status;
}

static tl_status add_rows(tl_prepared *prepared, const tl_brdf_table *table, tl_error *err)
{
    void *rows = NULL;
    const tl_status status =
        tl_section_add(prepared, sizeof table->rows, &prepared->frame.brdfs_at, &rows, err);
    if (status != TL_OK)
        return status;
    memcpy(rows, table->rows, sizeof table->rows);
    return TL_OK;
}

/* Where materials are given and select nothing, though nothing is wrong. */
static void tell_of_rows(const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         const tl_brdf_table *table,
                         const tl_notices *notices)
{
    if (lights->material_count == 0 || table->selects)
        return;
    if (gbuffer->present & TL_GROUP_BRDF)
        tl_notice(notices, "no surface has an index that the lights' materials are for");
    else
        tl_notice(
            notices,
            "the lights' materials are for nothing: the capture has no plane brdf; capture "
            "it with --materials");
}

/* Lights of the frame that ask for what the capture lacks; those that give nothing are none of it. */
static void tell_of_shadows(const tl_gbuffer *gbuffer,
                            const tl_light_set *lights,
                            const tl_prepared *prepared,
                            const tl_notices *notices)
{
    size_t count = 0;
    for (uint32_t i = 0; i < prepared->frame.light_count; i++) {
        const tl_light *light = &lights->lights[prepared->sources[i]];
        count += light->casts_shadow && !tl_shadow_of(gbuffer, light);
    }
    if (count > 0)
        tl_notice(notices,
                  "%zu light%s without the shadow%s asked for, for the capture has no map of "
                  "%s: capture the scene with --shadows, or with these lights",
                  count, count == 1 ? " is lit" : "s are lit", count == 1 ? "" : "s",
                  count == 1 ? "it" : "them");
}

static void tell_of_occlusion(const tl_light_set *lights,
                              const tl_needs *needs,
                              const tl_notices *notices)
{
    if (lights->occlusion_radius > 0.0f && !needs->surroundings)
        tl_notice(notices,
                  "ambient occlusion is for nothing: there is no ambient light to keep "
                  "from surfaces; \"ambient\" of the lights file brings some");
}

tl_status tl_prepare(const tl_gbuffer *gbuffer,
                     const tl_light_set *lights,
                     const tl_prepare_options *options,
                     const tl_notices *notices,
                     tl_prepared *prepared,
                     tl_error *err)
{
    tl_status status = TL_OK;
    tl_brdf_table table;
    TRY(tl_brdf_table_make(gbuffer, lights, &table, err));
    TRY(reserve_lights(prepared, lights->count, err));
    TRY(tl_maps_begin(lights, prepared, err));
    prepared->frame = frame_of(gbuffer, lights, options);
    prepared->rows = NULL;
    prepared->explanation = tl_causes_of_frame(gbuffer, lights, &table, options->effects);
    if (options->layers > 0 && gbuffer->layers.count > 0)
        prepared->explanation.causes |= TL_BY(TL_CAUSE_BLENDED);
    prepared->explanation.without = options->without;
    prepared->two_colored_count = 0;
    prepared->some_call = 0;
    prepared->all_call = ~0u;
    prepared->brightest_texel = 1.0f;
    prepared->brightness = 0.0;
    prepared->sections_size = 0;
    prepared->planes_size = 0;
    prepared->spots = (tl_view_spot *)(prepared->lights + lights->count);
    collect(gbuffer, lights, options, 1, prepared);
    collect(gbuffer, lights, options, 0, prepared);
    close_up(prepared);
    TRY(tl_shapes_add(gbuffer, lights,
                      options->shadow_filter ? options->shadow_filter
                                             : TL_DEFAULT_SHADOW_FILTER,
                      prepared, err));
    TRY(tl_links_add(gbuffer, lights, prepared, err));
    if (!gbuffer->opacity)
        TRY(tl_sky_add(&gbuffer->camera, lights, prepared, err));
    prepared->may_be_cut =
        prepared->brightness * (double)prepared->brightest_texel * TL_MOST_OF_LIGHT >
        0.5 * (double)TL_MOST_FLOAT;
    prepared->needs = tl_needs_of_surfaces(gbuffer, &table);
    prepared->needs.split = options->split;
    tl_needs_by_causes(&prepared->explanation, &prepared->needs);
    if (has_one_color(prepared)) {
        prepared->explanation.causes |= TL_BY(TL_CAUSE_ONE_COLOR);
        tl_needs_by_causes(&prepared->explanation, &prepared->needs);
    }
    if (prepared->explanation.causes & TL_BY(TL_CAUSE_SKY_LIGHT))
        TRY(tl_sky_light_add(&gbuffer->camera, lights, prepared, err));
    if (reads_planes(prepared->needs, TL_GROUP_BRDF))
        TRY(add_rows(prepared, &table, err));
    name_empty_cones(lights, notices);
    tell_of_rows(gbuffer, lights, &table, notices);
    tell_of_shadows(gbuffer, lights, prepared, notices);
    tell_of_occlusion(lights, &prepared->needs, notices);
    if (options->effects != TL_EFFECTS_ALL)
        TRY(tl_choices_open(prepared, err));
    if (prepared->needs.surroundings)
        TRY(tl_surroundings_add(gbuffer, lights, options->occlusion_samples, prepared, err));
    /* Sections may have moved while others were added. */
    if (reads_planes(prepared->needs, TL_GROUP_BRDF))
        prepared->rows = tl_section_at(prepared, prepared->frame.brdfs_at);
done:
    return status;
}

size_t tl_prepared_lights_size(const tl_prepared *prepared)
{
    const size_t count = prepared->frame.light_count;
    if (prepared->sections_size > 0)
        return count * TL_LIGHT_AND_CONE + prepared->sections_size;
    return count * (prepared->needs.spots ? TL_LIGHT_AND_CONE : sizeof(tl_view_light));
}

size_t tl_prepared_buffer_size(const tl_prepared *prepared)
{
    return tl_prepared_lights_size(prepared) + prepared->planes_size;
}

void tl_prepared_clear(tl_prepared *prepared)
{
    tl_sky_map_release(prepared->sky_map);
    free(prepared->images_at);
    free(prepared->sources);
    free(prepared->light_causes);
    free(prepared->lights);
    *prepared = (tl_prepared){0};
}
