#define _POSIX_C_SOURCE 200809L
#include "text.h"

#include "load_limits.h"
#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static tl_status read_all(int file, uint8_t *data, size_t size, const char *path, tl_error *err)
{
    size_t done = 0;
    while (done < size) {
        const ssize_t got = read(file, data + done, size - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", path, strerror(errno));
        if (got == 0)
            return tl_fail(err, TL_ERR_READ, "%s: became shorter while it was read", path);
        done += (size_t)got;
    }
    return TL_OK;
}

tl_status tl_file_read(const char *path,
                       uint64_t limit,
                       size_t padding,
                       uint8_t **out,
                       size_t *size,
                       tl_error *err)
{
    tl_status status = TL_OK;
    struct stat facts;
    uint8_t *data = NULL;

    /* A pipe would block the opening itself; a regular file ignores the flag. */
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 || fstat(file, &facts) != 0) {
        status = tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, strerror(errno));
        goto done;
    }
    if (!S_ISREG(facts.st_mode)) {
        status = tl_fail(err, TL_ERR_READ, "%s: is not a regular file", path);
        goto done;
    }
    if (facts.st_size <= 0) {
        status = tl_fail(err, TL_ERR_READ, "%s: is empty", path);
        goto done;
    }
    if ((uint64_t)facts.st_size > limit) {
        status = tl_fail(err, TL_ERR_UNSUPPORTED,
                         "%s: is too large: %llu bytes, where %llu may be read", path,
                         (unsigned long long)facts.st_size, (unsigned long long)limit);
        goto done;
    }
    data = malloc((size_t)facts.st_size + padding);
    if (!data) {
        status = tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its %llu bytes", path,
                         (unsigned long long)facts.st_size);
        goto done;
    }
    TRY(read_all(file, data, (size_t)facts.st_size, path, err));
    memset(data + facts.st_size, 0, padding);

    *size = (size_t)facts.st_size;
    *out = data;
    data = NULL;
done:
    free(data);
    if (file >= 0)
        close(file);
    return status;
}

static uint32_t little_endian(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

enum { HEADER = 12, CHUNK_HEADER = 8 };
static const uint32_t chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;

/* The chunk at `at`, if it is of this kind and inside the file. */
static tl_status find_chunk(const char *path,
                            const uint8_t *data,
                            size_t size,
                            size_t at,
                            uint32_t kind,
                            size_t *chunk_size,
                            tl_error *err)
{
    const char *const name = kind == chunk_json ? "JSON" : "BIN";
    if (size - at < CHUNK_HEADER)
        return tl_fail(err, TL_ERR_FORMAT, "%s: is cut off before its %s chunk", path, name);
    if (little_endian(data + at + 4) != kind)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has no %s chunk where one must be", path, name);
    *chunk_size = little_endian(data + at);
    if (*chunk_size > size - at - CHUNK_HEADER)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: its %s chunk claims %zu bytes, but %zu are left in the file", path,
                       name, *chunk_size, size - at - CHUNK_HEADER);
    if (*chunk_size == 0 || *chunk_size % 4 != 0)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: its %s chunk has %zu bytes, which is no multiple of 4 above 0",
                       path, name, *chunk_size);
    return TL_OK;
}

tl_status tl_gltf_find_text(
    const char *path, const uint8_t *data, size_t size, tl_gltf_text *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_gltf_text found = {(const char *)data, size, 0, 0};

    if (size >= 4 && memcmp(data, "glTF", 4) == 0) {
        if (size < HEADER)
            return tl_fail(err, TL_ERR_FORMAT, "%s: is cut off in its header", path);
        if (little_endian(data + 4) != 2)
            return tl_fail(err, TL_ERR_UNSUPPORTED,
                           "%s: is binary glTF of version %u; version 2 can be read", path,
                           (unsigned)little_endian(data + 4));
        const size_t length = little_endian(data + 8);
        if (length > size || length < HEADER)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: its header says %zu bytes, but the file has %zu", path, length,
                           size);
        TRY(find_chunk(path, data, length, HEADER, chunk_json, &found.json_size, err));
        found.json = (const char *)data + HEADER + CHUNK_HEADER;
        found.is_binary = 1;
        const size_t next = HEADER + CHUNK_HEADER + found.json_size;
        if (next < length)
            TRY(find_chunk(path, data, length, next, chunk_binary, &found.binary_size, err));
    }
    *out = found;
done:
    return status;
}

/* A walk over JSON text that follows strings and brackets only: whether the text is JSON at all is
 * the parser's to say. */
typedef struct walk {
    size_t depth, element_count;
    bool in_string, escaped, in_buffers;
    size_t key_start; /* of the last string at the top level */
} walk;

static tl_status step(
    const char *path, const tl_gltf_text *text, size_t i, walk *at, tl_error *err)
{
    static const char key[] = "buffers";
    const char c = text->json[i];
    if (at->in_string) {
        if (at->escaped)
            at->escaped = false;
        else if (c == '\\' && at->depth == 1)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: a top-level name has a backslash, which no name of glTF has",
                           path);
        else if (c == '\\')
            at->escaped = true;
        else if (c == '"') {
            at->in_string = false;
            if (at->depth == 1)
                at->in_buffers = i - at->key_start == sizeof key - 1 &&
                                 memcmp(text->json + at->key_start, key, sizeof key - 1) == 0;
        }
        return TL_OK;
    }
    if (c == '"') {
        at->in_string = true;
        at->key_start = i + 1;
    } else if (c == '{' || c == '[') {
        if (at->depth++ == TL_MAX_JSON_DEPTH)
            return tl_fail(err, TL_ERR_FORMAT, "%s: is nested deeper than %d levels", path,
                           TL_MAX_JSON_DEPTH);
        at->element_count += at->in_buffers && at->depth == 3;
    } else if ((c == '}' || c == ']') && at->depth > 0)
        at->depth--;
    return TL_OK;
}

tl_status tl_gltf_guard_text(const char *path, const tl_gltf_text *text, tl_error *err)
{
    walk at = {0};
    for (size_t i = 0; i < text->json_size; i++) {
        const tl_status status = step(path, text, i, &at, err);
        if (status != TL_OK)
            return status;
    }
    if (text->binary_size > 0 && at.element_count > tl_max_buffer_bytes / text->binary_size)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: has %zu buffers beside a binary chunk of %zu bytes, too many", path,
                       at.element_count, text->binary_size);
    return TL_OK;
}
