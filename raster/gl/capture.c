#include "tilelight/capture.h"

#include "blending.h"
#include "geometry_pass.h"
#include "shadow_pass.h"
#include "targets.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>

/* Planes are there where something that is drawn has need of them. */
static uint32_t planes_of(const tl_model *model, bool materials)
{
    uint32_t present = TL_GROUP_BASE | TL_GROUP_METAL_ROUGH;
    if (materials)
        present |= TL_GROUP_BRDF;
    for (size_t i = 0; i < model->draw_count; i++) {
        const tl_part *const part = &model->parts[model->draws[i].part];
        const tl_material *const material = &model->materials[part->material];
        if (materials && model->vertices[part->vertices].attributes[TL_GLTF_TANGENT])
            present |= TL_GROUP_TANGENT;
        if (material->slots[TL_GLTF_OCCLUSION].texture != -1)
            present |= TL_GROUP_OCCLUSION;
        if (material->emits)
            present |= TL_GROUP_EMISSIVE;
    }
    return present;
}

/* Of the square that a pixel's samples make; 0: they make none. */
static uint32_t side_of(const tl_capture_options *options)
{
    return tl_samples_side(options->samples ? options->samples : 1);
}

static tl_status check_samples(const tl_capture_options *options,
                               uint32_t width,
                               uint32_t height,
                               tl_error *err)
{
    const uint32_t side = side_of(options);
    if (side == 0)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "cannot capture %u samples of a pixel: a square number from 1 to %d",
                       options->samples, TL_MAX_SAMPLES);
    if (side * width > TL_MAX_EXTENT || side * height > TL_MAX_EXTENT)
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "cannot capture %u x %u pixels of %u samples: they are a grid of %u x %u, and %d "
            "per side is the most; choose a smaller size or fewer samples",
            width, height, side * side, side * width, side * height, TL_MAX_EXTENT);
    return TL_OK;
}

static tl_status check_options(const tl_capture_options *options, tl_error *err)
{
    if (options->width > TL_MAX_EXTENT || options->height > TL_MAX_EXTENT ||
        !options->width != !options->height)
        return tl_fail(err, TL_ERR_ARGUMENT, "cannot capture %u x %u pixels: 1 to %d per side",
                       options->width, options->height, TL_MAX_EXTENT);
    if (options->anisotropy > TL_MAX_ANISOTROPY)
        return tl_fail(err, TL_ERR_ARGUMENT, "cannot filter with an anisotropy of %u: 1 to %d",
                       options->anisotropy, TL_MAX_ANISOTROPY);
    if (options->layers > TL_MOST_LAYERS)
        return tl_fail(err, TL_ERR_ARGUMENT, "cannot peel %u layers: 0 to %d", options->layers,
                       TL_MOST_LAYERS);
    return TL_OK;
}

/* What of the scene the layout has a place for; metal-rough becomes Phong where it has none for
 * that. */
static uint32_t stored_planes(const tl_model *model,
                              const tl_capture_options *options,
                              const tl_notices *notices)
{
    const enum tl_layout_name layout = options->layout;
    uint32_t found = planes_of(model, options->materials);
    if (!(tl_layout_planes(layout) & TL_GROUP_METAL_ROUGH))
        found = (found & ~TL_GROUP_METAL_ROUGH) | TL_GROUP_PHONG;
    const uint32_t stored = tl_layout_planes_of(layout, found);
    tl_layout_tell_dropped(layout, model->gltf->path, found & ~stored, notices);
    return stored;
}

/* Of an index's 8 bits 0 is none. */
static tl_status check_materials(const tl_model *model, tl_error *err)
{
    if (model->gltf->material_count <= TL_MAX_MATERIALS)
        return TL_OK;
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "%s: has %zu materials; a plane of their indices can tell %d apart: capture "
                   "without materials",
                   model->gltf->path, model->gltf->material_count, TL_MAX_MATERIALS);
}

static tl_status name_materials(const tl_model *model, tl_material_names *out, tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < model->gltf->material_count; i++)
        TRY(tl_material_names_add(out, model->gltf->materials[i].name, err));
done:
    return status;
}

/* Ids of the nodes that are drawn, and their names; those without one are called by their number. */
static tl_status begin_ids(const tl_model *model, tl_gbuffer *gbuffer, tl_error *err)
{
    tl_status status = TL_OK;
    bool *is_drawn = calloc(model->gltf->node_count + 1, sizeof *is_drawn);
    if (!is_drawn)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its objects",
                    model->gltf->path));
    if (tl_target_of_ids(gbuffer->layout, gbuffer->present) < 0)
        TRY(tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "%s: layout %s draws to as many targets as OpenGL has, and leaves none for ids of "
            "objects: capture in another layout and convert",
            model->gltf->path, tl_layout_word(gbuffer->layout)));
    TRY(tl_ids_add(gbuffer, err));
    for (size_t i = 0; i < model->draw_count; i++)
        is_drawn[model->draws[i].node] = true;
    for (size_t i = 0; i < model->gltf->node_count; i++) {
        char number[32];
        snprintf(number, sizeof number, "node %zu", i);
        const char *name = model->gltf->nodes[i].name;
        if (is_drawn[i])
            TRY(tl_objects_add(&gbuffer->objects, (uint32_t)i + 1, name[0] ? name : number,
                               err));
    }
done:
    free(is_drawn);
    return status;
}

static uint32_t layers_of(const tl_capture_options *options)
{
    const uint32_t asked = options->layers ? options->layers : TL_DEFAULT_LAYERS;
    return options->without_layers ? 0 : asked;
}

/* How many more layers there are is not known; whoever asks for more learns it. */
static void tell_of_layers(const tl_model *model,
                           const tl_capture_options *options,
                           const tl_gbuffer *gbuffer,
                           const tl_notices *notices)
{
    if (options->without_layers)
        tl_model_tell_of_blending(model, notices);
    if (gbuffer->layers.left > 0)
        tl_notice(
            notices,
            "%s: %.3g %% of the picture has more surfaces that blend than the nearest %u, "
            "which are kept: ask for more layers",
            model->gltf->path, 100.0 * tl_layers_left_share(gbuffer), layers_of(options));
}

static tl_status render(const tl_model *model,
                        const tl_camera *camera,
                        const tl_capture_options *options,
                        const tl_light_set *lights,
                        tl_gbuffer **out,
                        tl_timings *timings,
                        const tl_notices *notices,
                        tl_error *err)
{
    const enum tl_layout_name layout = options->layout;
    const uint32_t anisotropy =
        options->anisotropy ? options->anisotropy : TL_DEFAULT_ANISOTROPY;
    tl_status status = TL_OK;
    tl_gl *gl = NULL;
    tl_scene_objects objects = {0};
    tl_gbuffer *gbuffer = NULL;

    if (options->materials)
        TRY(check_materials(model, err));
    TRY(tl_gbuffer_create_packed(camera, layout, stored_planes(model, options, notices),
                                 &gbuffer, err));
    if (gbuffer->present & TL_GROUP_BRDF)
        TRY(name_materials(model, &gbuffer->materials, err));
    if (options->ids)
        TRY(begin_ids(model, gbuffer, err));
    gbuffer->samples = side_of(options) * side_of(options);
    TRY(tl_gl_open(&gl, err));
    TRY(tl_upload(gl, model, &objects, timings, err));
    TRY(tl_geometry_pass(gl, model, &objects, anisotropy, layers_of(options), gbuffer, timings,
                         err));
    tell_of_layers(model, options, gbuffer, notices);
    TRY(tl_shadow_plan(model, gbuffer, lights,
                       options->shadow_memory ? options->shadow_memory
                                              : TL_DEFAULT_SHADOW_MEMORY,
                       options->shadow_near, notices, &gbuffer->shadows, err));
    TRY(tl_shadow_pass(gl, model, &objects, anisotropy, gbuffer, timings, err));

    *out = gbuffer;
    gbuffer = NULL;
done:
    tl_gbuffer_destroy(gbuffer);
    tl_scene_objects_clear(&objects);
    tl_gl_close(gl);
    return status;
}

tl_status tl_capture(const char *path,
                     const tl_capture_options *options,
                     tl_gbuffer **out,
                     tl_light_set *lights,
                     tl_timings *timings,
                     const tl_notices *notices,
                     tl_error *err)
{
    const uint32_t width = options->width ? options->width : TL_DEFAULT_WIDTH;
    const uint32_t height = options->height ? options->height : TL_DEFAULT_HEIGHT;
    const tl_moment moment = {options->animation, options->time, options->has_time};
    tl_status status = TL_OK;
    tl_model *model = NULL;
    tl_light_set found = {0};
    tl_camera camera;
    const double clock = tl_seconds();

    TRY(check_options(options, err));
    TRY(check_samples(options, width, height, err));
    TRY(tl_model_load(path, &moment, options->variant, notices, &model, err));
    TRY(tl_model_lights(model, &found, err));
    if (options->change_lights && found.count > 0)
        TRY(options->change_lights(options->change_context, &found, err));
    for (size_t i = 0; options->all_shadows && i < found.count; i++)
        found.lights[i].casts_shadow = 1;
    TRY(tl_model_camera(model, options->camera, width, height, notices, &camera, err));
    tl_timings_end(timings, "load", clock);
    /* The edges are the picture's, whatever its samples. */
    camera.width *= side_of(options);
    camera.height *= side_of(options);
    TRY(render(model, &camera, options,
               options->shadow_lights ? options->shadow_lights : &found, out, timings, notices,
               err));

    tl_light_set_clear(lights);
    *lights = found;
    found = (tl_light_set){0};
done:
    tl_light_set_clear(&found);
    tl_model_destroy(model);
    return status;
}

tl_status tl_capture_describe(char *text, size_t size, tl_error *err)
{
    tl_gl *gl = NULL;
    const tl_status status = tl_gl_open(&gl, err);
    if (status != TL_OK)
        return status;
    snprintf(text, size, "%s, OpenGL %s", (const char *)gl->GetString(GL_RENDERER),
             (const char *)gl->GetString(GL_VERSION));
    tl_gl_close(gl);
    return TL_OK;
}
