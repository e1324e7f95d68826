#define _POSIX_C_SOURCE 200809L
#include "image_png.h"

#include "image_record.h"
#include "parallel.h"
#include "size_limit.h"
#include "try.h"
#include "whole_file.h"

#include <spng.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A picture of 16384 x 16384 in 16-bit RGBA is 2 GiB before compression; files are read whole. */
static const size_t largest_file = (size_t)2 << 30;

/* A rendered frame of 1920 x 1080 took 100 ms and 1.44 MB; the library's defaults, which try every
 * filter at level 6, 530 ms and 1.04 MB. A photograph: 131 ms, 3.08 MB; 1271 ms, 2.91 MB. */
enum { ZLIB_LEVEL = 2, FILTERS = SPNG_FILTER_CHOICE_SUB };

/* The library's numbers are no statuses of ours. */
static tl_status check(int code, const char *path, tl_status otherwise, tl_error *err)
{
    if (code == SPNG_OK)
        return TL_OK;
    if (code == SPNG_EMEM)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for a PNG", path);
    return tl_fail(err, otherwise,
                   otherwise == TL_ERR_WRITE ? "%s: cannot be written as PNG: %s"
                                             : "%s: is damaged or no PNG: %s",
                   path, spng_strerror(code));
}

/* The chunk that says what the codes mean. */
static int set_curve(spng_ctx *context, tl_curve curve)
{
    static const uint8_t perceptual = 0; /* rendering intent */
    if (curve == TL_CURVE_SRGB)
        return spng_set_srgb(context, perceptual);
    return spng_set_gama(context, 1.0 / 2.2);
}

/* The library reads the record when it encodes. */
static int set_record(spng_ctx *context, char *record)
{
    static const char name[] = TL_IMAGE_RECORD_NAME;
    struct spng_text text = {.type = SPNG_TEXT, .text = record, .length = strlen(record)};
    memcpy(text.keyword, name, sizeof name);
    return spng_set_text(context, &text, 1);
}

static tl_status set_header(spng_ctx *context,
                            const char *path,
                            const tl_png_picture *picture,
                            char *record,
                            tl_error *err)
{
    struct spng_ihdr header = {.width = picture->width,
                               .height = picture->height,
                               .bit_depth = (uint8_t)picture->depth,
                               .color_type = SPNG_COLOR_TYPE_TRUECOLOR};
    tl_status status = TL_OK;
    TRY(check(spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1), path, TL_ERR_WRITE, err));
    TRY(check(spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, ZLIB_LEVEL), path,
              TL_ERR_WRITE, err));
    TRY(check(spng_set_option(context, SPNG_FILTER_CHOICE, FILTERS), path, TL_ERR_WRITE, err));
    TRY(check(spng_set_ihdr(context, &header), path, TL_ERR_WRITE, err));
    TRY(check(set_curve(context, picture->curve), path, TL_ERR_WRITE, err));
    if (record[0])
        TRY(check(set_record(context, record), path, TL_ERR_WRITE, err));
done:
    return status;
}

tl_status tl_png_write_picture(const char *path, const tl_png_picture *picture, tl_error *err)
{
    tl_status status = TL_OK;
    const size_t codes_size =
        (size_t)picture->width * picture->height * 3 * (picture->depth / 8);
    void *bytes = NULL;
    size_t size = 0;
    int code = SPNG_OK;
    char record[TL_IMAGE_RECORD_SIZE];
    spng_ctx *context = spng_ctx_new(SPNG_CTX_ENCODER);
    if (!context)
        return check(SPNG_EMEM, path, TL_ERR_WRITE, err);

    snprintf(record, sizeof record, "%s", picture->record ? picture->record : "");
    TRY(set_header(context, path, picture, record, err));
    TRY(check(spng_encode_image(context, picture->codes, codes_size, SPNG_FMT_PNG,
                                SPNG_ENCODE_FINALIZE),
              path, TL_ERR_WRITE, err));
    bytes = spng_get_png_buffer(context, &size, &code);
    TRY(check(code, path, TL_ERR_WRITE, err));
    TRY(tl_whole_file_write(path, bytes, size, err));
done:
    free(bytes);
    spng_ctx_free(context);
    return status;
}

tl_status tl_png_write(const char *path,
                       const uint8_t *rgb,
                       uint32_t width,
                       uint32_t height,
                       tl_curve curve,
                       tl_error *err)
{
    const tl_png_picture picture = {
        .codes = rgb, .width = width, .height = height, .depth = 8, .curve = curve};
    return tl_png_write_picture(path, &picture, err);
}

tl_status tl_png_write_deep(const char *path,
                            const uint16_t *rgb,
                            uint32_t width,
                            uint32_t height,
                            tl_curve curve,
                            tl_error *err)
{
    const tl_png_picture picture = {
        .codes = rgb, .width = width, .height = height, .depth = 16, .curve = curve};
    return tl_png_write_picture(path, &picture, err);
}

/* What a decoded PNG is spread into planes from. */
typedef struct spreading {
    tl_image *image;
    const void *pixels; /* uint8_t [height][width][3], or uint16_t [height][width][4] */
    bool is_deep;
} spreading;

static void spread_rows(void *context, size_t begin, size_t end)
{
    const spreading *s = context;
    const size_t width = s->image->width;
    for (size_t y = begin; y < end; y++)
        for (unsigned c = 0; c < 3; c++) {
            float *row = tl_image_plane(s->image, c) + y * s->image->pitch;
            const uint8_t *narrow = (const uint8_t *)s->pixels + y * width * 3 + c;
            const uint16_t *deep = (const uint16_t *)s->pixels + y * width * 4 + c;
            for (size_t x = 0; x < width; x++)
                row[x] =
                    s->is_deep ? (float)deep[4 * x] / 65535.0f : (float)narrow[3 * x] / 255.0f;
        }
}

tl_status tl_image_read_png(const char *path, tl_image **out, tl_error *err)
{
    tl_status status = TL_OK;
    char *file = NULL;
    void *pixels = NULL;
    tl_image *made = NULL;
    spng_ctx *context = NULL;
    struct spng_ihdr header;
    size_t file_size = 0, size = 0;

    TRY(tl_whole_file_read(path, largest_file, &file, &file_size, err));
    context = spng_ctx_new(0);
    TRY(check(context ? SPNG_OK : SPNG_EMEM, path, TL_ERR_FORMAT, err));
    TRY(check(spng_set_image_limits(context, TL_MAX_EXTENT, TL_MAX_EXTENT), path, TL_ERR_FORMAT,
              err));
    TRY(check(spng_set_png_buffer(context, file, file_size), path, TL_ERR_FORMAT, err));
    TRY(check(spng_get_ihdr(context, &header), path, TL_ERR_FORMAT, err));

    const bool is_deep = header.bit_depth == 16;
    const int format = is_deep ? SPNG_FMT_RGBA16 : SPNG_FMT_RGB8;
    TRY(check(spng_decoded_image_size(context, format, &size), path, TL_ERR_FORMAT, err));
    TRY(tl_check_decoded_size(path, file_size, size, err));
    pixels = malloc(size);
    TRY(check(pixels ? SPNG_OK : SPNG_EMEM, path, TL_ERR_FORMAT, err));
    TRY(check(spng_decode_image(context, pixels, size, format, 0), path, TL_ERR_FORMAT, err));
    /* Up to the end chunk: without it the file is cut short. */
    TRY(check(spng_decode_chunks(context), path, TL_ERR_FORMAT, err));
    TRY(tl_image_create(header.width, header.height, &made, err));
    spreading spread = {.image = made, .pixels = pixels, .is_deep = is_deep};
    tl_parallel(header.height, 1, spread_rows, &spread);
    *out = made;
    made = NULL;
done:
    tl_image_destroy(made);
    spng_ctx_free(context);
    free(pixels);
    free(file);
    return status;
}
