#include "info.h"
#include "json_values.h"
#include "tilelight/layouts.h"
#include "word_channels.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

static const struct {
    const char *channel;
} planes[TL_PLANE_COUNT] = {
#define PLANE_ROW(name, channel, empty, meaning) [name] = {channel},
    TL_PLANES(PLANE_ROW)
#undef PLANE_ROW
};

static double degrees(double tangent_up, double tangent_down)
{
    return (atan(tangent_up) - atan(tangent_down)) * 57.29577951308232;
}

static info_values measure(const tl_gbuffer *g, enum tl_plane plane)
{
    return info_measure(tl_gbuffer_plane(g, plane), tl_gbuffer_plane(g, TL_DEPTH),
                        g->camera.width, g->camera.height, g->pitch);
}

static double coverage(const tl_gbuffer *g)
{
    const info_values depth = measure(g, TL_DEPTH);
    return (double)depth.count / ((double)g->camera.width * (double)g->camera.height);
}

static void eye_of(const tl_camera *c, double eye[3], double towards[3])
{
    static const double origin[3] = {0.0, 0.0, 0.0}, forwards[3] = {0.0, 0.0, -1.0};
    tl_camera_world_point(c, origin, eye);
    tl_camera_world_direction(c, forwards, towards);
}

static void print_camera(const tl_camera *c)
{
    double eye[3], towards[3];
    eye_of(c, eye, towards);
    printf("camera      at (%.6g, %.6g, %.6g) m, looking along (%.6g, %.6g, %.6g)\n", eye[0],
           eye[1], eye[2], towards[0], towards[1], towards[2]);
    if (c->projection == TL_PERSPECTIVE)
        printf("            perspective, %.6g x %.6g degrees",
               degrees((double)c->right, (double)c->left),
               degrees((double)c->top, (double)c->bottom));
    else
        printf("            orthographic, %.6g x %.6g m", (double)(c->right - c->left),
               (double)(c->top - c->bottom));
    printf(", near %.6g m, far %.6g m\n", (double)c->near, (double)c->far);
}

/* Bytes per pixel in memory. */
static unsigned channel_size(const tl_gbuffer *g, const tl_word_channel *c)
{
    unsigned size = 0;
    for (uint32_t w = 0; w < c->word_count; w++)
        size += tl_gbuffer_word_size(g, c->first_word + w);
    return size;
}

/* What the file's channels are; in full float they are the planes. */
static void print_layout(const tl_gbuffer *g)
{
    tl_word_channel channels[TL_MAX_WORDS];
    const size_t count = tl_word_channels(g->layout, g->present, channels);
    printf("layout      %s, %u bytes per pixel in memory\n", tl_layout_word(g->layout),
           tl_gbuffer_pixel_size(g));
    if (g->layout == TL_LAYOUT_FLOAT)
        return;
    printf("%-40s %5s %6s\n", "channel", "type", "bytes");
    for (size_t i = 0; i < count; i++)
        printf("%-40s %5s %6u\n", channels[i].name, tl_word_types[channels[i].type],
               channel_size(g, &channels[i]));
}

static void print_samples(const tl_gbuffer *g)
{
    const uint32_t side = tl_samples_side(g->samples);
    if (side > 1)
        printf("samples     %u x %u for each pixel of a picture of %u x %u\n", side, side,
               g->camera.width / side, g->camera.height / side);
}

/* By their indices in the plane brdf. */
static void print_materials(const tl_material_names *names)
{
    for (uint32_t i = 0; i < names->count; i++) {
        printf("%-12s%-4u", i == 0 ? "materials" : "", i + 1);
        info_print_text(names->of[i][0] ? names->of[i] : "(no name)", 0);
        putchar('\n');
    }
}

static void print_shadows(const tl_shadow_maps *maps)
{
    static const double metre = 1.0;
    if (maps->count > 0)
        printf("%-12s %6s %7s %10s %9s %12s\n", "shadow map", "views", "texels", "texel, mm",
               "covered", "slack, mm");
    for (uint32_t i = 0; i < maps->count; i++) {
        const tl_shadow_map *map = &maps->of[i];
        printf("%-12s %6u %7u %10.3g %7.2f %% %12.3g\n", tl_shadow_kind_words[map->kind],
               tl_shadow_view_count(map), map->size, 1e3 * tl_shadow_texel_width(map, metre),
               100.0 * tl_shadow_coverage(map), 1e3 * (double)map->slack);
    }
    if (maps->count > 0)
        puts("(a texel of a map that is no directional one: 1 m away)");
}

static json_t *shadows_json(const tl_shadow_maps *maps)
{
    json_t *out = json_array();
    for (uint32_t i = 0; i < maps->count; i++) {
        const tl_shadow_map *map = &maps->of[i];
        json_array_append_new(
            out, json_pack("{ss si si sf sf sf so so}", "kind", tl_shadow_kind_words[map->kind],
                           "views", (int)tl_shadow_view_count(map), "size", (int)map->size,
                           "texel_m", tl_shadow_texel_width(map, 1.0), "coverage",
                           tl_shadow_coverage(map), "slack_m", (double)map->slack, "position",
                           tl_json_numbers(map->position, 3), "direction",
                           tl_json_numbers(map->direction, 3)));
    }
    return out;
}

static void print_layers(const tl_gbuffer *g)
{
    for (uint32_t i = 0; i < g->layers.count; i++)
        printf("%-12s%-4u %.2f %% covered\n", i == 0 ? "layer" : "", i,
               100.0 * tl_layer_coverage(g, i));
    if (g->layers.left > 0)
        printf("            more would change %.3g %% of the picture\n",
               100.0 * tl_layers_left_share(g));
}

static json_t *layers_json(const tl_gbuffer *g)
{
    json_t *covered = json_array();
    for (uint32_t i = 0; i < g->layers.count; i++)
        json_array_append_new(covered, json_real(tl_layer_coverage(g, i)));
    return json_pack("{so sI sf}", "coverage", covered, "left", (json_int_t)g->layers.left,
                     "left_share", tl_layers_left_share(g));
}

static void print_objects(const tl_gbuffer *g)
{
    for (uint32_t i = 0; i < g->objects.count; i++) {
        printf("%-12s%-4u", i == 0 ? "objects" : "", g->objects.of[i].id);
        info_print_text(g->objects.of[i].name, 0);
        putchar('\n');
    }
    if (g->ids && g->objects.count == 0)
        puts("objects     by ids without names");
}

/* null where pixels do not say what they show. */
static json_t *objects_json(const tl_gbuffer *g)
{
    json_t *out = g->ids ? json_array() : json_null();
    for (uint32_t i = 0; i < g->objects.count; i++)
        json_array_append_new(out, json_pack("{sI ss}", "id", (json_int_t)g->objects.of[i].id,
                                             "name", g->objects.of[i].name));
    return out;
}

static json_t *materials_json(const tl_material_names *names)
{
    json_t *out = json_array();
    for (uint32_t i = 0; i < names->count; i++)
        json_array_append_new(out, json_string(names->of[i]));
    return out;
}

void info_print_gbuffer(const info_gbuffer *of)
{
    const tl_gbuffer *g = of->pixels;
    printf("G-buffer    %u x %u pixels, %.2f %% covered\n", g->camera.width, g->camera.height,
           100.0 * coverage(g));
    print_samples(g);
    print_layout(of->file);
    print_camera(&g->camera);
    printf("%-12s %12s %12s %12s\n", "plane", "min", "mean", "max");
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++) {
        if (!tl_gbuffer_plane(g, p))
            continue;
        const info_values values = measure(g, p);
        info_print_values(planes[p].channel, &values);
    }
    print_materials(&of->file->materials);
    print_objects(of->file);
    print_layers(of->file);
    print_shadows(&of->file->shadows);
    if (of->has_lights)
        info_print_lights(of->lights);
    else
        puts("no lights inside");
}

static json_t *camera_json(const tl_camera *c)
{
    double eye[3], towards[3];
    eye_of(c, eye, towards);
    json_t *out =
        json_pack("{ss s[fff] s[fff]}", "projection",
                  c->projection == TL_PERSPECTIVE ? "perspective" : "orthographic", "position",
                  eye[0], eye[1], eye[2], "direction", towards[0], towards[1], towards[2]);
    if (c->projection == TL_PERSPECTIVE)
        json_object_set_new(out, "field_of_view_degrees",
                            json_pack("[ff]", degrees((double)c->right, (double)c->left),
                                      degrees((double)c->top, (double)c->bottom)));
    const float edges[] = {c->left, c->right, c->bottom, c->top};
    json_object_set_new(out, "left_right_bottom_top", tl_json_numbers(edges, 4));
    json_object_set_new(out, "near", tl_json_number((double)c->near));
    json_object_set_new(out, "far", tl_json_number((double)c->far));
    return out;
}

static json_t *channels_json(const tl_gbuffer *g)
{
    tl_word_channel channels[TL_MAX_WORDS];
    const size_t count = tl_word_channels(g->layout, g->present, channels);
    json_t *out = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(out, json_pack("{ss ss si}", "name", channels[i].name, "type",
                                             tl_word_types[channels[i].type], "bytes",
                                             (int)channel_size(g, &channels[i])));
    return out;
}

json_t *info_gbuffer_json(const info_gbuffer *of)
{
    const tl_gbuffer *g = of->pixels;
    json_t *measured = json_object();
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++) {
        if (!tl_gbuffer_plane(g, p))
            continue;
        const info_values values = measure(g, p);
        json_object_set_new(measured, planes[p].channel, info_values_json(&values));
    }
    return json_pack("{ss s[ii] si sf ss si so so so so so so so so}", "kind", "gbuffer", "size",
                     (int)g->camera.width, (int)g->camera.height, "samples", (int)g->samples,
                     "coverage", coverage(g), "layout", tl_layout_word(of->file->layout),
                     "bytes_per_pixel", (int)tl_gbuffer_pixel_size(of->file), "channels",
                     channels_json(of->file), "camera", camera_json(&g->camera), "planes",
                     measured, "materials", materials_json(&of->file->materials), "objects",
                     objects_json(of->file), "layers", layers_json(of->file), "shadows",
                     shadows_json(&of->file->shadows), "lights",
                     of->has_lights ? info_lights_json(of->lights) : json_null());
}
