#include "loading.h"

#include "parallel.h"
#include "tangent_space.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* The corners of a part, taken apart, and what becomes of them. */
typedef struct corners {
    const tl_vertices *from;
    float (*position)[3], (*normal)[3], (*uv)[2], (*tangent)[4]; /* [index_count] */
    uint32_t *sources; /* [index_count]: of the vertices that are made, the one of `from` */
    uint32_t *next;    /* [index_count]: the next made of the same one; NONE */
    uint32_t *first;   /* [from->count]: the first made of each; NONE */
} corners;

enum { NONE = UINT32_MAX };

static const float *coordinates_of(const tl_model *model, const tl_part *part)
{
    const tl_texture_slot *slot = &model->materials[part->material].slots[TL_GLTF_NORMAL_MAP];
    return model->vertices[part->vertices].attributes[TL_GLTF_TEXCOORD_0 + slot->coordinates];
}

static bool wants_tangents(const tl_model *model, const tl_part *part)
{
    return part->index_count > 0 &&
           model->materials[part->material].slots[TL_GLTF_NORMAL_MAP].texture != -1 &&
           !model->vertices[part->vertices].attributes[TL_GLTF_TANGENT] &&
           coordinates_of(model, part);
}

static tl_status allocate(const tl_part *part, corners *c, tl_error *err)
{
    const size_t count = part->index_count;
    c->position = malloc(count * sizeof *c->position);
    c->normal = malloc(count * sizeof *c->normal);
    c->uv = malloc(count * sizeof *c->uv);
    c->tangent = malloc(count * sizeof *c->tangent);
    c->sources = malloc(count * sizeof *c->sources);
    c->next = malloc(count * sizeof *c->next);
    c->first = malloc(c->from->count * sizeof *c->first);
    if (!c->position || !c->normal || !c->uv || !c->tangent || !c->sources || !c->next ||
        !c->first)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
    memset(c->first, 0xff, c->from->count * sizeof *c->first);
    return TL_OK;
}

static void release(corners *c)
{
    free(c->position);
    free(c->normal);
    free(c->uv);
    free(c->tangent);
    free(c->sources);
    free(c->next);
    free(c->first);
}

/* The map's own directions are wanted: its coordinates as the lookup transforms them. */
static void take_apart(const tl_model *model, const tl_part *part, corners *c)
{
    const tl_texture_slot *slot = &model->materials[part->material].slots[TL_GLTF_NORMAL_MAP];
    const float *coordinates = coordinates_of(model, part);
    for (size_t i = 0; i < part->index_count; i++) {
        const size_t vertex = part->indices[i];
        const float *st = coordinates + 2 * vertex;
        memcpy(c->position[i], c->from->attributes[TL_GLTF_POSITION] + 3 * vertex,
               sizeof c->position[i]);
        memcpy(c->normal[i], c->from->attributes[TL_GLTF_NORMAL] + 3 * vertex,
               sizeof c->normal[i]);
        for (int k = 0; k < 2; k++)
            c->uv[i][k] = slot->uv_from_coordinates[k][0] * st[0] +
                          slot->uv_from_coordinates[k][1] * st[1] +
                          slot->uv_from_coordinates[k][2];
    }
}

/* Corners of one vertex with one tangent are one vertex again. indices becomes those of the made
 * vertices; how many there are. Their tangents stand at the front of c->tangent. */
static size_t put_together(const tl_part *part, corners *c)
{
    size_t count = 0;
    for (size_t i = 0; i < part->index_count; i++) {
        const uint32_t source = part->indices[i];
        uint32_t made = c->first[source];
        while (made != NONE &&
               memcmp(c->tangent[made], c->tangent[i], sizeof c->tangent[i]) != 0)
            made = c->next[made];
        if (made == NONE) {
            made = (uint32_t)count++;
            memmove(c->tangent[made], c->tangent[i], sizeof c->tangent[i]);
            c->sources[made] = source;
            c->next[made] = c->first[source];
            c->first[source] = made;
        }
        part->indices[i] = made;
    }
    return count;
}

static tl_status copy_vertices(const corners *c, size_t count, tl_vertices *out, tl_error *err)
{
    out->count = count;
    for (int i = 0; i < TL_GLTF_ATTRIBUTE_COUNT; i++) {
        const size_t width = (size_t)tl_accessor_width(i);
        const float *from = i == TL_GLTF_TANGENT ? &c->tangent[0][0] : c->from->attributes[i];
        if (!from)
            continue;
        out->attributes[i] = malloc(count * width * sizeof(float));
        if (!out->attributes[i])
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
        for (size_t k = 0; k < count; k++)
            memcpy(out->attributes[i] + width * k,
                   from + width * (i == TL_GLTF_TANGENT ? k : c->sources[k]),
                   width * sizeof(float));
    }
    out->sources = malloc(count * sizeof *out->sources);
    if (!out->sources)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
    for (size_t k = 0; k < count; k++)
        out->sources[k] = c->from->sources ? c->from->sources[c->sources[k]] : c->sources[k];
    return TL_OK;
}

static tl_status make_tangents(const tl_model *model,
                               const tl_part *part,
                               tl_vertices *out,
                               tl_error *err)
{
    tl_status status = TL_OK;
    corners c = {.from = &model->vertices[part->vertices]};
    TRY(allocate(part, &c, err));
    take_apart(model, part, &c);
    const tl_corners given = {part->index_count / 3, (const float(*)[3])c.position,
                              (const float(*)[3])c.normal, (const float(*)[2])c.uv};
    TRY(tl_tangent_space(&given, c.tangent, err));
    TRY(copy_vertices(&c, put_together(part, &c), out, err));
done:
    release(&c);
    return status;
}

/* Parts are independent; a vertices apiece is made for those that want tangents. */
typedef struct job {
    const tl_model *model;
    tl_vertices *made; /* [part_count] */
    tl_error *errors;  /* [part_count] */
} job;

static void make_some(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t i = begin; i < end; i++)
        if (wants_tangents(j->model, &j->model->parts[i]))
            (void)make_tangents(j->model, &j->model->parts[i], &j->made[i], &j->errors[i]);
}

static tl_status append(tl_model *model, const job *j, tl_error *err)
{
    tl_vertices *grown = realloc(
        model->vertices, (model->vertices_count + model->part_count + 1) * sizeof *grown);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for tangents", model->gltf->path);
    model->vertices = grown;
    for (size_t i = 0; i < model->part_count; i++) {
        if (j->made[i].count == 0)
            continue;
        model->parts[i].vertices = model->vertices_count;
        model->vertices[model->vertices_count++] = j->made[i];
        j->made[i] = (tl_vertices){0};
    }
    return TL_OK;
}

tl_status tl_load_tangents(tl_model *model, tl_error *err)
{
    tl_status status = TL_OK;
    job j = {.model = model,
             .made = calloc(model->part_count + 1, sizeof *j.made),
             .errors = calloc(model->part_count + 1, sizeof *j.errors)};
    if (!j.made || !j.errors)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for tangents", model->gltf->path));
    tl_parallel(model->part_count, 1, make_some, &j);
    for (size_t i = 0; i < model->part_count; i++)
        if (j.errors[i].status != TL_OK)
            TRY(tl_fail(err, j.errors[i].status, "%s: %s", model->gltf->path,
                        j.errors[i].message));
    TRY(append(model, &j, err));
done:
    for (size_t i = 0; j.made && i < model->part_count; i++)
        tl_vertices_clear(&j.made[i]);
    free(j.made);
    free(j.errors);
    return status;
}
