/* A PNG file in memory, uncompressed: pictures for scenes, and pictures to damage. */
#ifndef TL_PNG_BYTES_H
#define TL_PNG_BYTES_H

#include "testing.h"

typedef struct png_bytes {
    uint8_t *data; /* freed by the caller */
    size_t size;
} png_bytes;

static inline void png_append(png_bytes *to, const void *data, size_t size)
{
    to->data = realloc(to->data, to->size + size);
    assert_non_null(to->data);
    if (size > 0) /* an empty chunk has no bytes to point at */
        memcpy(to->data + to->size, data, size);
    to->size += size;
}

static inline void png_append_32(png_bytes *to, uint32_t value)
{
    const uint8_t bytes[4] = {(uint8_t)(value >> 24), (uint8_t)(value >> 16),
                              (uint8_t)(value >> 8), (uint8_t)value};
    png_append(to, bytes, 4);
}

static inline void png_chunk(png_bytes *to, const char *kind, const uint8_t *data, size_t size)
{
    uint32_t crc = 0xffffffffu;
    png_append_32(to, (uint32_t)size);
    const size_t start = to->size;
    png_append(to, kind, 4);
    png_append(to, data, size);
    for (size_t i = start; i < to->size; i++) {
        crc ^= to->data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    png_append_32(to, ~crc);
}

/* rgba is [height][width][4], of less than 64 KB. */
static inline png_bytes png_encode(const uint8_t *rgba, uint32_t width, uint32_t height)
{
    png_bytes file = {0}, header = {0}, raw = {0}, zlib = {0};
    uint32_t a = 1, b = 0;
    for (uint32_t y = 0; y < height; y++) {
        png_append(&raw, "", 1);
        png_append(&raw, rgba + (size_t)4 * width * y, (size_t)4 * width);
    }
    assert_in_range(raw.size, 1, 65535);
    for (size_t i = 0; i < raw.size; i++) {
        a = (a + raw.data[i]) % 65521;
        b = (b + a) % 65521;
    }
    const uint8_t stored[7] = {0x78,
                               0x01,
                               0x01,
                               (uint8_t)raw.size,
                               (uint8_t)(raw.size >> 8),
                               (uint8_t)~raw.size,
                               (uint8_t)(~raw.size >> 8)};
    png_append(&zlib, stored, 7);
    png_append(&zlib, raw.data, raw.size);
    png_append_32(&zlib, b << 16 | a);
    png_append_32(&header, width);
    png_append_32(&header, height);
    png_append(&header, "\x08\x06\0\0", 5);
    png_append(&file, "\x89PNG\r\n\x1a\n", 8);
    png_chunk(&file, "IHDR", header.data, header.size);
    png_chunk(&file, "IDAT", zlib.data, zlib.size);
    png_chunk(&file, "IEND", NULL, 0);
    free(header.data);
    free(raw.data);
    free(zlib.data);
    return file;
}

#endif
