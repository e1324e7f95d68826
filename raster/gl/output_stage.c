#include "output_stage.h"

#include "layout.h"
#include "targets.h"

#include "tilelight/layouts.h"

#include <assert.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

/* --- what the channels of a code hold: functions of layout.glsl and kernels/encode.h ------------------ */

static const char *const depth_functions[TL_DEPTH_CODE_COUNT] = {
    [TL_DEPTH_METRES] = "metres_channels",
    [TL_DEPTH_FORWARD] = "nearness_channels", /* packed by the shader, or a depth buffer */
    [TL_DEPTH_NDC] = "ndc_channels",
    [TL_DEPTH_REVERSED] = "nearness_channels",
    [TL_DEPTH_FRACTION] = "fraction_channels",
    [TL_DEPTH_VIEW_POSITION] = "view_position_channels",
    [TL_DEPTH_WORLD_POSITION] = "world_position_channels",
};

static const char *const normal_functions[TL_NORMAL_CODE_COUNT] = {
    [TL_NORMAL_XYZ] = "vec3",
    [TL_NORMAL_OCTAHEDRON] = "octahedron_channels",
    [TL_NORMAL_SPHEREMAP] = "spheremap_channels",
};

static const char *const color_functions[TL_COLOR_CODE_COUNT] = {
    [TL_COLOR_RGB] = "vec3",
    [TL_COLOR_SQUARED] = "roots_of",
    [TL_COLOR_GRAY] = "gray_channels",
    [TL_COLOR_SHARED] = "shared_channels",
};

static const char *const value_functions[TL_VALUE_CODE_COUNT] = {
    [TL_VALUE_PLAIN] = "vec3",
    [TL_VALUE_LOGARITHM] = "logarithm_channels",
};

static const struct {
    const char *name, *argument;
    size_t offset;
    uint32_t planes;
    const char *const *functions;
} attributes[] = {
    {"depth", "s", offsetof(tl_layout, depth), TL_HAS(TL_DEPTH), depth_functions},
    {"normal", "n", offsetof(tl_layout, normal), TL_THREE(TL_NORMAL_X), normal_functions},
    {"albedo", "s.albedo", offsetof(tl_layout, albedo), TL_THREE(TL_ALBEDO_R), color_functions},
    {"specular", "s.specular", offsetof(tl_layout, specular), TL_THREE(TL_SPECULAR_R),
     color_functions},
    {"shininess", "s.shininess", offsetof(tl_layout, shininess), TL_HAS(TL_SHININESS),
     value_functions},
    {"metallic", "s.metallic", offsetof(tl_layout, metallic), TL_GROUP_METAL_ROUGH,
     value_functions},
    {"roughness", "s.roughness", offsetof(tl_layout, roughness), TL_GROUP_METAL_ROUGH,
     value_functions},
    {"occlusion", "s.occlusion", offsetof(tl_layout, occlusion), TL_GROUP_OCCLUSION,
     value_functions},
    {"emissive", "s.emissive", offsetof(tl_layout, emissive), TL_GROUP_EMISSIVE,
     color_functions},
    {"brdf", "s.brdf", offsetof(tl_layout, brdf), TL_GROUP_BRDF, value_functions},
    {"tangent", "s.tangent", offsetof(tl_layout, tangent), TL_GROUP_TANGENT, normal_functions},
};
enum { ATTRIBUTE_COUNT = sizeof attributes / sizeof attributes[0] };

/* --- text ------------------------------------------------------------------------------------------- */

typedef struct stage {
    const tl_layout *layout;
    uint32_t present;
    char *text;
    size_t length;
} stage;

static void say(stage *to, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void say(stage *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length =
        vsnprintf(to->text + to->length, TL_OUTPUT_STAGE_SIZE - to->length, format, arguments);
    va_end(arguments);
    to->length += (size_t)length;
    assert(to->length < TL_OUTPUT_STAGE_SIZE);
}

/* The attribute where the frame stores it, else NULL. */
static const tl_attribute *stored_attribute(const stage *to, int index)
{
    const tl_attribute *a = (const void *)((const char *)to->layout + attributes[index].offset);
    return a->code && (to->present & attributes[index].planes) ? a : NULL;
}

/* Numbers of few bits have no place for what is not a number; floats keep it for whoever repairs. */
static void say_normal(stage *to)
{
    const tl_layout *l = to->layout;
    const tl_channel c = l->normal.channels[0];
    say(to, "    vec3 n = %s(s.normal);\n",
        c.number == TL_NUMBER_FLOAT ? "vec3" : "valid_normal");
    if (l->normal_space == TL_NORMALS_IN_VIEW)
        say(to, "    n = view_space(n);\n");
    if (l->normal.code == TL_NORMAL_XYZ && c.number == TL_NUMBER_UNORM)
        say(to, "    n = raised_normal(n);\n");
}

/* Each attribute as three numbers, of which channels take as many as they are. An octahedron has steps, from
 * 0 to 1. */
static void say_attributes(stage *to)
{
    for (int i = 0; i < ATTRIBUTE_COUNT; i++) {
        const tl_attribute *a = stored_attribute(to, i);
        if (!a)
            continue;
        say(to, "    vec3 %s = %s(%s", attributes[i].name, attributes[i].functions[a->code],
            attributes[i].argument);
        if (attributes[i].functions == normal_functions && a->code == TL_NORMAL_OCTAHEDRON)
            say(to, ", %u.0", (1u << (a->channels[0].bits - 1u)) - 1u);
        say(to, ");\n");
    }
}

/* --- channels ---------------------------------------------------------------------------------------- */

/* Where a channel stands: bits of a word. */
typedef struct place {
    uint32_t word, shift;
} place;

/* A word that the shader packs, from all fields in it. */
static void say_packed_word(stage *to, const tl_target *target, uint32_t number)
{
    say(to, "    target_%u = 0u", number);
    for (int i = 0; i < ATTRIBUTE_COUNT; i++) {
        const tl_attribute *a = stored_attribute(to, i);
        for (int k = 0; a && k < 3; k++) {
            const tl_channel c = a->channels[k];
            if (c.bits == 0 || c.word != target->first_word)
                continue;
            const char *const name = attributes[i].name;
            if (c.bits == 32)
                say(to, " | shared_of(%s)", name);
            else if (c.number == TL_NUMBER_WHOLE)
                say(to, " | uint(%s.%c) << %uu", name, "xyz"[k], c.shift);
            else if (c.number == TL_NUMBER_FLOAT24)
                say(to, " | float24_field(%s.x) << %uu", name, c.shift);
            else
                say(to, " | %s_field(%s.%c, %uu) << %uu",
                    c.number == TL_NUMBER_SNORM ? "snorm" : "unorm", name, "xyz"[k], c.bits,
                    c.shift);
        }
    }
    say(to, ";\n");
}

/* The number at a place, which OpenGL converts; 0 where there is none. Of a whole number its share of the
 * largest, which OpenGL rounds back to it. */
static void say_number(stage *to, place at)
{
    for (int i = 0; i < ATTRIBUTE_COUNT; i++) {
        const tl_attribute *a = stored_attribute(to, i);
        for (int k = 0; a && k < 3; k++) {
            const tl_channel c = a->channels[k];
            if (c.bits == 0 || c.word != at.word || c.shift != at.shift)
                continue;
            say(to, "%s(%s.%c)", c.number == TL_NUMBER_HALF ? "rounded_half" : "float",
                attributes[i].name, "xyz"[k]);
            if (c.number == TL_NUMBER_WHOLE)
                say(to, " / %u.0", (1u << c.bits) - 1u);
            return;
        }
    }
    say(to, "0.0");
}

/* Bit `bit` of a texel. */
static place place_of(const tl_layout *layout, const tl_target *target, uint32_t bit)
{
    place at = {target->first_word, bit};
    while (at.word < layout->word_count && at.shift >= 8 * layout->words[at.word].bytes)
        at.shift -= 8 * layout->words[at.word++].bytes;
    return at;
}

static void say_numbers(stage *to, const tl_target *target, uint32_t number)
{
    const tl_format_row *format = tl_format_describe(target->format);
    const uint32_t bits =
        target->format == TL_FORMAT_RGB10_A2 ? 10 : 8 * format->bytes / format->channels;
    const uint32_t end = target->first_word + target->word_count;
    say(to, "    target_%u = vec4(", number);
    for (uint32_t k = 0; k < 4; k++) {
        const place at = place_of(to->layout, target, k * bits);
        say(to, k ? ", " : "");
        if (k < format->channels && at.word < end)
            say_number(to, at);
        else
            say(to, "0.0");
    }
    say(to, ");\n");
}

static bool is_depth_of_3x8(const tl_layout *layout, const tl_target *target)
{
    const tl_channel c = layout->depth.channels[0];
    return c.number == TL_NUMBER_BYTES24 && c.word == target->first_word;
}

static void say_target(stage *to, const tl_target *target, uint32_t number)
{
    if (target->format == TL_FORMAT_R32UI)
        say_packed_word(to, target, number);
    else if (is_depth_of_3x8(to->layout, target))
        say(to, "    target_%u = bytes24(forward24_of_nearness(depth.x));\n", number);
    else
        say_numbers(to, target, number);
}

void tl_output_stage(enum tl_layout_name layout, uint32_t present, int id_target, char *text)
{
    const tl_layout_info *info = tl_layout_describe(layout);
    stage to = {.layout = &tl_layouts[layout], .present = present, .text = text};
    text[0] = '\0';
    for (uint32_t i = 0; i < info->target_count; i++)
        if (tl_target_is_color(layout, present, i))
            say(&to, "layout(location = %u) out %s target_%u;\n", i,
                info->targets[i].format == TL_FORMAT_R32UI ? "uint" : "vec4", i);
    if (id_target >= 0)
        say(&to,
            "layout(location = %d) out uint target_id;\n"
            "layout(location = UNIFORM_OBJECT) uniform uint object;\n",
            id_target);
    say(&to, "void main()\n{\n    surface s = visible_surface();\n    keep_fragment();\n");
    if (!(present & TL_GROUP_METAL_ROUGH))
        say(&to, "    s = phong_surface(s);\n");
    say_normal(&to);
    say_attributes(&to);
    for (uint32_t i = 0; i < info->target_count; i++)
        if (tl_target_is_color(layout, present, i))
            say_target(&to, &info->targets[i], i);
    if (id_target >= 0)
        say(&to, "    target_id = object;\n");
    say(&to, "}\n");
}
