/* Shadow maps as parts of a G-buffer's file, a part a view; docs/file-formats.md describes them. */
#ifndef TL_SHADOW_PARTS_H
#define TL_SHADOW_PARTS_H

#include "exr_part.h"
#include "exr_writer.h"

#include "tilelight/shadows.h"

/* Pictures of views, for tl_exr_writer_parts. All zero is valid to release. */
typedef struct tl_shadow_pictures {
    uint32_t count;
    tl_exr_picture *of;                /* [count], owned */
    struct tl_shadow_picture *sources; /* [count], owned: what rows are computed from */
} tl_shadow_pictures;

/* How many parts they are. */
uint32_t tl_shadow_part_count(const tl_shadow_maps *maps);

/* Adds the parts behind those of the writer, with their attributes, and lists what to write: maps outlive it.
 * Released with tl_shadow_pictures_clear. Fails as the writer does. */
tl_status tl_shadow_parts_add(tl_exr_writer *writer,
                              const tl_shadow_maps *maps,
                              exr_compression_t compression,
                              tl_shadow_pictures *out,
                              tl_error *err);

void tl_shadow_pictures_clear(tl_shadow_pictures *pictures);

/* Reads all maps of an open file into *out, which has none; parts without the attribute "tilelight:shadow"
 * are left alone. On failure some may be in *out. Fails with TL_ERR_FORMAT, naming part and attribute,
 * TL_ERR_UNSUPPORTED, TL_ERR_READ or TL_ERR_MEMORY. */
tl_status tl_shadow_parts_read(tl_exr_stream *stream,
                               uint64_t file_size,
                               tl_shadow_maps *out,
                               tl_error *err);

#endif
