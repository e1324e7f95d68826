#include "material_rows.h"

#include "largest.h"
#include "light_words.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIELD(name, parameter, count, member, least, most)                         \
    {                                                                              \
        name, parameter, count, offsetof(tl_material_row, member), (least), (most) \
    }

const tl_material_field tl_material_fields[TL_MATERIAL_FIELD_COUNT] = {
    FIELD("diffuse", TL_TAKES_DIFFUSE, 3, diffuse, 0.0f, 1.0f),
    FIELD("specular", TL_TAKES_SPECULAR, 3, specular, 0.0f, 1.0f),
    FIELD("shininess", TL_TAKES_EXPONENT, 1, exponent, 0.0f, 10000.0f),
    FIELD("roughness", TL_TAKES_ROUGHNESS, 1, roughness, 0.0f, 1.0f),
    FIELD("roughnessAcross", TL_TAKES_ACROSS, 1, across, 0.0f, 1.0f),
    FIELD("direction", TL_TAKES_DIRECTION, 3, direction, -TL_LONGEST, TL_LONGEST),
    FIELD("k", TL_TAKES_K, 1, k, 0.0f, 100.0f),
};

uint32_t tl_model_takes(enum tl_shading_model model)
{
    static const uint32_t takes[TL_MODEL_COUNT] = {
#define TAKES(name, word, traits, parameters, source) [name] = (parameters),
        TL_MODELS(TAKES)
#undef TAKES
    };
    return takes[model];
}

const float *tl_material_values(const tl_material_row *row, const tl_material_field *field)
{
    return (const float *)(const void *)((const char *)row + field->offset);
}

tl_material_label tl_material_label_of(const tl_light_set *set, size_t row)
{
    tl_material_label label;
    const char *name = set->materials[row].material;
    if (name[0])
        snprintf(label.text, sizeof label.text, "materials[%zu] \"%s\"", row, name);
    else
        snprintf(label.text, sizeof label.text, "materials[%zu]", row);
    return label;
}

tl_material_row tl_material_row_default(void)
{
    return (tl_material_row){
        .roughness = 1.0f, .across = 1.0f, .direction = {0.0f, 1.0f, 0.0f}, .k = 1.0f};
}

tl_status tl_light_set_add_material(tl_light_set *set,
                                    const tl_material_row *row,
                                    tl_error *err)
{
    tl_material_row *grown = realloc(set->materials, (set->material_count + 1) * sizeof *grown);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for materials");
    set->materials = grown;
    set->materials[set->material_count++] = *row;
    return TL_OK;
}

/* Among the rows before it; material_count: none. */
static size_t row_before(const tl_light_set *set, size_t row)
{
    const tl_material_row *of = &set->materials[row];
    for (size_t i = 0; i < row; i++) {
        const tl_material_row *other = &set->materials[i];
        if (of->material[0] ? strcmp(of->material, other->material) == 0
                            : !other->material[0] && of->index == other->index)
            return i;
    }
    return set->material_count;
}

static tl_status check_index(const tl_light_set *set,
                             size_t row,
                             const char *source,
                             tl_error *err)
{
    const tl_material_label label = tl_material_label_of(set, row);
    const uint32_t index = set->materials[row].index;
    const size_t before = row_before(set, row);
    if (!set->materials[row].material[0] && (index < 1 || index > TL_MAX_MATERIALS))
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s: \"index\" is %u, it must be from 1 to %d",
                       source, label.text, index, TL_MAX_MATERIALS);
    if (before == set->material_count)
        return TL_OK;
    if (set->materials[row].material[0])
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: materials[%zu] is for that material already", source,
                       label.text, before);
    return tl_fail(err, TL_ERR_FORMAT, "%s: %s: index %u has a row already, materials[%zu]",
                   source, label.text, index, before);
}

static tl_status check_range(const tl_light_set *set,
                             size_t row,
                             const tl_material_field *field,
                             const char *source,
                             tl_error *err)
{
    const tl_material_label label = tl_material_label_of(set, row);
    const float *values = tl_material_values(&set->materials[row], field);
    float most = 0.0f;
    for (uint32_t i = 0; i < field->count; i++) {
        if (!(values[i] >= field->least && values[i] <= field->most))
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s: \"%s\" is %g, it must be from %g to %g",
                           source, label.text, field->name, (double)values[i],
                           (double)field->least, (double)field->most);
        most = values[i] > most ? values[i] : -values[i] > most ? -values[i] : most;
    }
    if (field->most == TL_LONGEST && !(most >= TL_SHORTEST))
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s: \"%s\" has no length: it points nowhere",
                       source, label.text, field->name);
    return TL_OK;
}

static tl_status check_fields(const tl_light_set *set,
                              size_t row,
                              const char *source,
                              tl_error *err)
{
    const tl_material_row *of = &set->materials[row];
    const tl_material_label label = tl_material_label_of(set, row);
    if ((unsigned)of->model >= TL_MODEL_COUNT)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s: there is no shading model %u", source,
                       label.text, (unsigned)of->model);
    for (size_t i = 0; i < TL_MATERIAL_FIELD_COUNT; i++) {
        const tl_material_field *field = &tl_material_fields[i];
        if (!(of->given & field->parameter))
            continue;
        if (!(tl_model_takes(of->model) & field->parameter))
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s: the model %s takes no \"%s\"; remove it", source,
                           label.text, tl_model_words[of->model], field->name);
        const tl_status status = check_range(set, row, field, source, err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

tl_status tl_material_rows_check(const tl_light_set *set, const char *source, tl_error *err)
{
    tl_status status = TL_OK;
    if (set->material_count > TL_MAX_MATERIALS)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %zu materials; there are %d at most", source,
                       set->material_count, TL_MAX_MATERIALS);
    for (size_t row = 0; row < set->material_count && status == TL_OK; row++) {
        status = check_index(set, row, source, err);
        if (status == TL_OK)
            status = check_fields(set, row, source, err);
    }
    return status;
}
