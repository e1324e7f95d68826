#define _POSIX_C_SOURCE 200809L
#include "whole_file.h"

#include "atomic_file.h"
#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIRST_CAPACITY = 1 << 16 };

static tl_status grow(char **text, size_t *capacity, const char *name, tl_error *err)
{
    const size_t larger = *capacity ? 2 * *capacity : FIRST_CAPACITY;
    char *grown = realloc(*text, larger);
    if (!grown)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %zu bytes", name, larger);
    *text = grown;
    *capacity = larger;
    return TL_OK;
}

static tl_status read_all(
    int descriptor, const char *name, size_t limit, char **out, size_t *size, tl_error *err)
{
    tl_status status = TL_OK;
    char *text = NULL;
    size_t capacity = 0, length = 0;
    for (;;) {
        if (length + 1 >= capacity)
            TRY(grow(&text, &capacity, name, err));
        const ssize_t got = read(descriptor, text + length, capacity - length - 1);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            TRY(tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", name, strerror(errno)));
        if (got == 0)
            break;
        length += (size_t)got;
        if (length > limit)
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: is larger than the %zu MiB that are read",
                        name, limit >> 20));
    }
    text[length] = '\0';
    *out = text;
    *size = length;
    text = NULL;
done:
    free(text);
    return status;
}

tl_status tl_whole_file_read(
    const char *path, size_t limit, char **out, size_t *size, tl_error *err)
{
    if (strcmp(path, "-") == 0)
        return read_all(STDIN_FILENO, "standard input", limit, out, size, err);
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, strerror(errno));
    const tl_status status = read_all(descriptor, path, limit, out, size, err);
    close(descriptor);
    return status;
}

tl_status tl_whole_file_write(const char *path, const void *data, size_t size, tl_error *err)
{
    tl_status status = TL_OK;
    tl_atomic_file file = {0};
    int failure;
    if (strcmp(path, "-") == 0) {
        failure = tl_write_all(STDOUT_FILENO, data, size);
        return failure == 0 ? TL_OK : tl_write_failed("standard output", failure, err);
    }
    TRY(tl_atomic_file_begin(&file, path, err));
    failure = tl_write_all(file.descriptor, data, size);
    if (failure != 0)
        TRY(tl_write_failed(path, failure, err));
    TRY(tl_atomic_file_commit(&file, err));
done:
    tl_atomic_file_abandon(&file);
    return status;
}
