#include "loading.h"

#include "try.h"

#include <stdlib.h>
#include <string.h>

static void flat_normal(const float *const corners[3], float out[3])
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

void tl_set_flat_normals(const tl_part *part, tl_vertices *vertices)
{
    const float *const positions = vertices->attributes[TL_GLTF_POSITION];
    float *const normals = vertices->attributes[TL_GLTF_NORMAL];
    for (size_t i = 0; i < part->index_count; i += 3) {
        const uint32_t *const triangle = part->indices + i;
        const float *corners[3];
        float normal[3];
        for (int k = 0; k < 3; k++)
            corners[k] = positions + 3 * (size_t)triangle[k];
        flat_normal(corners, normal);
        for (int k = 0; k < 3; k++)
            memcpy(normals + 3 * (size_t)triangle[k], normal, sizeof normal);
    }
}

/* One vertex for each corner. */
static tl_status take_apart(const tl_gltf *gltf,
                            const char *user,
                            tl_budget *budget,
                            const tl_vertices *from,
                            const tl_part *part,
                            tl_vertices *to,
                            tl_error *err)
{
    tl_status status = TL_OK;
    void *data = NULL;
    to->count = part->index_count;
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++) {
        const size_t width = (size_t)tl_accessor_width(i);
        if (i == TL_GLTF_TANGENT || (i != TL_GLTF_NORMAL && !from->attributes[i]))
            continue;
        TRY(tl_budget_take(budget, gltf, user, to->count, width * sizeof(float), &data, err));
        to->attributes[i] = data;
        for (size_t k = 0; k < to->count && from->attributes[i]; k++)
            memcpy(to->attributes[i] + width * k,
                   from->attributes[i] + width * part->indices[k], width * sizeof(float));
    }
    TRY(tl_budget_take(budget, gltf, user, to->count, sizeof *to->sources, &data, err));
    to->sources = data;
    for (size_t k = 0; k < to->count; k++)
        to->sources[k] = part->indices[k];
done:
    return status;
}

tl_status tl_make_flat(const tl_gltf *gltf,
                       const char *user,
                       tl_budget *budget,
                       tl_vertices *vertices,
                       tl_part *part,
                       tl_error *err)
{
    tl_vertices flat = {0};
    tl_status status = TL_OK;
    TRY(take_apart(gltf, user, budget, vertices, part, &flat, err));
    const tl_vertices shared = *vertices;
    *vertices = flat;
    flat = shared;
    for (size_t k = 0; k < part->index_count; k++)
        part->indices[k] = (uint32_t)k;
    part->flat = true;
    tl_set_flat_normals(part, vertices);
done:
    tl_vertices_clear(&flat);
    return status;
}
