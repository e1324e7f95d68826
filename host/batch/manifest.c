#define _POSIX_C_SOURCE 200809L
#include "manifest.h"

#include "frame_set.h"
#include "item_inputs.h"
#include "suggest.h"
#include "try.h"
#include "whole_file.h"

#include <ctype.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static const size_t text_limit = (size_t)256 << 20; /* bytes; some hundred a frame */

/* Where the reading is. */
typedef struct reading {
    const char *path;
    size_t folder; /* how much of the path is the folder that others start in */
    const char *at, *end;
    int line;      /* of `at`, from 1 */
    int item_line; /* where the object begins that is being read */
    bool given;
} reading;

static tl_status fail_at(const reading *r, int line, const char *what, tl_error *err)
{
    return tl_fail(err, TL_ERR_FORMAT, "%s: line %d: %s", r->path, line, what);
}

static tl_status fail_field(const reading *r,
                            const char *field,
                            const char *want,
                            tl_error *err)
{
    return tl_fail(err, TL_ERR_FORMAT, "%s: line %d: \"%s\" must be %s", r->path, r->item_line,
                   field, want);
}

/* One that is not empty; jansson refuses those with a NUL, which paths cannot have. */
static const char *text_of(const json_t *value)
{
    const char *text = json_string_value(value);
    return text && text[0] ? text : NULL;
}

/* As seen from here. */
static tl_status take_path(
    const reading *r, const char *field, const json_t *value, char **out, tl_error *err)
{
    const char *text = text_of(value);
    if (!text)
        return fail_field(r, field, "a path", err);
    const size_t folder = text[0] == '/' ? 0 : r->folder, length = strlen(text) + 1;
    char *path = malloc(folder + length);
    if (!path)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", r->path);
    memcpy(path, r->path, folder);
    memcpy(path + folder, text, length);
    free(*out);
    *out = path;
    return TL_OK;
}

static tl_status take_input(const reading *r, const json_t *value, tl_item *item, tl_error *err)
{
    return take_path(r, "input", value, &item->input, err);
}

static tl_status take_lights(const reading *r,
                             const json_t *value,
                             tl_item *item,
                             tl_error *err)
{
    return take_path(r, "lights", value, &item->lights, err);
}

/* One of those of its kind that an item may have. */
static tl_status make_outputs(const reading *r, size_t count, tl_item *item, tl_error *err)
{
    if (item->outputs)
        return fail_at(r, r->item_line, "either \"output\" or \"outputs\", not both", err);
    if (r->given)
        return fail_at(r, r->item_line,
                       "it says what to write, and so does the option for all: leave one out",
                       err);
    item->outputs = calloc(count, sizeof *item->outputs);
    if (!item->outputs)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", r->path);
    item->output_count = count;
    return TL_OK;
}

static tl_status take_output(const reading *r,
                             const json_t *value,
                             tl_item *item,
                             tl_error *err)
{
    const tl_status status = make_outputs(r, 1, item, err);
    return status == TL_OK ? take_path(r, "output", value, &item->outputs[0], err) : status;
}

static tl_status take_outputs(const reading *r,
                              const json_t *value,
                              tl_item *item,
                              tl_error *err)
{
    const size_t count = json_array_size(value);
    if (count == 0)
        return fail_field(r, "outputs", "an array of paths", err);
    tl_status status = make_outputs(r, count, item, err);
    for (size_t i = 0; i < count && status == TL_OK; i++)
        status = take_path(r, "outputs", json_array_get(value, i), &item->outputs[i], err);
    return status;
}

static tl_status take_frame(const reading *r, const json_t *value, tl_item *item, tl_error *err)
{
    const json_int_t frame = json_integer_value(value);
    if (!json_is_integer(value) || frame < -TL_FARTHEST_FRAME || frame > TL_FARTHEST_FRAME)
        return fail_field(r, "frame", "a whole number of at most 9 digits", err);
    item->frame = (int32_t)frame;
    item->has_frame = true;
    return TL_OK;
}

static tl_status take_name(const reading *r, const json_t *value, tl_item *item, tl_error *err)
{
    const char *text = text_of(value);
    if (!text || strchr(text, '/'))
        return fail_field(r, "name", "a text without \"/\"", err);
    item->name = strdup(text);
    return item->name ? TL_OK : tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", r->path);
}

typedef tl_status take_field(const reading *r,
                             const json_t *value,
                             tl_item *item,
                             tl_error *err);

enum { FIELD_COUNT = 6 };
static const char *const field_names[FIELD_COUNT] = {"input",  "output", "outputs",
                                                     "lights", "frame",  "name"};
static take_field *const field_takers[FIELD_COUNT] = {take_input,  take_output, take_outputs,
                                                      take_lights, take_frame,  take_name};

static tl_status take_any(
    const reading *r, const char *field, const json_t *value, tl_item *item, tl_error *err)
{
    for (size_t i = 0; i < FIELD_COUNT; i++)
        if (strcmp(field, field_names[i]) == 0)
            return field_takers[i](r, value, item, err);
    const char *like = tl_suggest(field, field_names, FIELD_COUNT);
    return tl_fail(err, TL_ERR_FORMAT, "%s: line %d: there is no field \"%.60s\"%s%s%s",
                   r->path, r->item_line, field, like ? "; was \"" : "", like ? like : "",
                   like ? "\" meant?" : "");
}

/* What is not said follows from what is. */
static tl_status complete(const reading *r, tl_item *item, tl_error *err)
{
    if (!item->input)
        return fail_at(r, r->item_line, "it has no \"input\"", err);
    if (!item->outputs && !r->given)
        return fail_at(r, r->item_line, "it has no \"output\", and no option says one for all",
                       err);
    if (!item->name)
        item->name = tl_item_name(item->input);
    return item->name ? TL_OK : tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", r->path);
}

static tl_status add_item(const reading *r, json_t *object, tl_item_list *list, tl_error *err)
{
    tl_status status = TL_OK;
    tl_item item = {.name = NULL};
    const char *field;
    json_t *value;
    if (!json_is_object(object))
        return fail_at(r, r->item_line, "each item must be an object", err);
    json_object_foreach(object, field, value) TRY(take_any(r, field, value, &item, err));
    TRY(complete(r, &item, err));
    TRY(tl_items_add(list, &item, err));
done:
    tl_item_clear(&item);
    return status;
}

static void go_to(reading *r, const char *at)
{
    for (; r->at < at; r->at++)
        r->line += *r->at == '\n';
}

static void skip_spaces(reading *r)
{
    const char *at = r->at;
    while (at < r->end && isspace((unsigned char)*at))
        at++;
    go_to(r, at);
}

/* Whether that sign comes next; then it is behind. */
static bool take_sign(reading *r, char sign)
{
    skip_spaces(r);
    if (r->at == r->end || *r->at != sign)
        return false;
    r->at++;
    return true;
}

static tl_status read_item(reading *r, tl_item_list *list, tl_error *err)
{
    json_error_t error;
    skip_spaces(r);
    json_t *object = json_loadb(r->at, (size_t)(r->end - r->at),
                                JSON_REJECT_DUPLICATES | JSON_DISABLE_EOF_CHECK, &error);
    if (!object)
        return fail_at(r, r->line + (error.line > 0 ? error.line - 1 : 0), error.text, err);
    r->item_line = r->line;
    const tl_status status = add_item(r, object, list, err);
    go_to(r, r->at + error.position);
    json_decref(object);
    return status;
}

static tl_status read_array(reading *r, tl_item_list *list, tl_error *err)
{
    tl_status status = TL_OK;
    if (take_sign(r, ']'))
        return TL_OK;
    do
        status = read_item(r, list, err);
    while (status == TL_OK && take_sign(r, ','));
    if (status == TL_OK && !take_sign(r, ']'))
        return fail_at(r, r->line, "the array is not closed, or a comma is missing", err);
    return status;
}

static tl_status read_items(reading *r, tl_item_list *list, tl_error *err)
{
    tl_status status = TL_OK;
    if (take_sign(r, '[')) {
        TRY(read_array(r, list, err));
        skip_spaces(r);
        if (r->at < r->end)
            TRY(fail_at(r, r->line, "there is something behind the array", err));
    }
    for (skip_spaces(r); r->at < r->end; skip_spaces(r))
        TRY(read_item(r, list, err));
done:
    return status;
}

tl_status tl_manifest_read(const char *path, bool given, tl_item_list *list, tl_error *err)
{
    tl_status status = TL_OK;
    char *text = NULL;
    size_t size = 0;
    const char *slash = strrchr(path, '/');
    TRY(tl_whole_file_read(path, text_limit, &text, &size, err));
    reading r = {.path = strcmp(path, "-") == 0 ? "standard input" : path,
                 .folder = slash ? (size_t)(slash + 1 - path) : 0,
                 .at = text,
                 .end = text + size,
                 .line = 1,
                 .given = given};
    TRY(read_items(&r, list, err));
done:
    free(text);
    return status;
}
