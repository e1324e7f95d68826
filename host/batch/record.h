/* What an output was made from, in a line that it has inside itself: an output that has another line, or
 * none, is not what would be made now. */
#ifndef TL_RECORD_H
#define TL_RECORD_H

#include "tilelight/error.h"
#include "tilelight/image.h"

#include <stddef.h>

/* "1 ", which says how the rest came about, 32 hexadecimal digits, and a NUL. */
#define TL_RECORD_SIZE 35

/* What a file is to an output: which other files count as soon as it does. */
typedef enum tl_record_role {
    TL_RECORD_PLAIN,  /* none */
    TL_RECORD_LIGHTS, /* those that a lights file names */
    TL_RECORD_CAPTURE /* those that the lights inside name; a capture that others light is plain */
} tl_record_role;

typedef struct tl_record_file {
    const char *path;
    tl_record_role role;
} tl_record_file;

/* What files came to that are used for many outputs; any number of threads may use it. */
typedef struct tl_record_cache tl_record_cache;

/* The caller releases *out with tl_record_cache_destroy. Fails with TL_ERR_MEMORY. */
tl_status tl_record_cache_create(tl_record_cache **out, tl_error *err);

/* Accepts NULL. */
void tl_record_cache_destroy(tl_record_cache *cache);

/* 128 bits of XXH3 over `options`, which is every choice that shows in the output, `version` of the program,
 * and the contents of files, in their order; what they are called does not count. Files that are no captures
 * are hashed again only when their size, inode or a time of theirs has changed, or did within the last two
 * seconds. Contents are read in pieces.
 *
 * Take it before the files are read for use: if one changes in between, the output says that it is of the
 * older content, and is made again. Fails with TL_ERR_READ, naming the file, or TL_ERR_MEMORY. */
tl_status tl_record_of(tl_record_cache *cache,
                       const char *options,
                       const char *version,
                       const tl_record_file *files,
                       size_t count,
                       char out[TL_RECORD_SIZE],
                       tl_error *err);

#endif
