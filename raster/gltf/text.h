/* The bytes of a scene file, and what has to hold before a JSON parser may see them. */
#ifndef TL_GLTF_TEXT_H
#define TL_GLTF_TEXT_H

#include "tilelight/error.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a regular file of 1 to `limit` bytes. The caller frees *out; `padding` zero bytes stand
 * behind the *size of the file. Fails with TL_ERR_READ (also for folders, pipes and devices),
 * TL_ERR_UNSUPPORTED (larger than the limit) or TL_ERR_MEMORY. */
tl_status tl_file_read(const char *path,
                       uint64_t limit,
                       size_t padding,
                       uint8_t **out,
                       size_t *size,
                       tl_error *err);

/* Where JSON and binary chunk lie in a scene file; pointers into it. */
typedef struct tl_gltf_text {
    const char *json;
    size_t json_size, binary_size; /* binary_size 0: there is no chunk */
    int is_binary;                 /* a .glb, whatever its name says */
} tl_gltf_text;

/* Finds the chunks. Fails with TL_ERR_FORMAT, naming the file, or TL_ERR_UNSUPPORTED for another
 * version of the container. */
tl_status tl_gltf_find_text(
    const char *path, const uint8_t *data, size_t size, tl_gltf_text *out, tl_error *err);

/* Refuses, with TL_ERR_FORMAT or TL_ERR_UNSUPPORTED, what would make the parser recurse or allocate
 * without bound: nesting deeper than TL_MAX_JSON_DEPTH, and more embedded buffers than
 * tl_max_buffer_bytes can hold, as each becomes a copy of the binary chunk. */
tl_status tl_gltf_guard_text(const char *path, const tl_gltf_text *text, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
