#define _POSIX_C_SOURCE 200809L
#include "tilelight/lights.h"

#include "light_fields.h"
#include "light_images.h"
#include "material_rows.h"
#include "whole_file.h"

#include <float.h>
#include <jansson.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The fewest digits that read back as the same float: six show every decimal of up to six digits
 * as it was, nine are enough for all. */
static void print_number(FILE *out, float value)
{
    char text[32];
    int digits = FLT_DIG;
    do
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
    while (digits++ < FLT_DECIMAL_DIG && strtof(text, NULL) != value);
    /* JSON's readers may take -0 for the whole number 0, which has no sign. */
    fputs(strcmp(text, "-0") == 0 ? "-0.0" : text, out);
}

static void print_numbers(FILE *out, const float *values, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        fputs(i == 0 ? "[" : ", ", out);
        print_number(out, values[i]);
    }
    fputc(']', out);
}

static void print_vector(FILE *out, const float value[3])
{
    print_numbers(out, value, 3);
}

/* A name may be cut within a character, which JSON cannot hold: its longest valid start is. */
static void print_name(FILE *out, const char *name)
{
    json_t *string = NULL;
    for (size_t length = strlen(name) + 1; length > 0 && !string; length--)
        string = json_stringn(name, length - 1);
    char *quoted = string ? json_dumps(string, JSON_ENCODE_ANY) : NULL;
    fputs(quoted ? quoted : "\"\"", out);
    free(quoted);
    json_decref(string);
}

static void print_table(FILE *out, const tl_light_table *table)
{
    print_numbers(out, table->values, table->count);
}

/* What is written, and where to. */
typedef struct writing {
    FILE *out;
    const tl_light_set *set;
    const char *file;
    int failed; /* memory ran out */
} writing;

static void print_file(writing *w, const char *path)
{
    char *name = tl_light_file_name(w->set, path, w->file);
    w->failed |= !name;
    print_name(w->out, name ? name : "");
    free(name);
}

static void print_link(FILE *out, const tl_light_link *link)
{
    fprintf(out, "{ \"%s\": [", link->except ? "except" : "only");
    for (size_t i = 0; i < link->count; i++) {
        fputs(i == 0 ? "" : ", ", out);
        if (link->of[i].name[0])
            print_name(out, link->of[i].name);
        else
            fprintf(out, "%u", link->of[i].id);
    }
    fputs("] }", out);
}

static void print_field(writing *w, const tl_light_field *field, const tl_light *light)
{
    FILE *const out = w->out;
    const char *at = (const char *)light + field->offset;
    fprintf(out, ", \"%s\": ", field->name);
    if (field->kind == TL_FIELD_NUMBER)
        print_number(out, *(const float *)(const void *)at);
    else if (field->kind == TL_FIELD_NAME)
        print_name(out, at);
    else if (field->kind == TL_FIELD_TABLE)
        print_table(out, &w->set->tables[light->table - 1]);
    else if (field->kind == TL_FIELD_IMAGE)
        print_file(w, w->set->images[light->texture - 1].path);
    else if (field->kind == TL_FIELD_PROFILE)
        print_file(w, w->set->profiles[light->profile - 1].path);
    else if (field->kind == TL_FIELD_SCALE)
        fprintf(out, "\"%s\"", tl_profile_scale_words[light->profile_scale]);
    else if (field->kind == TL_FIELD_LINK)
        print_link(out, &w->set->links[light->link - 1]);
    else if (field->kind == TL_FIELD_FLAG)
        fputs(*(const uint32_t *)(const void *)at ? "true" : "false", out);
    else if (field->kind == TL_FIELD_FALLOFF)
        fprintf(out, "\"%s\"", tl_falloff_words[*(const tl_falloff *)(const void *)at]);
    else
        print_vector(out, (const float *)(const void *)at);
}

static size_t field_size(tl_field_kind kind)
{
    static const size_t sizes[] = {
        [TL_FIELD_NUMBER] = sizeof(float),
        [TL_FIELD_VECTOR] = 3 * sizeof(float),
        [TL_FIELD_UNIT] = 3 * sizeof(float),
        [TL_FIELD_FALLOFF] = sizeof(tl_falloff),
        [TL_FIELD_NAME] = 1, /* empty or not */
        [TL_FIELD_TABLE] = sizeof(uint32_t),
        [TL_FIELD_IMAGE] = sizeof(uint32_t),
        [TL_FIELD_PROFILE] = sizeof(uint32_t),
        [TL_FIELD_SCALE] = sizeof(tl_profile_scale),
        [TL_FIELD_FLAG] = sizeof(uint32_t),
        [TL_FIELD_LINK] = sizeof(uint32_t),
    };
    return sizes[kind];
}

/* Which a point light has with a profile, and then always: its default is not that of others. */
static int is_aim_of_point(const tl_light_field *field, const tl_light *light)
{
    return light->type == TL_LIGHT_POINT && field->offset == offsetof(tl_light, direction);
}

static int is_said(const tl_light_field *field, const tl_light *light)
{
    return (field->types >> light->type & 1) &&
           (light->profile > 0 || !is_aim_of_point(field, light));
}

/* Fields that hold their default, bit for bit, are left out: a range of infinity among them, which
 * JSON could not say. */
static void print_light(writing *w, const tl_light *light)
{
    const tl_light standard = tl_light_default();
    fprintf(w->out, "    { \"type\": \"%s\"", tl_light_type_words[light->type]);
    for (size_t i = 0; i < TL_LIGHT_FIELD_COUNT; i++) {
        const tl_light_field *field = &tl_light_fields[i];
        const int differs =
            memcmp((const char *)light + field->offset, (const char *)&standard + field->offset,
                   field_size(field->kind)) != 0;
        if (is_said(field, light) && ((field->required_by >> light->type & 1) || differs ||
                                      is_aim_of_point(field, light)))
            print_field(w, field, light);
    }
    fputs(" }", w->out);
}

static void print_row(FILE *out, const tl_material_row *row)
{
    fputs("    { ", out);
    if (row->material[0]) {
        fputs("\"material\": ", out);
        print_name(out, row->material);
    } else {
        fprintf(out, "\"index\": %u", row->index);
    }
    fprintf(out, ", \"model\": \"%s\"", tl_model_words[row->model]);
    for (size_t i = 0; i < TL_MATERIAL_FIELD_COUNT; i++) {
        const tl_material_field *field = &tl_material_fields[i];
        const float *values = tl_material_values(row, field);
        if (!(row->given & field->parameter))
            continue;
        fprintf(out, ", \"%s\": ", field->name);
        if (field->count == 3)
            print_vector(out, values);
        else
            print_number(out, *values);
    }
    fputs(" }", out);
}

static void print_materials(FILE *out, const tl_light_set *set)
{
    if (set->material_count > 0)
        fputs(",\n  \"materials\": [", out);
    for (size_t i = 0; i < set->material_count; i++) {
        fputs(i == 0 ? "\n" : ",\n", out);
        print_row(out, &set->materials[i]);
    }
    if (set->material_count > 0)
        fputs("\n  ]", out);
}

/* All fields of its type, none of which is long; what every sky may have, where it has it. */
static void print_sky(writing *w)
{
    fprintf(w->out, "{ \"type\": \"%s\"", tl_sky_type_words[w->set->sky_type]);
    for (size_t i = 0; i < TL_SKY_FIELD_COUNT; i++) {
        const tl_sky_field *field = &tl_sky_fields[i];
        const void *at = (const char *)w->set + field->offset;
        if (field->type == TL_ANY_SKY ? !(w->set->sky_light > 0.0f)
                                      : field->type != (int)w->set->sky_type)
            continue;
        fprintf(w->out, ", \"%s\": ", field->name);
        if (field->kind == TL_FIELD_VECTOR)
            print_vector(w->out, at);
        else if (field->kind == TL_FIELD_IMAGE)
            print_file(w, w->set->images[w->set->sky_image - 1].path);
        else
            print_number(w->out, *(const float *)at);
    }
    fputs(" }", w->out);
}

static void print_set(writing *w)
{
    FILE *const out = w->out;
    const tl_light_set *const set = w->set;
    fputs("{ \"tilelight\": 1,\n  \"ambient\": ", out);
    print_vector(out, set->ambient);
    if (set->occlusion_radius > 0.0f) {
        fputs(",\n  \"ambientOcclusion\": { \"radius\": ", out);
        print_number(out, set->occlusion_radius);
        fputs(" }", out);
    }
    fputs(",\n  \"sky\": ", out);
    print_sky(w);
    if (set->model != (enum tl_shading_model)0)
        fprintf(out, ",\n  \"model\": \"%s\"", tl_model_words[set->model]);
    if (set->has_shininess) {
        fputs(",\n  \"shininess\": ", out);
        print_number(out, set->shininess);
    }
    print_materials(out, set);
    fputs(",\n  \"lights\": [", out);
    for (size_t i = 0; i < set->count; i++) {
        fputs(i == 0 ? "\n" : ",\n", out);
        print_light(w, &set->lights[i]);
    }
    fputs(set->count > 0 ? "\n  ] }\n" : "] }\n", out);
}

tl_status tl_lights_format(const tl_light_set *set, const char *file, char **out, tl_error *err)
{
    char *text = NULL;
    size_t size = 0;
    /* A host program may have set a locale that writes decimal commas. */
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    FILE *stream = plain ? open_memstream(&text, &size) : NULL;
    int failed = !stream;
    if (stream) {
        const locale_t before = uselocale(plain);
        writing w = {.out = stream, .set = set, .file = file};
        print_set(&w);
        uselocale(before);
        failed = w.failed || ferror(stream);
        failed = fclose(stream) != 0 || failed;
    }
    if (plain)
        freelocale(plain);
    if (failed) {
        free(text);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the text of %zu lights",
                       set->count);
    }
    if (size > TL_LIGHTS_TEXT_LIMIT) {
        free(text);
        return tl_fail(err, TL_ERR_WRITE,
                       "%zu lights are %zu MiB of text; a file of lights holds %zu at most",
                       set->count, size >> 20, TL_LIGHTS_TEXT_LIMIT >> 20);
    }
    *out = text;
    return TL_OK;
}

tl_status tl_lights_write(const char *path, const tl_light_set *set, tl_error *err)
{
    char *text = NULL;
    tl_status status = tl_lights_format(set, path, &text, err);
    if (status == TL_OK)
        status = tl_whole_file_write(path, text, strlen(text), err);
    free(text);
    return status;
}
