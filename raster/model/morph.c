#include "loading.h"

#include "load_limits.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>

_Static_assert((int)TL_GLTF_POSITION == 0 && (int)TL_GLTF_NORMAL == 1 &&
                   (int)TL_GLTF_TANGENT == 2 &&
                   (int)TL_USE_MORPH_TANGENT == (int)TL_USE_MORPH_POSITION + 2,
               "morph targets displace the first attributes, in their order");

enum { WIDTH = 3 }; /* of a displacement; a tangent's sign stays what it is */

/* The sum of displacements of one attribute, in double: targets may be many and cancel. */
typedef struct sum {
    double *values; /* [vertex count][WIDTH], owned */
} sum;

static const char *const words[TL_GLTF_MORPHED_COUNT] = {"POSITION", "NORMAL", "TANGENT"};

/* Adds one attribute of one target. All are read: what is damaged is told whatever its weight. */
static tl_status add_target(const tl_gltf *gltf,
                            const char *user,
                            const tl_vertices *vertices,
                            int attribute,
                            int accessor,
                            double weight,
                            tl_budget *work,
                            sum *to,
                            tl_error *err)
{
    tl_budget budget = {tl_max_geometry_bytes};
    float *displacements = NULL;
    size_t count = 0;
    void *values = NULL;
    tl_status status = TL_OK;

    TRY(tl_accessor_read(gltf, user, accessor, TL_USE_MORPH_POSITION + attribute, &budget,
                         &displacements, &count, err));
    if (count != vertices->count) {
        status =
            tl_fail(err, TL_ERR_FORMAT, "%s: %s has %zu displacements of %s for %zu vertices",
                    gltf->path, user, count, words[attribute], vertices->count);
        goto done;
    }
    const uint64_t size = (uint64_t)count * WIDTH * sizeof *displacements;
    if (size > work->left) {
        status = tl_fail(err, TL_ERR_UNSUPPORTED,
                         "%s: %s: the scene's morph targets come to more than may be read",
                         gltf->path, user);
        goto done;
    }
    work->left -= size;
    if (weight == 0.0 || !vertices->attributes[attribute])
        goto done;
    if (!to->values) {
        TRY(tl_budget_take(&budget, gltf, user, count, WIDTH * sizeof(double), &values, err));
        to->values = values;
    }
    for (size_t i = 0; i < WIDTH * count; i++)
        to->values[i] += weight * (double)displacements[i];
done:
    free(displacements);
    return status;
}

static tl_status apply(const tl_gltf *gltf,
                       const char *user,
                       tl_vertices *vertices,
                       int attribute,
                       const sum *from,
                       tl_error *err)
{
    const size_t width = (size_t)tl_accessor_width(attribute);
    for (size_t i = 0; i < vertices->count; i++) {
        float *const to = vertices->attributes[attribute] + width * i;
        double moved[WIDTH];
        for (int c = 0; c < WIDTH; c++)
            moved[c] = (double)to[c] + from->values[WIDTH * i + (size_t)c];
        if (attribute != TL_GLTF_POSITION)
            tl_normalize(moved);
        for (int c = 0; c < WIDTH; c++) {
            to[c] = (float)moved[c];
            if (!isfinite(to[c]))
                return tl_fail(err, TL_ERR_FORMAT,
                               "%s: %s: the %s of vertex %zu is not finite once it is morphed",
                               gltf->path, user, words[attribute], i);
        }
    }
    return TL_OK;
}

tl_status tl_morph(const tl_gltf *gltf,
                   const char *user,
                   const tl_gltf_primitive *primitive,
                   const double *weights,
                   tl_budget *work,
                   tl_vertices *vertices,
                   tl_error *err)
{
    sum sums[TL_GLTF_MORPHED_COUNT] = {{0}};
    tl_status status = TL_OK;

    for (size_t k = 0; k < primitive->target_count; k++) {
        char target[192];
        snprintf(target, sizeof target, "%s, morph target %zu", user, k);
        for (int i = 0; i < TL_GLTF_MORPHED_COUNT; i++) {
            const int accessor = primitive->targets[k].attributes[i];
            if (accessor == -1)
                continue;
            if (primitive->attributes[i] == -1) {
                status = tl_fail(err, TL_ERR_FORMAT,
                                 "%s: %s displaces %s, which the primitive has not", gltf->path,
                                 target, words[i]);
                goto done;
            }
            TRY(add_target(gltf, target, vertices, i, accessor, weights ? weights[k] : 0.0,
                           work, &sums[i], err));
        }
    }
    for (int i = 0; i < TL_GLTF_MORPHED_COUNT; i++)
        if (sums[i].values)
            TRY(apply(gltf, user, vertices, i, &sums[i], err));
done:
    for (int i = 0; i < TL_GLTF_MORPHED_COUNT; i++)
        free(sums[i].values);
    return status;
}
