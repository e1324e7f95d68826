#include "model.h"

#include "loading.h"
#include "lookup.h"
#include "try.h"
#include "variants.h"

#include <stdlib.h>

tl_status tl_model_load(const char *path,
                        const tl_moment *moment,
                        const char *variant,
                        const tl_notices *notices,
                        tl_model **out,
                        tl_error *err)
{
    tl_status status = TL_OK;
    tl_pose pose = {0};
    tl_placements placements = {0};
    tl_model *made = calloc(1, sizeof *made);

    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", path);
    TRY(tl_gltf_open(path, notices, &made->gltf, err));
    TRY(tl_animation_pose(made->gltf, moment, notices, &pose, err));
    TRY(tl_find_variant(made->gltf, variant, &made->variant, err));
    TRY(tl_load_nodes(made, &pose, notices, &placements, err));
    TRY(tl_load_instances(made, &placements, err));
    TRY(tl_load_geometry(made, &pose, &placements, notices, err));
    TRY(tl_load_materials(made, notices, err));
    TRY(tl_load_tangents(made, err));
    TRY(tl_load_skins(made, &placements, err));

    *out = made;
    made = NULL;
done:
    tl_pose_clear(&pose);
    tl_placements_clear(&placements);
    tl_model_destroy(made);
    return status;
}

void tl_model_destroy(tl_model *model)
{
    if (!model)
        return;
    for (size_t i = 0; i < model->vertices_count; i++)
        tl_vertices_clear(&model->vertices[i]);
    for (size_t i = 0; i < model->part_count; i++)
        free(model->parts[i].indices);
    free(model->vertices);
    free(model->parts);
    free(model->draws);
    free(model->cameras);
    free(model->lights);
    free(model->materials);
    free(model->textures);
    free(model->pixels);
    tl_gltf_close(model->gltf);
    free(model);
}
