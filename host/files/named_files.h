/* Which other files a file names that is lit from or by: pictures, profiles, the picture of a sky. */
#ifndef TL_NAMED_FILES_H
#define TL_NAMED_FILES_H

#include "tilelight/error.h"

#include <stddef.h>

/* Paths as found from here, each once, in the order of the file. All zero is empty; released with
 * tl_named_files_clear. */
typedef struct tl_named_files {
    char **of; /* [count] */
    size_t count;
} tl_named_files;

/* What a lights file names, and what the lights inside a capture do; they are not looked for. A file that is
 * none, or damaged, names nothing: whoever reads it whole says so. *out is replaced on success. Fail with
 * TL_ERR_READ where the file cannot be read, or TL_ERR_MEMORY. */
tl_status tl_lights_named_files(const char *path, tl_named_files *out, tl_error *err);
tl_status tl_capture_named_files(const char *path, tl_named_files *out, tl_error *err);

/* Leaves an empty list. Accepts one. */
void tl_named_files_clear(tl_named_files *files);

#endif
