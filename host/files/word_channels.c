#include "word_channels.h"

#include "plane_channels.h"

#include <stdio.h>
#include <string.h>

const char *const tl_word_types[] = {
    [TL_WORD_UINT] = "uint", [TL_WORD_HALF] = "half", [TL_WORD_FLOAT] = "float"};

/* Where an attribute stands in a row of the table, and what a channel's name says of it. */
static const struct {
    size_t at;       /* in tl_layout */
    uint32_t planes; /* it is there where the frame has one of these */
    const char *name;
    const char *parts; /* of three channels */
} attributes[] = {
    {offsetof(tl_layout, depth), TL_HAS(TL_DEPTH), "depth", "XYZ"},
    {offsetof(tl_layout, normal), TL_THREE(TL_NORMAL_X), "normal", "XYZ"},
    {offsetof(tl_layout, albedo), TL_THREE(TL_ALBEDO_R), "albedo", "RGB"},
    {offsetof(tl_layout, specular), TL_THREE(TL_SPECULAR_R), "specular", "RGB"},
    {offsetof(tl_layout, shininess), TL_HAS(TL_SHININESS), "shininess", ""},
    {offsetof(tl_layout, metallic), TL_GROUP_METAL_ROUGH, "metallic", ""},
    {offsetof(tl_layout, roughness), TL_GROUP_METAL_ROUGH, "roughness", ""},
    {offsetof(tl_layout, occlusion), TL_GROUP_OCCLUSION, "ao", ""},
    {offsetof(tl_layout, emissive), TL_GROUP_EMISSIVE, "emissive", "RGB"},
    {offsetof(tl_layout, brdf), TL_GROUP_BRDF, "brdf", ""},
    {offsetof(tl_layout, tangent), TL_GROUP_TANGENT, "tangent", "XYZ"},
};
enum { ATTRIBUTE_COUNT = sizeof attributes / sizeof attributes[0] };

static const tl_attribute *attribute_of(const tl_layout *layout, uint32_t present, size_t index)
{
    const tl_attribute *a =
        (const tl_attribute *)(const void *)((const char *)layout + attributes[index].at);
    return a->code && (attributes[index].planes & present) ? a : NULL;
}

static const char *name_of(const tl_layout *layout, size_t index)
{
    if (attributes[index].at == offsetof(tl_layout, depth) &&
        TL_IS_POSITION(layout->depth.code))
        return layout->depth.code == TL_DEPTH_VIEW_POSITION ? "viewPosition" : "worldPosition";
    if (attributes[index].at == offsetof(tl_layout, normal) &&
        layout->normal_space == TL_NORMALS_IN_VIEW)
        return "viewNormal";
    return attributes[index].name;
}

/* The bit of the channel's number that `part` begins at; -1: it is elsewhere, or there is none. */
static int place_of(const tl_layout *layout, const tl_word_channel *c, tl_channel part)
{
    uint32_t before = 0;
    for (uint32_t w = c->first_word; w < c->first_word + c->word_count; w++) {
        if (part.bits && part.word == w)
            return (int)(before + part.shift);
        before += 8 * layout->words[w].bytes;
    }
    return -1;
}

/* What of attribute `index` stands in the channel, as "albedo" or "normalXY"; returns the bit it begins
 * at, -1 where nothing does. */
static int describe(const tl_layout *layout,
                    uint32_t present,
                    const tl_word_channel *c,
                    size_t index,
                    char text[24])
{
    const tl_attribute *a = attribute_of(layout, present, index);
    char parts[4] = "";
    size_t here = 0, count = 0;
    int first = -1;
    for (size_t i = 0; a && i < 3; i++) {
        const int at = place_of(layout, c, a->channels[i]);
        count += a->channels[i].bits > 0;
        if (at < 0)
            continue;
        first = first < 0 || at < first ? at : first;
        parts[here++] = attributes[index].parts[i];
    }
    if (count == 2) /* a normal's two numbers are no axes */
        for (size_t i = 0; i < here; i++)
            parts[i] = (char)('U' + parts[i] - 'X');
    snprintf(text, 24, "%s%s", first < 0 ? "" : name_of(layout, index),
             here < count ? parts : "");
    return first;
}

/* All that stands in the channel, by rising bits. */
static void set_name(const tl_layout *layout, uint32_t present, tl_word_channel *c)
{
    size_t length = (size_t)snprintf(c->name, sizeof c->name, "word%02u", c->first_word);
    char separator = '.';
    for (int bit = 0; bit < 32; bit++)
        for (size_t i = 0; i < ATTRIBUTE_COUNT; i++) {
            char text[24];
            if (describe(layout, present, c, i, text) != bit)
                continue;
            length += (size_t)snprintf(c->name + length, sizeof c->name - length, "%c%s",
                                       separator, text);
            separator = '_';
        }
    if (separator == '.')
        snprintf(c->name + length, sizeof c->name - length, ".unused");
}

/* A word that is one number of floating point is such a channel; but an index is a whole number to whoever
 * reads the file. */
static enum tl_word_type type_of(const tl_layout *layout, uint32_t present, uint32_t word)
{
    for (size_t i = 0; i < ATTRIBUTE_COUNT; i++) {
        const tl_attribute *a = attribute_of(layout, present, i);
        for (size_t k = 0; a && k < 3; k++) {
            const tl_channel part = a->channels[k];
            if (part.word != word || part.bits != 8 * layout->words[word].bytes)
                continue;
            if (part.number == TL_NUMBER_FLOAT)
                return attributes[i].planes == TL_GROUP_BRDF ? TL_WORD_UINT : TL_WORD_FLOAT;
            if (part.number == TL_NUMBER_HALF)
                return TL_WORD_HALF;
        }
    }
    return TL_WORD_UINT;
}

/* Whether the word is an index, which memory holds as a float. */
static int is_index(const tl_layout *layout, uint32_t present, uint32_t word)
{
    const tl_channel c = layout->brdf.channels[0];
    return (present & TL_GROUP_BRDF) && layout->brdf.code && c.word == word &&
           c.number == TL_NUMBER_FLOAT;
}

static int joins(const tl_layout *layout, uint32_t present, const tl_word_channel *c)
{
    const uint32_t next = c->first_word + c->word_count;
    return c->type == TL_WORD_UINT && next < layout->word_count &&
           word_bytes(layout, present, next) > 0 &&
           type_of(layout, present, next) == TL_WORD_UINT &&
           c->bits + 8 * layout->words[next].bytes <= 32;
}

size_t tl_word_channels(enum tl_layout_name name,
                        uint32_t present,
                        tl_word_channel out[TL_MAX_WORDS])
{
    const tl_layout *layout = &tl_layouts[name];
    size_t count = 0;
    for (uint32_t w = 0; w < layout->word_count;) {
        tl_word_channel c = {
            .first_word = w, .word_count = 1, .bits = 8 * layout->words[w].bytes};
        if (word_bytes(layout, present, w) == 0) {
            w++;
            continue;
        }
        c.type = type_of(layout, present, w);
        c.held = is_index(layout, present, w) ? TL_WORD_FLOAT : c.type;
        while (joins(layout, present, &c))
            c.bits += 8 * layout->words[c.first_word + c.word_count++].bytes;
        if (name == TL_LAYOUT_FLOAT)
            snprintf(c.name, sizeof c.name, "%s", tl_plane_channels[w]);
        else
            set_name(layout, present, &c);
        out[count++] = c;
        w += c.word_count;
    }
    return count;
}

int tl_word_is_whole(const tl_word_channel *c)
{
    return c->word_count == 1 && c->bits == (c->type == TL_WORD_HALF ? 16u : 32u);
}
