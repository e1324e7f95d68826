#include "json_values.h"

#include "try.h"
#include "whole_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t text_limit = (size_t)256 << 20; /* bytes; of what is read */

json_t *tl_json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *tl_json_numbers(const float *values, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, tl_json_number((double)values[i]));
    return array;
}

tl_status tl_json_write(const char *path, json_t *report, tl_error *err)
{
    tl_status status = TL_OK;
    /* 9 digits tell every float from its neighbours. */
    char *text = report ? json_dumps(report, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    if (!text)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the report"));
    const size_t length = strlen(text);
    text[length] = '\n'; /* in the place of the NUL */
    TRY(tl_whole_file_write(path, text, length + 1, err));
done:
    free(text);
    json_decref(report);
    return status;
}

tl_status tl_json_read(const char *path, json_t **out, tl_error *err)
{
    tl_status status = TL_OK;
    char *text = NULL;
    size_t size = 0;
    json_error_t error;
    json_t *root = NULL;
    TRY(tl_whole_file_read(path, text_limit, &text, &size, err));
    root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (!root)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: line %d: %s", path, error.line, error.text));
    if (!json_is_object(root))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: it holds no JSON object", path));
    *out = root;
    root = NULL;
done:
    json_decref(root);
    free(text);
    return status;
}
