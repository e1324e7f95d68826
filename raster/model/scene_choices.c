#include "describe.h"

#include "animation.h"
#include "extensions.h"
#include "tilelight/capture.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* A list of at least one thing, zeroed. */
static tl_status make_list(
    const tl_gltf *gltf, size_t count, size_t size, void **out, tl_error *err)
{
    *out = calloc(count + 1, size);
    return *out ? TL_OK
                : tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for saying what it holds",
                          gltf->path);
}

/* A fault of something that was not asked for is no failure: *out is its sentence, NULL where there was
 * none. Fails with TL_ERR_MEMORY. */
static tl_status keep_refusal(
    tl_status refused, const tl_error *reason, const tl_gltf *gltf, char **out, tl_error *err)
{
    const size_t size = strlen(reason->message) + 1;
    *out = NULL;
    if (refused == TL_OK)
        return TL_OK;
    if (refused == TL_ERR_MEMORY)
        return tl_fail(err, refused, "%s", reason->message);
    *out = malloc(size);
    if (!*out)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for saying what it holds",
                       gltf->path);
    memcpy(*out, reason->message, size);
    return TL_OK;
}

/* --- cameras ----------------------------------------------------------------------------------- */

static tl_scene_camera camera_at(const tl_gltf *gltf, const tl_placed *placed)
{
    const tl_gltf_camera *const from = &gltf->cameras[placed->what];
    const bool is_flat = from->orthographic;
    return (tl_scene_camera){
        .index = (size_t)placed->what,
        .node = placed->node,
        .name = from->name,
        .node_name = gltf->nodes[placed->node].name,
        .projection = is_flat ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE,
        .extent = is_flat ? 2.0 * fabs(from->ymag) : from->vertical_fov,
        .near = from->near,
        .far = from->far == 0.0 && !is_flat ? HUGE_VAL : from->far,
    };
}

static tl_status list_cameras(const tl_model *model, tl_scene_info *out, tl_error *err)
{
    const tl_gltf *const gltf = model->gltf;
    tl_status status = TL_OK;
    bool *is_placed = NULL;
    void *list = NULL;

    TRY(make_list(gltf, model->camera_count, sizeof *out->cameras, &list, err));
    out->cameras = list;
    TRY(make_list(gltf, gltf->camera_count, sizeof *is_placed, &list, err));
    is_placed = list;
    out->unplaced_camera_count = gltf->camera_count;
    for (size_t i = 0; i < model->camera_count; i++) {
        tl_scene_camera *const to = &out->cameras[out->camera_count++];
        tl_camera camera;
        tl_error reason = {0};
        *to = camera_at(gltf, &model->cameras[i]);
        out->unplaced_camera_count -= !is_placed[to->index];
        is_placed[to->index] = true;
        TRY(keep_refusal(tl_model_camera_at(model, &model->cameras[i], TL_DEFAULT_WIDTH,
                                            TL_DEFAULT_HEIGHT, &camera, &reason),
                         &reason, gltf, &to->refusal, err));
    }
done:
    free(is_placed);
    return status;
}

/* --- animations -------------------------------------------------------------------------------- */

static tl_status list_animations(const tl_gltf *gltf, tl_scene_info *out, tl_error *err)
{
    tl_status status = TL_OK;
    void *list = NULL;
    TRY(make_list(gltf, gltf->animation_count, sizeof *out->animations, &list, err));
    out->animations = list;
    for (size_t i = 0; i < gltf->animation_count; i++) {
        tl_scene_animation *const to = &out->animations[out->animation_count++];
        tl_error reason = {0};
        to->name = gltf->animations[i].name;
        to->curve_count = gltf->animations[i].channel_count;
        TRY(keep_refusal(tl_animation_end(gltf, i, &to->seconds, &reason), &reason, gltf,
                         &to->refusal, err));
    }
done:
    return status;
}

/* --- extensions -------------------------------------------------------------------------------- */

/* More than files use; a hostile list is no reason to compare for ever. */
enum { LISTED_AT_MOST = 256 };

static void list_extension(const char *name, bool is_required, tl_scene_info *out)
{
    size_t i = 0;
    while (i < out->extension_count && strcmp(out->extensions[i].name, name) != 0)
        i++;
    if (i == LISTED_AT_MOST)
        return;
    tl_scene_extension *const to = &out->extensions[i];
    if (i == out->extension_count) {
        to->name = name;
        to->fate = tl_gltf_extension_fate(name, &to->effect);
        out->extension_count++;
    }
    to->is_required |= is_required;
}

static tl_status list_extensions(const tl_gltf *gltf, tl_scene_info *out, tl_error *err)
{
    void *list = NULL;
    const tl_status status =
        make_list(gltf, LISTED_AT_MOST, sizeof *out->extensions, &list, err);
    out->extensions = list;
    if (status != TL_OK)
        return status;
    for (size_t i = 0; i < gltf->used_count; i++)
        list_extension(gltf->extensions_used[i], false, out);
    for (size_t i = 0; i < gltf->required_count; i++)
        list_extension(gltf->extensions_required[i], true, out);
    return TL_OK;
}

tl_status tl_list_choices(const tl_model *model, tl_scene_info *out, tl_error *err)
{
    tl_status status = TL_OK;
    out->variants = model->gltf->variants;
    out->variant_count = model->gltf->variant_count;
    TRY(list_cameras(model, out, err));
    TRY(list_animations(model->gltf, out, err));
    TRY(list_extensions(model->gltf, out, err));
done:
    return status;
}
