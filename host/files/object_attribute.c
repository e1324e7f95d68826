#define _POSIX_C_SOURCE 200809L
#include "object_attribute.h"

#include "try.h"

#include <ctype.h>
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>

static const char attribute[] = "tilelight:objects";

tl_status tl_object_attribute_write(tl_exr_stream *stream,
                                    const tl_objects *objects,
                                    tl_error *err)
{
    tl_status status = TL_OK;
    json_t *names = json_object();
    char *text = NULL;
    if (objects->count == 0)
        goto done;
    for (uint32_t i = 0; names && i < objects->count; i++) {
        char id[16];
        json_t *name = json_string(objects->of[i].name);
        snprintf(id, sizeof id, "%u", objects->of[i].id);
        json_object_set_new(names, id, name ? name : json_string("")); /* of no UTF-8 */
    }
    text = names ? json_dumps(names, JSON_COMPACT) : NULL;
    if (!text)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the names of objects"));
    TRY(tl_exr_check(stream, exr_attr_set_string(stream->context, 0, attribute, text), err));
done:
    free(text);
    json_decref(names);
    return status;
}

tl_status tl_ids_read(const tl_exr_part *part, tl_gbuffer *gbuffer, tl_error *err)
{
    const exr_attr_chlist_entry_t *found = tl_exr_part_channel(part, TL_ID_CHANNEL);
    tl_status status = TL_OK;
    if (!found)
        return TL_OK;
    if (found->pixel_type != EXR_PIXEL_UINT)
        TRY(tl_fail(
            err, TL_ERR_FORMAT,
            "%s: channel \"%s\" is of type %s; ids of objects are whole numbers, of type %s",
            part->stream->path, TL_ID_CHANNEL, tl_exr_type_words[found->pixel_type],
            tl_exr_type_words[EXR_PIXEL_UINT]));
    TRY(tl_ids_add(gbuffer, err));
    const tl_exr_target target = {TL_ID_CHANNEL, EXR_PIXEL_UINT, gbuffer->ids};
    TRY(tl_exr_part_pixels(part, &target, 1, gbuffer->pitch, err));
done:
    return status;
}

/* Whole numbers from 1, as they are written. */
static bool parse_id(const char *text, uint32_t *out)
{
    char *end = NULL;
    errno = 0;
    const unsigned long long id = strtoull(text, &end, 10);
    *out = (uint32_t)id;
    return isdigit((unsigned char)text[0]) && !*end && !errno && id >= 1 && id <= UINT32_MAX;
}

static int compare_objects(const void *a, const void *b)
{
    const tl_object *x = a, *y = b;
    return (x->id > y->id) - (x->id < y->id);
}

/* Keys in the order of their numbers; names stay the document's. */
static tl_status list_names(
    const char *path, json_t *names, tl_object *list, size_t *count, tl_error *err)
{
    const char *key;
    json_t *name;
    json_object_foreach(names, key, name)
    {
        uint32_t id = 0;
        if (!parse_id(key, &id) || !json_is_string(name))
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: attribute \"%s\": \"%.40s\" is no id with a name", path,
                           attribute, key);
        list[(*count)++] = (tl_object){id, (char *)(uintptr_t)json_string_value(name)};
    }
    qsort(list, *count, sizeof *list, compare_objects);
    return TL_OK;
}

tl_status tl_object_attribute_read(tl_exr_reader *reader, tl_objects *out, tl_error *err)
{
    tl_status status = TL_OK;
    const char *path = reader->stream.path, *text = NULL;
    int32_t length = 0;
    json_t *names = NULL;
    tl_object *list = NULL;
    size_t count = 0;
    if (!tl_exr_reader_has_attribute(reader, attribute))
        return TL_OK;
    if (exr_attr_get_string(reader->stream.context, 0, attribute, &length, &text) !=
        EXR_ERR_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" is not of type string", path,
                    attribute));
    names = json_loadb(text, (size_t)length, JSON_REJECT_DUPLICATES, NULL);
    if (!json_is_object(names))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" is no JSON object", path,
                    attribute));
    list = calloc(json_object_size(names) + 1, sizeof *list);
    if (!list)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the names of objects", path));
    TRY(list_names(path, names, list, &count, err));
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && list[i].id == list[i - 1].id)
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" names object %u twice", path,
                        attribute, list[i].id));
        TRY(tl_objects_add(out, list[i].id, list[i].name, err));
    }
done:
    free(list);
    json_decref(names);
    return status;
}
