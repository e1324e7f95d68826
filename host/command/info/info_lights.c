#include "info.h"
#include "json_values.h"
#include "light_words.h"
#include "material_rows.h"
#include "tilelight/light_groups.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Of the lights of one type. Ranges: over those that have one. */
typedef struct type_info {
    size_t count, ranged_count;
    double least_range, most_range, least_intensity, most_intensity;
} type_info;

typedef struct shape_info {
    size_t tables, textures, profiles, ambient; /* lights */
} shape_info;

static shape_info shape_info_of(const tl_light_set *set)
{
    shape_info out = {0};
    for (size_t i = 0; i < set->count; i++) {
        out.tables += set->lights[i].table > 0;
        out.textures += set->lights[i].texture > 0;
        out.profiles += set->lights[i].profile > 0;
        out.ambient += set->lights[i].ambient > 0.0f;
    }
    return out;
}

static type_info type_info_of(const tl_light_set *set, tl_light_type type)
{
    type_info out = {.least_range = INFINITY, .least_intensity = INFINITY};
    for (size_t i = 0; i < set->count; i++) {
        const tl_light *light = &set->lights[i];
        if (light->type != type)
            continue;
        out.count++;
        out.least_intensity = fmin(out.least_intensity, (double)light->intensity);
        out.most_intensity = fmax(out.most_intensity, (double)light->intensity);
        if (type == TL_LIGHT_DIRECTIONAL || isinf(light->range))
            continue;
        out.ranged_count++;
        out.least_range = fmin(out.least_range, (double)light->range);
        out.most_range = fmax(out.most_range, (double)light->range);
    }
    return out;
}

static void print_row(const tl_material_row *row, const char *heading)
{
    printf("%-12s", heading);
    if (row->material[0])
        info_print_text(row->material, 0);
    else
        printf("index %u", row->index);
    printf(": %s", tl_model_words[row->model]);
    for (size_t i = 0; i < TL_MATERIAL_FIELD_COUNT; i++) {
        const tl_material_field *field = &tl_material_fields[i];
        const float *values = tl_material_values(row, field);
        if (!(row->given & field->parameter))
            continue;
        printf(", %s %.6g", field->name, (double)values[0]);
        for (uint32_t k = 1; k < field->count; k++)
            printf(" %.6g", (double)values[k]);
    }
    putchar('\n');
}

static void print_color(const char *before, const float color[3])
{
    printf("%s(%.6g, %.6g, %.6g)", before, (double)color[0], (double)color[1],
           (double)color[2]);
}

static void print_quoted(const char *text)
{
    putchar('"');
    info_print_text(text, 0);
    putchar('"');
}

static void print_sky(const tl_light_set *set)
{
    if (set->sky_type == TL_SKY_IMAGE) {
        printf("sky ");
        print_quoted(set->images[set->sky_image - 1].path);
    } else if (set->sky_type == TL_SKY_GRADIENT) {
        print_color("sky ", set->zenith);
        print_color(" to ", set->sky);
        print_color(" to ", set->ground);
    } else {
        print_color("sky ", set->sky);
    }
    putchar('\n');
}

/* As a lights file has it. */
static json_t *row_json(const tl_material_row *row)
{
    json_t *out = json_object();
    if (row->material[0])
        json_object_set_new(out, "material", json_string(row->material));
    else
        json_object_set_new(out, "index", json_integer(row->index));
    json_object_set_new(out, "model", json_string(tl_model_words[row->model]));
    for (size_t i = 0; i < TL_MATERIAL_FIELD_COUNT; i++) {
        const tl_material_field *field = &tl_material_fields[i];
        const float *values = tl_material_values(row, field);
        if (row->given & field->parameter)
            json_object_set_new(out, field->name,
                                field->count == 3 ? tl_json_numbers(values, 3)
                                                  : tl_json_number((double)*values));
    }
    return out;
}

static json_t *rows_json(const tl_light_set *set)
{
    json_t *out = json_array();
    for (size_t i = 0; i < set->material_count; i++)
        json_array_append_new(out, row_json(&set->materials[i]));
    return out;
}

static void print_profile(const tl_light_profile *profile)
{
    printf("profile     ");
    print_quoted(profile->path);
    printf(", %.6g cd at most, %.6g lm", profile->peak, profile->flux);
    if (profile->lamp_lumens >= 0.0)
        printf(" of %.6g of its lamps", profile->lamp_lumens);
    printf(", %u x %u angles", profile->columns, profile->rows);
    if (profile->off > 0.0)
        printf(", off by %.2g cd between the file's own", profile->off);
    putchar('\n');
}

static json_t *profiles_json(const tl_light_set *set)
{
    json_t *out = json_array();
    for (size_t i = 0; i < set->profile_count; i++) {
        const tl_light_profile *p = &set->profiles[i];
        json_array_append_new(out, json_pack("{ss* sf sf sf s[ii] sf}", "path", p->path,
                                             "peak_cd", p->peak, "flux_lm", p->flux, "lamp_lm",
                                             p->lamp_lumens, "angles", (int)p->columns,
                                             (int)p->rows, "off_cd", p->off));
    }
    return out;
}

/* Lights with more than most have, the pictures and the profiles. */
static void print_shapes(const tl_light_set *set)
{
    const shape_info info = shape_info_of(set);
    if (info.tables + info.textures + info.profiles + info.ambient > 0)
        printf(
            "of them     %zu with a falloff table, %zu with a texture, %zu with a profile, %zu "
            "with an ambient lobe\n",
            info.tables, info.textures, info.profiles, info.ambient);
    for (size_t i = 0; i < set->image_count; i++) {
        printf("image       ");
        print_quoted(set->images[i].path);
        printf(", %u x %u pixels\n", set->images[i].width, set->images[i].height);
    }
    for (size_t i = 0; i < set->profile_count; i++)
        print_profile(&set->profiles[i]);
}

/* Where memory runs out, none is listed. */
static void print_groups(const tl_light_set *set)
{
    tl_light_group *groups = NULL;
    size_t count = 0;
    tl_error ignored;
    if (tl_light_groups_find(set, &groups, &count, &ignored) != TL_OK)
        return;
    for (size_t i = 0; i < count; i++) {
        printf("group       ");
        print_quoted(groups[i].name);
        printf(", %zu light%s\n", groups[i].light_count, groups[i].light_count == 1 ? "" : "s");
    }
    free(groups);
}

static json_t *groups_json(const tl_light_set *set)
{
    tl_light_group *groups = NULL;
    size_t count = 0;
    tl_error ignored;
    if (tl_light_groups_find(set, &groups, &count, &ignored) != TL_OK)
        return json_null();
    json_t *out = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(out, json_pack("{ss* sI}", "name", groups[i].name, "lights",
                                             (json_int_t)groups[i].light_count));
    free(groups);
    return out;
}

void info_print_lights(const tl_light_set *set)
{
    printf("lights      %zu, ambient (%.6g, %.6g, %.6g), ", set->count, (double)set->ambient[0],
           (double)set->ambient[1], (double)set->ambient[2]);
    print_sky(set);
    printf("model       %s\n", tl_model_words[set->model]);
    if (set->has_shininess)
        printf("shininess   %.6g, of all surfaces\n", (double)set->shininess);
    for (size_t i = 0; i < set->material_count; i++)
        print_row(&set->materials[i], i == 0 ? "materials" : "");
    for (tl_light_type type = 0; type < TL_LIGHT_TYPE_COUNT; type++) {
        const type_info info = type_info_of(set, type);
        if (info.count == 0)
            continue;
        printf("%-11s %zu, intensity %.6g to %.6g", tl_light_type_words[type], info.count,
               info.least_intensity, info.most_intensity);
        if (info.ranged_count > 0)
            printf(", range %.6g to %.6g m", info.least_range, info.most_range);
        if (info.ranged_count < info.count && type != TL_LIGHT_DIRECTIONAL)
            printf(", %zu without range", info.count - info.ranged_count);
        putchar('\n');
    }
    print_groups(set);
    print_shapes(set);
}

static json_t *type_json(const type_info *info)
{
    json_t *out = json_pack("{sI s[ff]}", "count", (json_int_t)info->count, "intensity",
                            info->least_intensity, info->most_intensity);
    if (info->ranged_count > 0)
        json_object_set_new(out, "range",
                            json_pack("[ff]", info->least_range, info->most_range));
    json_object_set_new(out, "without_range",
                        json_integer((json_int_t)(info->count - info->ranged_count)));
    return out;
}

/* Of one colour, as it is; else an object as of a lights file. */
static json_t *sky_json(const tl_light_set *set)
{
    if (set->sky_type == TL_SKY_CONSTANT)
        return tl_json_numbers(set->sky, 3);
    if (set->sky_type == TL_SKY_GRADIENT)
        return json_pack(
            "{ss so so so}", "type", "gradient", "zenith", tl_json_numbers(set->zenith, 3),
            "horizon", tl_json_numbers(set->sky, 3), "ground", tl_json_numbers(set->ground, 3));
    return json_pack("{ss ss* sf sf}", "type", "image", "image",
                     set->images[set->sky_image - 1].path, "intensity",
                     (double)set->sky_intensity, "rotation", (double)set->sky_rotation);
}

static json_t *images_json(const tl_light_set *set)
{
    json_t *out = json_array();
    for (size_t i = 0; i < set->image_count; i++)
        json_array_append_new(out,
                              json_pack("{ss* s[ii]}", "path", set->images[i].path, "size",
                                        (int)set->images[i].width, (int)set->images[i].height));
    return out;
}

json_t *info_lights_json(const tl_light_set *set)
{
    json_t *types = json_object();
    for (tl_light_type type = 0; type < TL_LIGHT_TYPE_COUNT; type++) {
        const type_info info = type_info_of(set, type);
        if (info.count > 0)
            json_object_set_new(types, tl_light_type_words[type], type_json(&info));
    }
    json_t *shininess = set->has_shininess ? json_real((double)set->shininess) : json_null();
    const shape_info info = shape_info_of(set);
    return json_pack("{sI so so ss so so so so so so s{sI sI sI sI}}", "count",
                     (json_int_t)set->count, "ambient", tl_json_numbers(set->ambient, 3), "sky",
                     sky_json(set), "model", tl_model_words[set->model], "shininess", shininess,
                     "materials", rows_json(set), "types", types, "groups", groups_json(set),
                     "images", images_json(set), "profiles", profiles_json(set), "with",
                     "table", (json_int_t)info.tables, "texture", (json_int_t)info.textures,
                     "profile", (json_int_t)info.profiles, "ambient", (json_int_t)info.ambient);
}
