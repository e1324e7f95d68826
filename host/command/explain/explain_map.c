#include "explain_map.h"

#include "ramp.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t tile_count(const explained *e)
{
    return (size_t)e->tiles_x * e->tiles_y;
}

static int class_of(const map_scale *scale, double value)
{
    int i = 0;
    while (i + 1 < scale->count && value > scale->of[i].to)
        i++;
    return i;
}

static double value_of(const map_scale *scale, size_t tile)
{
    return scale->lights ? (double)scale->lights[tile] : scale->us[tile];
}

static int is_shown_as_sky(const explained *e, const map_scale *scale, size_t tile)
{
    return scale->lights && e->surfaces[tile] == 0;
}

static void count_tiles(const explained *e, map_scale *scale)
{
    for (size_t t = 0; t < tile_count(e); t++) {
        if (is_shown_as_sky(e, scale, t))
            scale->sky_tiles++;
        else
            scale->of[class_of(scale, value_of(scale, t))].tiles++;
    }
}

map_scale explain_map_scale(const explained *e)
{
    map_scale scale = {.lights = e->lights, .count = 1, .sky = {128, 128, 128}};
    uint32_t most = 0;
    for (size_t t = 0; t < tile_count(e); t++)
        if (e->surfaces[t] > 0 && e->lights[t] > most)
            most = e->lights[t];
    scale.of[0].above = -1.0;
    const uint32_t classes = most < MOST_MAP_CLASSES ? most : MOST_MAP_CLASSES;
    for (uint32_t i = 0; i < classes; i++) {
        map_class *of = &scale.of[scale.count++];
        of->above = (double)((uint64_t)most * i / classes);
        of->to = (double)((uint64_t)most * (i + 1) / classes);
        tl_ramp(classes > 1 ? (double)i / (classes - 1) : 1.0, of->color);
    }
    count_tiles(e, &scale);
    return scale;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

tl_status explain_cost_scale(const explained *e, map_scale *out, tl_error *err)
{
    const size_t count = tile_count(e);
    map_scale scale = {.us = e->tile_us, .count = MOST_MAP_CLASSES};
    double *sorted = malloc(count * sizeof *sorted);
    if (!sorted)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for times of %zu tiles", count);
    memcpy(sorted, e->tile_us, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, ascending);
    const double common = sorted[(count - 1) * 99 / 100], most = sorted[count - 1];
    free(sorted);
    for (int i = 0; i < scale.count; i++) {
        map_class *of = &scale.of[i];
        of->above = common * i / scale.count;
        of->to = i + 1 < scale.count ? common * (i + 1) / scale.count : most;
        tl_ramp((double)i / (scale.count - 1), of->color);
    }
    count_tiles(e, &scale);
    *out = scale;
    return TL_OK;
}

static const uint8_t *color_of(const explained *e, const map_scale *scale, size_t tile)
{
    return is_shown_as_sky(e, scale, tile)
               ? scale->sky
               : scale->of[class_of(scale, value_of(scale, tile))].color;
}

tl_status explain_map_write(
    const job *j, const explained *e, const map_scale *scale, const char *path, tl_error *err)
{
    const uint32_t side = tl_samples_side(j->gbuffer->samples);
    const uint32_t width = j->gbuffer->camera.width / side;
    const uint32_t height = j->gbuffer->camera.height / side;
    uint8_t *rgb = malloc(3 * (size_t)width * height), *to = rgb;
    if (!rgb)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a map of %u x %u pixels", width,
                       height);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++, to += 3) {
            const size_t tile =
                (size_t)(y * side / e->tile_size) * e->tiles_x + x * side / e->tile_size;
            memcpy(to, color_of(e, scale, tile), 3);
        }
    const tl_status status = tl_png_write(path, rgb, width, height, TL_CURVE_SRGB, err);
    free(rgb);
    return status;
}

static void color_text(const uint8_t color[3], char text[8])
{
    snprintf(text, 8, "#%02x%02x%02x", color[0], color[1], color[2]);
}

void explain_map_print(const map_scale *scale, const char *path)
{
    char color[8];
    fprintf(stderr, "%s\n", path);
    if (scale->lights) {
        color_text(scale->sky, color);
        fprintf(stderr, "  %s  sky alone%16s %10" PRIu32 " tiles\n", color, "",
                scale->sky_tiles);
    }
    for (int i = 0; i < scale->count; i++) {
        const map_class *of = &scale->of[i];
        color_text(of->color, color);
        if (scale->lights)
            fprintf(stderr, "  %s  %7.0f to %7.0f lights %10" PRIu32 " tiles\n", color,
                    of->above + 1.0, of->to, of->tiles);
        else
            fprintf(stderr, "  %s  %7.2f to %7.2f us %10" PRIu32 " tiles\n", color, of->above,
                    of->to, of->tiles);
    }
}

json_t *explain_map_json(const map_scale *scale, const char *path)
{
    json_t *classes = json_array();
    json_t *map = json_pack("{ss so}", "file", path, "classes", classes);
    char color[8];
    for (int i = 0; i < scale->count; i++) {
        const map_class *of = &scale->of[i];
        color_text(of->color, color);
        json_t *row = json_pack("{ss sI}", "color", color, "tiles", (json_int_t)of->tiles);
        if (scale->lights)
            json_object_update_new(row, json_pack("{sI sI}", "from", (json_int_t)of->above + 1,
                                                  "to", (json_int_t)of->to));
        else
            json_object_update_new(
                row, json_pack("{sf sf}", "above_us", of->above, "to_us", of->to));
        json_array_append_new(classes, row);
    }
    color_text(scale->sky, color);
    if (scale->lights)
        json_object_set_new(
            map, "sky",
            json_pack("{ss sI}", "color", color, "tiles", (json_int_t)scale->sky_tiles));
    return map;
}
