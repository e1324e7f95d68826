#include "named_files.h"

#include "exr_stream.h"
#include "light_fields.h"
#include "light_images.h"
#include "regular_file.h"
#include "try.h"
#include "whole_file.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static bool has(const tl_named_files *files, const char *path)
{
    for (size_t i = 0; i < files->count; i++)
        if (strcmp(files->of[i], path) == 0)
            return true;
    return false;
}

/* Takes `path`, which may be NULL: out of memory. */
static tl_status add(tl_named_files *files, char *path, tl_error *err)
{
    char **grown = NULL;
    if (path && has(files, path)) {
        free(path);
        return TL_OK;
    }
    if (path)
        grown = realloc(files->of, (files->count + 1) * sizeof *grown);
    if (!grown) {
        free(path);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for names of files");
    }
    files->of = grown;
    files->of[files->count++] = path;
    return TL_OK;
}

static bool names_file(tl_field_kind kind)
{
    return kind == TL_FIELD_IMAGE || kind == TL_FIELD_PROFILE;
}

/* The value of a field of that name, if there is one; "" names nothing. */
static tl_status add_field(tl_named_files *files,
                           const json_t *object,
                           const char *field,
                           const char *folder,
                           tl_error *err)
{
    const char *name = json_string_value(json_object_get(object, field));
    return name && name[0] ? add(files, tl_light_path(folder, name), err) : TL_OK;
}

/* Of one light, or of the sky. */
static tl_status add_light(tl_named_files *files,
                           const json_t *light,
                           const char *folder,
                           tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++)
        if (names_file(tl_light_fields[i].kind))
            TRY(add_field(files, light, tl_light_fields[i].name, folder, err));
done:
    return status;
}

static tl_status add_sky(tl_named_files *files,
                         const json_t *sky,
                         const char *folder,
                         tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < TL_SKY_FIELD_COUNT; i++)
        if (names_file(tl_sky_fields[i].kind))
            TRY(add_field(files, sky, tl_sky_fields[i].name, folder, err));
done:
    return status;
}

/* file: which the names start from. */
static tl_status add_text(
    tl_named_files *files, const char *text, size_t size, const char *file, tl_error *err)
{
    tl_light_set set = {.folder = NULL}; /* has a folder alone */
    tl_status status = TL_OK;
    json_t *root = json_loadb(text, size, 0, NULL);
    size_t i;
    json_t *light;
    TRY(tl_light_images_begin(&set, file, err));
    TRY(add_sky(files, json_object_get(root, "sky"), set.folder, err));
    json_array_foreach(json_object_get(root, "lights"), i, light)
        TRY(add_light(files, light, set.folder, err));
done:
    free(set.folder);
    json_decref(root);
    return status;
}

static void replace(tl_named_files *out, tl_named_files *made)
{
    tl_named_files_clear(out);
    *out = *made;
    *made = (tl_named_files){NULL, 0};
}

tl_status tl_lights_named_files(const char *path, tl_named_files *out, tl_error *err)
{
    tl_named_files made = {NULL, 0};
    tl_status status = TL_OK;
    char *text = NULL;
    size_t size = 0;
    tl_error why;
    status = tl_whole_file_read(path, TL_LIGHTS_TEXT_LIMIT, &text, &size, &why);
    if (status == TL_ERR_FORMAT) /* too large for one */
        status = TL_OK;
    if (status != TL_OK)
        TRY(tl_fail(err, status, "%s", why.message));
    if (text)
        TRY(add_text(&made, text, size, path, err));
    replace(out, &made);
done:
    tl_named_files_clear(&made);
    free(text);
    return status;
}

tl_status tl_capture_named_files(const char *path, tl_named_files *out, tl_error *err)
{
    static const unsigned char magic[4] = {0x76, 0x2f, 0x31, 0x01};
    tl_named_files made = {NULL, 0};
    tl_exr_stream stream = {.context = NULL};
    tl_status status = TL_OK;
    unsigned char start[sizeof magic] = {0};
    uint64_t size;
    size_t got;
    int32_t length = 0;
    const char *text = NULL;
    TRY(tl_regular_file_start(path, start, sizeof start, &got, &size, err));
    if (memcmp(start, magic, sizeof magic) == 0 &&
        tl_exr_stream_open(&stream, path, &size, NULL) == TL_OK &&
        exr_attr_get_string(stream.context, 0, "tilelight:lights", &length, &text) ==
            EXR_ERR_SUCCESS)
        TRY(add_text(&made, text, (size_t)length, path, err));
    replace(out, &made);
done:
    tl_named_files_clear(&made);
    tl_exr_stream_close_file(&stream);
    return status;
}

void tl_named_files_clear(tl_named_files *files)
{
    for (size_t i = 0; i < files->count; i++)
        free(files->of[i]);
    free(files->of);
    *files = (tl_named_files){NULL, 0};
}
