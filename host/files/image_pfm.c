#include "image_pfm.h"

#include "parallel.h"
#include "pfm.h"
#include "try.h"
#include "whole_file.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct spreading {
    const tl_pfm *from;
    tl_image *to;
} spreading;

static void spread_rows(void *context, size_t begin, size_t end)
{
    const spreading *s = context;
    const size_t width = s->from->width;
    for (size_t y = begin; y < end; y++)
        for (size_t c = 0; c < 3; c++) {
            float *row = tl_image_plane(s->to, (unsigned)c) + y * s->to->pitch;
            for (size_t x = 0; x < width; x++)
                row[x] = tl_pfm_number(s->from, x, y, c % s->from->numbers);
        }
}

tl_status tl_image_read_pfm(const char *path, tl_image **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_pfm from = {0};
    tl_image *made = NULL;
    TRY(tl_pfm_read(path, &from, err));
    TRY(tl_image_create(from.width, from.height, &made, err));
    spreading job = {&from, made};
    tl_parallel(from.height, 1, spread_rows, &job);
    *out = made;
    made = NULL;
done:
    tl_image_destroy(made);
    tl_pfm_clear(&from);
    return status;
}

typedef struct laying {
    const tl_image *from;
    unsigned char
        *to; /* [height][width][3] floats, their lowest byte first, rows from the bottom up */
} laying;

static void lay_rows(void *context, size_t begin, size_t end)
{
    const laying *job = context;
    const tl_image *from = job->from;
    for (size_t y = begin; y < end; y++)
        for (unsigned c = 0; c < 3; c++) {
            const float *row = tl_image_plane(from, c) + y * from->pitch;
            unsigned char *to = job->to + 12 * (from->height - 1 - y) * from->width + 4 * c;
            for (size_t x = 0; x < from->width; x++, to += 12) {
                uint32_t bits;
                memcpy(&bits, &row[x], sizeof bits);
                for (int byte = 0; byte < 4; byte++)
                    to[byte] = (unsigned char)(bits >> 8 * byte);
            }
        }
}

tl_status tl_image_write_pfm(const char *path, const tl_image *image, tl_error *err)
{
    char header[64];
    const int length = snprintf(header, sizeof header, "PF\n%" PRIu32 " %" PRIu32 "\n-1.0\n",
                                image->width, image->height);
    const size_t size = (size_t)length + 12 * (size_t)image->width * image->height;
    unsigned char *bytes = malloc(size);
    if (!bytes)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for a PFM of %zu bytes", path,
                       size);
    memcpy(bytes, header, (size_t)length);
    laying job = {image, bytes + length};
    tl_parallel(image->height, 1, lay_rows, &job);
    const tl_status status = tl_whole_file_write(path, bytes, size, err);
    free(bytes);
    return status;
}
