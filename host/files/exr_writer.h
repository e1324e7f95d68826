/* Writes planes as scanline parts of an OpenEXR file, on all threads, atomically.
 *
 *     tl_exr_writer_begin, attributes through writer.stream.context (part 0),
 *     tl_exr_writer_pixels, tl_exr_writer_commit; tl_exr_writer_abandon whatever happened
 *
 * Of several parts: tl_exr_writer_open, tl_exr_writer_add for each, attributes, tl_exr_writer_parts. */
#ifndef TL_EXR_WRITER_H
#define TL_EXR_WRITER_H

#include "atomic_file.h"
#include "exr_stream.h"

#include <stddef.h>

/* A channel comes from memory, or is computed as the file is written. */
typedef struct tl_exr_channel {
    const char *name;
    exr_pixel_type_t type; /* in the file */
    exr_pixel_type_t held; /* in memory: `type`, bit for bit; or float, which is converted */
    const void *plane;     /* [height][pitch]; NULL: the next of the computed ones */
} tl_exr_channel;

typedef struct tl_exr_picture {
    uint32_t width, height; /* px */
    size_t pitch;           /* pixels from row to row of every plane */
    size_t channel_count;
    const tl_exr_channel *channels;
    /* Fills one row of the computed channels, however many, in the order of `channels`; called on any thread.
     * rows[i] is [width] of what the channel holds. NULL where every channel has a plane. */
    void (*compute)(const void *context, uint32_t y, void *const *rows);
    const void *context;
} tl_exr_picture;

/* Must not move between begin and commit or abandon. All zero is valid to abandon. */
typedef struct tl_exr_writer {
    tl_atomic_file file;
    tl_exr_stream stream;
} tl_exr_writer;

/* Display and data window are (0, 0) to (width - 1, height - 1). path is kept, not copied. Fails
 * with TL_ERR_WRITE or TL_ERR_MEMORY, as all of these. */
tl_status tl_exr_writer_begin(tl_exr_writer *writer,
                              const char *path,
                              uint32_t width,
                              uint32_t height,
                              exr_compression_t compression,
                              tl_error *err);

/* Of a part of a picture of that size, whose upper left pixel is at (x, y) there: the data window moves
 * there, and the display window is the picture's. Before pixels. */
tl_status tl_exr_writer_window(tl_exr_writer *writer,
                               uint32_t x,
                               uint32_t y,
                               uint32_t whole_width,
                               uint32_t whole_height,
                               tl_error *err);

/* The same without a part, and a part of it: parts count from 0 in the order in which they are added. name:
 * NULL of a part that stays alone. The data window is (0, 0) to (width - 1, height - 1); so is the display
 * window of the first, which all parts share. */
tl_status tl_exr_writer_open(tl_exr_writer *writer, const char *path, tl_error *err);
tl_status tl_exr_writer_add(tl_exr_writer *writer,
                            const char *name,
                            uint32_t width,
                            uint32_t height,
                            exr_compression_t compression,
                            tl_error *err);

/* Writes the header, then the pixels of each part: the same bytes whatever the number of threads.
 * pictures: [parts]. */
tl_status tl_exr_writer_parts(tl_exr_writer *writer,
                              const tl_exr_picture *pictures,
                              int count,
                              tl_error *err);

/* The same of a single part. */
tl_status tl_exr_writer_pixels(tl_exr_writer *writer,
                               const tl_exr_picture *picture,
                               tl_error *err);

tl_status tl_exr_writer_commit(tl_exr_writer *writer, tl_error *err);

/* Leaves nothing behind. Does nothing after a commit. */
void tl_exr_writer_abandon(tl_exr_writer *writer);

#endif
