#include "brdf_table.h"

#include "material_rows.h"
#include "try.h"

#include <stdio.h>
#include <string.h>

static tl_brdf row_of(const tl_material_row *from)
{
    tl_brdf row = {.model = from->model,
                   .given = from->given,
                   .exponent = from->exponent,
                   .k = from->k,
                   .roughness = from->roughness,
                   .across = from->across};
    memcpy(row.diffuse, from->diffuse, sizeof row.diffuse);
    memcpy(row.specular, from->specular, sizeof row.specular);
    memcpy(row.direction, from->direction, sizeof row.direction);
    return row;
}

static tl_status put_row(
    tl_brdf_table *table, const tl_light_set *set, size_t row, uint32_t index, tl_error *err)
{
    if (table->sources[index] >= 0)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s of the lights: index %u has a row already, materials[%d]",
                       tl_material_label_of(set, row).text, index, table->sources[index]);
    table->rows[index] = row_of(&set->materials[row]);
    table->sources[index] = (int)row;
    return TL_OK;
}

/* As many of the names as fit. */
static void list_names(const tl_material_names *names, char *text, size_t size)
{
    size_t length = 0;
    text[0] = '\0';
    for (uint32_t i = 0; i < names->count && length < size; i++)
        if (names->of[i][0])
            length += (size_t)snprintf(text + length, size - length, "%s\"%s\"",
                                       length ? ", " : "", names->of[i]);
    if (length >= size)
        strcpy(text + size - 4, "...");
}

static tl_status no_such_material(const tl_gbuffer *gbuffer,
                                  const tl_light_set *set,
                                  size_t row,
                                  tl_error *err)
{
    char names[512];
    const tl_material_label label = tl_material_label_of(set, row);
    if (gbuffer->materials.count == 0)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s of the lights: the capture names no materials; capture it with "
                       "--materials, or give the row an \"index\"",
                       label.text);
    list_names(&gbuffer->materials, names, sizeof names);
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s of the lights: the capture has no material of this name; it has %s",
                   label.text, names);
}

/* A name may be that of several materials: the row is for all of them. */
static tl_status put_named(const tl_gbuffer *gbuffer,
                           const tl_light_set *set,
                           size_t row,
                           tl_brdf_table *table,
                           tl_error *err)
{
    tl_status status = TL_OK;
    bool is_found = false;
    for (uint32_t i = 0; i < gbuffer->materials.count; i++) {
        if (strcmp(gbuffer->materials.of[i], set->materials[row].material) != 0)
            continue;
        is_found = true;
        TRY(put_row(table, set, row, i + 1, err));
    }
    if (!is_found)
        TRY(no_such_material(gbuffer, set, row, err));
done:
    return status;
}

/* Indices that are not known to be absent count where they have a row. */
static void find_what_occurs(const tl_gbuffer *gbuffer, tl_brdf_table *table)
{
    const uint32_t telling = gbuffer->present & ~gbuffer->neutral;
    for (uint32_t i = 0; i < TL_BRDF_COUNT; i++) {
        table->occurs[i] = !(telling & TL_GROUP_BRDF) ? i == 0
                           : gbuffer->knows_indices   ? gbuffer->indices[i / 32] >> i % 32 & 1u
                                                      : i == 0 || table->sources[i] >= 0;
        if (!table->occurs[i])
            continue;
        table->selects |= table->sources[i] >= 0;
        table->models |= 1u << table->rows[i].model;
    }
}

static tl_status check_what_occurs(const tl_gbuffer *gbuffer,
                                   const tl_brdf_table *table,
                                   tl_error *err)
{
    const uint32_t named = tl_gbuffer_owner(gbuffer)->materials.count;
    for (uint32_t i = named + 1; i < TL_BRDF_COUNT; i++)
        if (table->occurs[i] && table->sources[i] < 0)
            return tl_fail(
                err, TL_ERR_FORMAT,
                "the capture has pixels of index %u, for which the lights have no row "
                "in \"materials\", and which it gives no name; add a row with "
                "\"index\": %u",
                i, i);
    return TL_OK;
}

tl_status tl_brdf_table_make(const tl_gbuffer *gbuffer,
                             const tl_light_set *lights,
                             tl_brdf_table *out,
                             tl_error *err)
{
    tl_status status = TL_OK;
    *out = (tl_brdf_table){.models = 0};
    for (int i = 0; i < TL_BRDF_COUNT; i++) {
        out->rows[i].model = lights->model;
        out->sources[i] = -1;
    }
    for (size_t row = 0; row < lights->material_count; row++)
        if (!lights->materials[row].material[0])
            TRY(put_row(out, lights, row, lights->materials[row].index, err));
    for (size_t row = 0; row < lights->material_count; row++)
        if (lights->materials[row].material[0])
            TRY(put_named(tl_gbuffer_owner(gbuffer), lights, row, out, err));
    find_what_occurs(gbuffer, out);
    if (out->models == 0) /* a frame of sky */
        out->models = 1u << lights->model;
    if (lights->material_count > 0)
        TRY(check_what_occurs(gbuffer, out, err));
done:
    return status;
}
