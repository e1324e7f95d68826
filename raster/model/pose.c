#include "pose.h"

#include "lookup.h"

#include <stdlib.h>

void tl_pose_clear(tl_pose *pose)
{
    for (size_t i = 0; i < pose->count && pose->nodes; i++)
        for (int k = 0; k < TL_PATH_COUNT; k++)
            free(pose->nodes[i].values[k]);
    free(pose->nodes);
    *pose = (tl_pose){0};
}

/* What moves this of the node; NULL: nothing. */
static const double *moved(const tl_pose *pose, size_t index, enum tl_path path)
{
    return pose->nodes ? pose->nodes[index].values[path] : NULL;
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

bool tl_transform_of_parts(const double translation[3],
                           const double rotation[4],
                           const double scale[3],
                           tl_affine *out)
{
    double unit[4] = {0, 0, 0, 1}, length = 0.0;
    for (int i = 0; i < 4 && rotation; i++)
        length = hypot(length, rotation[i]);
    if (rotation && (!(length > 0.0) || !isfinite(length)))
        return false;
    for (int i = 0; i < 4 && rotation; i++)
        unit[i] = rotation[i] / length;
    *out = rotation_of(unit);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3 && scale; j++)
            out->m[i][j] *= scale[j];
        out->m[i][3] = translation ? translation[i] : 0.0;
    }
    return true;
}

static tl_affine local_of_matrix(const double *columns)
{
    tl_affine local;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            local.m[i][j] = columns[4 * j + i];
    return local;
}

static tl_status check_counts(const tl_gltf *gltf, size_t index, tl_error *err)
{
    const tl_gltf_node *const node = &gltf->nodes[index];
    const tl_label label = tl_label_of("node", index, node->name);
    if ((node->matrix_count && node->matrix_count != 16) ||
        (node->translation_count && node->translation_count != 3) ||
        (node->rotation_count && node->rotation_count != 4) ||
        (node->scale_count && node->scale_count != 3))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has a transform with the wrong number of values", gltf->path,
                       label.text);
    return TL_OK;
}

/* The animation's numbers, else the file's, else NULL. */
static const double *numbers(
    const tl_pose *pose, size_t index, enum tl_path path, size_t count, const double *of_file)
{
    const double *const of_animation = moved(pose, index, path);
    return of_animation ? of_animation : count ? of_file : NULL;
}

tl_status tl_pose_local(
    const tl_gltf *gltf, const tl_pose *pose, size_t index, tl_affine *out, tl_error *err)
{
    const tl_gltf_node *const node = &gltf->nodes[index];
    const tl_label label = tl_label_of("node", index, node->name);
    const tl_status status = check_counts(gltf, index, err);
    if (status != TL_OK)
        return status;
    if (node->matrix_count) {
        const double *const m = node->matrix;
        if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s has a matrix whose last row is not 0 0 0 1", gltf->path,
                           label.text);
        *out = local_of_matrix(m);
        return TL_OK;
    }
    if (!tl_transform_of_parts(
            numbers(pose, index, TL_PATH_TRANSLATION, node->translation_count,
                    node->translation),
            numbers(pose, index, TL_PATH_ROTATION, node->rotation_count, node->rotation),
            numbers(pose, index, TL_PATH_SCALE, node->scale_count, node->scale), out))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has a rotation whose length is 0 or not finite", gltf->path,
                       label.text);
    return TL_OK;
}

/* --- weights of morph targets ------------------------------------------------------------------ */

size_t tl_mesh_target_count(const tl_gltf_mesh *mesh)
{
    return mesh->primitive_count ? mesh->primitives[0].target_count : 0;
}

static tl_status check_weights(const tl_gltf *gltf,
                               const char *user,
                               size_t count,
                               const double *weights,
                               size_t target_count,
                               tl_error *err)
{
    if (count > 0 && count != target_count)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has %zu weights for %zu morph targets",
                       gltf->path, user, count, target_count);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(weights[i]))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s has a weight that is not finite",
                           gltf->path, user);
    return TL_OK;
}

tl_status tl_pose_weights(
    const tl_gltf *gltf, const tl_pose *pose, size_t index, const double **out, tl_error *err)
{
    const tl_gltf_node *const node = &gltf->nodes[index];
    const tl_gltf_mesh *const mesh = &gltf->meshes[node->mesh];
    const tl_label mesh_label = tl_label_of("mesh", (size_t)node->mesh, mesh->name);
    const size_t count = tl_mesh_target_count(mesh);
    for (size_t i = 1; i < mesh->primitive_count; i++)
        if (mesh->primitives[i].target_count != count)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s: its primitives have %zu and %zu morph targets; all need "
                           "the same",
                           gltf->path, mesh_label.text, count,
                           mesh->primitives[i].target_count);
    tl_status status =
        check_weights(gltf, mesh_label.text, mesh->weight_count, mesh->weights, count, err);
    if (status == TL_OK)
        status = check_weights(gltf, tl_label_of("node", index, node->name).text,
                               node->weight_count, node->weights, count, err);
    if (status != TL_OK)
        return status;
    const double *const of_animation = moved(pose, index, TL_PATH_WEIGHTS);
    *out = of_animation         ? of_animation
           : node->weight_count ? node->weights
           : mesh->weight_count ? mesh->weights
                                : NULL;
    return TL_OK;
}
