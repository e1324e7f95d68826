#define _POSIX_C_SOURCE 200809L
#include "image_record.h"

#include "exr_part.h"
#include "regular_file.h"
#include "tilelight/image.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Chunks before the first of pixels: there are a dozen kinds. */
enum { MOST_CHUNKS = 64 };

static const unsigned char png_start[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
static const unsigned char png_end[12] = {0,   0,   0,    0,    'I',  'E',
                                          'N', 'D', 0xae, 0x42, 0x60, 0x82};

static bool read_at(int file, void *to, size_t size, uint64_t offset)
{
    size_t got;
    return tl_regular_file_read_at(file, to, size, offset, &got) && got == size;
}

/* From a text chunk's bytes: its name, a NUL, the text. */
static bool read_text(int file,
                      uint64_t offset,
                      uint32_t length,
                      char out[TL_IMAGE_RECORD_SIZE])
{
    static const char name[] = TL_IMAGE_RECORD_NAME;
    char bytes[sizeof name + TL_IMAGE_RECORD_SIZE] = "";
    if (length < sizeof name || length >= sizeof bytes ||
        !read_at(file, bytes, length, offset) || memcmp(bytes, name, sizeof name) != 0)
        return false;
    memcpy(out, bytes + sizeof name, TL_IMAGE_RECORD_SIZE);
    return true;
}

static bool read_png(int file, uint64_t size, char out[TL_IMAGE_RECORD_SIZE])
{
    unsigned char end[sizeof png_end], head[8];
    uint64_t at = sizeof png_start;
    if (size < sizeof end || !read_at(file, end, sizeof end, size - sizeof end) ||
        memcmp(end, png_end, sizeof end) != 0)
        return false;
    for (int i = 0; i < MOST_CHUNKS && read_at(file, head, sizeof head, at); i++) {
        const uint32_t length = (uint32_t)head[0] << 24 | (uint32_t)head[1] << 16 |
                                (uint32_t)head[2] << 8 | head[3];
        if (memcmp(head + 4, "IDAT", 4) == 0)
            return false;
        if (memcmp(head + 4, "tEXt", 4) == 0 && read_text(file, at + sizeof head, length, out))
            return true;
        at += sizeof head + length + 4;
    }
    return false;
}

/* Our writers have the last rows at the end. */
static bool is_whole(const tl_exr_part *part)
{
    exr_chunk_info_t last;
    return exr_read_scanline_chunk_info(part->stream->context, 0, part->data.max.y, &last) ==
               EXR_ERR_SUCCESS &&
           last.data_offset <= part->file_size &&
           last.packed_size <= part->file_size - last.data_offset;
}

static bool read_exr(tl_exr_stream *stream, uint64_t size, char out[TL_IMAGE_RECORD_SIZE])
{
    tl_exr_part part;
    if (tl_exr_part_open(stream, size, 0, &part, NULL) != TL_OK)
        return false;
    const exr_attribute_t *found = tl_exr_part_attribute(&part, TL_IMAGE_RECORD_NAME);
    if (!found || found->type != EXR_ATTR_STRING ||
        found->string->length >= TL_IMAGE_RECORD_SIZE || !is_whole(&part))
        return false;
    memcpy(out, found->string->str, (size_t)found->string->length);
    out[found->string->length] = '\0';
    return true;
}

int tl_image_record(const char *path, char out[TL_IMAGE_RECORD_SIZE])
{
    unsigned char start[sizeof png_start];
    tl_exr_stream stream;
    uint64_t size;
    int file;
    bool found = false;
    out[0] = '\0';
    if (tl_regular_file_open(path, &file, &size, NULL) != TL_OK)
        return false;
    if (!read_at(file, start, sizeof start, 0)) {
        found = false;
    } else if (memcmp(start, png_start, sizeof start) == 0) {
        found = read_png(file, size, out);
    } else if (tl_exr_stream_read(&stream, path, file, NULL) == TL_OK) {
        found = read_exr(&stream, size, out);
        tl_exr_stream_close(&stream, NULL);
    }
    close(file);
    if (!found)
        out[0] = '\0';
    return found;
}
