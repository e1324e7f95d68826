/* From what was asked for to a list of items. */
#ifndef TL_ITEM_LIST_H
#define TL_ITEM_LIST_H

#include "items.h"

/* As it was written; nothing is copied or kept. Either inputs or a manifest. */
typedef struct tl_batch_request {
    const char *const *inputs; /* [input_count]: patterns, globs, names of files */
    size_t input_count;
    const char
        *frames; /* a set as in frame_set.h, for inputs with a number; NULL: what is there */
    const char *manifest;       /* a path, "-" for standard input, or NULL */
    const char *const *outputs; /* [output_count] patterns */
    size_t output_count;
    const char *lights;          /* one file for all, a pattern, or NULL */
    unsigned shard, shard_count; /* the shard-th of so many, from 1; both 0: all */
} tl_batch_request;

/* Inputs, in their order:
 *
 *   a name with a number (pattern.h)   with a set: each frame of it, there or not; without: the frames that
 *                                      are there, from the lowest on
 *   a name with *, ? or [              the files that it fits, by their bytes; at least one
 *   any other name                     that file, there or not
 *
 * A file that has a name that is written so is that file, whatever signs it has. Items of the last two kinds
 * have the last number in their file's name as frame, where there is one.
 *
 * A manifest is JSON: objects, one a line or as an array, with
 *
 *   input     a path, which is all that is required
 *   output    a path, or `outputs`: an array of them; else the request's
 *   lights    a path; else the request's
 *   frame     a whole number
 *   name      without "/"; else as the input is called
 *
 * where paths that are not absolute start in the manifest's folder.
 *
 * In outputs and lights of the request, the number is the item's frame, and in outputs {name} its name.
 *
 * A shard has every shard_count-th item, from the shard-th on. What is refused is refused for all shards
 * alike: an output that two items have or that is something's input, one pattern without number or {name}
 * for several items, a number for an item without frame, a manifest's item with outputs where the request
 * has some. Paths are compared as written, but for "./" and "//".
 *
 * Fails with TL_ERR_ARGUMENT, TL_ERR_READ (a folder or manifest), TL_ERR_FORMAT (a manifest, with the line,
 * or of more than 256 MiB) or TL_ERR_MEMORY. *out is replaced on success and left alone on failure; the caller clears it. */
tl_status tl_items_list(const tl_batch_request *request, tl_item_list *out, tl_error *err);

#endif
