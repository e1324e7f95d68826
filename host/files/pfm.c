#include "pfm.h"

#include "tilelight/camera.h"
#include "try.h"
#include "whole_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Three numbers for 16384 x 16384 pixels. */
static const size_t largest_file = (size_t)4 << 30; /* bytes */

bool tl_pfm_recognises(const unsigned char *bytes, size_t size)
{
    return size >= 3 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') &&
           (bytes[2] == '\n' || bytes[2] == '\r' || bytes[2] == ' ' || bytes[2] == '\t');
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* The next word of the header, and *at behind it; NULL where there is none of a sane length. */
static const char *next_word(const char *bytes, size_t size, size_t *at, char word[32])
{
    size_t length = 0;
    while (*at < size && is_space(bytes[*at]))
        (*at)++;
    while (*at < size && !is_space(bytes[*at]) && length < 31)
        word[length++] = bytes[(*at)++];
    word[length] = '\0';
    return length > 0 && *at < size && is_space(bytes[*at]) ? word : NULL;
}

static bool parse_extent(const char *word, uint32_t *out)
{
    uint32_t value = 0;
    if (!word)
        return false;
    for (; *word; word++) {
        if (*word < '0' || *word > '9' || value > TL_MAX_EXTENT)
            return false;
        value = 10 * value + (uint32_t)(*word - '0');
    }
    *out = value;
    return value >= 1 && value <= TL_MAX_EXTENT;
}

static tl_status parse_header(const char *path, size_t size, tl_pfm *of, tl_error *err)
{
    char word[32], *end = NULL;
    size_t at = 2;
    if (!parse_extent(next_word(of->bytes, size, &at, word), &of->width) ||
        !parse_extent(next_word(of->bytes, size, &at, word), &of->height))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is damaged: no width and height from 1 to %d follow \"P%c\"", path,
                       TL_MAX_EXTENT, of->bytes[1]);
    const char *scale_word = next_word(of->bytes, size, &at, word);
    const double scale = scale_word ? strtod(scale_word, &end) : 0.0;
    if (!scale_word || *end || !isfinite(scale) || !(fabs(scale) > 0.0))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is damaged: no scale follows its size, whose sign says the order "
                       "of bytes",
                       path);
    of->is_little = scale < 0.0;
    of->numbers = of->bytes[1] == 'F' ? 3 : 1;
    of->pixels_at = at + 1; /* one white space ends the header */
    const uint64_t wanted =
        of->pixels_at + (uint64_t)of->width * of->height * of->numbers * sizeof(float);
    if (size != wanted)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is %s: %zu bytes, where its header promises %" PRIu64, path,
                       size < wanted ? "cut short" : "damaged", size, wanted);
    return TL_OK;
}

tl_status tl_pfm_read(const char *path, tl_pfm *out, tl_error *err)
{
    tl_status status = TL_OK;
    size_t size = 0;
    *out = (tl_pfm){0};
    TRY(tl_whole_file_read(path, largest_file, &out->bytes, &size, err));
    if (!tl_pfm_recognises((const unsigned char *)out->bytes, size))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: is damaged: it changed while it was read", path));
    TRY(parse_header(path, size, out, err));
done:
    return status;
}

float tl_pfm_number(const tl_pfm *of, size_t x, size_t y, size_t c)
{
    const size_t index = ((of->height - 1 - y) * of->width + x) * of->numbers + c;
    const unsigned char *b = (const unsigned char *)of->bytes + of->pixels_at + 4 * index;
    const uint32_t bits = of->is_little ? (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 |
                                              (uint32_t)b[1] << 8 | (uint32_t)b[0]
                                        : (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 |
                                              (uint32_t)b[2] << 8 | (uint32_t)b[3];
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

void tl_pfm_clear(tl_pfm *of)
{
    free(of->bytes);
    *of = (tl_pfm){0};
}
