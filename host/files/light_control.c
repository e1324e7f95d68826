#define _POSIX_C_SOURCE 200809L
#include "tilelight/light_control.h"

#include "largest.h"
#include "suggest.h"
#include "tilelight/light_groups.h"
#include "try.h"

#include <ctype.h>
#include <fnmatch.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const tl_light_control_options[TL_LIGHT_CONTROL_COUNT] = {
#define OPTION(name, option, selects) [name] = option,
    TL_LIGHT_CONTROLS(OPTION)
#undef OPTION
};

/* Of ways to read a name the first that selects something counts. */
typedef bool selects(const tl_light *light, size_t index, const char *name);

static bool has_name(const tl_light *light, size_t index, const char *name)
{
    (void)index;
    return name[0] && strcmp(light->name, name) == 0;
}

static bool has_group(const tl_light *light, size_t index, const char *name)
{
    (void)index;
    return name[0] && strcmp(light->group, name) == 0;
}

static bool has_either(const tl_light *light, size_t index, const char *name)
{
    return has_name(light, index, name) || has_group(light, index, name);
}

static bool has_index(const tl_light *light, size_t index, const char *name)
{
    char *end = NULL;
    (void)light;
    return isdigit((unsigned char)name[0]) && strtoull(name, &end, 10) == index && !*end;
}

/* Nothing has no name: a pattern does not select it. */
static bool fits(const char *text, const char *pattern)
{
    return text[0] && fnmatch(pattern, text, 0) == 0;
}

/* A light without a name is selected by patterns of its index. */
static bool name_fits(const tl_light *light, size_t index, const char *name)
{
    char number[32];
    snprintf(number, sizeof number, "%zu", index);
    return fits(light->name[0] ? light->name : number, name);
}

static bool group_fits(const tl_light *light, size_t index, const char *name)
{
    (void)index;
    return fits(light->group, name);
}

static bool either_fits(const tl_light *light, size_t index, const char *name)
{
    return name_fits(light, index, name) || fits(light->group, name);
}

enum { MOST_WAYS = 3 };
static selects *const ways[TL_LIGHT_CONTROL_COUNT][MOST_WAYS] = {
    [TL_CONTROL_LIGHT] = {has_name, has_index, name_fits},
    [TL_CONTROL_GROUP] = {has_group, group_fits},
    [TL_CONTROL_SOLO] = {has_either, has_index, either_fits},
};

/* The words that could have been meant: names of lights, and of groups. */
typedef struct known_words {
    const char **words; /* [count] */
    size_t count;
} known_words;

static tl_status find_words(const tl_light_set *set,
                            tl_light_control_kind kind,
                            known_words *out,
                            tl_error *err)
{
    tl_light_group *groups = NULL;
    size_t group_count = 0;
    tl_status status = TL_OK;
    TRY(tl_light_groups_find(set, &groups, &group_count, err));
    out->words = malloc((set->count + group_count + 1) * sizeof *out->words);
    if (!out->words)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the names of lights"));
    for (size_t i = 0; kind != TL_CONTROL_LIGHT && i < group_count; i++)
        out->words[out->count++] = groups[i].name;
    for (size_t i = 0; kind != TL_CONTROL_GROUP && i < set->count; i++)
        if (set->lights[i].name[0])
            out->words[out->count++] = set->lights[i].name;
done:
    free(groups);
    return status;
}

/* `"key", "rim" and 3 more`, as far as it fits. */
static void list_words(const known_words *known, char *text, size_t size)
{
    enum { MOST_LISTED = 12 };
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < known->count; i++) {
        if (i == MOST_LISTED || used + 100 > size) {
            snprintf(text + used, size - used, " and %zu more", known->count - i);
            return;
        }
        used += (size_t)snprintf(text + used, size - used, "%s\"%s\"", i ? ", " : "",
                                 known->words[i]);
    }
}

static tl_status refuse(const tl_light_set *set, const tl_light_control *control, tl_error *err)
{
    const char *const what = control->kind == TL_CONTROL_GROUP   ? "group"
                             : control->kind == TL_CONTROL_LIGHT ? "light"
                                                                 : "light and no group";
    known_words known = {NULL, 0};
    char list[640], indices[64] = "";
    tl_status status = TL_OK;
    TRY(find_words(set, control->kind, &known, err));
    list_words(&known, list, sizeof list);
    if (control->kind != TL_CONTROL_GROUP && set->count > 0)
        snprintf(indices, sizeof indices, "; by index 0 to %zu", set->count - 1);
    const char *const meant = tl_suggest(control->name, known.words, known.count);
    status = tl_fail(err, TL_ERR_ARGUMENT, "%s: there is no %s \"%.64s\"%s%s%s; there %s%s%s",
                     tl_light_control_options[control->kind], what, control->name,
                     meant ? "; did you mean \"" : "", meant ? meant : "", meant ? "\"?" : "",
                     known.count ? "are " : "is none that has a name", list, indices);
done:
    free(known.words);
    return status;
}

/* What one control selects: selected[i] for light i. */
static tl_status select_lights(const tl_light_set *set,
                               const tl_light_control *control,
                               bool *selected,
                               tl_error *err)
{
    for (int way = 0; way < MOST_WAYS && ways[control->kind][way]; way++) {
        bool any = false;
        for (size_t i = 0; i < set->count; i++) {
            selected[i] = ways[control->kind][way](&set->lights[i], i, control->name);
            any = any || selected[i];
        }
        if (any)
            return TL_OK;
    }
    return refuse(set, control, err);
}

/* Products first, then all at once. */
static tl_status scale_lights(tl_light_set *set, const double *scales, tl_error *err)
{
    for (size_t i = 0; i < set->count; i++) {
        const tl_light *light = &set->lights[i];
        if (!((double)light->intensity * scales[i] <= (double)TL_BRIGHTEST))
            return tl_fail(err, TL_ERR_ARGUMENT,
                           "lights[%zu]%s%s%s is scaled to an intensity of %g; it must be from "
                           "0 to %g",
                           i, light->name[0] ? " \"" : "", light->name,
                           light->name[0] ? "\"" : "", (double)light->intensity * scales[i],
                           (double)TL_BRIGHTEST);
    }
    for (size_t i = 0; i < set->count; i++)
        set->lights[i].intensity = (float)((double)set->lights[i].intensity * scales[i]);
    return TL_OK;
}

tl_status tl_light_set_control(tl_light_set *set,
                               const tl_light_control *controls,
                               size_t count,
                               tl_error *err)
{
    tl_status status = TL_OK;
    double *const scales = malloc((set->count + 1) * sizeof *scales);
    bool *const selected = malloc(set->count + 1), *const heard = calloc(set->count + 1, 1);
    bool any_solo = false;
    if (!scales || !selected || !heard)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for what switches lights"));
    for (size_t i = 0; i < set->count; i++)
        scales[i] = 1.0;
    for (size_t c = 0; c < count; c++) {
        const bool is_solo = controls[c].kind == TL_CONTROL_SOLO;
        TRY(select_lights(set, &controls[c], selected, err));
        any_solo = any_solo || is_solo;
        for (size_t i = 0; i < set->count; i++) {
            heard[i] = heard[i] || (is_solo && selected[i]);
            scales[i] *= selected[i] && !is_solo ? (double)controls[c].scale : 1.0;
        }
    }
    for (size_t i = 0; any_solo && i < set->count; i++)
        scales[i] = heard[i] ? scales[i] : 0.0;
    TRY(scale_lights(set, scales, err));
done:
    free(scales);
    free(selected);
    free(heard);
    return status;
}
