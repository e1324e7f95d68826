#include "link_read.h"

#include "try.h"

#include <stdlib.h>
#include <string.h>

static const char *const words[] = {"only", "except"};
enum { MOST_OBJECTS = 1000000 };

static tl_status read_object(const tl_place *at,
                             const char *field,
                             const json_t *value,
                             tl_link_object *out,
                             tl_error *err)
{
    const char *name = json_string_value(value);
    const json_int_t id = json_is_integer(value) ? json_integer_value(value) : -1;
    if (name && name[0] && strlen(name) < sizeof out->name) {
        memcpy(out->name, name, strlen(name) + 1);
        return TL_OK;
    }
    if (name)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"%s\": a name of an object has 1 to %zu bytes", at->source,
                       at->inside, field, sizeof out->name - 1);
    if (id < 0 || id > UINT32_MAX)
        return tl_fail(
            err, TL_ERR_FORMAT,
            "%s:%s \"%s\" must list names and ids, whole numbers from 0 to 4294967295",
            at->source, at->inside, field);
    out->id = (uint32_t)id;
    return TL_OK;
}

static tl_status read_list(const tl_place *at,
                           const char *field,
                           const json_t *list,
                           tl_light_link *link,
                           tl_error *err)
{
    const size_t count = json_array_size(list); /* 0 of what is no array */
    tl_status status = TL_OK;
    if (count == 0 || count > MOST_OBJECTS)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"%s\" must list 1 to %d objects, by name or id", at->source,
                       at->inside, field, MOST_OBJECTS);
    link->of = calloc(count, sizeof *link->of);
    if (!link->of)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for a link", at->source);
    for (; link->count < count; link->count++)
        TRY(read_object(at, field, json_array_get(list, link->count), &link->of[link->count],
                        err));
done:
    return status;
}

tl_status tl_read_link(const tl_place *at,
                       const char *field,
                       const json_t *value,
                       tl_light_set *set,
                       uint32_t *out,
                       tl_error *err)
{
    tl_light_link link = {.except = 0};
    tl_status status = TL_OK;
    const char *key;
    json_t *list;
    if (json_object_size(value) != 1)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s:%s \"%s\" must be an object with one of \"only\" and \"except\"",
                    at->source, at->inside, field));
    json_object_foreach((json_t *)(uintptr_t)value, key, list)
    {
        link.except = strcmp(key, words[1]) == 0;
        if (!link.except && strcmp(key, words[0]) != 0)
            TRY(tl_unknown_field(at, key, words, 2, err));
        TRY(read_list(at, key, list, &link, err));
    }
    TRY(tl_light_set_add_link(set, &link, out, err));
done:
    free(link.of);
    return status;
}
