/* glTF scenes: does any file do more than be refused, and is what goes to OpenGL what it takes: numbers that
 * are finite, indices of what is there? Files of odd length are looked at in the middle of their
 * animation. */
#include "fuzz.h"
#include "model.h"

#include "tilelight/scene_info.h"

#include <math.h>

static void must_be_finite(const float *values, size_t count, const char *what)
{
    for (size_t i = 0; values && i < count; i++)
        fuzz_must(isfinite(values[i]), "%s: number %zu is %g", what, i, (double)values[i]);
}

static void check_part(const tl_model *model, const tl_part *part)
{
    if (part->index_count == 0)
        return;
    fuzz_must(part->vertices < model->vertices_count && part->material < model->material_count,
              "vertices %zu, material %zu", part->vertices, part->material);
    const tl_vertices *const of = &model->vertices[part->vertices];
    fuzz_must(part->index_count % 3 == 0, "%zu indices", part->index_count);
    for (size_t i = 0; i < part->index_count; i++)
        fuzz_must(part->indices[i] < of->count, "index %u of %zu vertices", part->indices[i],
                  of->count);
    must_be_finite(of->attributes[TL_GLTF_POSITION], 3 * of->count, "positions");
    must_be_finite(of->attributes[TL_GLTF_NORMAL], 3 * of->count, "normals");
    must_be_finite(of->attributes[TL_GLTF_TANGENT], 4 * of->count, "tangents");
}

static void check_material(const tl_model *model, const tl_material *material)
{
    must_be_finite(material->base_color, 4, "base colour");
    must_be_finite(material->emissive, 3, "emission");
    for (int s = 0; s < TL_GLTF_SLOT_COUNT; s++) {
        const tl_texture_slot *const slot = &material->slots[s];
        fuzz_must(slot->texture < (int)model->texture_count &&
                      slot->coordinates < TL_GLTF_TEXCOORD_COUNT,
                  "texture %d of %zu, coordinates %d", slot->texture, model->texture_count,
                  slot->coordinates);
        must_be_finite(&slot->uv_from_coordinates[0][0], 6, "coordinates");
    }
}

static void check_model(const tl_model *model)
{
    for (size_t i = 0; i < model->part_count; i++)
        check_part(model, &model->parts[i]);
    for (size_t i = 0; i < model->material_count; i++)
        check_material(model, &model->materials[i]);
    for (size_t i = 0; i < model->draw_count; i++) {
        fuzz_must(model->draws[i].part < model->part_count, "part %zu", model->draws[i].part);
        for (int k = 0; k < 12; k++)
            fuzz_must(isfinite(model->draws[i].world.m[k / 4][k % 4]), "draw %zu moves", i);
    }
}

/* Where the animation is in its middle. */
static void load(const char *path)
{
    const tl_moment moment = {.time = 0.5, .has_time = true};
    tl_error err = {.status = TL_OK};
    tl_light_set lights = {.count = 0};
    tl_model *model = NULL;
    tl_camera camera;
    const tl_status status = tl_model_load(path, &moment, NULL, NULL, &model, &err);
    if (status != TL_ERR_ARGUMENT) /* there is no animation */
        fuzz_must_tell(status, &err, path);
    if (status == TL_OK) {
        check_model(model);
        if (tl_model_lights(model, &lights, &err) == TL_OK)
            fuzz_must(tl_light_set_check(&lights, path, &err) == TL_OK, "%s", err.message);
        if (tl_model_camera(model, NULL, 16, 9, NULL, &camera, &err) == TL_OK)
            fuzz_must(tl_camera_check(&camera, &err) == TL_OK, "%s", err.message);
    }
    tl_light_set_clear(&lights);
    tl_model_destroy(model);
}

static void describe(const char *path)
{
    tl_error err = {.status = TL_OK};
    tl_scene_info info = {.scene_count = 0};
    const tl_status status = tl_scene_describe(path, NULL, &info, &err);
    fuzz_must_tell(status, &err, path);
    if (status == TL_OK)
        check_model(info.source);
    tl_scene_info_clear(&info);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *const path = fuzz_file(data, size);
    if (size % 2)
        load(path);
    else
        describe(path);
    return 0;
}
