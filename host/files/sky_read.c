#include "sky_read.h"

#include "light_fields.h"
#include "light_images.h"
#include "try.h"

#include <stdbool.h>
#include <string.h>

const tl_sky_field tl_sky_fields[TL_SKY_FIELD_COUNT] = {
    {"color", TL_SKY_CONSTANT, TL_FIELD_VECTOR, offsetof(tl_light_set, sky), true},
    {"zenith", TL_SKY_GRADIENT, TL_FIELD_VECTOR, offsetof(tl_light_set, zenith), true},
    {"horizon", TL_SKY_GRADIENT, TL_FIELD_VECTOR, offsetof(tl_light_set, sky), true},
    {"ground", TL_SKY_GRADIENT, TL_FIELD_VECTOR, offsetof(tl_light_set, ground), true},
    {"image", TL_SKY_IMAGE, TL_FIELD_IMAGE, offsetof(tl_light_set, sky_image), true},
    {"intensity", TL_SKY_IMAGE, TL_FIELD_NUMBER, offsetof(tl_light_set, sky_intensity), false},
    {"rotation", TL_SKY_IMAGE, TL_FIELD_NUMBER, offsetof(tl_light_set, sky_rotation), false},
    {"light", TL_ANY_SKY, TL_FIELD_NUMBER, offsetof(tl_light_set, sky_light), false},
};

static tl_status read_field(const tl_place *at,
                            const tl_sky_field *field,
                            const json_t *value,
                            tl_light_set *set,
                            tl_error *err)
{
    void *to = (char *)set + field->offset;
    if (field->kind == TL_FIELD_VECTOR)
        return tl_read_vector(at, field->name, value, to, err);
    if (field->kind == TL_FIELD_NUMBER)
        return tl_read_number(at, field->name, value, to, err);
    return tl_light_image_read(at, field->name, value, set, to, err);
}

/* One "key": value of a sky whose type is known. */
static tl_status read_member(
    const tl_place *at, const char *key, const json_t *value, tl_light_set *set, tl_error *err)
{
    const char *words[TL_SKY_FIELD_COUNT + 1] = {"type"};
    if (strcmp(key, "type") == 0)
        return TL_OK;
    for (size_t i = 0; i < TL_SKY_FIELD_COUNT; i++) {
        const tl_sky_field *field = &tl_sky_fields[i];
        words[i + 1] = field->name;
        if (strcmp(key, field->name) != 0)
            continue;
        if (field->type != TL_ANY_SKY && field->type != (int)set->sky_type)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s:%s a sky of type \"%s\" has no \"%s\"; remove it", at->source,
                           at->inside, tl_sky_type_words[set->sky_type], key);
        return read_field(at, field, value, set, err);
    }
    return tl_unknown_field(at, key, words, TL_SKY_FIELD_COUNT + 1, err);
}

tl_status tl_sky_read(const tl_place *at, json_t *sky, tl_light_set *set, tl_error *err)
{
    tl_status status = TL_OK;
    const tl_place inside = {.source = at->source, .inside = " sky:"};
    const char *key;
    json_t *value;
    int type = 0;
    if (!json_is_object(sky))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: \"sky\" must be an object with a \"type\"",
                    at->source));
    TRY(tl_read_word(&inside, "type", json_object_get(sky, "type"), tl_sky_type_words,
                     TL_SKY_COUNT, &type, err));
    set->sky_type = (tl_sky)type;
    set->sky_intensity = set->sky_type == TL_SKY_IMAGE ? 1.0f : 0.0f;
    json_object_foreach(sky, key, value) TRY(read_member(&inside, key, value, set, err));
    for (size_t i = 0; i < TL_SKY_FIELD_COUNT; i++)
        if (tl_sky_fields[i].is_required && tl_sky_fields[i].type == (int)set->sky_type &&
            !json_object_get(sky, tl_sky_fields[i].name))
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: a sky of type \"%s\" needs \"%s\"", at->source,
                        tl_sky_type_words[type], tl_sky_fields[i].name));
done:
    return status;
}
