#define _POSIX_C_SOURCE 200809L
#include "sequence.h"

#include "try.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The one name of a path that has the number, and what is around it. */
typedef struct place {
    const tl_pattern *pattern;
    size_t name, name_end; /* in the pattern's text */
    char *folder;          /* that the name is in */
} place;

static tl_status find_place(const tl_pattern *pattern, place *out, tl_error *err)
{
    const char *text = pattern->text;
    size_t name = pattern->before;
    while (name > 0 && text[name - 1] != '/')
        name--;
    *out = (place){.pattern = pattern,
                   .name = name,
                   .name_end = pattern->behind + strcspn(text + pattern->behind, "/"),
                   .folder = name > 0 ? strndup(text, name) : strdup(".")};
    return out->folder ? TL_OK : tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", text);
}

/* The number in a name that has the right start; false where there is none. */
static bool read_frame(const place *at, const char *name, int32_t *out)
{
    const size_t before = at->pattern->before - at->name;
    if (strncmp(name, at->pattern->text + at->name, before) != 0)
        return false;
    const char *number = name + before;
    if (!isdigit((unsigned char)number[*number == '-']))
        return false;
    const long value = strtol(number, NULL, 10);
    if (value < -TL_FARTHEST_FRAME || value > TL_FARTHEST_FRAME)
        return false;
    *out = (int32_t)value;
    return true;
}

/* Whether the path of that frame is the one with this name, and there. */
static tl_status check_frame(
    const place *at, const char *name, int32_t frame, bool *is_there, tl_error *err)
{
    char *path = NULL;
    const char *rest = at->pattern->text + at->name_end;
    const tl_status status = tl_pattern_fill(at->pattern, frame, NULL, &path, err);
    if (status != TL_OK)
        return status;
    const size_t length = strlen(path) - strlen(rest) - at->name;
    *is_there = strlen(name) == length && strncmp(path + at->name, name, length) == 0 &&
                (!rest[0] || access(path, F_OK) == 0);
    free(path);
    return TL_OK;
}

static int ascending(const void *a, const void *b)
{
    const int32_t left = *(const int32_t *)a, right = *(const int32_t *)b;
    return left < right ? -1 : left > right;
}

static tl_status keep(tl_frames *to, size_t *capacity, int32_t frame, tl_error *err)
{
    if (to->count == TL_MOST_FRAMES)
        return tl_fail(err, TL_ERR_ARGUMENT, "more than %u frames in one sequence",
                       TL_MOST_FRAMES);
    if (to->count == *capacity) {
        const size_t larger = *capacity ? 2 * *capacity : 256;
        int32_t *grown = realloc(to->of, larger * sizeof *grown);
        if (!grown)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for a sequence");
        to->of = grown;
        *capacity = larger;
    }
    to->of[to->count++] = frame;
    return TL_OK;
}

static tl_status read_folder(const place *at, DIR *folder, tl_frames *out, tl_error *err)
{
    size_t capacity = 0;
    for (const struct dirent *entry; (errno = 0, entry = readdir(folder)) != NULL;) {
        int32_t frame;
        bool is_there = false;
        if (!read_frame(at, entry->d_name, &frame))
            continue;
        tl_status status = check_frame(at, entry->d_name, frame, &is_there, err);
        if (status == TL_OK && is_there)
            status = keep(out, &capacity, frame, err);
        if (status != TL_OK)
            return status;
    }
    return errno == 0 ? TL_OK
                      : tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", at->folder,
                                strerror(errno));
}

tl_status tl_sequence_find(const tl_pattern *pattern, tl_frames *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_frames found = {NULL, 0};
    place at = {.folder = NULL};
    DIR *folder = NULL;
    TRY(find_place(pattern, &at, err));
    folder = opendir(at.folder);
    if (!folder)
        TRY(tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", at.folder, strerror(errno)));
    TRY(read_folder(&at, folder, &found, err));
    if (found.count > 0)
        qsort(found.of, found.count, sizeof *found.of, ascending);
    tl_frames_clear(out);
    *out = found;
    found = (tl_frames){NULL, 0};
done:
    if (folder)
        closedir(folder);
    free(at.folder);
    tl_frames_clear(&found);
    return status;
}
