#define _POSIX_C_SOURCE 200809L
#include "aliases.h"

#include "suggest.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

const tl_alias tl_aliases[] = {
#define ROW(plane, name, program, space, attribute) {plane, name, program, space, attribute},
    TL_ALIASES(ROW)
#undef ROW
};
const size_t tl_alias_count = sizeof tl_aliases / sizeof tl_aliases[0];

const tl_import_kind tl_import_kinds[TL_IMPORT_COUNT] = {
#define KIND(name, word, numbers, plane, meaning) [name] = {word, numbers, plane},
    TL_IMPORTS(KIND)
#undef KIND
};

/* Long enough for any name that can be in a table; longer ones match nothing. */
enum { LONGEST_NAME = 600 };

/* Components, in the order in which they are looked for. "" is the name alone. */
static const char *const vectors[][3] = {{"X", "Y", "Z"}, {"R", "G", "B"}};
static const char *const numbers[] = {"", "Z", "V", "Y", "R", "X"};
static const char *const coverage[] = {"", "A"};

/* A channel's name with its part's in front, where the part's says more. */
static const char *full_name(const tl_source *source, uint32_t channel, char name[LONGEST_NAME])
{
    const tl_source_channel *c = &source->channels[channel];
    const char *part = source->parts[c->part].name;
    if (!part[0] || strchr(c->name, '.') ||
        snprintf(name, LONGEST_NAME, "%s.%s", part, c->name) >= LONGEST_NAME)
        return c->name;
    return name;
}

/* Whether `name` is `wanted`, or ends in it behind a dot where layers may stand in front. */
static bool is_called(const char *name, const char *wanted, bool may_have_layers)
{
    const size_t length = strlen(name), end = strlen(wanted);
    if (length == end)
        return strcasecmp(name, wanted) == 0;
    return may_have_layers && length > end && name[length - end - 1] == '.' &&
           strcasecmp(name + length - end, wanted) == 0;
}

/* The channel in the same part whose name differs in its last letter alone; channel_count where
 * there is none. */
static uint32_t find_sibling(const tl_source *source, uint32_t channel, char last)
{
    const tl_source_channel *of = &source->channels[channel];
    const size_t length = strlen(of->name);
    for (uint32_t i = 0; i < source->channel_count; i++) {
        const tl_source_channel *c = &source->channels[i];
        if (c->part == of->part && c->is_number && strlen(c->name) == length && length > 0 &&
            memcmp(c->name, of->name, length - 1) == 0 &&
            strncasecmp(c->name + length - 1, &last, 1) == 0)
            return i;
    }
    return source->channel_count;
}

/* The Z of a vector is no depth: X stands beside it. */
static bool is_third_of_vector(const tl_source *source, uint32_t channel)
{
    const char *name = source->channels[channel].name;
    const size_t length = strlen(name);
    return length > 0 && strncasecmp(name + length - 1, "Z", 1) == 0 &&
           find_sibling(source, channel, 'X') < source->channel_count;
}

/* Whether the channel can be read as this plane: of whole numbers, indices alone. */
static bool suits(const tl_source_channel *c, tl_import_plane plane)
{
    return c->is_number || (c->is_whole && plane == TL_IMPORT_BRDF);
}

/* The first channel of this name, none of a vector where it is for one number; else channel_count. */
static uint32_t find_called(const tl_source *source,
                            const char *wanted,
                            bool may_have_layers,
                            tl_import_plane plane)
{
    const bool alone = tl_import_kinds[plane].numbers == 1;
    char buffer[LONGEST_NAME];
    for (uint32_t i = 0; i < source->channel_count; i++) {
        const tl_source_channel *c = &source->channels[i];
        if (!suits(c, plane) || strncasecmp(source->parts[c->part].name, "crypto", 6) == 0 ||
            (alone && is_third_of_vector(source, i)))
            continue;
        if (is_called(c->name, wanted, may_have_layers) ||
            is_called(full_name(source, i, buffer), wanted, may_have_layers))
            return i;
    }
    return source->channel_count;
}

static bool find_vector(const tl_source *source,
                        tl_import_plane plane,
                        const char *name,
                        bool layers,
                        uint32_t out[3])
{
    char wanted[LONGEST_NAME];
    for (size_t set = 0; set < 2; set++) {
        snprintf(wanted, sizeof wanted, "%s.%s", name, vectors[set][0]);
        out[0] = find_called(source, wanted, layers, plane);
        if (out[0] == source->channel_count)
            continue;
        out[1] = find_sibling(source, out[0], vectors[set][1][0]);
        out[2] = find_sibling(source, out[0], vectors[set][2][0]);
        if (out[1] < source->channel_count && out[2] < source->channel_count)
            return true;
    }
    return false;
}

static bool find_number(const tl_source *source,
                        tl_import_plane plane,
                        const char *name,
                        bool layers,
                        uint32_t *out)
{
    char wanted[LONGEST_NAME];
    const bool is_alpha = plane == TL_IMPORT_ALPHA;
    const char *const *components = is_alpha ? coverage : numbers;
    const size_t count =
        is_alpha ? sizeof coverage / sizeof coverage[0] : sizeof numbers / sizeof numbers[0];
    for (size_t i = 0; i < count; i++) {
        snprintf(wanted, sizeof wanted, "%s%s%s", name, components[i][0] ? "." : "",
                 components[i]);
        *out = find_called(source, wanted, layers, plane);
        if (*out < source->channel_count)
            return true;
    }
    return false;
}

/* Whether the row holds in this file. */
static bool holds(const tl_alias *alias, const tl_source *source)
{
    if (!alias->attribute)
        return true;
    for (uint32_t p = 0; p < source->part_count && source->format == &tl_source_exr; p++)
        if (tl_exr_part_has_attribute_like(&source->parts[p].exr, alias->attribute))
            return true;
    return false;
}

bool tl_alias_find(const tl_source *source, tl_import_plane plane, tl_binding *out)
{
    for (int with_layers = 0; with_layers < 2; with_layers++)
        for (size_t i = 0; i < tl_alias_count; i++) {
            const tl_alias *alias = &tl_aliases[i];
            if (alias->plane != plane || !holds(alias, source) ||
                (with_layers && !alias->name[1]))
                continue;
            const bool found =
                tl_import_kinds[plane].numbers == 3
                    ? find_vector(source, plane, alias->name, with_layers != 0, out->channels)
                    : find_number(source, plane, alias->name, with_layers != 0, out->channels);
            if (found) {
                out->is_bound = true;
                out->alias = alias;
                return true;
            }
        }
    return false;
}

static uint32_t find_exactly(const tl_source *source, const char *part, const char *name)
{
    for (uint32_t i = 0; i < source->channel_count; i++)
        if (strcmp(source->channels[i].name, name) == 0 &&
            (!part[0] || strcmp(source->parts[source->channels[i].part].name, part) == 0))
            return i;
    return source->channel_count;
}

/* BASE and a letter each; a dot between where `dot`. */
static bool find_letters(const tl_source *source,
                         const char *part,
                         const char *base,
                         size_t base_length,
                         bool dot,
                         const char letters[3],
                         uint32_t out[3])
{
    char wanted[LONGEST_NAME];
    for (int i = 0; i < 3; i++) {
        snprintf(wanted, sizeof wanted, "%.*s%s%c", (int)base_length, base, dot ? "." : "",
                 letters[i]);
        out[i] = find_exactly(source, part, wanted);
        if (out[i] == source->channel_count ||
            source->channels[out[i]].part != source->channels[out[0]].part)
            return false;
    }
    return true;
}

/* "a,b,c". */
static bool find_list(const tl_source *source,
                      const char *part,
                      const char *text,
                      uint32_t out[3])
{
    char name[LONGEST_NAME];
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(text, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        out[i] = find_exactly(source, part, name);
        text += length;
        if (out[i] == source->channel_count || (*text == ',') != (i < 2) ||
            source->channels[out[i]].part != source->channels[out[0]].part)
            return false;
        text++;
    }
    return true;
}

/* "N" stands for N.X, N.Y, N.Z or N.R, N.G, N.B; "N.XYZ", "RGB" for three that end in these letters. */
static bool find_three(const tl_source *source, const tl_import_map *map, uint32_t out[3])
{
    static const char sets[][4] = {"XYZ", "RGB", "xyz", "rgb"};
    const char *text = map->channels[0] ? map->channels : "RGB";
    const size_t length = strlen(text);
    if (strchr(text, ','))
        return find_list(source, map->part, text, out);
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++)
        if (find_letters(source, map->part, text, length, true, sets[i], out))
            return true;
    if (length >= 3 &&
        find_letters(source, map->part, text, length - 3, false, text + length - 3, out))
        return true;
    return !map->channels[0] && find_letters(source, map->part, "", 0, false, sets[0], out);
}

/* Without a name: the only channel, or the usual ones of a picture. */
static bool find_one(const tl_source *source, const tl_import_map *map, uint32_t *out)
{
    static const char *const usual[] = {"Z", "Y", "R"};
    if (map->channels[0])
        *out = find_exactly(source, map->part, map->channels);
    else if (source->channel_count == 1)
        *out = 0;
    else
        for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++) {
            *out = find_exactly(source, map->part, usual[i]);
            if (*out < source->channel_count)
                break;
        }
    return *out < source->channel_count;
}

static const char *closest(const tl_source *source, const char *text)
{
    enum { MOST = 256, LONGEST_SUGGESTED = 31 };
    const char *names[MOST];
    size_t count = 0;
    for (uint32_t i = 0; i < source->channel_count && count < MOST; i++)
        if (strlen(source->channels[i].name) <= LONGEST_SUGGESTED)
            names[count++] = source->channels[i].name;
    return tl_suggest(text, names, count);
}

static tl_status not_found(const tl_source *source, const tl_import_map *map, tl_error *err)
{
    const char *near = closest(source, map->channels);
    const unsigned wanted = tl_import_kinds[map->plane].numbers;
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s: --map %s: has no %s \"%.200s\"%s%.100s%s; `tilelight info' lists its "
                   "channels%s%s%s",
                   source->path, tl_import_kinds[map->plane].word,
                   wanted == 3 ? "three channels" : "channel",
                   map->channels[0] ? map->channels
                   : wanted == 3    ? "RGB"
                                    : "Z, Y or R",
                   map->part[0] ? " in a part \"" : "", map->part, map->part[0] ? "\"" : "",
                   near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
}

tl_status tl_map_find(const tl_source *source,
                      const tl_import_map *map,
                      tl_binding *out,
                      tl_error *err)
{
    const unsigned count = tl_import_kinds[map->plane].numbers;
    uint32_t found[3] = {source->channel_count, source->channel_count, source->channel_count};
    const bool is_found =
        count == 3 ? find_three(source, map, found) : find_one(source, map, &found[0]);
    if (!is_found)
        return not_found(source, map, err);
    for (unsigned i = 0; i < count; i++) {
        const tl_source_channel *c = &source->channels[found[i]];
        const char *refusal = source->parts[c->part].refusal;
        if (refusal[0])
            return tl_fail(err, TL_ERR_UNSUPPORTED, "--map %s: %s",
                           tl_import_kinds[map->plane].word, refusal);
        if (map->plane == TL_IMPORT_BRDF && source->format == &tl_source_png)
            return tl_fail(
                err, TL_ERR_UNSUPPORTED,
                "%s: --map brdf: the numbers of a PNG are shares of 1, and no indices; "
                "write them as OpenEXR or PFM",
                source->path);
        if (!suits(c, map->plane))
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: --map %s: channel \"%s\" holds whole numbers; it must be half "
                           "or float",
                           source->path, tl_import_kinds[map->plane].word, c->name);
        out->channels[i] = found[i];
    }
    out->is_bound = true;
    out->alias = NULL;
    return TL_OK;
}
