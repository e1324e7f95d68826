#include "tilelight/lights.h"

#include "light_fields.h"
#include "light_images.h"
#include "light_profiles.h"
#include "light_values.h"
#include "link_read.h"
#include "material_rows_read.h"
#include "sky_read.h"
#include "try.h"
#include "whole_file.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { KNOWN_VERSION = 1, MAX_LIGHTS = 10000000 };

static tl_status refuse_unknown(const tl_place *at, const char *key, tl_error *err)
{
    const char *words[1 + TL_LIGHT_FIELD_COUNT] = {"type"};
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++)
        words[1 + i] = tl_light_fields[i].name;
    return tl_unknown_field(at, key, words, 1 + TL_LIGHT_FIELD_COUNT, err);
}

static tl_status read_falloff(
    const tl_place *at, const char *field, const json_t *value, tl_falloff *out, tl_error *err)
{
    int index = 0;
    const tl_status status =
        tl_read_word(at, field, value, tl_falloff_words, TL_FALLOFF_COUNT, &index, err);
    if (status == TL_OK)
        *out = (tl_falloff)index;
    return status;
}

static tl_status read_scale(const tl_place *at,
                            const char *field,
                            const json_t *value,
                            tl_profile_scale *out,
                            tl_error *err)
{
    int index = 0;
    const tl_status status = tl_read_word(at, field, value, tl_profile_scale_words,
                                          TL_PROFILE_SCALE_COUNT, &index, err);
    if (status == TL_OK)
        *out = (tl_profile_scale)index;
    return status;
}

static tl_status read_table(const tl_place *at,
                            const char *field,
                            const json_t *value,
                            tl_light_set *set,
                            uint32_t *out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    const size_t count = json_array_size(value); /* 0 of what is no array */
    float read[TL_MOST_SAMPLES];
    if (count < TL_LEAST_SAMPLES || count > TL_MOST_SAMPLES)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be an array of %d to %d numbers",
                    at->source, at->inside, field, TL_LEAST_SAMPLES, TL_MOST_SAMPLES));
    for (size_t i = 0; i < count; i++)
        TRY(tl_read_number(at, field, json_array_get(value, i), &read[i], err));
    TRY(tl_light_set_add_table(set, read, (uint32_t)count, out, err));
done:
    return status;
}

static tl_status read_name(
    const tl_place *at, const char *field, const json_t *value, char out[64], tl_error *err)
{
    const char *name = json_string_value(value);
    if (!name)
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be a string", at->source,
                       at->inside, field);
    tl_light_text(name, out);
    return TL_OK;
}

static tl_status read_flag(
    const tl_place *at, const char *field, const json_t *value, uint32_t *out, tl_error *err)
{
    if (!json_is_boolean(value))
        return tl_fail(err, TL_ERR_FORMAT, "%s:%s \"%s\" must be true or false", at->source,
                       at->inside, field);
    *out = json_is_true(value);
    return TL_OK;
}

static tl_status read_field(const tl_place *at,
                            const tl_light_field *field,
                            const json_t *value,
                            tl_light_set *set,
                            tl_light *light,
                            tl_error *err)
{
    void *to = (char *)light + field->offset;
    switch (field->kind) {
    case TL_FIELD_NUMBER: return tl_read_number(at, field->name, value, to, err);
    case TL_FIELD_VECTOR: return tl_read_vector(at, field->name, value, to, err);
    case TL_FIELD_UNIT: return tl_read_unit(at, field->name, value, to, err);
    case TL_FIELD_FALLOFF: return read_falloff(at, field->name, value, to, err);
    case TL_FIELD_TABLE: return read_table(at, field->name, value, set, to, err);
    case TL_FIELD_IMAGE: return tl_light_image_read(at, field->name, value, set, to, err);
    case TL_FIELD_PROFILE: return tl_light_profile_read(at, field->name, value, set, to, err);
    case TL_FIELD_SCALE: return read_scale(at, field->name, value, to, err);
    case TL_FIELD_FLAG: return read_flag(at, field->name, value, to, err);
    case TL_FIELD_LINK: return tl_read_link(at, field->name, value, set, to, err);
    case TL_FIELD_NAME: break;
    }
    return read_name(at, field->name, value, to, err);
}

/* One "key": value of a light whose type is known. */
static tl_status read_member(const tl_place *at,
                             const char *key,
                             const json_t *value,
                             tl_light_set *set,
                             tl_light *light,
                             tl_error *err)
{
    if (strcmp(key, "type") == 0)
        return TL_OK;
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++) {
        const tl_light_field *field = &tl_light_fields[i];
        if (strcmp(key, field->name) != 0)
            continue;
        if (!(field->types >> light->type & 1))
            return tl_fail(err, TL_ERR_FORMAT, "%s:%s a %s light has no \"%s\"; remove it",
                           at->source, at->inside, tl_light_type_words[light->type], key);
        return read_field(at, field, value, set, light, err);
    }
    return refuse_unknown(at, key, err);
}

/* A lamp hangs upright unless its profile is aimed. */
static tl_status aim_point(const tl_place *at,
                           const json_t *object,
                           tl_light *light,
                           tl_error *err)
{
    static const float down[3] = {0.0f, -1.0f, 0.0f};
    const json_t *const direction = json_object_get(object, "direction");
    if (light->type != TL_LIGHT_POINT)
        return TL_OK;
    if (direction && light->profile == 0)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s a point light has no \"direction\" without a \"profile\"; remove "
                       "it",
                       at->source, at->inside);
    if (!direction && light->profile > 0)
        memcpy(light->direction, down, sizeof down);
    return TL_OK;
}

static tl_status read_light(const char *source,
                            size_t index,
                            json_t *object,
                            tl_light_set *set,
                            tl_light *out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    const tl_place at = tl_place_in(source, "lights", index, object, "name");
    tl_light light = tl_light_default();
    int type = 0;
    const char *key;
    json_t *value;

    if (!json_is_object(object))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s must be an object", source, at.inside));
    TRY(tl_read_word(&at, "type", json_object_get(object, "type"), tl_light_type_words,
                     TL_LIGHT_TYPE_COUNT, &type, err));
    light.type = (tl_light_type)type;
    json_object_foreach(object, key, value) TRY(read_member(&at, key, value, set, &light, err));
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++) {
        const tl_light_field *field = &tl_light_fields[i];
        if ((field->required_by >> type & 1) && !json_object_get(object, field->name))
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s:%s a %s light needs \"%s\"", source, at.inside,
                        tl_light_type_words[type], field->name));
    }
    TRY(aim_point(&at, object, &light, err));
    *out = light;
done:
    return status;
}

static tl_status read_lights(const tl_place *at,
                             json_t *array,
                             tl_light_set *set,
                             tl_error *err)
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
        TRY(read_light(at->source, i, object, set, &light, err));
        TRY(tl_light_set_add(set, &light, err));
    }
done:
    return status;
}

static tl_status read_ambient(const tl_place *at,
                              json_t *value,
                              tl_light_set *set,
                              tl_error *err)
{
    return tl_read_vector(at, "ambient", value, set->ambient, err);
}

static tl_status read_occlusion(const tl_place *at,
                                json_t *object,
                                tl_light_set *set,
                                tl_error *err)
{
    static const char *const words[] = {"radius"};
    const tl_place inside = {.source = at->source, .inside = " ambientOcclusion:"};
    tl_status status = TL_OK;
    const char *key;
    json_t *value;
    if (!json_is_object(object) || !json_object_get(object, words[0]))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: \"ambientOcclusion\" must be an object with a \"radius\", in metres",
                    at->source));
    json_object_foreach(object, key, value)
    {
        if (strcmp(key, words[0]) != 0)
            TRY(tl_unknown_field(&inside, key, words, 1, err));
        TRY(tl_read_number(&inside, words[0], value, &set->occlusion_radius, err));
    }
done:
    return status;
}

static tl_status read_version(const tl_place *at,
                              json_t *value,
                              tl_light_set *set,
                              tl_error *err)
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

static tl_status read_model(const tl_place *at, json_t *value, tl_light_set *set, tl_error *err)
{
    return tl_read_model(at, value, &set->model, err);
}

static tl_status read_shininess(const tl_place *at,
                                json_t *value,
                                tl_light_set *set,
                                tl_error *err)
{
    set->has_shininess = 1;
    return tl_read_number(at, "shininess", value, &set->shininess, err);
}

/* Once the rest is read: rows that name no model have the set's. */
static tl_status read_later(const tl_place *at, json_t *value, tl_light_set *set, tl_error *err)
{
    (void)at;
    (void)value;
    (void)set;
    (void)err;
    return TL_OK;
}

static tl_status read_top(const char *source, json_t *root, tl_light_set *set, tl_error *err)
{
    static const struct {
        const char *name;
        tl_status (*read)(const tl_place *at, json_t *value, tl_light_set *set, tl_error *err);
    } members[] = {{"tilelight", read_version},
                   {"ambient", read_ambient},
                   {"ambientOcclusion", read_occlusion},
                   {"sky", tl_sky_read},
                   {"lights", read_lights},
                   {"model", read_model},
                   {"shininess", read_shininess},
                   {"materials", read_later}};
    enum { MEMBER_COUNT = sizeof members / sizeof members[0] };
    tl_status status = TL_OK;
    const tl_place at = {.source = source};
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
            TRY(tl_unknown_field(&at, key, words, MEMBER_COUNT, err));
        TRY(members[i].read(&at, value, set, err));
    }
    value = json_object_get(root, "materials");
    if (value)
        TRY(tl_read_materials(&at, value, set, err));
done:
    return status;
}

tl_status tl_lights_parse(const char *text,
                          size_t size,
                          const char *source,
                          const char *file,
                          tl_light_set *set,
                          tl_error *err)
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
    TRY(tl_light_images_begin(&made, file, err));
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
                                 path, set, err);
    free(text);
    return status;
}
