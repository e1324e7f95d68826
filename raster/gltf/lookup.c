#define _POSIX_C_SOURCE 200809L
#include "lookup.h"

#include "printable.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

tl_label tl_label_of(const char *kind, size_t index, const char *name)
{
    enum { SHOWN = 48 }; /* characters of a name: enough to find it, too few to flood a log */
    tl_label label;
    char shown[SHOWN + 1];
    const char *const space = kind[0] ? " " : "";
    const size_t length = strnlen(name, SHOWN);
    if (length == 0) {
        snprintf(label.text, sizeof label.text, "%s%s%zu", kind, space, index);
        return label;
    }
    for (size_t i = 0; i < length; i++)
        shown[i] = tl_printable(name[i]);
    shown[length] = '\0';
    snprintf(label.text, sizeof label.text, "%s%s%zu (\"%s\")", kind, space, index, shown);
    return label;
}

bool tl_list_add(char *list, size_t size, const char *item)
{
    static const char more[] = " ...";
    const size_t length = strlen(list);
    const bool fits = length + strlen(item) + sizeof ", " + sizeof more <= size;
    snprintf(list + length, size - length, "%s%s", fits && length ? ", " : "",
             fits ? item : more);
    return fits;
}

bool tl_index_of(const char *text, size_t count, size_t *out)
{
    char *end;
    const long index = strtol(text, &end, 10);
    if (end == text || *end != '\0' || index < 0 || (size_t)index >= count)
        return false;
    *out = (size_t)index;
    return true;
}

tl_status tl_gltf_check_index(const tl_gltf *gltf,
                              const char *user,
                              const char *kind,
                              int index,
                              size_t count,
                              tl_error *err)
{
    if (index >= 0 && (size_t)index < count)
        return TL_OK;
    return tl_fail(err, TL_ERR_FORMAT, "%s: %s refers to %s %d, but the file has %zu",
                   gltf->path, user, kind, index, count);
}

tl_status tl_gltf_view_bytes(
    const tl_gltf *gltf, const char *user, int view, tl_gltf_bytes *out, tl_error *err)
{
    tl_status status =
        tl_gltf_check_index(gltf, user, "buffer view", view, gltf->view_count, err);
    if (status != TL_OK)
        return status;
    const tl_gltf_view *const found = &gltf->views[view];
    const tl_label label = tl_label_of("buffer view", (size_t)view, "");
    status =
        tl_gltf_check_index(gltf, label.text, "buffer", found->buffer, gltf->buffer_count, err);
    if (status != TL_OK)
        return status;
    const tl_gltf_bytes buffer = gltf->buffers[found->buffer];
    /* Subtraction, because the sum of two sizes from a file may wrap. */
    if (found->offset > buffer.size || found->size > buffer.size - found->offset)
        return tl_fail(
            err, TL_ERR_FORMAT,
            "%s: buffer view %d reaches outside buffer %d: %zu bytes from %zu on, of "
            "%zu",
            gltf->path, view, found->buffer, found->size, found->offset, buffer.size);
    *out = (tl_gltf_bytes){buffer.data + found->offset, found->size};
    return TL_OK;
}
