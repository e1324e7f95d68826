/* Opening what is read in pieces: a regular file, never a pipe that would make it wait. */
#ifndef TL_REGULAR_FILE_H
#define TL_REGULAR_FILE_H

#include "tilelight/error.h"

#include <stddef.h>
#include <stdint.h>

/* The caller closes *descriptor. *size is in bytes. Fails with TL_ERR_READ. */
tl_status tl_regular_file_open(const char *path,
                               int *descriptor,
                               uint64_t *size,
                               tl_error *err);

/* The first `room` bytes, or all if there are fewer; *got: how many. *size as above. Fails with
 * TL_ERR_READ. */
tl_status tl_regular_file_start(
    const char *path, void *bytes, size_t room, size_t *got, uint64_t *size, tl_error *err);

#endif
