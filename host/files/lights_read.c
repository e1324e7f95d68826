#include "tilelight/lights.h"

#include "light_fields.h"
#include "suggest.h"
#include "try.h"
#include "whole_file.h"

#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KNOWN_VERSION = 1, MAX_LIGHTS = 10000000, MAX_WORDS = 32 };

/* Where a value stands, for sentences: "lights.json: lights[3] "key"" or the file alone. */
typedef struct place {
    const char *source;
    char light[96]; /* "" outside lights */
} place;

static place place_of_light(const char *source, size_t index, const json_t *light)
{
    place at = {.source = source};
    const char *name = json_string_value(json_object_get(light, "name"));
    if (name && name[0])
        snprintf(at.light, sizeof at.light, " lights[%zu] \"%.60s\":", index, name);
    else
        snprintf(at.light, sizeof at.light, " lights[%zu]:", index);
    return at;
}

/* Fields of the format that this version cannot light yet. Some have a value that asks for
 * nothing. */
static const struct {
    const char *name;
    enum { NEVER, IF_FALSE, IF_ZERO } harmless;
} later_fields[] = {
    {"ambient", IF_ZERO}, {"castsShadow", IF_FALSE}, {"texture", NEVER},
    {"lut", NEVER},       {"group", NEVER},
};
enum { LATER_COUNT = sizeof later_fields / sizeof later_fields[0] };

static tl_status unknown_field(const place *at,
                               const char *key,
                               const char *const *words,
                               size_t word_count,
                               tl_error *err)
{
    const char *meant = tl_suggest(key, words, word_count);
    return tl_fail(err, TL_ERR_FORMAT, "%s:%s unknown field \"%.64s\"%s%s%s", at->source,
                   at->light, key, meant ? "; did you mean \"" : "", meant ? meant : "",
                   meant ? "\"?" : "");
}

static tl_status check_later(const place *at,
                             const char *key,
                             const json_t *value,
                             tl_error *err)
{
    const char *words[MAX_WORDS] = {"type"};
    size_t word_count = 1;
    for (size_t i = 0; i < LATER_COUNT; i++) {
        if (strcmp(key, later_fields[i].name) != 0)
            continue;
        if ((later_fields[i].harmless == IF_FALSE && json_is_false(value)) ||
            (later_fields[i].harmless == IF_ZERO && json_is_number(value) &&
             fpclassify(json_number_value(value)) == FP_ZERO))
            return TL_OK;
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s:%s field \"%s\" is not supported by this version; remove it",
                       at->source, at->light, key);
    }
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++)
        words[word_count++] = tl_light_fields[i].name;
    for (size_t i = 0; i < LATER_COUNT; i++)
        words[word_count++] = later_fields[i].name;
    return unknown_field(at, key, words, word_count, err);
}

static tl_status read_number(
    const place *at, const char *field, const json_t *value, float *out, tl_error *err)
{
    if (!json_is_number(value))
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be a number", at->source,
                       at->light, field);
    const float number = (float)json_number_value(value);
    if (!isfinite(number))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"%s\" is %g: larger than a float holds (3.4e38)", at->source,
                       at->light, field, json_number_value(value));
    *out = number;
    return TL_OK;
}

static tl_status read_vector(
    const place *at, const char *field, const json_t *value, float out[3], tl_error *err)
{
    tl_status status = TL_OK;
    float read[3];
    if (!json_is_array(value) || json_array_size(value) != 3)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be an array of three numbers",
                    at->source, at->light, field));
    for (size_t i = 0; i < 3; i++)
        TRY(read_number(at, field, json_array_get(value, i), &read[i], err));
    memcpy(out, read, sizeof read);
done:
    return status;
}

/* A direction that was of length 1 before it was rounded to float is kept as it is, so that what
 * tl_lights_format wrote reads back bit for bit: rounding, and normalising in float, move the
 * squared length by less than 16 * 2^-24. */
static tl_status read_unit(
    const place *at, const char *field, const json_t *value, float out[3], tl_error *err)
{
    static const double rounding = 1e-6;
    tl_status status = TL_OK;
    float read[3];
    TRY(read_vector(at, field, value, read, err));
    const double x = (double)read[0], y = (double)read[1], z = (double)read[2];
    const double length2 = x * x + y * y + z * z;
    if (!(length2 > 0.0))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" has no length: it points nowhere",
                    at->source, at->light, field));
    const double scale = fabs(length2 - 1.0) <= rounding ? 1.0 : 1.0 / sqrt(length2);
    for (int i = 0; i < 3; i++)
        out[i] = (float)((double)read[i] * scale);
done:
    return status;
}

/* The index of a word among `words`. */
static tl_status read_word(const place *at,
                           const char *field,
                           const json_t *value,
                           const char *const *words,
                           int word_count,
                           int *out,
                           tl_error *err)
{
    const char *word = json_string_value(value);
    char known[128] = "";
    for (int i = 0; i < word_count; i++) {
        if (word && strcmp(word, words[i]) == 0) {
            *out = i;
            return TL_OK;
        }
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s\"%s\"", i == 0 ? "" : ", ", words[i]);
    }
    if (!word)
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be one of %s", at->source,
                       at->light, field, known);
    return tl_fail(err, TL_ERR_FORMAT, "%s:%s unknown %s \"%.64s\"; it must be one of %s",
                   at->source, at->light, field, word, known);
}

static tl_status read_falloff(
    const place *at, const char *field, const json_t *value, tl_falloff *out, tl_error *err)
{
    int index = 0;
    const char *word = json_string_value(value);
    if (word && strcmp(word, "lut") == 0)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s:%s falloff \"lut\" is not supported by this version", at->source,
                       at->light);
    const tl_status status =
        read_word(at, field, value, tl_falloff_words, TL_FALLOFF_COUNT, &index, err);
    if (status == TL_OK)
        *out = (tl_falloff)index;
    return status;
}

/* Names are for messages: a long one is cut, between characters of UTF-8. */
static tl_status read_name(
    const place *at, const char *field, const json_t *value, char out[64], tl_error *err)
{
    const char *name = json_string_value(value);
    if (!name)
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be a string", at->source,
                       at->light, field);
    size_t length = strlen(name);
    if (length > sizeof(tl_light){0}.name - 1)
        length = sizeof(tl_light){0}.name - 1;
    while (length > 0 && ((unsigned char)name[length] & 0xc0) == 0x80)
        length--;
    memcpy(out, name, length);
    out[length] = '\0';
    return TL_OK;
}

static tl_status read_field(const place *at,
                            const tl_light_field *field,
                            const json_t *value,
                            tl_light *light,
                            tl_error *err)
{
    void *to = (char *)light + field->offset;
    switch (field->kind) {
    case TL_FIELD_NUMBER: return read_number(at, field->name, value, to, err);
    case TL_FIELD_VECTOR: return read_vector(at, field->name, value, to, err);
    case TL_FIELD_UNIT: return read_unit(at, field->name, value, to, err);
    case TL_FIELD_FALLOFF: return read_falloff(at, field->name, value, to, err);
    case TL_FIELD_NAME: break;
    }
    return read_name(at, field->name, value, to, err);
}

/* One "key": value of a light whose type is known. */
static tl_status read_member(
    const place *at, const char *key, const json_t *value, tl_light *light, tl_error *err)
{
    if (strcmp(key, "type") == 0)
        return TL_OK;
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++) {
        const tl_light_field *field = &tl_light_fields[i];
        if (strcmp(key, field->name) != 0)
            continue;
        if (!(field->types >> light->type & 1))
            return tl_fail(err, TL_ERR_FORMAT, "%s:%s a %s light has no \"%s\"; remove it",
                           at->source, at->light, tl_light_type_words[light->type], key);
        return read_field(at, field, value, light, err);
    }
    return check_later(at, key, value, err);
}

static tl_status read_light(
    const char *source, size_t index, json_t *object, tl_light *out, tl_error *err)
{
    tl_status status = TL_OK;
    const place at = place_of_light(source, index, object);
    tl_light light = tl_light_default();
    int type = 0;
    const char *key;
    json_t *value;

    if (!json_is_object(object))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s must be an object", source, at.light));
    TRY(read_word(&at, "type", json_object_get(object, "type"), tl_light_type_words,
                  TL_LIGHT_TYPE_COUNT, &type, err));
    light.type = (tl_light_type)type;
    json_object_foreach(object, key, value) TRY(read_member(&at, key, value, &light, err));
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++) {
        const tl_light_field *field = &tl_light_fields[i];
        if (field->is_required && (field->types >> type & 1) &&
            !json_object_get(object, field->name))
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s a %s light needs \"%s\"", source, at.light,
                        tl_light_type_words[type], field->name));
    }
    *out = light;
done:
    return status;
}

static tl_status read_lights(const place *at, json_t *array, tl_light_set *set, tl_error *err)
{
    tl_status status = TL_OK;
    size_t i;
    json_t *object;
    if (!json_is_array(array))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: \"lights\" must be an array", at->source));
    if (json_array_size(array) > MAX_LIGHTS)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: %zu lights; %d at most are read", at->source,
                    json_array_size(array), MAX_LIGHTS));
    json_array_foreach(array, i, object)
    {
        tl_light light;
        TRY(read_light(at->source, i, object, &light, err));
        TRY(tl_light_set_add(set, &light, err));
    }
done:
    return status;
}

static tl_status read_ambient(const place *at, json_t *value, tl_light_set *set, tl_error *err)
{
    return read_vector(at, "ambient", value, set->ambient, err);
}

static tl_status read_sky(const place *at, json_t *sky, tl_light_set *set, tl_error *err)
{
    static const char *const words[] = {"type", "color"};
    static const char *const later[] = {"gradient", "latlong"};
    tl_status status = TL_OK;
    const place in_sky = {.source = at->source, .light = " sky:"};
    const char *type = json_string_value(json_object_get(sky, "type"));
    const char *key;
    json_t *value;
    if (!json_is_object(sky) || !type)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: \"sky\" must be an object with a \"type\"",
                    at->source));
    for (size_t i = 0; i < sizeof later / sizeof later[0]; i++)
        if (strcmp(type, later[i]) == 0)
            TRY(tl_fail(
                err, TL_ERR_UNSUPPORTED,
                "%s: a sky of type \"%s\" is not supported by this version; \"constant\" "
                "is",
                at->source, type));
    if (strcmp(type, "constant") != 0)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: unknown sky type \"%.64s\"; it must be \"constant\"", at->source,
                    type));
    json_object_foreach(sky, key,
                        value) if (strcmp(key, "type") != 0 && strcmp(key, "color") != 0)
        TRY(unknown_field(&in_sky, key, words, 2, err));
    if (!json_object_get(sky, "color"))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: a constant sky needs \"color\"", at->source));
    TRY(read_vector(&in_sky, "color", json_object_get(sky, "color"), set->sky, err));
done:
    return status;
}

static tl_status read_version(const place *at, json_t *value, tl_light_set *set, tl_error *err)
{
    (void)set;
    if (!json_is_integer(value))
        return tl_fail(err, TL_ERR_FORMAT, "%s: \"tilelight\" must be the version, 1",
                       at->source);
    if (json_integer_value(value) != KNOWN_VERSION)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: is a lights file of version %lld; this program reads version %d",
                       at->source, (long long)json_integer_value(value), KNOWN_VERSION);
    return TL_OK;
}

static tl_status read_materials(const place *at,
                                json_t *materials,
                                tl_light_set *set,
                                tl_error *err)
{
    static const char *const words[] = {"model"};
    tl_status status = TL_OK;
    const place inside = {.source = at->source, .light = " materials:"};
    const char *key;
    json_t *value;
    int index = set->model;
    if (!json_is_object(materials))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: \"materials\" must be an object", at->source));
    json_object_foreach(materials, key, value) if (strcmp(key, "model") != 0)
        TRY(unknown_field(&inside, key, words, 1, err));
    value = json_object_get(materials, "model");
    if (value)
        TRY(read_word(&inside, "model", value, tl_model_words, TL_MODEL_COUNT, &index, err));
    set->model = (enum tl_shading_model)index;
done:
    return status;
}

static tl_status read_top(const char *source, json_t *root, tl_light_set *set, tl_error *err)
{
    static const struct {
        const char *name;
        tl_status (*read)(const place *at, json_t *value, tl_light_set *set, tl_error *err);
    } members[] = {{"tilelight", read_version},
                   {"ambient", read_ambient},
                   {"sky", read_sky},
                   {"lights", read_lights},
                   {"materials", read_materials}};
    enum { MEMBER_COUNT = sizeof members / sizeof members[0] };
    tl_status status = TL_OK;
    const place at = {.source = source};
    const char *words[MEMBER_COUNT], *key;
    json_t *value;

    if (!json_object_get(root, "tilelight"))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: is no lights file: it must be an object with \"tilelight\": 1",
                    source));
    /* The version first, whatever the order: it says what the rest means. */
    TRY(read_version(&at, json_object_get(root, "tilelight"), set, err));
    for (size_t i = 0; i < MEMBER_COUNT; i++)
        words[i] = members[i].name;
    json_object_foreach(root, key, value)
    {
        size_t i = 0;
        while (i < MEMBER_COUNT && strcmp(key, members[i].name) != 0)
            i++;
        if (i == MEMBER_COUNT)
            TRY(unknown_field(&at, key, words, MEMBER_COUNT, err));
        TRY(members[i].read(&at, value, set, err));
    }
done:
    return status;
}

tl_status tl_lights_parse(
    const char *text, size_t size, const char *source, tl_light_set *set, tl_error *err)
{
    tl_status status = TL_OK;
    tl_light_set made = {0};
    json_error_t error;
    json_t *root = NULL;

    if (size > TL_LIGHTS_TEXT_LIMIT)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: is larger than the %zu MiB that are read", source,
                    TL_LIGHTS_TEXT_LIMIT >> 20));
    root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (!root && json_error_code(&error) == json_error_out_of_memory)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its lights", source));
    if (!root)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: line %d, column %d: is not JSON: %s", source,
                    error.line, error.column, error.text));
    TRY(read_top(source, root, &made, err));
    TRY(tl_light_set_check(&made, source, err));
    tl_light_set_clear(set);
    *set = made;
    made = (tl_light_set){0};
done:
    tl_light_set_clear(&made);
    json_decref(root);
    return status;
}

tl_status tl_lights_read(const char *path, tl_light_set *set, tl_error *err)
{
    char *text = NULL;
    size_t size = 0;
    tl_status status = tl_whole_file_read(path, TL_LIGHTS_TEXT_LIMIT, &text, &size, err);
    if (status == TL_OK)
        status = tl_lights_parse(text, size, strcmp(path, "-") == 0 ? "standard input" : path,
                                 set, err);
    free(text);
    return status;
}
