/* Files that are read or written in one piece. */
#ifndef TL_WHOLE_FILE_H
#define TL_WHOLE_FILE_H

#include "tilelight/error.h"

#include <stddef.h>

/* The bytes of a file, or of standard input for "-", followed by a NUL that *size does not count.
 * The caller frees *out. A file larger than `limit` bytes fails with TL_ERR_FORMAT; else
 * TL_ERR_READ or TL_ERR_MEMORY. */
tl_status tl_whole_file_read(
    const char *path, size_t limit, char **out, size_t *size, tl_error *err);

/* Atomically, or to standard output for "-". Fails with TL_ERR_WRITE. */
tl_status tl_whole_file_write(const char *path, const void *data, size_t size, tl_error *err);

#endif
