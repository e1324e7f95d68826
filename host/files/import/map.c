/* The words of --map and of what numbers mean, and the defaults of all options of importing. */
#include "aliases.h"
#include "suggest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Blender writes 1e10 where nothing was hit; no scene is a million kilometres deep. */
static const double far_away = 1e9;

const char *const tl_depth_kind_words[TL_DEPTH_KIND_COUNT] = {
#define DEPTH_WORD(name, word, meaning) [name] = word,
    TL_DEPTH_KINDS(DEPTH_WORD)
#undef DEPTH_WORD
};

const char *const tl_import_space_words[TL_SPACE_COUNT] = {
#define SPACE_WORD(name, word, meaning) [name] = word,
    TL_IMPORT_SPACES(SPACE_WORD)
#undef SPACE_WORD
};

tl_import_options tl_import_options_default(void)
{
    return (tl_import_options){
        .unit = 1.0, .sky_from = far_away, .camera = {.up = {0.0, 1.0, 0.0}}};
}

/* Whether a text without a colon names a file rather than channels. */
static bool is_file(const char *text, size_t length)
{
    static const char *const suffixes[] = {".exr", ".pfm", ".png"};
    for (size_t i = 0; i < sizeof suffixes / sizeof suffixes[0]; i++)
        if (length > 4 && memcmp(text + length - 4, suffixes[i], 4) == 0)
            return true;
    return false;
}

static tl_status copy(
    const char *text, size_t length, char *to, size_t size, const char *what, tl_error *err)
{
    if (length >= size)
        return tl_fail(err, TL_ERR_ARGUMENT, "the name of its %s is too long", what);
    memcpy(to, text, length);
    to[length] = '\0';
    return TL_OK;
}

static tl_status find_plane(const char *text,
                            size_t length,
                            tl_import_plane *out,
                            tl_error *err)
{
    char typed[32], list[256] = "";
    const char *words[TL_IMPORT_COUNT];
    snprintf(typed, sizeof typed, "%.*s", (int)(length < 31 ? length : 31), text);
    for (size_t i = 0, used = 0; i < TL_IMPORT_COUNT; i++) {
        words[i] = tl_import_kinds[i].word;
        if (strcmp(words[i], typed) == 0) {
            *out = (tl_import_plane)i;
            return TL_OK;
        }
        used +=
            (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", words[i]);
    }
    const char *near = tl_suggest(typed, words, TL_IMPORT_COUNT);
    return tl_fail(err, TL_ERR_ARGUMENT, "no such plane \"%s\"%s%s%s; planes: %s", typed,
                   near ? ": did you mean \"" : "", near ? near : "", near ? "\"?" : "", list);
}

tl_status tl_import_map_parse(const char *text, tl_import_map *out, tl_error *err)
{
    const char *equals = strchr(text, '=');
    tl_import_map map = {.file = ""};
    if (!equals || !equals[1])
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "\"%.100s\" is no map; write PLANE=[FILE:][PART/]CHANNELS, as "
                       "depth=depth.exr:R or normal=N.XYZ",
                       text);
    tl_status status = find_plane(text, (size_t)(equals - text), &map.plane, err);
    const char *rest = equals + 1, *colon = strrchr(rest, ':');
    if (status == TL_OK && !colon && is_file(rest, strlen(rest)))
        colon = rest + strlen(rest);
    if (status == TL_OK && colon) {
        status = copy(rest, (size_t)(colon - rest), map.file, sizeof map.file, "file", err);
        rest = *colon ? colon + 1 : colon;
    }
    const char *slash = strrchr(rest, '/');
    if (status == TL_OK && slash) {
        status = copy(rest, (size_t)(slash - rest), map.part, sizeof map.part, "part", err);
        rest = slash + 1;
    }
    if (status == TL_OK)
        status = copy(rest, strlen(rest), map.channels, sizeof map.channels, "channels", err);
    if (status == TL_OK)
        *out = map;
    return status;
}
