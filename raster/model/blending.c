#define _GNU_SOURCE
#include "blending.h"

#include "accessor.h"
#include "lookup.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* Ranks are floats in the shaders. */
static const size_t most_triangles = (size_t)1 << 24;

static const tl_material *material_of(const tl_model *model, size_t draw)
{
    return &model->materials[model->parts[model->draws[draw].part].material];
}

bool tl_model_blends(const tl_model *model)
{
    for (size_t i = 0; i < model->draw_count; i++)
        if (material_of(model, i)->blends)
            return true;
    return false;
}

void tl_model_tell_of_blending(const tl_model *model, const tl_notices *notices)
{
    char names[512] = "";
    for (size_t i = 0; i < model->gltf->material_count; i++)
        if (model->materials[i].blends &&
            !tl_list_add(names, sizeof names,
                         tl_label_of("material", i, model->gltf->materials[i].name).text))
            break;
    if (names[0])
        tl_notice(notices, "%s: blending is shown as opaque where alpha is at least 0.5: %s",
                  model->gltf->path, names);
}

/* --- the order of draws: each compares to below, equal or above 0 ------------------------------------ */

static int compare_sizes(size_t a, size_t b)
{
    return (a > b) - (a < b);
}

static int compare_bytes(const void *a, const void *b, size_t size)
{
    return size > 0 ? memcmp(a, b, size) : 0;
}

static int compare_vertices(const tl_vertices *a, const tl_vertices *b)
{
    int order = compare_sizes(a->count, b->count);
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT && order == 0; i++) {
        order = (a->attributes[i] != NULL) - (b->attributes[i] != NULL);
        if (order == 0 && a->attributes[i])
            order = compare_bytes(a->attributes[i], b->attributes[i],
                                  a->count * (size_t)tl_accessor_width(i) * sizeof(float));
    }
    return order;
}

static int compare_geometry(const tl_model *model, const tl_part *a, const tl_part *b)
{
    int order = compare_sizes(a->index_count, b->index_count);
    if (order == 0)
        order = compare_vertices(&model->vertices[a->vertices], &model->vertices[b->vertices]);
    if (order == 0)
        order = compare_bytes(a->indices, b->indices, a->index_count * sizeof *a->indices);
    return order;
}

static int compare_textures(const tl_model *model, int a, int b)
{
    int order = (a != -1) - (b != -1);
    if (order != 0 || a == -1)
        return order;
    const tl_texture *first = &model->textures[a], *second = &model->textures[b];
    const tl_gltf_bytes x = model->pixels[first->pixels].bytes,
                        y = model->pixels[second->pixels].bytes;
    order = compare_sizes(x.size, y.size);
    if (order == 0)
        order = compare_bytes(x.data, y.data, x.size);
    if (order == 0)
        order = compare_bytes(&first->sampler, &second->sampler, sizeof first->sampler);
    return order;
}

static int compare_materials(const tl_model *model, const tl_material *a, const tl_material *b)
{
    const float x[] = {a->metallic,           a->roughness,           a->normal_scale,
                       a->occlusion_strength, (float)a->double_sided, (float)a->unlit};
    const float y[] = {b->metallic,           b->roughness,           b->normal_scale,
                       b->occlusion_strength, (float)b->double_sided, (float)b->unlit};
    int order = compare_bytes(a->base_color, b->base_color, sizeof a->base_color);
    if (order == 0)
        order = compare_bytes(a->emissive, b->emissive, sizeof a->emissive);
    if (order == 0)
        order = compare_bytes(x, y, sizeof x);
    for (int i = 0; i < TL_GLTF_SLOT_COUNT && order == 0; i++) {
        const tl_texture_slot *s = &a->slots[i], *t = &b->slots[i];
        order = compare_textures(model, s->texture, t->texture);
        if (order == 0)
            order = s->coordinates - t->coordinates;
        if (order == 0)
            order = compare_bytes(s->uv_from_coordinates, t->uv_from_coordinates,
                                  sizeof s->uv_from_coordinates);
    }
    return order;
}

/* Draws that are the same in all of it have the order of the file. */
static int compare_draws(const void *left, const void *right, void *context)
{
    const tl_model *model = context;
    const size_t i = *(const size_t *)left, j = *(const size_t *)right;
    const tl_draw *a = &model->draws[i], *b = &model->draws[j];
    const tl_part *x = &model->parts[a->part], *y = &model->parts[b->part];
    int order = compare_bytes(&a->world, &b->world, sizeof a->world);
    if (order == 0)
        order = compare_geometry(model, x, y);
    if (order == 0)
        order = compare_materials(model, &model->materials[x->material],
                                  &model->materials[y->material]);
    return order != 0 ? order : compare_sizes(i, j);
}

tl_status tl_blending_ranks(const tl_model *model, uint32_t *ranks, tl_error *err)
{
    tl_status status = TL_OK;
    size_t count = 0, triangles = 0;
    size_t *order = calloc(model->draw_count + 1, sizeof *order);
    if (!order)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for what blends",
                    model->gltf->path));
    for (size_t i = 0; i < model->draw_count; i++) {
        ranks[i] = 0;
        if (material_of(model, i)->blends)
            order[count++] = i;
    }
    qsort_r(order, count, sizeof *order, compare_draws, (void *)(uintptr_t)model);
    for (size_t i = 0; i < count; i++) {
        ranks[order[i]] = (uint32_t)triangles;
        triangles += model->parts[model->draws[order[i]].part].index_count / 3;
        if (triangles > most_triangles)
            TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                        "%s: more than %zu triangles blend, which is the most that can be put "
                        "in order: capture without layers",
                        model->gltf->path, most_triangles));
    }
done:
    free(order);
    return status;
}
