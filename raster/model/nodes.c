#include "loading.h"

#include "lookup.h"
#include "try.h"

#include <stdlib.h>

enum { NO_PARENT = -1 };

/* --- that the nodes are trees ------------------------------------------------------------------ */

/* Fills parents[node_count]; each node has one at most. */
static tl_status find_parents(const tl_gltf *gltf, int *parents, tl_error *err)
{
    for (size_t i = 0; i < gltf->node_count; i++)
        parents[i] = NO_PARENT;
    for (size_t i = 0; i < gltf->node_count; i++) {
        const tl_label label = tl_label_of("node", i, gltf->nodes[i].name);
        for (size_t k = 0; k < gltf->nodes[i].child_count; k++) {
            const int child = gltf->nodes[i].children[k];
            const tl_status status =
                tl_gltf_check_index(gltf, label.text, "node", child, gltf->node_count, err);
            if (status != TL_OK)
                return status;
            if (parents[child] != NO_PARENT)
                return tl_fail(err, TL_ERR_FORMAT,
                               "%s: node %d is a child of both node %d and node %zu",
                               gltf->path, child, parents[child], i);
            parents[child] = (int)i;
        }
    }
    return TL_OK;
}

/* With one parent at most, a node that no parentless node leads to is on or below a cycle. `stack`
 * has room for every node. */
static tl_status refuse_cycles(const tl_gltf *gltf,
                               const int *parents,
                               int *stack,
                               tl_error *err)
{
    size_t height = 0, reached = 0;
    for (size_t i = 0; i < gltf->node_count; i++)
        if (parents[i] == NO_PARENT)
            stack[height++] = (int)i;
    while (height > 0) {
        const tl_gltf_node *const node = &gltf->nodes[stack[--height]];
        reached++;
        for (size_t k = 0; k < node->child_count; k++)
            stack[height++] = node->children[k];
    }
    if (reached < gltf->node_count)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %zu of its %zu nodes are their own ancestors or below such a node",
                       gltf->path, gltf->node_count - reached, gltf->node_count);
    return TL_OK;
}

/* --- transforms -------------------------------------------------------------------------------- */

static tl_affine rotation_of(const double q[4])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const tl_affine r = {{
        {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0},
    }};
    return r;
}

static tl_affine local_of_matrix(const double *columns)
{
    tl_affine local;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            local.m[i][j] = columns[4 * j + i];
    return local;
}

/* Counts are right: what is there is whole. */
static tl_affine local_of_parts(const tl_gltf_node *node, const double unit_rotation[4])
{
    tl_affine local = rotation_of(unit_rotation);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3 && node->scale_count; j++)
            local.m[i][j] *= node->scale[j];
        local.m[i][3] = node->translation_count ? node->translation[i] : 0.0;
    }
    return local;
}

static tl_status local_transform(const tl_gltf *gltf,
                                 size_t index,
                                 tl_affine *out,
                                 tl_error *err)
{
    const tl_gltf_node *const node = &gltf->nodes[index];
    const tl_label label = tl_label_of("node", index, node->name);
    double rotation[4] = {0, 0, 0, 1};

    if ((node->matrix_count && node->matrix_count != 16) ||
        (node->translation_count && node->translation_count != 3) ||
        (node->rotation_count && node->rotation_count != 4) ||
        (node->scale_count && node->scale_count != 3))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has a transform with the wrong number of values", gltf->path,
                       label.text);
    if (node->matrix_count) {
        const double *const m = node->matrix;
        if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s has a matrix whose last row is not 0 0 0 1", gltf->path,
                           label.text);
        *out = local_of_matrix(m);
        return TL_OK;
    }
    if (node->rotation_count) {
        double length = 0.0;
        for (int i = 0; i < 4; i++)
            length = hypot(length, node->rotation[i]);
        if (!(length > 0.0) || !isfinite(length))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s has a rotation of length %g", gltf->path,
                           label.text, length);
        for (int i = 0; i < 4; i++)
            rotation[i] = node->rotation[i] / length;
    }
    *out = local_of_parts(node, rotation);
    return TL_OK;
}

/* --- the walk ---------------------------------------------------------------------------------- */

typedef struct walk {
    tl_model *model;
    const int *parents;
    bool *seen;        /* [node_count] */
    int *stack;        /* [node_count] */
    tl_affine *worlds; /* [node_count] */
    tl_placements meshes;
} walk;

/* Room for as many as there are nodes was made beforehand. */
static tl_status place(walk *at,
                       size_t node,
                       const char *kind,
                       int what,
                       size_t what_count,
                       tl_placed *list,
                       size_t *count,
                       tl_error *err)
{
    const tl_gltf *const gltf = at->model->gltf;
    const tl_label label = tl_label_of("node", node, gltf->nodes[node].name);
    if (what == -1)
        return TL_OK;
    const tl_status status = tl_gltf_check_index(gltf, label.text, kind, what, what_count, err);
    if (status == TL_OK)
        list[(*count)++] = (tl_placed){what, node, at->worlds[node]};
    return status;
}

static tl_status visit(walk *at, size_t index, tl_error *err)
{
    tl_model *const model = at->model;
    const tl_gltf *const gltf = model->gltf;
    const tl_gltf_node *const node = &gltf->nodes[index];
    tl_status status = TL_OK;
    tl_affine local;

    if (at->seen[index])
        return tl_fail(err, TL_ERR_FORMAT, "%s: its scene names node %zu twice", gltf->path,
                       index);
    at->seen[index] = true;
    TRY(local_transform(gltf, index, &local, err));
    const int parent = at->parents[index];
    at->worlds[index] =
        parent == NO_PARENT ? local : tl_affine_product(&at->worlds[parent], &local);
    if (!tl_affine_is_finite(&at->worlds[index])) {
        status = tl_fail(err, TL_ERR_FORMAT, "%s: %s has a transform that is not finite",
                         gltf->path, tl_label_of("node", index, node->name).text);
        goto done;
    }
    TRY(place(at, index, "mesh", node->mesh, gltf->mesh_count, at->meshes.meshes,
              &at->meshes.count, err));
    TRY(place(at, index, "camera", node->camera, gltf->camera_count, model->cameras,
              &model->camera_count, err));
    TRY(place(at, index, "light", node->light, gltf->light_count, model->lights,
              &model->light_count, err));
done:
    return status;
}

/* In the order of the file: a node, then its children, first to last. */
static tl_status visit_below(walk *at, int root, tl_error *err)
{
    const tl_gltf *const gltf = at->model->gltf;
    size_t height = 0;
    at->stack[height++] = root;
    while (height > 0) {
        const size_t index = (size_t)at->stack[--height];
        const tl_status status = visit(at, index, err);
        if (status != TL_OK)
            return status;
        const tl_gltf_node *const node = &gltf->nodes[index];
        for (size_t k = node->child_count; k > 0; k--)
            at->stack[height++] = node->children[k - 1];
    }
    return TL_OK;
}

static tl_status visit_scene(walk *at, const tl_notices *notices, tl_error *err)
{
    const tl_gltf *const gltf = at->model->gltf;
    tl_status status = TL_OK;

    if (gltf->scene_count == 0) {
        tl_notice(notices, "%s: has no scene; all of its nodes are shown", gltf->path);
        for (size_t i = 0; i < gltf->node_count; i++)
            if (at->parents[i] == NO_PARENT)
                TRY(visit_below(at, (int)i, err));
        goto done;
    }
    const int wanted = gltf->default_scene == -1 ? 0 : gltf->default_scene;
    TRY(tl_gltf_check_index(gltf, "the default scene", "scene", wanted, gltf->scene_count,
                            err));
    const tl_gltf_scene *const scene = &gltf->scenes[wanted];
    for (size_t i = 0; i < scene->node_count; i++) {
        TRY(tl_gltf_check_index(gltf, tl_label_of("scene", (size_t)wanted, scene->name).text,
                                "node", scene->nodes[i], gltf->node_count, err));
        if (at->parents[scene->nodes[i]] != NO_PARENT) {
            status = tl_fail(err, TL_ERR_FORMAT,
                             "%s: node %d is a root of scene %d and a child of node %d",
                             gltf->path, scene->nodes[i], wanted, at->parents[scene->nodes[i]]);
            goto done;
        }
        TRY(visit_below(at, scene->nodes[i], err));
    }
done:
    return status;
}

tl_status tl_load_nodes(tl_model *model,
                        const tl_notices *notices,
                        tl_placements *out,
                        tl_error *err)
{
    const size_t count = model->gltf->node_count + 1; /* one more: malloc(0) may be NULL */
    tl_status status = TL_OK;
    int *const parents = malloc(count * sizeof *parents);
    walk at = {
        .model = model,
        .parents = parents,
        .seen = calloc(count, sizeof *at.seen),
        .stack = malloc(count * sizeof *at.stack),
        .worlds = malloc(count * sizeof *at.worlds),
        .meshes.meshes = malloc(count * sizeof *at.meshes.meshes),
    };
    model->cameras = malloc(count * sizeof *model->cameras);
    model->lights = malloc(count * sizeof *model->lights);
    if (!parents || !at.seen || !at.stack || !at.worlds || !at.meshes.meshes ||
        !model->cameras || !model->lights) {
        status =
            tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its nodes", model->gltf->path);
        goto done;
    }
    TRY(find_parents(model->gltf, parents, err));
    TRY(refuse_cycles(model->gltf, parents, at.stack, err));
    TRY(visit_scene(&at, notices, err));
    *out = at.meshes;
    at.meshes.meshes = NULL;
done:
    free(parents);
    free(at.seen);
    free(at.stack);
    free(at.worlds);
    free(at.meshes.meshes);
    return status;
}
