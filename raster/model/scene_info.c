#include "tilelight/scene_info.h"

#include "describe.h"
#include "parallel.h"
#include "tilelight/capture.h"
#include "try.h"

#include <stdlib.h>

/* An image's header was read with the scene; whether the rest is whole shows when it is
 * decoded. Not all of them at once: that could take gigabytes. */
static tl_status check_images(const tl_model *model, tl_error *err)
{
    const size_t batch = 2 * (size_t)tl_thread_count();
    tl_texels *const texels = calloc(batch, sizeof *texels);
    tl_status status = TL_OK;
    if (!texels)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its images",
                       model->gltf->path);
    for (size_t first = 0; first < model->pixels_count; first += batch) {
        const size_t left = model->pixels_count - first;
        TRY(tl_model_decode(model, first, left < batch ? left : batch, texels, err));
    }
done:
    for (size_t i = 0; i < batch; i++)
        free(texels[i].rgba);
    free(texels);
    return status;
}

static void name_scene(const tl_gltf *gltf, tl_scene_info *out)
{
    out->scene_count = gltf->scene_count;
    out->scene_index = gltf->default_scene == -1 ? 0 : (size_t)gltf->default_scene;
    out->scene_name = gltf->scene_count ? gltf->scenes[out->scene_index].name : "";
}

/* The order is tl_capture's: of several faults both name the same one. */
tl_status tl_scene_describe(const char *path,
                            const tl_notices *notices,
                            tl_scene_info *out,
                            tl_error *err)
{
    const tl_moment at_rest = {0};
    tl_status status = TL_OK;
    tl_scene_info made = {0};
    tl_model *model = NULL;
    tl_camera camera;

    TRY(tl_model_load(path, &at_rest, NULL, notices, &model, err));
    made.source = model;
    TRY(tl_model_lights(model, &made.lights, err));
    TRY(tl_model_camera(model, NULL, TL_DEFAULT_WIDTH, TL_DEFAULT_HEIGHT, NULL, &camera, err));
    TRY(check_images(model, err));
    name_scene(model->gltf, &made);
    made.has_bounds = tl_model_bounds(model, made.low, made.high);
    TRY(tl_count_scene(model, &made, err));
    TRY(tl_list_choices(model, &made, err));

    *out = made;
    made = (tl_scene_info){0};
done:
    tl_scene_info_clear(&made);
    return status;
}

void tl_scene_info_clear(tl_scene_info *info)
{
    for (size_t i = 0; i < info->camera_count && info->cameras; i++)
        free(info->cameras[i].refusal);
    for (size_t i = 0; i < info->animation_count && info->animations; i++)
        free(info->animations[i].refusal);
    free(info->cameras);
    free(info->animations);
    free(info->extensions);
    tl_light_set_clear(&info->lights);
    tl_model_destroy(info->source);
    *info = (tl_scene_info){0};
}
