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

/* --- the walk ---------------------------------------------------------------------------------- */

typedef struct walk {
    tl_model *model;
    const tl_pose *pose;
    const int *parents;
    int *stack; /* [node_count] */
    tl_placements out;
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
        list[(*count)++] = (tl_placed){what, node, at->out.worlds[node]};
    return status;
}

static tl_status visit(walk *at, size_t index, tl_error *err)
{
    tl_model *const model = at->model;
    const tl_gltf *const gltf = model->gltf;
    const tl_gltf_node *const node = &gltf->nodes[index];
    tl_status status = TL_OK;
    tl_affine local;

    if (at->out.in_scene[index])
        return tl_fail(err, TL_ERR_FORMAT, "%s: its scene names node %zu twice", gltf->path,
                       index);
    at->out.in_scene[index] = true;
    TRY(tl_pose_local(gltf, at->pose, index, &local, err));
    const int parent = at->parents[index];
    at->out.worlds[index] =
        parent == NO_PARENT ? local : tl_affine_product(&at->out.worlds[parent], &local);
    if (!tl_affine_is_finite(&at->out.worlds[index])) {
        status = tl_fail(err, TL_ERR_FORMAT, "%s: %s has a transform that is not finite",
                         gltf->path, tl_label_of("node", index, node->name).text);
        goto done;
    }
    TRY(place(at, index, "mesh", node->mesh, gltf->mesh_count, at->out.meshes, &at->out.count,
              err));
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

void tl_placements_clear(tl_placements *placements)
{
    free(placements->in_scene);
    free(placements->worlds);
    free(placements->meshes);
    *placements = (tl_placements){0};
}

tl_status tl_load_nodes(tl_model *model,
                        const tl_pose *pose,
                        const tl_notices *notices,
                        tl_placements *out,
                        tl_error *err)
{
    const size_t count = model->gltf->node_count + 1; /* one more: malloc(0) may be NULL */
    tl_status status = TL_OK;
    int *const parents = malloc(count * sizeof *parents);
    walk at = {
        .model = model,
        .pose = pose,
        .parents = parents,
        .stack = malloc(count * sizeof *at.stack),
        .out = {.in_scene = calloc(count, sizeof *at.out.in_scene),
                .worlds = malloc(count * sizeof *at.out.worlds),
                .meshes = malloc(count * sizeof *at.out.meshes)},
    };
    model->cameras = malloc(count * sizeof *model->cameras);
    model->lights = malloc(count * sizeof *model->lights);
    if (!parents || !at.stack || !at.out.in_scene || !at.out.worlds || !at.out.meshes ||
        !model->cameras || !model->lights) {
        status =
            tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its nodes", model->gltf->path);
        goto done;
    }
    TRY(find_parents(model->gltf, parents, err));
    TRY(refuse_cycles(model->gltf, parents, at.stack, err));
    TRY(visit_scene(&at, notices, err));
    *out = at.out;
    at.out = (tl_placements){0};
done:
    free(parents);
    free(at.stack);
    tl_placements_clear(&at.out);
    return status;
}
