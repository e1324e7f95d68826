/* What is read in pieces: a regular file, never a pipe that would make it wait. */
#ifndef TL_REGULAR_FILE_H
#define TL_REGULAR_FILE_H

#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The caller closes *descriptor. *size is in bytes. Fails with TL_ERR_READ. */
tl_status tl_regular_file_open(const char *path,
                               int *descriptor,
                               uint64_t *size,
                               tl_error *err);

/* Reads `size` bytes from `offset` on, or what there is until the file's end; *got: how many. False
 * where it fails, and errno says why. */
bool tl_regular_file_read_at(
    int descriptor, void *to, size_t size, uint64_t offset, size_t *got);

/* The first `room` bytes, or all if there are fewer; *got: how many. *size as above. Fails with
 * TL_ERR_READ. */
tl_status tl_regular_file_start(
    const char *path, void *bytes, size_t room, size_t *got, uint64_t *size, tl_error *err);

#endif
