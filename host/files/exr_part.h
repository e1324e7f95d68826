/* One part of an open OpenEXR file: its pictures as planes, on all threads. Scanlines, or tiles of
 * which the first level is read. */
#ifndef TL_EXR_PART_H
#define TL_EXR_PART_H

#include "exr_stream.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* All of it is the context's, and as long as the stream is open. */
typedef struct tl_exr_part {
    tl_exr_stream *stream;
    uint64_t file_size; /* bytes */
    int index;
    const char *name; /* "" where it has none */
    exr_storage_t storage;
    exr_compression_t compression;
    exr_attr_box2i_t data, display;    /* px, both ends included */
    uint32_t width, height;            /* px, of the data window */
    int chunk_width, chunk_height;     /* px: of a tile; or the width and the rows of a chunk */
    int chunks_x, chunks_y;            /* that hold the picture */
    const exr_attr_chlist_t *channels; /* sorted by name */
    uint64_t pixel_size;               /* bytes per pixel, all channels */
} tl_exr_part;

/* A channel and where it goes. */
typedef struct tl_exr_target {
    const char *channel;
    /* In memory: the channel's type, bit for bit; or float, to which it is converted. */
    exr_pixel_type_t held;
    void *plane; /* [height][pitch], of the data window */
} tl_exr_target;

/* Checks storage kind, windows, extents, channel list, compression, and that the file is large enough
 * for what the part's header promises, before anything is allocated by it. Fails with TL_ERR_FORMAT
 * or TL_ERR_UNSUPPORTED, naming the file, and the part where it has a name. What was found until
 * then is in *out: name, storage, windows, channels. */
tl_status tl_exr_part_open(
    tl_exr_stream *stream, uint64_t file_size, int index, tl_exr_part *out, tl_error *err);

/* The extent of its data or display window, px. Fails with TL_ERR_FORMAT unless that is 1 to
 * TL_MAX_EXTENT per side. */
tl_status tl_exr_part_extent(const tl_exr_part *part,
                             const exr_attr_box2i_t *window,
                             uint32_t *width,
                             uint32_t *height,
                             tl_error *err);

/* Whether the data window is the display window. */
bool tl_exr_part_is_uncropped(const tl_exr_part *part);

/* What both windows cover; false: nothing. */
bool tl_exr_part_overlap(const tl_exr_part *part, exr_attr_box2i_t *out);

/* NULL where there is none. */
const exr_attr_chlist_entry_t *tl_exr_part_channel(const tl_exr_part *part, const char *name);

/* NULL where there is none; asking does not count as an error of the stream. */
const exr_attribute_t *tl_exr_part_attribute(const tl_exr_part *part, const char *name);

/* Whether it has one whose name begins so. */
bool tl_exr_part_has_attribute_like(const tl_exr_part *part, const char *start);

/* The words of types of channels: "uint", "half", "float". */
extern const char *const tl_exr_type_words[EXR_PIXEL_LAST_TYPE];

/* "scanlines", "tiles", ... */
const char *tl_exr_storage_words(exr_storage_t storage);

/* Reads the targets' channels, which the part has; of type uint those that are held as such, or that are
 * indices: a float holds those exactly. Fails with TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or
 * TL_ERR_MEMORY. */
tl_status tl_exr_part_pixels(const tl_exr_part *part,
                             const tl_exr_target *targets,
                             size_t target_count,
                             size_t pitch,
                             tl_error *err);

#endif
