#include "loading.h"

#include "influences.h"
#include "load_limits.h"
#include "lookup.h"
#include "parallel.h"
#include "try.h"

#include <stdlib.h>

/* --- joints ------------------------------------------------------------------------------------ */

/* Vertices are kept in floats: around an anchor near the mesh they stay fine where the scene is far
 * from the origin. */
typedef struct palette {
    size_t count;
    tl_affine *anchor_from_mesh; /* [count], owned: by each joint */
    double anchor[3];            /* in the world: where the first joint is */
} palette;

/* Last rows come out of an inversion in float: they count as 0 0 0 1 within this. */
static const double last_row_slack = 1e-5;

static tl_status read_inverse_bind(const tl_gltf *gltf,
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

/* Joints that the scene has, each at most once. */
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

static tl_status open_palette(
    const tl_gltf *gltf, int skin, const tl_placements *placements, palette *out, tl_error *err)
{
    const tl_gltf_skin *const from = &gltf->skins[skin];
    const tl_label user = tl_label_of("skin", (size_t)skin, from->name);
    tl_budget budget = {tl_max_geometry_bytes};
    float *inverse_binds = NULL;
    void *matrices = NULL;
    size_t count = 0;
    tl_status status = TL_OK;

    TRY(check_joints(gltf, user.text, from, placements, err));
    if (from->inverse_bind != -1) {
        TRY(tl_accessor_read(gltf, user.text, from->inverse_bind, TL_USE_INVERSE_BIND, &budget,
                             &inverse_binds, &count, err));
        if (count < from->joint_count) {
            status = tl_fail(err, TL_ERR_FORMAT,
                             "%s: %s has %zu inverse bind matrices for %zu joints", gltf->path,
                             user.text, count, from->joint_count);
            goto done;
        }
    }
    TRY(tl_budget_take(&budget, gltf, user.text, from->joint_count,
                       sizeof *out->anchor_from_mesh, &matrices, err));
    out->anchor_from_mesh = matrices;
    out->count = from->joint_count;
    tl_affine_column(&placements->worlds[from->joints[0]], 3, out->anchor);
    for (size_t i = 0; i < out->count; i++) {
        tl_affine bind = tl_affine_identity, world = placements->worlds[from->joints[i]];
        if (inverse_binds)
            TRY(read_inverse_bind(gltf, user.text, inverse_binds, i, &bind, err));
        for (int c = 0; c < 3; c++)
            world.m[c][3] -= out->anchor[c];
        out->anchor_from_mesh[i] = tl_affine_product(&world, &bind);
    }
done:
    free(inverse_binds);
    return status;
}

/* --- vertices ---------------------------------------------------------------------------------- */

/* Vertices while they are moved; parts that share them follow each other. */
typedef struct skinning {
    const palette *joints;
    tl_influences influences; /* of the primitive's vertices in the file */
    tl_vertices *vertices;
    bool *mirrored; /* [vertices->count], owned: its matrix turns left into right */
} skinning;

static size_t source_of(const tl_vertices *vertices, size_t vertex)
{
    return vertices->sources ? vertices->sources[vertex] : vertex;
}

/* The mean of the matrices of a vertex's joints, by their weights over the sum of these. A vertex without
 * weights, which no triangle has, is at the anchor. */
static tl_affine blend(const skinning *s, size_t source)
{
    const double sum = tl_influences_sum(&s->influences, source);
    tl_affine mean = {{{0}}};
    for (size_t i = 0; i < s->influences.set_count; i++)
        for (size_t k = 0; k < TL_JOINTS_PER_SET; k++) {
            const size_t at = TL_JOINTS_PER_SET * source + k;
            const double weight = (double)s->influences.sets[i].weights[at];
            if (weight == 0.0)
                continue;
            const tl_affine *const joint =
                &s->joints->anchor_from_mesh[(size_t)s->influences.sets[i].joints[at]];
            for (int e = 0; e < 12; e++)
                mean.m[e / 4][e % 4] += weight / sum * joint->m[e / 4][e % 4];
        }
    return mean;
}

/* A direction, moved by the linear part and brought to length 1; one of length 0 stays so. */
static void turn(float *v, const double matrix[3][3])
{
    double from[3], to[3];
    for (int c = 0; c < 3; c++)
        from[c] = (double)v[c];
    for (int c = 0; c < 3; c++)
        to[c] = tl_dot(matrix[c], from);
    if (!tl_normalize(to))
        to[0] = to[1] = to[2] = 0.0;
    for (int c = 0; c < 3; c++)
        v[c] = (float)to[c];
}

static void move_vertex(const skinning *s, size_t vertex)
{
    const tl_affine matrix = blend(s, source_of(s->vertices, vertex));
    float *const position = s->vertices->attributes[TL_GLTF_POSITION] + 3 * vertex;
    float *const tangents = s->vertices->attributes[TL_GLTF_TANGENT];
    double from[3], to[3], linear[3][3], normal[3][3];
    for (int c = 0; c < 3; c++)
        from[c] = (double)position[c];
    tl_affine_point(&matrix, from, to);
    for (int c = 0; c < 3; c++)
        position[c] = (float)to[c];
    tl_affine_normal_matrix(&matrix, normal, &s->mirrored[vertex]);
    turn(s->vertices->attributes[TL_GLTF_NORMAL] + 3 * vertex, (const double(*)[3])normal);
    if (!tangents)
        return;
    for (int e = 0; e < 9; e++)
        linear[e / 3][e % 3] = matrix.m[e / 3][e % 3];
    turn(tangents + 4 * vertex, (const double(*)[3])linear);
    if (s->mirrored[vertex]) /* as the cross product of normal and tangent does */
        tangents[4 * vertex + 3] = -tangents[4 * vertex + 3];
}

static void move_some(void *context, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++)
        move_vertex(context, i);
}

static tl_status check_moved(const tl_gltf *gltf,
                             const char *user,
                             const skinning *s,
                             tl_error *err)
{
    const float *const positions = s->vertices->attributes[TL_GLTF_POSITION];
    for (size_t i = 0; i < 3 * s->vertices->count; i++)
        if (!isfinite(positions[i]))
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s: vertex %zu is not finite where its skin puts it",
                           gltf->path, user, source_of(s->vertices, i / 3));
    return TL_OK;
}

static void release(skinning *s)
{
    tl_influences_clear(&s->influences);
    free(s->mirrored);
    *s = (skinning){0};
}

static tl_status move_vertices(const tl_model *model,
                               const tl_part *part,
                               const char *user,
                               const palette *joints,
                               skinning *s,
                               tl_error *err)
{
    enum { GRAIN = 4096 }; /* vertices: some ms of work */
    const tl_gltf *const gltf = model->gltf;
    const tl_gltf_primitive *const from = &gltf->meshes[part->mesh].primitives[part->primitive];
    const int positions = from->attributes[TL_GLTF_POSITION];
    tl_status status = TL_OK;

    release(s);
    s->joints = joints;
    s->vertices = &model->vertices[part->vertices];
    TRY(tl_influences_read(gltf, user, from, gltf->accessors[positions].count, joints->count,
                           &s->influences, err));
    s->mirrored = calloc(s->vertices->count + 1, sizeof *s->mirrored);
    if (!s->mirrored) {
        status = tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %s", gltf->path, user);
        goto done;
    }
    tl_parallel(s->vertices->count, GRAIN, move_some, s);
    TRY(check_moved(gltf, user, s, err));
done:
    return status;
}

/* --- parts ------------------------------------------------------------------------------------- */

static tl_status check_sums(const tl_gltf *gltf,
                            const char *user,
                            const tl_part *part,
                            const skinning *s,
                            tl_error *err)
{
    for (size_t i = 0; i < part->index_count; i++) {
        const size_t source = source_of(s->vertices, part->indices[i]);
        if (!(tl_influences_sum(&s->influences, source) > 0.0))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s: no joint moves its vertex %zu",
                           gltf->path, user, source);
    }
    return TL_OK;
}

/* What glTF 2.0, section 3.7.4, says of nodes, for joints: where they mirror, the front turns around. A
 * triangle goes by most of its corners. */
static void turn_mirrored(const tl_part *part, const bool *mirrored)
{
    for (size_t i = 0; i < part->index_count; i += 3) {
        uint32_t *const triangle = part->indices + i;
        if (mirrored[triangle[0]] + mirrored[triangle[1]] + mirrored[triangle[2]] < 2)
            continue;
        const uint32_t second = triangle[1];
        triangle[1] = triangle[2];
        triangle[2] = second;
    }
}

static tl_status skin_part(const tl_model *model,
                           const tl_part *part,
                           const palette *joints,
                           skinning *s,
                           tl_error *err)
{
    const tl_primitive_label user =
        tl_label_primitive(model->gltf, part->mesh, part->primitive);
    tl_status status = TL_OK;
    if (s->joints != joints || s->vertices != &model->vertices[part->vertices])
        TRY(move_vertices(model, part, user.text, joints, s, err));
    TRY(check_sums(model->gltf, user.text, part, s, err));
    turn_mirrored(part, s->mirrored);
    if (part->flat)
        tl_set_flat_normals(part, s->vertices);
done:
    return status;
}

tl_status tl_load_skins(tl_model *model, const tl_placements *placements, tl_error *err)
{
    const tl_gltf *const gltf = model->gltf;
    palette *const palettes = calloc(gltf->skin_count + 1, sizeof *palettes);
    skinning s = {0};
    tl_status status = TL_OK;

    if (!palettes) {
        status = tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its skins", gltf->path);
        goto done;
    }
    for (size_t i = 0; i < model->draw_count; i++) {
        tl_draw *const draw = &model->draws[i];
        const int skin = gltf->nodes[draw->node].skin;
        if (skin == -1)
            continue;
        TRY(tl_gltf_check_index(
            gltf, tl_label_of("node", draw->node, gltf->nodes[draw->node].name).text, "skin",
            skin, gltf->skin_count, err));
        if (!palettes[skin].anchor_from_mesh)
            TRY(open_palette(gltf, skin, placements, &palettes[skin], err));
        TRY(skin_part(model, &model->parts[draw->part], &palettes[skin], &s, err));
        draw->world = tl_affine_identity; /* the node's own does not count */
        for (int c = 0; c < 3; c++)
            draw->world.m[c][3] = palettes[skin].anchor[c];
    }
done:
    release(&s);
    for (size_t i = 0; palettes && i < gltf->skin_count; i++)
        free(palettes[i].anchor_from_mesh);
    free(palettes);
    return status;
}
