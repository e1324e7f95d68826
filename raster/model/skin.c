#include "loading.h"

#include "influences.h"
#include "joints.h"
#include "load_limits.h"
#include "lookup.h"
#include "parallel.h"
#include "try.h"

#include <stdlib.h>

/* --- vertices ---------------------------------------------------------------------------------- */

/* Vertices while they are moved; parts that share them follow each other. */
typedef struct skinning {
    const tl_joints *joints;
    tl_budget budget;         /* for the influences of all primitives */
    tl_influences influences; /* of the primitive's vertices in the file */
    tl_vertices *vertices;
    bool *mirrored; /* [vertices->count], owned: its matrix turns left into right */
} skinning;

static size_t source_of(const tl_vertices *vertices, size_t vertex)
{
    return vertices->sources ? vertices->sources[vertex] : vertex;
}

/* The mean of the matrices of a vertex's joints, by their weights over the sum of these. A
 * vertex without weights, which no triangle has, is at the anchor. */
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
    *s = (skinning){.budget = s->budget};
}

static tl_status move_vertices(const tl_model *model,
                               const tl_part *part,
                               const char *user,
                               const tl_joints *joints,
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
                           &s->budget, &s->influences, err));
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
                           const tl_joints *joints,
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
    tl_joints *const skins = calloc(gltf->skin_count + 1, sizeof *skins);
    skinning s = {.budget = {tl_max_geometry_bytes}};
    tl_status status = TL_OK;

    if (!skins) {
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
        if (!skins[skin].anchor_from_mesh)
            TRY(tl_joints_open(gltf, skin, placements, &skins[skin], err));
        TRY(skin_part(model, &model->parts[draw->part], &skins[skin], &s, err));
        draw->world = tl_affine_identity; /* the node's own does not count */
        for (int c = 0; c < 3; c++)
            draw->world.m[c][3] = skins[skin].anchor[c];
    }
done:
    release(&s);
    for (size_t i = 0; skins && i < gltf->skin_count; i++)
        tl_joints_clear(&skins[i]);
    free(skins);
    return status;
}
