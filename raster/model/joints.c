#include "joints.h"

#include "load_limits.h"
#include "lookup.h"
#include "try.h"

#include <stdlib.h>

/* Last rows come out of an inversion in float: they count as 0 0 0 1 within this. */
static const double last_row_slack = 1e-5;

static tl_status to_affine(const tl_gltf *gltf,
                           const char *user,
                           const float *columns,
                           size_t joint,
                           tl_affine *out,
                           tl_error *err)
{
    const float *const m = columns + 16 * joint;
    for (int j = 0; j < 4; j++) {
        const double expected = j == 3 ? 1.0 : 0.0;
        if (fabs((double)m[4 * j + 3] - expected) > last_row_slack)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s: its inverse bind matrix %zu has a last row that is not 0 0 "
                           "0 1",
                           gltf->path, user, joint);
        for (int i = 0; i < 3; i++)
            out->m[i][j] = (double)m[4 * j + i];
    }
    return TL_OK;
}

/* That all are in the scene. */
static tl_status check_joints(const tl_gltf *gltf,
                              const char *user,
                              const tl_gltf_skin *skin,
                              const tl_placements *placements,
                              tl_error *err)
{
    tl_status status = TL_OK;
    if (skin->joint_count == 0)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has no joints", gltf->path, user);
    if (skin->skeleton != -1)
        TRY(tl_gltf_check_index(gltf, user, "node", skin->skeleton, gltf->node_count, err));
    for (size_t i = 0; i < skin->joint_count; i++) {
        const int node = skin->joints[i];
        TRY(tl_gltf_check_index(gltf, user, "node", node, gltf->node_count, err));
        if (!placements->in_scene[node]) {
            status = tl_fail(err, TL_ERR_FORMAT,
                             "%s: %s: its joint %zu, node %d, is not in the scene", gltf->path,
                             user, i, node);
            goto done;
        }
    }
done:
    return status;
}

/* Those of the file, [joint_count][16], by columns; NULL where it has none. */
static tl_status read_inverse_binds(
    const tl_gltf *gltf, const char *user, const tl_gltf_skin *skin, float **out, tl_error *err)
{
    tl_budget budget = {tl_max_geometry_bytes};
    size_t count = 0;
    *out = NULL;
    if (skin->inverse_bind == -1)
        return TL_OK;
    const tl_status status = tl_accessor_read(gltf, user, skin->inverse_bind,
                                              TL_USE_INVERSE_BIND, &budget, out, &count, err);
    if (status == TL_OK && count < skin->joint_count)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has %zu inverse bind matrices for %zu joints", gltf->path, user,
                       count, skin->joint_count);
    return status;
}

tl_status tl_joints_open(const tl_gltf *gltf,
                         int skin,
                         const tl_placements *placements,
                         tl_joints *out,
                         tl_error *err)
{
    const tl_gltf_skin *const from = &gltf->skins[skin];
    const tl_label user = tl_label_of("skin", (size_t)skin, from->name);
    tl_budget budget = {tl_max_geometry_bytes};
    float *inverse_binds = NULL;
    void *matrices = NULL;
    tl_status status = TL_OK;

    TRY(check_joints(gltf, user.text, from, placements, err));
    TRY(read_inverse_binds(gltf, user.text, from, &inverse_binds, err));
    TRY(tl_budget_take(&budget, gltf, user.text, from->joint_count,
                       sizeof *out->anchor_from_mesh, &matrices, err));
    out->anchor_from_mesh = matrices;
    out->count = from->joint_count;
    tl_affine_column(&placements->worlds[from->joints[0]], 3, out->anchor);
    for (size_t i = 0; i < out->count; i++) {
        tl_affine bind = tl_affine_identity, world = placements->worlds[from->joints[i]];
        if (inverse_binds)
            TRY(to_affine(gltf, user.text, inverse_binds, i, &bind, err));
        for (int c = 0; c < 3; c++)
            world.m[c][3] -= out->anchor[c];
        out->anchor_from_mesh[i] = tl_affine_product(&world, &bind);
    }
done:
    free(inverse_binds);
    return status;
}

void tl_joints_clear(tl_joints *joints)
{
    free(joints->anchor_from_mesh);
    *joints = (tl_joints){0};
}
