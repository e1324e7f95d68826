/* Reads channels of the first part of an OpenEXR file as planes, where its picture is whole: the data
 * window is the display window, from (0, 0) on. */
#ifndef TL_EXR_READER_H
#define TL_EXR_READER_H

#include "exr_part.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Must not move while it is open. All zero is valid to close. */
typedef struct tl_exr_reader {
    bool is_open;
    tl_exr_stream stream;
    tl_exr_part part;
    uint32_t width, height; /* px */
} tl_exr_reader;

/* Opens the file and checks storage kind, windows, extents, channel list, compression, and that
 * the file is large enough for what its header promises. path is kept, not copied. Fails with
 * TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or TL_ERR_MEMORY. */
tl_status tl_exr_reader_open(tl_exr_reader *reader, const char *path, tl_error *err);

/* The same where the data window may be a part of the display window: reader->part has both. */
tl_status tl_exr_reader_open_part(tl_exr_reader *reader, const char *path, tl_error *err);

void tl_exr_reader_close(tl_exr_reader *reader);

bool tl_exr_reader_has_channel(const tl_exr_reader *reader, const char *name);

/* Fails with TL_ERR_FORMAT for a channel that is absent or holds whole numbers. */
tl_status tl_exr_reader_require(const tl_exr_reader *reader,
                                const char *channel,
                                tl_error *err);

/* Fails with TL_ERR_FORMAT for a channel that is absent or of another type. */
tl_status tl_exr_reader_require_type(const tl_exr_reader *reader,
                                     const char *channel,
                                     exr_pixel_type_t type,
                                     tl_error *err);

bool tl_exr_reader_has_attribute(const tl_exr_reader *reader, const char *name);

/* Fails with TL_ERR_FORMAT where planes of `size` bytes in all would be out of proportion to the
 * file, so that a header of some bytes cannot take a machine's memory. */
tl_status tl_exr_reader_check_size(const tl_exr_reader *reader, uint64_t size, tl_error *err);

/* Reads the targets' channels, which have passed one of the two that require them. Fails as
 * open does. */
tl_status tl_exr_reader_pixels(tl_exr_reader *reader,
                               const tl_exr_target *targets,
                               size_t target_count,
                               size_t pitch,
                               tl_error *err);

#endif
