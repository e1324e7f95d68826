/* One layout, word by word. */
#include "json_values.h"
#include "layout.h"
#include "layouts.h"
#include "pass_bytes.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* What the rows of kernels/layout.h are made of, in words. */
static const char *const number_words[TL_NUMBER_COUNT] = {
    [TL_NUMBER_FLOAT] = "float",     [TL_NUMBER_HALF] = "half",
    [TL_NUMBER_FLOAT24] = "float24", [TL_NUMBER_UNORM] = "unorm",
    [TL_NUMBER_SNORM] = "snorm",     [TL_NUMBER_BYTES24] = "unorm, high byte first",
    [TL_NUMBER_WHOLE] = "whole",
};
static const char *const depth_words[TL_DEPTH_CODE_COUNT] = {
    [TL_DEPTH_METRES] = "metres",
    [TL_DEPTH_FORWARD] = "0 near to 1 far",
    [TL_DEPTH_NDC] = "-1 near to 1 far",
    [TL_DEPTH_REVERSED] = "1 near to 0 far",
    [TL_DEPTH_FRACTION] = "share of the way from near to far",
    [TL_DEPTH_VIEW_POSITION] = "position in view space, m",
    [TL_DEPTH_WORLD_POSITION] = "position in world space, m",
};
static const char *const normal_words[TL_NORMAL_CODE_COUNT] = {
    [TL_NORMAL_XYZ] = "x, y, z",
    [TL_NORMAL_SPHEREMAP] = "sphere map",
    [TL_NORMAL_OCTAHEDRON] = "octahedron",
};
static const char *const color_words[TL_COLOR_CODE_COUNT] = {
    [TL_COLOR_RGB] = "as it is",
    [TL_COLOR_SQUARED] = "square roots",
    [TL_COLOR_GRAY] = "one value for all channels",
    [TL_COLOR_SHARED] = "a mantissa each, one exponent (RGB9E5)",
};
static const char *const value_words_of[TL_VALUE_CODE_COUNT] = {
    [TL_VALUE_PLAIN] = "as it is",
    [TL_VALUE_LOGARITHM] = "logarithm of 1 + it",
};

static const struct {
    const char *name;
    size_t offset; /* of a tl_attribute in tl_layout */
    const char *const *codes;
    int plane; /* its first */
} attributes[] = {
    {"depth", offsetof(tl_layout, depth), depth_words, TL_DEPTH},
    {"normal", offsetof(tl_layout, normal), normal_words, TL_NORMAL_X},
    {"albedo", offsetof(tl_layout, albedo), color_words, TL_ALBEDO_R},
    {"specular", offsetof(tl_layout, specular), color_words, TL_SPECULAR_R},
    {"shininess", offsetof(tl_layout, shininess), value_words_of, TL_SHININESS},
    {"metallic", offsetof(tl_layout, metallic), value_words_of, TL_METALLIC},
    {"roughness", offsetof(tl_layout, roughness), value_words_of, TL_ROUGHNESS},
    {"occlusion", offsetof(tl_layout, occlusion), value_words_of, TL_OCCLUSION},
    {"emission", offsetof(tl_layout, emissive), color_words, TL_EMISSIVE_R},
    {"brdf", offsetof(tl_layout, brdf), value_words_of, TL_BRDF},
    {"tangent", offsetof(tl_layout, tangent), normal_words, TL_TANGENT_X},
};
enum { ATTRIBUTE_COUNT = sizeof attributes / sizeof attributes[0] };

static const tl_attribute *attribute_of(const tl_layout *layout, int index)
{
    return (const tl_attribute *)(const void *)((const char *)layout +
                                                attributes[index].offset);
}

static int channel_count(const tl_attribute *attribute)
{
    int count = 0;
    while (count < 3 && attribute->code && attribute->channels[count].bits)
        count++;
    return count;
}

/* Where three channels have one exponent, none of them is a number by itself. */
static const char *number_of(const tl_attribute *attribute, const tl_channel *channel)
{
    return channel->bits == 32 && channel->number == TL_NUMBER_UNORM &&
                   attribute->code == TL_COLOR_SHARED
               ? "RGB9E5"
               : number_words[channel->number];
}

static void print_targets(const tl_layout_info *info)
{
    for (uint32_t i = 0; i < info->target_count; i++) {
        const tl_target *target = &info->targets[i];
        char words[32];
        snprintf(words, sizeof words, "%u", target->first_word);
        if (target->word_count > 1)
            snprintf(words, sizeof words, "%u to %u", target->first_word,
                     target->first_word + target->word_count - 1);
        printf("%-12s%-12sword%s %-*s %s\n", i == 0 ? "targets" : "",
               tl_format_describe(target->format)->word, target->word_count > 1 ? "s" : "",
               target->word_count > 1 ? 7 : 8, words, target->holds);
    }
}

static void print_range(double low, double high)
{
    char text[64] = "any";
    if (!isinf(low))
        snprintf(text, sizeof text, "%g to %g", low, high);
    printf("%-18s", text);
}

static void print_attribute(enum tl_layout_name layout, int index)
{
    const tl_camera camera = layouts_camera();
    const tl_attribute *a = attribute_of(&tl_layouts[layout], index);
    double low = 0.0, high = 0.0;
    printf("%-11s %-40s", attributes[index].name,
           a->code ? attributes[index].codes[a->code] : "not stored");
    if (a->code) {
        tl_layout_range(&camera, layout, (enum tl_plane)attributes[index].plane, &low, &high);
        print_range(low, high);
    }
    for (int c = 0; c < channel_count(a); c++) {
        const tl_channel *channel = &a->channels[c];
        printf("%s%u: %u to %u %s", c ? ", " : "", channel->word, channel->shift,
               channel->shift + channel->bits - 1, number_of(a, channel));
    }
    putchar('\n');
}

static void print_error_bounds(enum tl_layout_name layout)
{
    const tl_camera camera = layouts_camera();
    const tl_layout_errors errors = tl_layout_errors_of(&camera, layout);
    const uint32_t can_hold = tl_layout_planes(layout);
    const char *label = "at most";
    for (int i = 0; i < ERROR_ROW_COUNT; i++) {
        double value = 0.0;
        memcpy(&value, (const char *)&errors + error_rows[i].offset, sizeof value);
        if (!(can_hold & error_rows[i].planes))
            continue;
        char amount[32] = "none";
        if (value > 0.0)
            snprintf(amount, sizeof amount, "%.1e", value);
        printf("%-12s%-8s %s%s\n", label, amount, error_rows[i].meaning,
               errors.specular_is_gray && (error_rows[i].planes & TL_HAS(TL_SPECULAR_R))
                   ? ", and half of what its channels are apart"
                   : "");
        label = "";
    }
}

static void print_word_set(const char *pass, uint32_t words)
{
    printf("            %s:", pass);
    for (int i = 0; i < TL_MAX_WORDS; i++)
        if (words >> i & 1u)
            printf(" %d", i);
    putchar('\n');
}

void layout_print_details(enum tl_layout_name layout)
{
    const tl_layout *row = &tl_layouts[layout];
    const tl_layout_info *info = tl_layout_describe(layout);
    const uint32_t all = layout_content(layout, TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE |
                                                    TL_GROUP_BRDF | TL_GROUP_TANGENT);
    const tl_pass_words words = tl_pass_words_of(layout, all, true);
    printf("%-12s%s\nsource      %s\n", tl_layout_word(layout), info->summary, info->source);
    printf("bytes       %u; with all that the layout can hold of a frame %u\n",
           layout_pixel_size(layout, layout_content(layout, 0)),
           layout_pixel_size(layout, all));
    print_targets(info);
    printf("normals     in %s space\n\n%-11s %-40s%-18s%s\n",
           row->normal_space == TL_NORMALS_IN_VIEW ? "view" : "world", "attribute", "as",
           "range", "word: bits");
    for (int i = 0; i < ATTRIBUTE_COUNT; i++)
        print_attribute(layout, i);
    puts("\nerrors, under the camera that `tilelight layouts' says");
    print_error_bounds(layout);
    puts("\nwords that passes need");
    print_word_set("culling", words.positions);
    print_word_set("shading, before the lights", words.surfaces);
    print_word_set("shading, after them", words.colors);
}

static json_t *channels_json(const tl_attribute *attribute)
{
    json_t *array = json_array();
    for (int c = 0; c < channel_count(attribute); c++) {
        const tl_channel *channel = &attribute->channels[c];
        json_array_append_new(array,
                              json_pack("{si si si ss}", "word", (int)channel->word, "shift",
                                        (int)channel->shift, "bits", (int)channel->bits,
                                        "number", number_of(attribute, channel)));
    }
    return array;
}

static json_t *attributes_json(enum tl_layout_name layout)
{
    const tl_camera camera = layouts_camera();
    json_t *object = json_object();
    for (int i = 0; i < ATTRIBUTE_COUNT; i++) {
        const tl_attribute *a = attribute_of(&tl_layouts[layout], i);
        double low = 0.0, high = 0.0;
        if (!a->code)
            continue;
        tl_layout_range(&camera, layout, (enum tl_plane)attributes[i].plane, &low, &high);
        json_object_set_new(object, attributes[i].name,
                            json_pack("{ss s[oo] so}", "code", attributes[i].codes[a->code],
                                      "range", tl_json_number(low), tl_json_number(high),
                                      "channels", channels_json(a)));
    }
    return object;
}

json_t *layout_words_json(enum tl_layout_name layout)
{
    const tl_layout *row = &tl_layouts[layout];
    json_t *sizes = json_array();
    for (uint32_t i = 0; i < row->word_count; i++)
        json_array_append_new(sizes, json_integer((json_int_t)row->words[i].bytes));
    return json_pack("{so ss so}", "bytes", sizes, "normals_in",
                     row->normal_space == TL_NORMALS_IN_VIEW ? "view" : "world", "attributes",
                     attributes_json(layout));
}
