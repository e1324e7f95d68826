#include "loading.h"

#include "load_limits.h"
#include "lookup.h"
#include "try.h"
#include "variants.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A mesh as a node shows it: nodes that show it alike share its parts. */
typedef struct version {
    bool is_read;
    size_t first;          /* of its parts */
    size_t skin_node;      /* joints move it for this node alone; NO_NODE: none do */
    const double *weights; /* of its morph targets; NULL: all 0 */
} version;

static const size_t NO_NODE = (size_t)-1;

typedef struct loader {
    tl_model *model;
    tl_budget budget, displacements;
    version *versions;                    /* [mesh_count]: the last that was read */
    size_t skipped_count;                 /* primitives */
    bool is_used[TL_GLTF_TEXCOORD_COUNT]; /* sets of texture coordinates, by some material */
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

/* The first sets of texture coordinates are always read; others only where a material looks at them. */
static bool is_wanted(const loader *at, int attribute)
{
    return attribute <= TL_GLTF_TEXCOORD_1 || attribute == TL_GLTF_COLOR ||
           at->is_used[attribute - TL_GLTF_TEXCOORD_0];
}

static void find_used_sets(loader *at)
{
    const tl_gltf *const gltf = at->model->gltf;
    for (size_t i = 0; i < gltf->material_count * TL_GLTF_SLOT_COUNT; i++) {
        const tl_gltf_texture_use *const use =
            &gltf->materials[i / TL_GLTF_SLOT_COUNT].textures[i % TL_GLTF_SLOT_COUNT];
        if (use->texture != -1 && use->coordinates >= 0 &&
            use->coordinates < TL_GLTF_TEXCOORD_COUNT)
            at->is_used[use->coordinates] = true;
    }
}

static tl_status read_attributes(loader *at,
                                 const char *user,
                                 const tl_gltf_primitive *from,
                                 tl_vertices *vertices,
                                 tl_error *err)
{
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++) {
        size_t count = 0;
        if (from->attributes[i] == -1 || !is_wanted(at, i))
            continue;
        const tl_status status =
            tl_accessor_read(at->model->gltf, user, from->attributes[i], i, &at->budget,
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

/* --- parts ------------------------------------------------------------------------------------- */

tl_primitive_label tl_label_primitive(const tl_gltf *gltf, size_t mesh, size_t primitive)
{
    tl_primitive_label label;
    snprintf(label.text, sizeof label.text, "%s, primitive %zu",
             tl_label_of("mesh", mesh, gltf->meshes[mesh].name).text, primitive);
    return label;
}

void tl_vertices_clear(tl_vertices *vertices)
{
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++)
        free(vertices->attributes[i]);
    free(vertices->sources);
    *vertices = (tl_vertices){0};
}

static bool have_same_vertices(const tl_gltf_primitive *a, const tl_gltf_primitive *b)
{
    return memcmp(a->attributes, b->attributes, sizeof a->attributes) == 0 &&
           a->target_count == b->target_count && a->influences_count == b->influences_count &&
           (a->target_count == 0 ||
            memcmp(a->targets, b->targets, a->target_count * sizeof *a->targets) == 0) &&
           (a->influences_count == 0 ||
            memcmp(a->influences, b->influences, a->influences_count * sizeof *a->influences) ==
                0);
}

/* Exporters let the primitives of a mesh share one set of vertices; so do parts, unless flat
 * normals made them their own. */
static bool shares_vertices(const tl_gltf_mesh *mesh, size_t primitive, const tl_part *before)
{
    const tl_gltf_primitive *const one = &mesh->primitives[primitive];
    return primitive > 0 && before[-1].index_count > 0 && !before[-1].flat &&
           have_same_vertices(one, &one[-1]);
}

static tl_status load_part(
    loader *at, size_t mesh_index, size_t primitive, const double *weights, tl_error *err)
{
    tl_model *const model = at->model;
    const tl_gltf *const gltf = model->gltf;
    const tl_gltf_mesh *const mesh = &gltf->meshes[mesh_index];
    const tl_gltf_primitive *const from = &mesh->primitives[primitive];
    const tl_primitive_label user = tl_label_primitive(gltf, mesh_index, primitive);
    tl_part *const part = &model->parts[model->part_count];
    uint32_t *sequence = NULL;
    tl_status status = TL_OK;

    *part = (tl_part){.mesh = mesh_index, .primitive = primitive};
    model->part_count++;
    if (from->mode < 0 || from->mode >= MODE_COUNT)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has the mode %d; 0 to 6 are modes",
                       gltf->path, user.text, from->mode);
    TRY(tl_variant_material(gltf, user.text, from, model->variant, &part->material, err));
    if (from->mode < FIRST_TRIANGLE_MODE || from->attributes[TL_GLTF_POSITION] == -1) {
        at->skipped_count++;
        return TL_OK;
    }
    if (!shares_vertices(mesh, primitive, part)) {
        tl_vertices *const made = &model->vertices[model->vertices_count++];
        TRY(read_attributes(at, user.text, from, made, err));
        TRY(tl_morph(gltf, user.text, from, weights, &at->displacements, made, err));
    }
    part->vertices = model->vertices_count - 1;
    tl_vertices *const vertices = &model->vertices[part->vertices];
    size_t length = vertices->count;
    if (from->indices != -1)
        TRY(tl_accessor_read_indices(gltf, user.text, from->indices, vertices->count,
                                     &at->budget, &sequence, &length, err));
    TRY(expand_triangles(at, user.text, from->mode, sequence, length, part, err));
    if (!vertices->attributes[TL_GLTF_NORMAL])
        TRY(tl_make_flat(gltf, user.text, &at->budget, vertices, part, err));
done:
    free(sequence);
    return status;
}

/* --- placements -------------------------------------------------------------------------------- */

/* Room for what is drawn at most, so that it is allocated once; no more parts can be read. */
static tl_status make_room(loader *at, const tl_placements *placements, tl_error *err)
{
    tl_model *const model = at->model;
    const tl_gltf *const gltf = model->gltf;
    size_t draws = 0;

    for (size_t i = 0; i < placements->count; i++) {
        draws += gltf->meshes[placements->meshes[i].what].primitive_count;
        if (draws > TL_MAX_DRAW_COUNT)
            return tl_fail(err, TL_ERR_UNSUPPORTED, "%s: draws more than %d primitives",
                           gltf->path, TL_MAX_DRAW_COUNT);
    }
    at->versions = calloc(gltf->mesh_count + 1, sizeof *at->versions);
    model->vertices = calloc(draws + 1, sizeof *model->vertices);
    model->parts = calloc(draws + 1, sizeof *model->parts);
    model->draws = calloc(draws + 1, sizeof *model->draws);
    if (!at->versions || !model->vertices || !model->parts || !model->draws)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its meshes", gltf->path);
    return TL_OK;
}

static bool are_equal(const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count && a != b; i++)
        if ((a ? a[i] : 0.0) != (b ? b[i] : 0.0))
            return false;
    return true;
}

/* Where the parts are that this node shows: those of the version before, where it is the same. */
static tl_status find_parts(
    loader *at, const tl_pose *pose, const tl_placed *placed, size_t *first, tl_error *err)
{
    const tl_gltf *const gltf = at->model->gltf;
    const size_t mesh = (size_t)placed->what;
    const tl_gltf_mesh *const from = &gltf->meshes[mesh];
    version *const last = &at->versions[mesh];
    version wanted = {.is_read = true,
                      .first = at->model->part_count,
                      .skin_node =
                          gltf->nodes[placed->node].skin == -1 ? NO_NODE : placed->node};
    tl_status status = TL_OK;

    TRY(tl_pose_weights(gltf, pose, placed->node, &wanted.weights, err));
    if (!last->is_read || last->skin_node != wanted.skin_node ||
        !are_equal(last->weights, wanted.weights, tl_mesh_target_count(from))) {
        *last = wanted;
        for (size_t i = 0; i < from->primitive_count; i++)
            TRY(load_part(at, mesh, i, wanted.weights, err));
    }
    *first = last->first;
done:
    return status;
}

tl_status tl_load_geometry(tl_model *model,
                           const tl_pose *pose,
                           const tl_placements *placements,
                           const tl_notices *notices,
                           tl_error *err)
{
    loader at = {.model = model,
                 .budget = {tl_max_geometry_bytes},
                 .displacements = {tl_max_displacement_bytes}};
    tl_status status = TL_OK;

    find_used_sets(&at);
    TRY(make_room(&at, placements, err));
    for (size_t i = 0; i < placements->count; i++) {
        const tl_placed *const placed = &placements->meshes[i];
        const size_t count = model->gltf->meshes[placed->what].primitive_count;
        size_t first = 0;
        TRY(find_parts(&at, pose, placed, &first, err));
        for (size_t k = first; k < first + count; k++)
            if (model->parts[k].index_count > 0)
                model->draws[model->draw_count++] = (tl_draw){k, placed->node, placed->world};
    }
    if (at.skipped_count)
        tl_notice(notices,
                  "%s: %zu primitives are points or lines or have no positions, and "
                  "are left out",
                  model->gltf->path, at.skipped_count);
done:
    free(at.versions);
    return status;
}
