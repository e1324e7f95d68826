/* G-buffers as OpenEXR files; docs/file-formats.md describes them. */
#ifndef TL_GBUFFER_FILE_H
#define TL_GBUFFER_FILE_H

#include "gbuffer.h"
#include "lights.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How OpenEXR files are compressed: what its C library can write, which is all but DWAA and DWAB.
 * X(name, word, whether every number comes back bit for bit, meaning) */
#define TL_COMPRESSIONS(X)                                                                    \
    X(TL_COMPRESSION_NONE, "none", true, "numbers as they are")                               \
    X(TL_COMPRESSION_RLE, "rle", true, "runs of equal bytes, a row at a time")                \
    X(TL_COMPRESSION_ZIPS, "zips", true, "zlib, a row at a time")                             \
    X(TL_COMPRESSION_ZIP, "zip", true, "zlib, 16 rows at a time")                             \
    X(TL_COMPRESSION_PIZ, "piz", true, "wavelets and Huffman's code, 32 rows at a time")      \
    X(TL_COMPRESSION_PXR24, "pxr24", false, "zlib of floats that are rounded to 24 bits")     \
    X(TL_COMPRESSION_B44, "b44", false, "4 x 4 halves in 14 bytes; what is no half as it is") \
    X(TL_COMPRESSION_B44A, "b44a", false, "the same, and 3 bytes where all 16 are of one value")

typedef enum tl_compression {
#define TL_COMPRESSION_NAME(name, word, exact, meaning) name,
    TL_COMPRESSIONS(TL_COMPRESSION_NAME)
#undef TL_COMPRESSION_NAME
        TL_COMPRESSION_COUNT
} tl_compression;

/* Writes the G-buffer, in its layout, with a preview in R, G, B, A, and `lights` (may be NULL)
 * inside, on all threads. Under a temporary name beside `path`, synced, then
 * renamed: whatever happens, `path` is the old file, the new one, or absent. Fails with
 * TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_gbuffer_write_compressed(const char *path,
                                      const tl_gbuffer *gbuffer,
                                      const tl_light_set *lights,
                                      tl_compression compression,
                                      tl_error *err);

/* The same with TL_COMPRESSION_NONE. */
tl_status tl_gbuffer_write(const char *path,
                           const tl_gbuffer *gbuffer,
                           const tl_light_set *lights,
                           tl_error *err);

/* Reads what tl_gbuffer_write wrote, whatever its compression. Storage kind, sizes and channels
 * are checked before anything is allocated by them. The layout is the file's. The caller
 * releases *out with tl_gbuffer_destroy, and *lights with tl_light_set_clear; NULL: the file's
 * lights are not read, whatever is wrong with them. *has_lights (may be NULL) says whether the
 * file brought any. Pixels are as the file has them: see tl_gbuffer_repair. Fails with
 * TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or TL_ERR_MEMORY, naming the file and the
 * channel or attribute. */
tl_status tl_gbuffer_read(
    const char *path, tl_gbuffer **out, tl_light_set *lights, bool *has_lights, tl_error *err);

/* Whether an OpenEXR file is a G-buffer of tilelight's, of whatever version: what
 * tl_gbuffer_read is for. Fails as it does, for a file that is no OpenEXR file. */
tl_status tl_gbuffer_is_own(const char *path, bool *out, tl_error *err);

/* The lights inside a G-buffer's file alone. *lights and *has_lights as tl_gbuffer_read has
 * them; fails as it does. */
tl_status tl_gbuffer_read_lights(const char *path,
                                 tl_light_set *lights,
                                 bool *has_lights,
                                 tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
