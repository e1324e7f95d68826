#include "item_outputs.h"

#include "pattern.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* The caller frees *out. */
static tl_status fill(
    const tl_pattern *pattern, const tl_item *item, const char *name, char **out, tl_error *err)
{
    if (pattern->digits > 0 && !item->has_frame)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s has no number that could take its place in %s",
                       item->input, pattern->text);
    return tl_pattern_fill(pattern, item->frame, name, out, err);
}

static tl_status fill_output(tl_item_list *list, size_t which, const char *text, tl_error *err)
{
    tl_pattern pattern;
    tl_status status = tl_pattern_read(text, &pattern, err);
    if (status == TL_OK && list->count > 1 && pattern.digits == 0 &&
        !tl_pattern_has_name(&pattern))
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "%s: all of %zu frames would be written there; put #### or {name} into it", text,
            list->count);
    for (size_t i = 0; i < list->count && status == TL_OK; i++)
        status =
            fill(&pattern, &list->of[i], list->of[i].name, &list->of[i].outputs[which], err);
    return status;
}

tl_status tl_item_outputs_fill(tl_item_list *list,
                               const char *const *patterns,
                               size_t count,
                               tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < list->count; i++) {
        list->of[i].outputs = calloc(count, sizeof *list->of[i].outputs);
        if (!list->of[i].outputs)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for names");
        list->of[i].output_count = count;
    }
    for (size_t which = 0; which < count && status == TL_OK; which++)
        status = fill_output(list, which, patterns[which], err);
    return status;
}

tl_status tl_item_lights_fill(tl_item_list *list, const char *text, tl_error *err)
{
    tl_pattern pattern;
    tl_status status = tl_pattern_read(text, &pattern, err);
    for (size_t i = 0; i < list->count && status == TL_OK; i++)
        if (!list->of[i].lights)
            status = fill(&pattern, &list->of[i], NULL, &list->of[i].lights, err);
    return status;
}

/* One path of an item. */
typedef struct use {
    const char *path;
    const tl_item *item;
    bool is_output;
} use;

/* What names no other place: "./" at the start of a name, and slashes behind the first. */
static const char *skip_idle(const char *at, char before)
{
    for (;;) {
        if (at[0] == '/' && before == '/')
            at++;
        else if (at[0] == '.' && at[1] == '/' && (before == '/' || before == '\0'))
            at += 2 + strspn(at + 2, "/");
        else
            return at;
    }
}

static int compare_paths(const char *a, const char *b)
{
    for (char before = '\0';; before = *a++, b++) {
        a = skip_idle(a, before);
        b = skip_idle(b, before);
        if (*a != *b || *a == '\0')
            return (unsigned char)*a - (unsigned char)*b;
    }
}

/* Outputs before others of the same path. */
static int by_path(const void *a, const void *b)
{
    const use *left = a, *right = b;
    const int order = compare_paths(left->path, right->path);
    return order ? order : right->is_output - left->is_output;
}

static tl_status check_neighbours(const use *first, const use *second, tl_error *err)
{
    if (!first->is_output || compare_paths(first->path, second->path) != 0)
        return TL_OK;
    if (second->is_output && strcmp(first->item->input, second->item->input) == 0)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: %s would be written there twice", first->path,
                       first->item->input);
    if (second->is_output)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: both %s and %s would be written there",
                       first->path, first->item->input, second->item->input);
    return tl_fail(err, TL_ERR_ARGUMENT,
                   "%s: is %s, and would be written over; choose another name for the output",
                   first->path,
                   second->path == second->item->input ? "an input" : "a lights file");
}

static size_t collect_uses(const tl_item_list *list, use *to)
{
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++) {
        const tl_item *item = &list->of[i];
        to[count++] = (use){item->input, item, false};
        if (item->lights)
            to[count++] = (use){item->lights, item, false};
        for (size_t k = 0; k < item->output_count; k++)
            to[count++] = (use){item->outputs[k], item, true};
    }
    return count;
}

tl_status tl_item_outputs_check(const tl_item_list *list, tl_error *err)
{
    tl_status status = TL_OK;
    size_t most = 1;
    for (size_t i = 0; i < list->count; i++)
        most += 2 + list->of[i].output_count;
    use *uses = malloc(most * sizeof *uses);
    if (!uses)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu names", most);
    const size_t count = collect_uses(list, uses);
    qsort(uses, count, sizeof *uses, by_path);
    for (size_t i = 1; i < count; i++)
        TRY(check_neighbours(&uses[i - 1], &uses[i], err));
done:
    free(uses);
    return status;
}
