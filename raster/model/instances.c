#include "loading.h"

#include "accessor.h"
#include "load_limits.h"
#include "lookup.h"
#include "pose.h"
#include "try.h"

#include <stdlib.h>

/* The attributes of one node's instances. */
typedef struct instances {
    float *translations, *rotations, *scales; /* [count][3], [4], [3], owned; NULL: none */
    size_t count;                             /* 1 where there are none of them */
} instances;

bool tl_is_instanced(const tl_gltf_node *node)
{
    return node->instance_translation != -1 || node->instance_rotation != -1 ||
           node->instance_scale != -1;
}

static void release(instances *from)
{
    free(from->translations);
    free(from->rotations);
    free(from->scales);
    *from = (instances){0};
}

static tl_status read_attributes(const tl_gltf *gltf,
                                 const char *user,
                                 const tl_gltf_node *node,
                                 instances *out,
                                 tl_error *err)
{
    const struct {
        int accessor, use;
        float **values;
    } attributes[] = {
        {node->instance_translation, TL_USE_INSTANCE_TRANSLATION, &out->translations},
        {node->instance_rotation, TL_USE_INSTANCE_ROTATION, &out->rotations},
        {node->instance_scale, TL_USE_INSTANCE_SCALE, &out->scales},
    };
    tl_budget budget = {tl_max_geometry_bytes};
    for (size_t i = 0; i < sizeof attributes / sizeof attributes[0]; i++) {
        size_t count = 0;
        if (attributes[i].accessor == -1)
            continue;
        const tl_status status =
            tl_accessor_read(gltf, user, attributes[i].accessor, attributes[i].use, &budget,
                             attributes[i].values, &count, err);
        if (status != TL_OK)
            return status;
        if (out->count != 0 && count != out->count)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s has instances whose attributes are %zu and %zu elements",
                           gltf->path, user, out->count, count);
        out->count = count;
    }
    return TL_OK;
}

/* Three or four numbers as doubles; NULL: there are none. */
static const double *widened(const float *values, size_t width, size_t index, double *room)
{
    for (size_t i = 0; i < width && values; i++)
        room[i] = (double)values[width * index + i];
    return values ? room : NULL;
}

/* node_from_instance. */
static tl_status place_instance(const tl_gltf *gltf,
                                const char *user,
                                const instances *from,
                                size_t index,
                                tl_affine *out,
                                tl_error *err)
{
    double translation[3], rotation[4], scale[3];
    if (!tl_transform_of_parts(widened(from->translations, 3, index, translation),
                               widened(from->rotations, 4, index, rotation),
                               widened(from->scales, 3, index, scale), out))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: its instance %zu has a rotation of length 0", gltf->path, user,
                       index);
    return TL_OK;
}

/* Room for `count` more. */
static tl_status make_room(const tl_gltf *gltf,
                           const char *user,
                           size_t count,
                           tl_placements *to,
                           size_t *room,
                           tl_error *err)
{
    if (count > TL_MAX_DRAW_COUNT || to->count > TL_MAX_DRAW_COUNT)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: %s: its scene shows meshes at more than %d places", gltf->path,
                       user, TL_MAX_DRAW_COUNT);
    if (to->count + count <= *room)
        return TL_OK;
    const size_t wanted = 2 * (to->count + count);
    tl_placed *const grown = realloc(to->meshes, wanted * sizeof *grown);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its instances", gltf->path);
    to->meshes = grown;
    *room = wanted;
    return TL_OK;
}

/* What the walk of the nodes placed once stands where each of its instances is. */
static tl_status multiply(
    const tl_gltf *gltf, const tl_placed *once, tl_placements *out, size_t *room, tl_error *err)
{
    const tl_gltf_node *const node = &gltf->nodes[once->node];
    const tl_label label = tl_label_of("node", once->node, node->name);
    instances all = {0};
    tl_status status = TL_OK;

    if (tl_is_instanced(node) && node->skin != -1)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: %s has a skin and instances, which glTF gives no meaning together",
                       gltf->path, label.text);
    TRY(read_attributes(gltf, label.text, node, &all, err));
    const size_t count = all.count ? all.count : 1;
    TRY(make_room(gltf, label.text, count, out, room, err));
    for (size_t i = 0; i < count; i++) {
        tl_affine local;
        TRY(place_instance(gltf, label.text, &all, i, &local, err));
        const tl_affine world = tl_affine_product(&once->world, &local);
        if (!tl_affine_is_finite(&world)) {
            status = tl_fail(err, TL_ERR_FORMAT,
                             "%s: %s: its instance %zu has a transform that is not finite",
                             gltf->path, label.text, i);
            goto done;
        }
        out->meshes[out->count++] = (tl_placed){once->what, once->node, world};
    }
done:
    release(&all);
    return status;
}

tl_status tl_load_instances(const tl_model *model, tl_placements *placements, tl_error *err)
{
    tl_placements made = {0};
    size_t room = placements->count + 1;
    tl_status status = TL_OK;

    made.meshes = malloc(room * sizeof *made.meshes);
    if (!made.meshes) {
        status = tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its instances",
                         model->gltf->path);
        goto done;
    }
    for (size_t i = 0; i < placements->count; i++)
        TRY(multiply(model->gltf, &placements->meshes[i], &made, &room, err));
    tl_placed *const once = placements->meshes;
    placements->meshes = made.meshes;
    placements->count = made.count;
    made.meshes = once;
done:
    free(made.meshes);
    return status;
}
