#include "plan.h"

#include "try.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The capture, and one a map's file. */
enum { MAX_SOURCES = TL_MAX_MAPS + 1 };

static tl_status open_source(tl_import_plan *plan,
                             const char *path,
                             uint32_t *index,
                             tl_error *err)
{
    tl_status status = TL_OK;
    for (uint32_t i = 0; i < plan->source_count; i++)
        if (strcmp(plan->sources[i].path, path) == 0) {
            *index = i;
            return TL_OK;
        }
    TRY(tl_source_open(&plan->sources[plan->source_count], path, err));
    *index = plan->source_count++;
done:
    return status;
}

static tl_status bind_map(tl_import_plan *plan, const tl_import_map *map, tl_error *err)
{
    tl_status status = TL_OK;
    tl_binding *binding = &plan->bindings[map->plane];
    const char *word = tl_import_kinds[map->plane].word;
    uint32_t source = 0;
    if (binding->is_bound)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "--map: \"%s\" is given twice", word));
    if (map->file[0])
        TRY(open_source(plan, map->file, &source, err));
    else if (!plan->has_capture)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "--map %s: names no file, and no capture is given; write %s=FILE:CHANNELS",
                    word, word));
    binding->source = source;
    TRY(tl_map_find(&plan->sources[source], map, binding, err));
done:
    return status;
}

/* What maps leave open is found in the capture. */
static void bind_aliases(tl_import_plan *plan)
{
    for (tl_import_plane p = 0; p < TL_IMPORT_COUNT && plan->has_capture; p++)
        if (!plan->bindings[p].is_bound)
            tl_alias_find(&plan->sources[0], p, &plan->bindings[p]);
}

const tl_source_part *tl_import_part(const tl_import_plan *plan, tl_import_plane plane)
{
    const tl_binding *b = &plan->bindings[plane];
    const tl_source *source = &plan->sources[b->source];
    return &source->parts[source->channels[b->channels[0]].part];
}

static bool is_bound(const tl_import_plan *plan, tl_import_plane plane)
{
    return plan->bindings[plane].is_bound;
}

/* The part that says how large the frame is: that of the depth, or of the first plane found. */
static const tl_source_part *leading_part(const tl_import_plan *plan, const char **path)
{
    for (tl_import_plane p = 0; p < TL_IMPORT_COUNT; p++)
        if (is_bound(plan, p)) {
            *path = plan->sources[plan->bindings[p].source].path;
            return tl_import_part(plan, p);
        }
    return NULL;
}

static tl_status find_frame(tl_import_plan *plan, tl_error *err)
{
    const char *path = NULL;
    const tl_source_part *lead = leading_part(plan, &path);
    plan->pixel_aspect = 1.0;
    if (!lead)
        return TL_OK;
    plan->width = lead->width;
    plan->height = lead->height;
    for (tl_import_plane p = 0; p < TL_IMPORT_COUNT; p++) {
        if (!is_bound(plan, p))
            continue;
        const tl_source_part *part = tl_import_part(plan, p);
        if (part->width != plan->width || part->height != plan->height)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: \"%s\" is %u x %u pixels, and %s is %u x %u; planes must be of "
                           "one size",
                           plan->sources[plan->bindings[p].source].path,
                           tl_import_kinds[p].word, part->width, part->height, path,
                           plan->width, plan->height);
    }
    if (lead->exr.stream) {
        const exr_attribute_t *a = tl_exr_part_attribute(&lead->exr, "pixelAspectRatio");
        if (a && a->type == EXR_ATTR_FLOAT)
            plan->pixel_aspect = (double)a->f;
        if (!(plan->pixel_aspect > 1e-3) || !(plan->pixel_aspect < 1e3))
            return tl_fail(err, TL_ERR_FORMAT, "%s: its pixels are %g times as wide as high",
                           path, plan->pixel_aspect);
    }
    return TL_OK;
}

/* The planes of the G-buffer, of what was bound; tells what is of no use alone. */
static uint32_t find_present(const tl_import_plan *plan, const tl_notices *notices)
{
    uint32_t present = TL_GROUP_BASE;
    const bool specular = is_bound(plan, TL_IMPORT_SPECULAR);
    const bool exponent = is_bound(plan, TL_IMPORT_SHININESS);
    const bool metallic = is_bound(plan, TL_IMPORT_METALLIC);
    const bool roughness = is_bound(plan, TL_IMPORT_ROUGHNESS);
    if (specular && (exponent || roughness) && !(metallic && roughness)) {
        present |= TL_GROUP_PHONG;
        if (!exponent)
            tl_notice(notices, "shininess is 2/alpha^2 - 2, alpha the square of roughness");
    } else if (roughness) {
        present |= TL_GROUP_METAL_ROUGH;
        if (!metallic)
            tl_notice(notices, "no metallic: taken as 0 everywhere");
    }
    if (specular && !(present & TL_GROUP_PHONG))
        tl_notice(notices, "specular is ignored: %s",
                  roughness ? "metallic and roughness say it"
                            : "nothing says how sharp it is; --map shininess or roughness");
    if (metallic && !roughness)
        tl_notice(notices, "metallic is ignored without roughness");
    if (is_bound(plan, TL_IMPORT_OCCLUSION))
        present |= TL_GROUP_OCCLUSION;
    if (is_bound(plan, TL_IMPORT_EMISSIVE))
        present |= TL_GROUP_EMISSIVE;
    if (is_bound(plan, TL_IMPORT_BRDF))
        present |= TL_GROUP_BRDF;
    if (is_bound(plan, TL_IMPORT_TANGENT))
        present |= TL_GROUP_TANGENT;
    return present;
}

/* The refusal of a part of the capture, or NULL. */
static const char *first_refusal(const tl_import_plan *plan, bool *is_all)
{
    const char *first = NULL;
    *is_all = plan->has_capture;
    for (uint32_t p = 0; plan->has_capture && p < plan->sources[0].part_count; p++) {
        const char *refusal = plan->sources[0].parts[p].refusal;
        if (!refusal[0])
            *is_all = false;
        else if (!first)
            first = refusal;
    }
    return first;
}

/* Parts that could not be read may hold what is missing. */
static void say_missing(tl_import_plan *plan)
{
    const char *name = plan->source_count > 0 ? plan->sources[0].path : "";
    const bool depth = is_bound(plan, TL_IMPORT_DEPTH) || is_bound(plan, TL_IMPORT_POSITION);
    const bool normal = is_bound(plan, TL_IMPORT_NORMAL);
    bool is_all;
    const char *refusal = first_refusal(plan, &is_all);
    plan->missing[0] = '\0';
    if ((!depth || !normal) && !plan->has_capture)
        snprintf(plan->missing, sizeof plan->missing,
                 "no --map names %s, and no capture is given that could hold it; add --map "
                 "%s=FILE:CHANNELS",
                 depth ? "normals" : "depth", depth ? "normal" : "depth");
    else if ((!depth || !normal) && is_all)
        snprintf(plan->missing, sizeof plan->missing, "%s", refusal);
    else if (!depth || !normal)
        snprintf(plan->missing, sizeof plan->missing,
                 "%.300s: no channel of a known name holds %s; --map tells which do, and "
                 "`tilelight info' lists them%s%.400s%s",
                 name,
                 depth    ? "normals"
                 : normal ? "depth"
                          : "depth or normals",
                 refusal ? " (not read: " : "", refusal ? refusal : "", refusal ? ")" : "");
    else if (plan->camera.missing[0])
        snprintf(plan->missing, sizeof plan->missing, "%.200s: %.800s", name,
                 plan->camera.missing);
}

tl_status tl_import_plan_open(tl_import_plan *plan,
                              const char *path,
                              const tl_import_options *options,
                              const tl_notices *notices,
                              tl_error *err)
{
    tl_status status = TL_OK;
    uint32_t first;
    *plan = (tl_import_plan){.options = options, .has_capture = path != NULL};
    plan->sources = calloc(MAX_SOURCES, sizeof *plan->sources);
    if (!plan->sources)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the files of a capture"));
    if (path)
        TRY(open_source(plan, path, &first, err));
    for (size_t i = 0; i < options->map_count; i++)
        TRY(bind_map(plan, &options->maps[i], err));
    bind_aliases(plan);
    TRY(find_frame(plan, err));
    if (plan->width > 0)
        TRY(tl_import_find_camera(plan, notices, err));
    plan->present = find_present(plan, notices);
    say_missing(plan);
done:
    if (status != TL_OK)
        tl_import_plan_close(plan);
    return status;
}

void tl_import_plan_close(tl_import_plan *plan)
{
    for (uint32_t i = 0; i < plan->source_count; i++)
        tl_source_close(&plan->sources[i]);
    free(plan->sources);
    *plan = (tl_import_plan){.options = NULL};
}
