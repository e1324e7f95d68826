#include "describe.h"

#include "loading.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* What has been counted, so that nothing is twice: a mark for each thing of the file's lists. Owned. */
typedef struct seen {
    bool *meshes, *positions, *nodes, *skins, *materials, *images;
    bool *primitives;        /* of all meshes, one mesh after another */
    size_t *first_primitive; /* [mesh_count]: where a mesh begins in those */
} seen;

static void release(seen *marks)
{
    free(marks->meshes);
    free(marks->positions);
    free(marks->nodes);
    free(marks->skins);
    free(marks->materials);
    free(marks->images);
    free(marks->primitives);
    free(marks->first_primitive);
}

/* One more each: calloc(0) may be NULL. */
static bool make_marks(const tl_gltf *gltf, seen *out)
{
    size_t primitive_count = 0;
    out->first_primitive = calloc(gltf->mesh_count + 1, sizeof *out->first_primitive);
    for (size_t i = 0; i < gltf->mesh_count && out->first_primitive; i++) {
        out->first_primitive[i] = primitive_count;
        primitive_count += gltf->meshes[i].primitive_count;
    }
    out->meshes = calloc(gltf->mesh_count + 1, sizeof(bool));
    out->positions = calloc(gltf->accessor_count + 1, sizeof(bool));
    out->nodes = calloc(gltf->node_count + 1, sizeof(bool));
    out->skins = calloc(gltf->skin_count + 1, sizeof(bool));
    out->materials = calloc(gltf->material_count + 1, sizeof(bool));
    out->images = calloc(gltf->image_count + 1, sizeof(bool));
    out->primitives = calloc(primitive_count + 1, sizeof(bool));
    return out->first_primitive && out->meshes && out->positions && out->nodes && out->skins &&
           out->materials && out->images && out->primitives;
}

/* Marks it, and says whether that is new. */
static bool mark(bool *of)
{
    const bool is_new = !*of;
    *of = true;
    return is_new;
}

/* --- meshes ------------------------------------------------------------------------------------ */

static void count_primitive(const tl_model *model,
                            const tl_part *part,
                            seen *marks,
                            tl_scene_meshes *out)
{
    const tl_gltf_mesh *const mesh = &model->gltf->meshes[part->mesh];
    const tl_gltf_primitive *const primitive = &mesh->primitives[part->primitive];
    const int positions = primitive->attributes[TL_GLTF_POSITION];
    if (mark(&marks->meshes[part->mesh])) {
        out->shown_count++;
        out->morphed_count += primitive->target_count > 0; /* that of each of them */
        out->target_count += primitive->target_count;
    }
    if (mark(&marks->primitives[marks->first_primitive[part->mesh] + part->primitive])) {
        out->primitive_count++;
        out->triangle_count += part->index_count / 3;
        if (mark(&marks->positions[positions]))
            out->vertex_count += model->gltf->accessors[positions].count;
    }
}

/* A mesh at a place: its draws follow each other in the order of its primitives. */
static void count_place(const tl_model *model,
                        const tl_draw *draw,
                        seen *marks,
                        tl_scene_meshes *out)
{
    const tl_gltf *const gltf = model->gltf;
    const tl_gltf_node *const node = &gltf->nodes[draw->node];
    out->place_count++;
    out->instance_count += tl_is_instanced(node);
    if (!mark(&marks->nodes[draw->node]))
        return;
    out->instanced_node_count += tl_is_instanced(node);
    if (node->skin == -1)
        return;
    assert((size_t)node->skin < gltf->skin_count);
    if (mark(&marks->skins[node->skin])) {
        out->skin_count++;
        out->joint_count += gltf->skins[node->skin].joint_count;
    }
}

static void count_meshes(const tl_model *model, seen *marks, tl_scene_meshes *out)
{
    out->count = model->gltf->mesh_count;
    for (size_t i = 0; i < model->draw_count; i++) {
        const tl_draw *const draw = &model->draws[i];
        const tl_part *const part = &model->parts[draw->part];
        out->drawn_triangle_count += part->index_count / 3;
        count_primitive(model, part, marks, out);
        if (i == 0 || draw[-1].node != draw->node || draw[-1].part >= draw->part)
            count_place(model, draw, marks, out);
    }
}

/* --- materials and their images ---------------------------------------------------------------- */

static void count_material(const tl_model *model, size_t index, tl_scene_materials *out)
{
    const tl_gltf_material *const from = &model->gltf->materials[index];
    const tl_material *const used = &model->materials[index];
    const bool traits[TL_MATERIAL_TRAIT_COUNT] = {
        [TL_MATERIAL_UNLIT] = used->unlit,
        [TL_MATERIAL_MASKED] = strcmp(from->alpha_mode, "MASK") == 0,
        [TL_MATERIAL_BLENDED] = strcmp(from->alpha_mode, "BLEND") == 0,
        [TL_MATERIAL_DOUBLE_SIDED] = used->double_sided,
        [TL_MATERIAL_EMISSIVE] = used->emits && !used->unlit,
        [TL_MATERIAL_NORMAL_MAPPED] = used->slots[TL_GLTF_NORMAL_MAP].texture != -1,
    };
    out->shown_count++;
    for (int i = 0; i < TL_MATERIAL_TRAIT_COUNT; i++)
        out->trait_counts[i] += traits[i];
}

static void count_materials(const tl_model *model, seen *marks, tl_scene_materials *out)
{
    out->count = model->gltf->material_count;
    for (size_t i = 0; i < model->draw_count; i++) {
        const size_t material = model->parts[model->draws[i].part].material;
        if (!mark(&marks->materials[material]))
            continue;
        if (material == out->count)
            out->shows_default = true;
        else
            count_material(model, material, out);
    }
}

/* The model has an image twice where it is looked at as colours and as data. */
static void count_images(const tl_model *model, seen *marks, tl_scene_images *out)
{
    uint64_t largest = 0;
    out->count = model->gltf->image_count;
    for (size_t i = 0; i < model->pixels_count; i++) {
        const tl_pixels *const pixels = &model->pixels[i];
        const uint64_t size = (uint64_t)pixels->width * pixels->height;
        if (!mark(&marks->images[pixels->image]))
            continue;
        out->shown_count++;
        out->pixel_count += size;
        if (size > largest) {
            largest = size;
            out->largest_width = pixels->width;
            out->largest_height = pixels->height;
        }
    }
}

tl_status tl_count_scene(const tl_model *model, tl_scene_info *out, tl_error *err)
{
    seen marks = {0};
    tl_status status = TL_OK;
    if (make_marks(model->gltf, &marks)) {
        count_meshes(model, &marks, &out->meshes);
        count_materials(model, &marks, &out->materials);
        count_images(model, &marks, &out->images);
    } else {
        status = tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for counting what it holds",
                         model->gltf->path);
    }
    release(&marks);
    return status;
}
