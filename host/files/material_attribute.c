#include "material_attribute.h"

#include "try.h"

#include <jansson.h>
#include <stdlib.h>

static const char attribute[] = "tilelight:materials";

tl_status tl_material_attribute_write(tl_exr_stream *stream,
                                      const tl_material_names *names,
                                      tl_error *err)
{
    tl_status status = TL_OK;
    json_t *array = json_array();
    char *text = NULL;
    if (names->count == 0)
        goto done;
    for (uint32_t i = 0; array && i < names->count; i++) {
        json_t *name = json_string(names->of[i]);
        json_array_append_new(array, name ? name : json_string("")); /* of no UTF-8 */
    }
    text = array ? json_dumps(array, JSON_COMPACT) : NULL;
    if (!text)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the names of materials"));
    TRY(tl_exr_check(stream, exr_attr_set_string(stream->context, 0, attribute, text), err));
done:
    free(text);
    json_decref(array);
    return status;
}

tl_status tl_material_attribute_read(tl_exr_reader *reader,
                                     tl_material_names *out,
                                     tl_error *err)
{
    tl_status status = TL_OK;
    const char *path = reader->stream.path, *text = NULL;
    int32_t length = 0;
    json_t *array = NULL, *name;
    size_t i;
    if (!tl_exr_reader_has_attribute(reader, attribute))
        return TL_OK;
    if (exr_attr_get_string(reader->stream.context, 0, attribute, &length, &text) !=
        EXR_ERR_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" is not of type string", path,
                    attribute));
    array = json_loadb(text, (size_t)length, JSON_REJECT_DUPLICATES, NULL);
    if (!json_is_array(array))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" is no JSON array", path,
                    attribute));
    if (json_array_size(array) > TL_MAX_MATERIALS)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: attribute \"%s\" names %zu materials; there are %d at most", path,
                    attribute, json_array_size(array), TL_MAX_MATERIALS));
    json_array_foreach(array, i, name)
    {
        if (!json_is_string(name))
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\": name %zu is no string", path,
                        attribute, i));
        TRY(tl_material_names_add(out, json_string_value(name), err));
    }
done:
    json_decref(array);
    return status;
}
