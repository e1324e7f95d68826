#include "picture_parts.h"

#include <string.h>

static uint32_t big_endian(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 |
           (uint32_t)bytes[3];
}

static int chunks_are_there(const uint8_t *data, size_t size)
{
    static const size_t head = 8, checksum = 4; /* length and type */
    size_t at = 8;
    while (at <= size && size - at >= head && memcmp(data + at + 4, "IEND", 4) != 0) {
        const uint32_t length = big_endian(data + at);
        if (length > size - at - head)
            return 0;
        at += head + length + checksum;
    }
    return 1;
}

/* Markers of JPEG, ITU-T T.81, table B.1. */
enum { STUFFED = 0x00, TABLES = 0xc4, RESTART = 0xd0, END = 0xd9, FILL = 0xff };

/* Without a length behind them: restarts, the start and the end of the picture. */
static int stands_alone(uint8_t marker)
{
    return marker >= RESTART && marker <= END;
}

/* The segment of `length` bytes that begins at `at`, with its length: a byte of class and number, the numbers
 * of codes of each size, then a byte a code; again and again. Beyond the segment's end a decoder reads on,
 * and beyond the file's it reads zeroes. */
static int tables_are_sound(const uint8_t *data, size_t size, size_t at, size_t length)
{
    enum { SIZES = 16, MOST_CODES = 256 };
    const size_t end = at + length;
    for (at += 2; at < end;) {
        size_t codes = 0;
        for (size_t i = at + 1; i <= at + SIZES && i < size; i++)
            codes += data[i];
        if (codes > MOST_CODES)
            return 0;
        at += 1 + SIZES + codes;
    }
    return 1;
}

/* From marker to marker; between the segment of a scan and the next one are codes, in which FILL is followed
 * by STUFFED or a restart. */
static int codes_are_sound(const uint8_t *data, size_t size)
{
    for (size_t at = 2; at + 1 < size;) {
        const uint8_t marker = data[at + 1];
        if (data[at] != FILL || marker == FILL || marker == STUFFED || stands_alone(marker)) {
            at++;
            continue;
        }
        if (size - at < 4)
            return 1;
        const size_t length = (size_t)data[at + 2] << 8 | data[at + 3];
        if (marker == TABLES && !tables_are_sound(data, size, at + 2, length))
            return 0;
        at += 2 + length;
    }
    return 1;
}

int tl_picture_is_sound(const uint8_t *data, size_t size)
{
    if (size >= 8 && memcmp(data, "\x89PNG", 4) == 0)
        return chunks_are_there(data, size);
    if (size >= 4 && memcmp(data, "\xff\xd8", 2) == 0)
        return codes_are_sound(data, size);
    return 1;
}
