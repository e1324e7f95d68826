#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "study_page.h"

#include "base64.h"
#include "json_values.h"
#include "page_texts.h"
#include "ramp.h"
#include "try.h"
#include "whole_file.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum {
    PATH_SIZE = 4096,
    MOST_PICTURE = 1 << 24, /* bytes of a file; maps are small */
    RAMP_COLORS = 17,       /* between which a browser blends: within 2 codes of the ramp */
};

/* What stands between two pairs of @ in page.html is the name of one. */
typedef struct part {
    const char *name, *text;
    int is_json;
} part;

static void put_text(FILE *out, const char *text)
{
    fputs(text, out);
}

/* JSON for a script element: `<' stands in strings only, and could end the element. */
static void put_json(FILE *out, const char *text)
{
    for (const char *c = text; *c; c++)
        if (*c == '<')
            fputs("\\u003c", out);
        else
            fputc(*c, out);
}

static json_t *ramp_json(void)
{
    json_t *array = json_array();
    for (int i = 0; i < RAMP_COLORS; i++) {
        uint8_t code[3];
        char text[8];
        tl_ramp(i / (double)(RAMP_COLORS - 1), code);
        snprintf(text, sizeof text, "#%02x%02x%02x", code[0], code[1], code[2]);
        json_array_append_new(array, json_string(text));
    }
    return array;
}

/* When the file was written, in UTC. */
static json_t *written_json(const char *path)
{
    struct stat of;
    struct tm utc;
    char text[32];
    if (stat(path, &of) != 0 || !gmtime_r(&of.st_mtime, &utc))
        return json_null();
    strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return json_string(text);
}

static int is_png(const char *bytes, size_t size)
{
    static const char signature[8] = "\x89PNG\r\n\x1a\n";
    return size > sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

/* The file `name` of the folder, a text, as a data URI in images[name]. What cannot be read is left out. */
static tl_status add_image(json_t *images,
                           const char *folder,
                           const json_t *name,
                           tl_error *err)
{
    const char *word = json_string_value(name);
    char path[PATH_SIZE], *bytes = NULL, *text = NULL;
    size_t size = 0;
    tl_status status = TL_OK;
    tl_error ignored;
    if (!word || !word[0] || json_object_get(images, word))
        return TL_OK;
    snprintf(path, sizeof path, "%s/%s", folder, word);
    if (tl_whole_file_read(path, MOST_PICTURE, &bytes, &size, &ignored) != TL_OK ||
        !is_png(bytes, size))
        goto done;
    text = tl_base64(bytes, size);
    json_t *uri = text ? json_sprintf("data:image/png;base64,%s", text) : NULL;
    if (json_object_set_new(images, word, uri) != 0)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the page", path));
done:
    free(text);
    free(bytes);
    return status;
}

static tl_status add_images(json_t *images,
                            const char *folder,
                            const json_t *study,
                            tl_error *err)
{
    const json_t *frames = json_object_get(study, "frames");
    tl_status status = TL_OK;
    for (size_t i = 0; i < json_array_size(frames); i++) {
        const json_t *frame = json_array_get(frames, i);
        const json_t *configurations = json_object_get(frame, "configurations");
        TRY(add_image(images, folder, json_object_get(frame, "picture"), err));
        for (size_t k = 0; k < json_array_size(configurations); k++)
            TRY(add_image(images, folder,
                          json_object_get(json_array_get(configurations, k), "map"), err));
    }
done:
    return status;
}

/* What the page needs besides study.json, as a text of JSON that the caller frees. */
static tl_status make_extras(
    const char *folder, const char *path, const json_t *study, char **out, tl_error *err)
{
    json_t *images = json_object(), *extras = NULL;
    tl_status status = TL_OK;
    TRY(add_images(images, folder, study, err));
    extras = json_pack("{so so ss sO}", "written", written_json(path), "ramp", ramp_json(),
                       "licence", tl_copyright, "images", images);
    *out = extras ? json_dumps(extras, JSON_COMPACT) : NULL;
    if (!*out)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the page", path));
done:
    json_decref(extras);
    json_decref(images);
    return status;
}

/* page.html with its parts put in. */
static void put_page(FILE *out, const char *study, const char *extras)
{
    const part parts[] = {
        {"plot.css", tl_plot_css, 0},
        {"page.css", tl_page_css, 0},
        {"study", study, 1},
        {"extras", extras, 1},
        {"d3", tl_d3_min_js, 0},
        {"study_data.js", tl_study_data_js, 0},
        {"study_plots.js", tl_study_plots_js, 0},
        {"page_elements.js", tl_page_elements_js, 0},
        {"page_tables.js", tl_page_tables_js, 0},
        {"page_details.js", tl_page_details_js, 0},
        {"page_front.js", tl_page_front_js, 0},
        {"page_maps.js", tl_page_maps_js, 0},
        {"page.js", tl_page_js, 0},
    };
    const char *from = tl_page_html, *at;
    for (; (at = strstr(from, "@@")) != NULL; from = at + strcspn(at, "@") + 2) {
        const part *found = NULL;
        fwrite(from, 1, (size_t)(at - from), out);
        at += 2;
        for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
            if (strlen(parts[i].name) == strcspn(at, "@") &&
                strncmp(parts[i].name, at, strlen(parts[i].name)) == 0)
                found = &parts[i];
        assert(found);
        (found->is_json ? put_json : put_text)(out, found->text);
    }
    fputs(from, out);
}

static tl_status write_page(const char *path,
                            const char *study,
                            const char *extras,
                            tl_error *err)
{
    char *text = NULL;
    size_t size = 0;
    tl_status status = TL_OK;
    FILE *stream = open_memstream(&text, &size);
    int failed = !stream;
    if (stream) {
        put_page(stream, study, extras);
        failed = ferror(stream);
        failed = fclose(stream) != 0 || failed;
    }
    if (failed)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the page", path));
    TRY(tl_whole_file_write(path, text, size, err));
done:
    free(text);
    return status;
}

tl_status tl_study_page_write(const char *folder, tl_error *err)
{
    char path[PATH_SIZE], *text = NULL, *extras = NULL;
    json_t *study = NULL;
    tl_status status = TL_OK;
    snprintf(path, sizeof path, "%s/study.json", folder);
    TRY(tl_json_read(path, &study, err));
    if (!json_is_array(json_object_get(study, "frames")))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: it is no study that `tilelight study' wrote",
                    path));
    /* Numbers stay as they are written. */
    text = json_dumps(study, JSON_COMPACT | JSON_REAL_PRECISION(9));
    if (!text)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for the page", path));
    TRY(make_extras(folder, path, study, &extras, err));
    snprintf(path, sizeof path, "%s/study.html", folder);
    TRY(write_page(path, text, extras, err));
done:
    free(extras);
    free(text);
    json_decref(study);
    return status;
}
