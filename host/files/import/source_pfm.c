/* PFM files as sources: "PF" (three numbers) or "Pf" (one), width, height, a scale whose sign
 * says the order of bytes (negative: the lowest first), then float rows from the bottom up.
 * Described by Paul Debevec, "PFM portable floatmap image format", 2003. The size of the scale
 * is not applied: writers put anything there. */
#include "size_limit.h"
#include "source.h"
#include "tilelight/camera.h"
#include "try.h"
#include "whole_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Three numbers for 16384 x 16384 pixels. */
static const size_t largest_file = (size_t)4 << 30; /* bytes */

/* What the header says. */
typedef struct pfm {
    char *bytes;      /* the whole file */
    size_t pixels_at; /* where the numbers begin */
    size_t numbers;   /* per pixel */
    bool is_little;
} pfm;

static bool recognises(const unsigned char *bytes, size_t size)
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

static tl_status parse_header(tl_source *source, size_t size, pfm *of, tl_error *err)
{
    uint32_t width = 0, height = 0;
    char word[32], *end = NULL;
    size_t at = 2;
    if (!parse_extent(next_word(of->bytes, size, &at, word), &width) ||
        !parse_extent(next_word(of->bytes, size, &at, word), &height))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is damaged: no width and height from 1 to %d follow \"P%c\"",
                       source->path, TL_MAX_EXTENT, of->bytes[1]);
    const char *scale_word = next_word(of->bytes, size, &at, word);
    const double scale = scale_word ? strtod(scale_word, &end) : 0.0;
    if (!scale_word || *end || !isfinite(scale) || !(fabs(scale) > 0.0))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is damaged: no scale follows its size, whose sign says the order "
                       "of bytes",
                       source->path);
    of->is_little = scale < 0.0;
    of->numbers = of->bytes[1] == 'F' ? 3 : 1;
    of->pixels_at = at + 1; /* one white space ends the header */
    const uint64_t wanted =
        of->pixels_at + (uint64_t)width * height * of->numbers * sizeof(float);
    if (size != wanted)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: is %s: %zu bytes, where its header promises %" PRIu64, source->path,
                       size < wanted ? "cut short" : "damaged", size, wanted);
    return tl_source_add_picture(source, width, height, of->numbers, "float", err);
}

static tl_status open_pfm(tl_source *source, tl_error *err)
{
    tl_status status = TL_OK;
    size_t size = 0;
    pfm *of = calloc(1, sizeof *of);
    source->pixels = of;
    if (!of)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", source->path));
    TRY(tl_whole_file_read(source->path, largest_file, &of->bytes, &size, err));
    if (!recognises((const unsigned char *)of->bytes, size))
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: is damaged: it changed while it was read",
                    source->path));
    TRY(parse_header(source, size, of, err));
done:
    return status;
}

static float number_at(const pfm *of, size_t index)
{
    const unsigned char *b = (const unsigned char *)of->bytes + of->pixels_at + 4 * index;
    const uint32_t bits = of->is_little ? (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 |
                                              (uint32_t)b[1] << 8 | (uint32_t)b[0]
                                        : (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 |
                                              (uint32_t)b[2] << 8 | (uint32_t)b[3];
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static tl_status read_pfm(tl_source *source,
                          const uint32_t *indices,
                          float *const *planes,
                          size_t count,
                          size_t pitch,
                          tl_error *err)
{
    const pfm *of = source->pixels;
    const size_t width = source->parts[0].width, height = source->parts[0].height;
    (void)err;
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++)
            for (size_t i = 0; i < count; i++)
                planes[i][y * pitch + x] =
                    number_at(of, ((height - 1 - y) * width + x) * of->numbers + indices[i]);
    return TL_OK;
}

static void close_pfm(tl_source *source)
{
    pfm *of = source->pixels;
    if (of)
        free(of->bytes);
    free(of);
}

const tl_source_format tl_source_pfm = {"PFM", recognises, open_pfm, read_pfm, close_pfm};
