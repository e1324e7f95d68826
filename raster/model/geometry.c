#include "loading.h"

#include "load_limits.h"
#include "lookup.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct loader {
    tl_model *model;
    tl_budget budget;
    size_t *first_parts; /* [mesh_count]: where a mesh's parts begin, SIZE_MAX: not read */
    size_t skipped_count, morphing_count; /* primitives */
} loader;

/* --- triangles --------------------------------------------------------------------------------- */

/* Corner `corner` of triangle `triangle`, as a place in the sequence of vertices: glTF 2.0,
 * section 3.7.2.1. */
static size_t corner_of_list(size_t triangle, size_t corner)
{
    return 3 * triangle + corner;
}

static size_t corner_of_strip(size_t triangle, size_t corner)
{
    const size_t odd = triangle % 2;
    return triangle + (corner == 0 ? 0 : corner == 1 ? 1 + odd : 2 - odd);
}

static size_t corner_of_fan(size_t triangle, size_t corner)
{
    return corner == 2 ? 0 : triangle + 1 + corner;
}

enum { FIRST_TRIANGLE_MODE = 4, MODE_COUNT = 7 };

static const struct {
    size_t (*corner)(size_t triangle, size_t corner);
    size_t step, rest; /* triangles = (vertices - rest) / step */
} modes[MODE_COUNT] = {
    [4] = {corner_of_list, 3, 0},
    [5] = {corner_of_strip, 1, 2},
    [6] = {corner_of_fan, 1, 2},
};

/* The sequence of vertices as a list of triangles; sequence NULL: 0, 1, 2 ... */
static tl_status expand_triangles(loader *at,
                                  const char *user,
                                  int mode,
                                  const uint32_t *sequence,
                                  size_t length,
                                  tl_part *part,
                                  tl_error *err)
{
    void *indices = NULL;
    if (length < 3 || (length - modes[mode].rest) % modes[mode].step != 0)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has %zu vertices, which make no whole triangles",
                       at->model->gltf->path, user, length);
    const size_t count = (length - modes[mode].rest) / modes[mode].step;
    const tl_status status = tl_budget_take(&at->budget, at->model->gltf, user, 3 * count,
                                            sizeof(uint32_t), &indices, err);
    if (status != TL_OK)
        return status;
    part->indices = indices;
    part->index_count = 3 * count;
    for (size_t i = 0; i < count; i++)
        for (size_t corner = 0; corner < 3; corner++) {
            const size_t place = modes[mode].corner(i, corner);
            part->indices[3 * i + corner] = sequence ? sequence[place] : (uint32_t)place;
        }
    return TL_OK;
}

/* --- vertices ---------------------------------------------------------------------------------- */

static tl_status read_attributes(loader *at,
                                 const char *user,
                                 const tl_gltf_primitive *from,
                                 tl_vertices *vertices,
                                 tl_error *err)
{
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++) {
        size_t count = 0;
        if (from->attributes[i] == -1)
            continue;
        const tl_status status = tl_accessor_read_attribute(
            at->model->gltf, user, from->attributes[i], (enum tl_gltf_attribute)i, &at->budget,
            &vertices->attributes[i], &count, err);
        if (status != TL_OK)
            return status;
        if (i == TL_GLTF_POSITION) /* the first of the attributes */
            vertices->count = count;
        if (count != vertices->count)
            return tl_fail(
                err, TL_ERR_FORMAT, "%s: %s has %zu positions, but %zu elements in accessor %d",
                at->model->gltf->path, user, vertices->count, count, from->attributes[i]);
    }
    if (vertices->count > UINT32_MAX)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "%s: %s has more than 2^32 vertices",
                       at->model->gltf->path, user);
    return TL_OK;
}

static void flat_normal(const float corners[3][3], float out[3])
{
    double edges[2][3], normal[3];
    for (int c = 0; c < 3; c++) {
        edges[0][c] = (double)corners[1][c] - (double)corners[0][c];
        edges[1][c] = (double)corners[2][c] - (double)corners[0][c];
    }
    tl_cross(edges[0], edges[1], normal);
    if (!tl_normalize(normal)) /* a triangle without area, which covers no pixel */
        normal[0] = normal[1] = normal[2] = 0.0;
    for (int c = 0; c < 3; c++)
        out[c] = (float)normal[c];
}

/* Gives every triangle vertices of its own with its normal; given tangents go, as glTF demands. */
static tl_status make_flat(
    loader *at, const char *user, tl_vertices *vertices, tl_part *part, tl_error *err)
{
    tl_vertices flat = {.count = part->index_count};
    tl_status status = TL_OK;

    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++) {
        const size_t width = (size_t)tl_attribute_width((enum tl_gltf_attribute)i);
        void *data = NULL;
        if (i == TL_GLTF_TANGENT || (i != TL_GLTF_NORMAL && !vertices->attributes[i]))
            continue;
        TRY(tl_budget_take(&at->budget, at->model->gltf, user, flat.count,
                           width * sizeof(float), &data, err));
        flat.attributes[i] = data;
        for (size_t k = 0; k < flat.count && vertices->attributes[i]; k++)
            memcpy(flat.attributes[i] + width * k,
                   vertices->attributes[i] + width * part->indices[k], width * sizeof(float));
    }
    for (size_t k = 0; k < flat.count; k++) {
        float corners[3][3];
        memcpy(corners, flat.attributes[TL_GLTF_POSITION] + 9 * (k / 3), sizeof corners);
        flat_normal((const float(*)[3])corners, flat.attributes[TL_GLTF_NORMAL] + 3 * k);
        part->indices[k] = (uint32_t)k;
    }
    const tl_vertices shared = *vertices;
    *vertices = flat;
    flat = shared;
done:
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++)
        free(flat.attributes[i]);
    return status;
}

/* --- parts ------------------------------------------------------------------------------------- */

/* Exporters let the primitives of a mesh share one set of vertices; so do parts, unless flat
 * normals made them their own. */
static bool shares_vertices(const tl_gltf_mesh *mesh, size_t primitive, const tl_part *before)
{
    const tl_gltf_primitive *const one = &mesh->primitives[primitive];
    return primitive > 0 && before[-1].index_count > 0 &&
           one->attributes[TL_GLTF_NORMAL] != -1 &&
           memcmp(one->attributes, one[-1].attributes, sizeof one->attributes) == 0;
}

static tl_status load_part(loader *at, size_t mesh_index, size_t primitive, tl_error *err)
{
    tl_model *const model = at->model;
    const tl_gltf *const gltf = model->gltf;
    const tl_gltf_mesh *const mesh = &gltf->meshes[mesh_index];
    const tl_gltf_primitive *const from = &mesh->primitives[primitive];
    tl_part *const part = &model->parts[model->part_count];
    uint32_t *sequence = NULL;
    tl_status status = TL_OK;
    char user[160];

    snprintf(user, sizeof user, "%s, primitive %zu",
             tl_label_of("mesh", mesh_index, mesh->name).text, primitive);
    *part = (tl_part){.material = gltf->material_count};
    model->part_count++;
    if (from->mode < 0 || from->mode >= MODE_COUNT)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has the mode %d; 0 to 6 are modes",
                       gltf->path, user, from->mode);
    if (from->material != -1) {
        TRY(tl_gltf_check_index(gltf, user, "material", from->material, gltf->material_count,
                                err));
        part->material = (size_t)from->material;
    }
    at->morphing_count += from->morphs;
    if (from->mode < FIRST_TRIANGLE_MODE || from->attributes[TL_GLTF_POSITION] == -1) {
        at->skipped_count++;
        return TL_OK;
    }
    if (!shares_vertices(mesh, primitive, part)) {
        model->vertices_count++;
        TRY(read_attributes(at, user, from, &model->vertices[model->vertices_count - 1], err));
    }
    part->vertices = model->vertices_count - 1;
    tl_vertices *const vertices = &model->vertices[part->vertices];
    size_t length = vertices->count;
    if (from->indices != -1)
        TRY(tl_accessor_read_indices(gltf, user, from->indices, vertices->count, &at->budget,
                                     &sequence, &length, err));
    TRY(expand_triangles(at, user, from->mode, sequence, length, part, err));
    if (!vertices->attributes[TL_GLTF_NORMAL])
        TRY(make_flat(at, user, vertices, part, err));
done:
    free(sequence);
    return status;
}

/* Counts what will be read and drawn, so that it is allocated once. */
static tl_status make_room(loader *at, const tl_placements *placements, tl_error *err)
{
    tl_model *const model = at->model;
    const tl_gltf *const gltf = model->gltf;
    size_t parts = 0, draws = 0;

    at->first_parts = malloc((gltf->mesh_count + 1) * sizeof *at->first_parts);
    for (size_t i = 0; i < gltf->mesh_count && at->first_parts; i++)
        at->first_parts[i] = SIZE_MAX;
    for (size_t i = 0; i < placements->count && at->first_parts; i++) {
        const size_t mesh = (size_t)placements->meshes[i].what;
        const size_t count = gltf->meshes[mesh].primitive_count;
        if (at->first_parts[mesh] == SIZE_MAX) {
            at->first_parts[mesh] = parts;
            parts += count;
        }
        draws += count;
        if (draws > TL_MAX_DRAW_COUNT)
            return tl_fail(err, TL_ERR_UNSUPPORTED, "%s: draws more than %d primitives",
                           gltf->path, TL_MAX_DRAW_COUNT);
    }
    model->vertices = calloc(parts + 1, sizeof *model->vertices);
    model->parts = calloc(parts + 1, sizeof *model->parts);
    model->draws = calloc(draws + 1, sizeof *model->draws);
    if (!at->first_parts || !model->vertices || !model->parts || !model->draws)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its meshes", gltf->path);
    return TL_OK;
}

static void tell(const loader *at, const tl_placements *placements, const tl_notices *notices)
{
    const tl_gltf *const gltf = at->model->gltf;
    size_t skinned = 0;
    for (size_t i = 0; i < placements->count; i++)
        skinned += gltf->nodes[placements->meshes[i].node].skin != -1;
    if (at->skipped_count)
        tl_notice(notices,
                  "%s: %zu primitives are points or lines or have no positions, and "
                  "are left out",
                  gltf->path, at->skipped_count);
    if (skinned)
        tl_notice(notices, "%s: %zu skinned meshes are shown without their skins", gltf->path,
                  skinned);
    if (at->morphing_count)
        tl_notice(notices, "%s: %zu primitives are shown without their morph targets",
                  gltf->path, at->morphing_count);
}

tl_status tl_load_geometry(tl_model *model,
                           const tl_placements *placements,
                           const tl_notices *notices,
                           tl_error *err)
{
    loader at = {.model = model, .budget = {tl_max_geometry_bytes}};
    tl_status status = TL_OK;

    TRY(make_room(&at, placements, err));
    for (size_t i = 0; i < placements->count; i++) {
        const tl_placed *const placed = &placements->meshes[i];
        const size_t mesh = (size_t)placed->what;
        const size_t first = at.first_parts[mesh];
        const size_t count = model->gltf->meshes[mesh].primitive_count;
        if (first == model->part_count) /* parts come in the order of first use */
            for (size_t k = 0; k < count; k++)
                TRY(load_part(&at, mesh, k, err));
        for (size_t k = 0; k < count; k++)
            if (model->parts[first + k].index_count > 0)
                model->draws[model->draw_count++] =
                    (tl_draw){first + k, placed->node, placed->world};
    }
    tell(&at, placements, notices);
done:
    free(at.first_parts);
    return status;
}
