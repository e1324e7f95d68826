#define _POSIX_C_SOURCE 200809L
#include "item_inputs.h"

#include "pattern.h"
#include "sequence.h"
#include "try.h"

#include <ctype.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

char *tl_item_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *suffix = strrchr(name, '.');
    return strndup(name, suffix && suffix > name ? (size_t)(suffix - name) : strlen(name));
}

/* The last number in a name, without a sign. */
static void find_frame(tl_item *item)
{
    const char *end = item->name + strlen(item->name);
    while (end > item->name && !isdigit((unsigned char)end[-1]))
        end--;
    const char *start = end;
    while (start > item->name && isdigit((unsigned char)start[-1]))
        start--;
    const long value = start < end ? strtol(start, NULL, 10) : -1;
    item->has_frame = value >= 0 && value <= TL_FARTHEST_FRAME;
    item->frame = item->has_frame ? (int32_t)value : 0;
}

/* Takes `input`, also where it fails. frame: NULL where the name is all that tells. */
static tl_status add_file(tl_item_list *list, char *input, const int32_t *frame, tl_error *err)
{
    tl_item item = {.input = input, .name = input ? tl_item_name(input) : NULL};
    if (!item.name) {
        tl_item_clear(&item);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a name");
    }
    if (frame) {
        item.frame = *frame;
        item.has_frame = true;
    } else {
        find_frame(&item);
    }
    return tl_items_add(list, &item, err);
}

static tl_status add_frames(tl_item_list *list,
                            const tl_pattern *pattern,
                            const tl_frames *frames,
                            tl_error *err)
{
    for (size_t i = 0; i < frames->count; i++) {
        char *input = NULL;
        tl_status status = tl_pattern_fill(pattern, frames->of[i], NULL, &input, err);
        if (status == TL_OK)
            status = add_file(list, input, &frames->of[i], err);
        if (status != TL_OK)
            return status;
    }
    return TL_OK;
}

static tl_status add_sequence(tl_item_list *list, const tl_pattern *pattern, tl_error *err)
{
    tl_status status = TL_OK;
    tl_frames found = {NULL, 0};
    TRY(tl_sequence_find(pattern, &found, err));
    if (found.count == 0)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%s: no file has such a name", pattern->text));
    TRY(add_frames(list, pattern, &found, err));
done:
    tl_frames_clear(&found);
    return status;
}

static int by_bytes(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static tl_status add_glob(tl_item_list *list, const char *input, tl_error *err)
{
    tl_status status = TL_OK;
    glob_t found = {.gl_pathc = 0};
    const int code = glob(input, GLOB_NOSORT, NULL, &found);
    if (code == GLOB_NOSPACE)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for names", input));
    if (code != 0)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%s: no file has such a name", input));
    qsort(found.gl_pathv, found.gl_pathc, sizeof *found.gl_pathv, by_bytes);
    for (size_t i = 0; i < found.gl_pathc; i++)
        TRY(add_file(list, strdup(found.gl_pathv[i]), NULL, err));
done:
    globfree(&found);
    return status;
}

tl_status tl_item_inputs_add(tl_item_list *list,
                             const char *input,
                             const tl_frames *frames,
                             tl_error *err)
{
    tl_pattern pattern;
    const tl_status status = tl_pattern_read(input, &pattern, err);
    if (status != TL_OK)
        return status;
    if (frames && pattern.digits == 0)
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "%s: there is no number in it that frames could take the place of; write "
            "#### or %%04d there",
            input);
    if (frames)
        return add_frames(list, &pattern, frames, err);
    if (access(input, F_OK) == 0)
        return add_file(list, strdup(input), NULL, err);
    if (pattern.digits > 0)
        return add_sequence(list, &pattern, err);
    if (strpbrk(input, "*?["))
        return add_glob(list, input, err);
    return add_file(list, strdup(input), NULL, err);
}
