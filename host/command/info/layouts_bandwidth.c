#include "layouts_bandwidth.h"

#include "bandwidth_model.h"
#include "json_values.h"
#include "layout.h"
#include "layouts.h"
#include "pass_bytes.h"

#include <stdbool.h>
#include <stdio.h>

/* The three ways that the article comes to a figure. Its text is inconsistent: depth has 32 bits in its
 * table 1, and 8 bytes in the example from which its table 2 is rounded. */
static const struct {
    const char *key, *heading;
    double depth_bytes; /* 0: equation 7, which has no variables left */
    int digits;         /* that the article's own figures are told with */
} forms[] = {
    {"equation_7", "equation 7: table 2", 0.0, 0},
    {"equation_6_depth_8", "equation 6, 8 bytes of depth", 8.0, 1},
    {"equation_6_depth_4", "equation 6, 4 bytes of depth", 4.0, 1},
};
enum { FORM_COUNT = sizeof forms / sizeof forms[0] };

static const double target_counts[] = {2.0, 3.0, 4.0};
static const double target_bits[] = {32.0, 64.0, 128.0};
enum {
    ROW_COUNT = sizeof target_counts / sizeof target_counts[0],
    COLUMN_COUNT = sizeof target_bits / sizeof target_bits[0]
};

/* 10^9 bytes a second. The rounded form knows one size for writing and reading: the larger. */
static double by_form(int form, tl_target_bytes targets)
{
    tl_bandwidth_variables variables = tl_bandwidth_variables_default();
    if (forms[form].depth_bytes <= 0.0)
        return 1e-9 * tl_bandwidth_rounded(targets.read);
    variables.depth_bytes = forms[form].depth_bytes;
    return 1e-9 * tl_bandwidth(&variables, targets);
}

static void print_article(void)
{
    const tl_bandwidth_variables v = tl_bandwidth_variables_default();
    printf(
        "Thibieroz, \"Deferred Shading with Multiple Render Targets\", ShaderX2, 2003: %.0f x "
        "%.0f pixels,\n%.0f full-screen passes, %.0f frames a second; in 10^9 bytes a "
        "second\n\n%-10s",
        v.width, v.height, v.shading_passes, v.frames_per_second, "");
    for (int form = 0; form < FORM_COUNT; form++)
        printf("   %-28s", forms[form].heading);
    printf("\n%-10s", "targets of");
    for (int form = 0; form < FORM_COUNT; form++)
        for (int column = 0; column < COLUMN_COUNT; column++)
            printf("%s%3.0f bits", column ? " " : "   ", target_bits[column]);
    putchar('\n');
    for (int row = 0; row < ROW_COUNT; row++) {
        printf("%10.0f", target_counts[row]);
        for (int form = 0; form < FORM_COUNT; form++)
            for (int column = 0; column < COLUMN_COUNT; column++)
                printf(
                    "%s%8.*f", column ? " " : "   ", forms[form].digits,
                    by_form(form, tl_targets_alike(target_counts[row], target_bits[column])));
        putchar('\n');
    }
    puts(
        "\nThe text is inconsistent: depth has 32 bits in table 1 and 8 bytes in the example, "
        "which equation 7\nrounds to half of 10^9 bytes a second for each byte of targets, and "
        "10 more.");
}

/* As capture makes them. Every target is there of which the frame has a word; a depth buffer is written
 * in any case, and counts as such. */
static tl_target_bytes target_bytes(enum tl_layout_name layout, uint32_t present)
{
    const tl_layout_info *info = tl_layout_describe(layout);
    tl_target_bytes bytes = {0.0, 0.0};
    for (uint32_t i = 0; i < info->target_count; i++) {
        const tl_target *target = &info->targets[i];
        const double texel = tl_format_describe(target->format)->bytes;
        bool is_there = false;
        for (uint32_t w = 0; w < target->word_count; w++)
            is_there |= word_bytes(&tl_layouts[layout], present, target->first_word + w) != 0;
        if (!is_there)
            continue;
        bytes.read += texel;
        if (target->format != TL_FORMAT_D24 && target->format != TL_FORMAT_D32F)
            bytes.written += texel;
    }
    return bytes;
}

/* What a layout is told for: its material, and no emission. */
typedef struct layout_bytes {
    uint32_t present;
    tl_target_bytes targets;
    double culling, shading, twice, written; /* of our passes */
} layout_bytes;

static layout_bytes bytes_of(enum tl_layout_name layout)
{
    const uint32_t present = layout_content(layout, 0);
    const tl_frame_extent pixel = {
        .layout = layout, .present = present, .specular = true, .pixels = 1.0};
    const tl_pass_words words = tl_pass_words_of(layout, present, true);
    const tl_pass_bytes culling = tl_culling_bytes(&pixel), shading = tl_shading_bytes(&pixel);
    return (layout_bytes){.present = present,
                          .targets = target_bytes(layout, present),
                          .culling = culling.words,
                          .shading = shading.words,
                          .twice = tl_words_size(layout, words.surfaces & words.colors),
                          .written = shading.radiance};
}

static void print_layout(enum tl_layout_name layout)
{
    const layout_bytes b = bytes_of(layout);
    printf("%-18s %7g %6g", tl_layout_word(layout), b.targets.written, b.targets.read);
    for (int form = 0; form < FORM_COUNT; form++)
        printf(" %7.1f", by_form(form, b.targets));
    printf("   %7g %7g %7g %7g %7g\n", b.culling, b.shading, b.written,
           b.culling + b.shading + b.written, b.twice);
}

void bandwidth_print(enum tl_layout_name first, enum tl_layout_name end)
{
    print_article();
    printf("\nThe model on the layouts' own targets, and the bytes of a pixel that our passes "
           "move:\n\n%-18s %14s %23s   %39s\n%-18s %7s %6s %7s %7s %7s   %7s %7s %7s %7s %7s\n",
           "", "targets, bytes", "the model, 10^9 B/s", "our passes, bytes", "layout",
           "written", "read", "eq. 7", "6: 8 B", "6: 4 B", "culling", "shading", "picture",
           "sum", "twice");
    for (int i = (int)first; i < (int)end; i++)
        print_layout((enum tl_layout_name)i);
    puts("\nCulling reads the words that positions are in, shading every word, and the picture "
         "is written.\n\"twice\": words that shading loads before the lights and again after "
         "them, when they are in the\ncache. Lists, lights and boxes of tiles come on top, "
         "whatever the layout.");
}

json_t *bandwidth_article_json(void)
{
    const tl_bandwidth_variables v = tl_bandwidth_variables_default();
    json_t *object = json_pack(
        "{ss s{sf sf sf sf sf sf sf sf sf sf sf sf}}", "source",
        "Thibieroz, \"Deferred Shading with Multiple Render Targets\", ShaderX2, 2003",
        "variables", "width", v.width, "height", v.height, "depth_bytes", v.depth_bytes,
        "back_buffer_bytes", v.back_buffer_bytes, "overdraw", v.overdraw, "sorting", v.sorting,
        "texture_bytes", v.texture_bytes, "building_lookups", v.building_lookups,
        "shading_lookups", v.shading_lookups, "shading_passes", v.shading_passes,
        "geometry_bytes", v.geometry_bytes, "frames_per_second", v.frames_per_second);
    json_t *rows = json_array();
    for (int row = 0; row < ROW_COUNT; row++)
        for (int column = 0; column < COLUMN_COUNT; column++) {
            json_t *cell = json_pack("{sf sf}", "targets", target_counts[row], "bits",
                                     target_bits[column]);
            for (int form = 0; form < FORM_COUNT; form++)
                json_object_set_new(
                    cell, forms[form].key,
                    tl_json_number(by_form(
                        form, tl_targets_alike(target_counts[row], target_bits[column]))));
            json_array_append_new(rows, cell);
        }
    json_object_set_new(object, "gbyte_per_s", rows);
    return object;
}

/* The numbers of the words in a set. */
static json_t *words_json(uint32_t words)
{
    json_t *array = json_array();
    for (int i = 0; i < 32; i++)
        if (words >> i & 1u)
            json_array_append_new(array, json_integer(i));
    return array;
}

json_t *bandwidth_layout_json(enum tl_layout_name layout)
{
    const layout_bytes b = bytes_of(layout);
    const tl_pass_words words = tl_pass_words_of(layout, b.present, true);
    json_t *model = json_object();
    for (int form = 0; form < FORM_COUNT; form++)
        json_object_set_new(model, forms[form].key, tl_json_number(by_form(form, b.targets)));
    return json_pack("{sf sf so s{sf sf sf sf} s{so so so}}", "target_bytes_written",
                     b.targets.written, "target_bytes_read", b.targets.read,
                     "model_gbyte_per_s", model, "counted_bytes_per_pixel", "culling",
                     b.culling, "shading", b.shading, "shading_twice", b.twice, "picture",
                     b.written, "words", "positions", words_json(words.positions), "surfaces",
                     words_json(words.surfaces), "colors", words_json(words.colors));
}
