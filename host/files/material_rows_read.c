#include "material_rows_read.h"

#include "material_rows.h"
#include "try.h"

#include <string.h>

static tl_status read_index(const tl_place *at,
                            const json_t *value,
                            tl_material_row *row,
                            tl_error *err)
{
    const json_int_t index = json_integer_value(value);
    if (!json_is_integer(value) || index < 1 || index > TL_MAX_MATERIALS)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"index\" must be a whole number from 1 to %d", at->source,
                       at->inside, TL_MAX_MATERIALS);
    row->index = (uint32_t)index;
    return TL_OK;
}

/* A name is matched with the capture's, so none is cut. */
static tl_status read_name(const tl_place *at,
                           const json_t *value,
                           tl_material_row *row,
                           tl_error *err)
{
    const char *name = json_string_value(value);
    if (!name || !name[0])
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"material\" must be the name of a material",
                       at->source, at->inside);
    if (strlen(name) >= sizeof row->material)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"material\" is longer than %zu bytes; name it by its \"index\"",
                       at->source, at->inside, sizeof row->material - 1);
    strcpy(row->material, name);
    row->index = 0;
    return TL_OK;
}

static tl_status read_parameter(const tl_place *at,
                                const char *key,
                                const json_t *value,
                                tl_material_row *row,
                                tl_error *err)
{
    const char *words[TL_MATERIAL_FIELD_COUNT + 3] = {"index", "material", "model"};
    for (size_t i = 0; i < TL_MATERIAL_FIELD_COUNT; i++) {
        const tl_material_field *field = &tl_material_fields[i];
        float *to = (float *)(void *)((char *)row + field->offset);
        words[3 + i] = field->name;
        if (strcmp(key, field->name) != 0)
            continue;
        row->given |= field->parameter;
        return field->count == 3 ? tl_read_vector(at, key, value, to, err)
                                 : tl_read_number(at, key, value, to, err);
    }
    return tl_unknown_field(at, key, words, sizeof words / sizeof words[0], err);
}

static tl_status read_row(
    const tl_place *at, json_t *object, size_t position, tl_light_set *set, tl_error *err)
{
    tl_status status = TL_OK;
    tl_material_row row = tl_material_row_default();
    const char *key;
    json_t *value;
    row.index = (uint32_t)position + 1;
    row.model = set->model;
    if (!json_is_object(object))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s must be an object", at->source, at->inside));
    if (json_object_get(object, "index") && json_object_get(object, "material"))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s:%s \"index\" and \"material\" exclude each other; remove one",
                    at->source, at->inside));
    json_object_foreach(object, key, value)
    {
        if (strcmp(key, "index") == 0)
            TRY(read_index(at, value, &row, err));
        else if (strcmp(key, "material") == 0)
            TRY(read_name(at, value, &row, err));
        else if (strcmp(key, "model") == 0)
            TRY(tl_read_model(at, value, &row.model, err));
        else
            TRY(read_parameter(at, key, value, &row, err));
    }
    TRY(tl_light_set_add_material(set, &row, err));
done:
    return status;
}

/* What came before there were rows. */
static tl_status read_model_alone(const tl_place *at,
                                  json_t *object,
                                  tl_light_set *set,
                                  tl_error *err)
{
    static const char *const words[] = {"model"};
    const tl_place inside = {.source = at->source, .inside = " materials:"};
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value)
    {
        const tl_status status = strcmp(key, "model") == 0
                                     ? tl_read_model(&inside, value, &set->model, err)
                                     : tl_unknown_field(&inside, key, words, 1, err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

tl_status tl_read_materials(const tl_place *at,
                            json_t *materials,
                            tl_light_set *set,
                            tl_error *err)
{
    tl_status status = TL_OK;
    size_t i;
    json_t *row;
    if (json_is_object(materials))
        return read_model_alone(at, materials, set, err);
    if (!json_is_array(materials))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: \"materials\" must be an array", at->source));
    if (json_array_size(materials) > TL_MAX_MATERIALS)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: %zu materials; there are %d at most", at->source,
                    json_array_size(materials), TL_MAX_MATERIALS));
    json_array_foreach(materials, i, row)
    {
        const tl_place inside = tl_place_in(at->source, "materials", i, row, "material");
        TRY(read_row(&inside, row, i, set, err));
    }
done:
    return status;
}
