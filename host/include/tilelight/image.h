/* Pictures: linear radiance in memory; OpenEXR, PFM and PNG as files. */
#ifndef TL_IMAGE_H
#define TL_IMAGE_H

#include "error.h"
#include "tones.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Three float planes R, G, B, padded like a G-buffer's; a picture that was asked for in parts has as many for
 * each of them behind. */
typedef struct tl_image {
    uint32_t width, height; /* px */
    uint32_t pitch, rows;   /* multiples of TL_PADDING, at least width and height */
    float
        *planes; /* [1 + part_count][3][rows][pitch], aligned to 4096 bytes; linear Rec. 709 */
    uint32_t part_count;
    /* Of a part of a picture: where in it its upper left pixel is, and its size, px. All 0: it is the
     * whole. */
    uint32_t x, y, whole_width, whole_height;
} tl_image;

/* All black. The caller releases *out with tl_image_destroy. Fails with TL_ERR_ARGUMENT for an
 * extent outside 1 to TL_MAX_EXTENT, or TL_ERR_MEMORY. */
tl_status tl_image_create(uint32_t width, uint32_t height, tl_image **out, tl_error *err);

/* The same, with room for parts. */
tl_status tl_image_create_parts(
    uint32_t width, uint32_t height, uint32_t part_count, tl_image **out, tl_error *err);

/* Accepts NULL. */
void tl_image_destroy(tl_image *image);

/* Plane 0, 1 or 2, or of part p, which counts from 0, 3 (1 + p) on: [rows][pitch], owned by the image. */
float *tl_image_plane(const tl_image *image, unsigned channel);

/* 3, and 3 for each part. */
uint32_t tl_image_plane_count(const tl_image *image);

/* How many pixels have a channel above `most`; NaN is not. On all threads. Cannot fail. */
uint64_t tl_image_count_above(const tl_image *image, float most);

/* A picture of samples to one of pixels: each is the mean of its side x side samples, radiance
 * as it is, before exposure and tone. Summed in double from the top left, row by row, and
 * rounded once: equal samples keep their value, and the bits do not depend on the number of
 * threads. What is not finite makes its own pixel so. width and height of `from` are multiples
 * of side. Parts likewise. On all threads. The caller releases *out with tl_image_destroy. Fails with
 * TL_ERR_MEMORY. */
tl_status tl_image_resolve(const tl_image *from, uint32_t side, tl_image **out, tl_error *err);

/* Rows of kernels/tones.h. */
typedef enum tl_tone_name tl_tone;
typedef enum tl_curve_name tl_curve;
typedef enum tl_dither_name tl_dither;

/* Of tone curves that have a white, in exposed radiance. */
#define TL_DEFAULT_WHITE 4.0f
#define TL_LEAST_WHITE 0.01f
#define TL_MOST_WHITE 1e6f

/* How radiance becomes a picture of 8 bits. All zero is ours. */
typedef struct tl_look {
    tl_tone tone;
    tl_curve curve;
    tl_dither dither;
    float white; /* TL_LEAST_WHITE to TL_MOST_WHITE; 0: TL_DEFAULT_WHITE */
} tl_look;

/* Whether its codes rise with each channel, whatever the others are: its tone takes each channel by
 * itself. */
int tl_look_is_of_channels(tl_look look);

/* Whether codes follow from 255 thresholds of radiance, exactly: such a tone, without dither. */
int tl_look_has_thresholds(tl_look look);

/* The exposure in stops that brings the picture's log-average luminance to 0.18. Pixels that are
 * black, negative or not finite are left out; 0 where none remains. The same on any number of
 * threads. */
float tl_image_auto_exposure(const tl_image *image);

/* 8-bit RGB, no alpha: radiance times 2^exposure, tone curve, curve of the codes, rounded as that or as the
 * dither says. A tone that takes each channel by itself without dither is exact: what these formulas give in
 * double, for every float. Others are off by less than 2^-10 of a code before they are rounded, but for AgX,
 * which is off by less than 2^-7 (kernels/tone.h). NaN and negative radiance are black, infinity is white.
 * exposure is finite. rgb is [height][width][3]. On all threads. Cannot fail. */
void tl_image_to_rgb8(const tl_image *image, float exposure, tl_look look, uint8_t *rgb);

/* The same with 16 bits: 65535 times what is shown, in double. */
void tl_image_to_rgb16(const tl_image *image, float exposure, tl_look look, uint16_t *rgb);

/* The same before it is rounded: every value becomes what the curves make of it, 0 to 1, of which the
 * codes are 255 times. In place. On all threads. Cannot fail. */
void tl_image_to_screen(tl_image *image, float exposure, tl_look look);

/* Compressions of OpenEXR. Those that round do so by as much as they say.
 * X(name, word on the command line, whether OpenEXRCore 3.1 writes it, what) */
#define TL_EXR_COMPRESSIONS(X)                                                                \
    X(TL_EXR_USUAL, "usual", 1, "zip of halves, none of floats")                              \
    X(TL_EXR_NONE, "none", 1, "as the numbers are")                                           \
    X(TL_EXR_RLE, "rle", 1, "runs of equal bytes")                                            \
    X(TL_EXR_ZIPS, "zips", 1, "deflate, row by row")                                          \
    X(TL_EXR_ZIP, "zip", 1, "deflate, 16 rows at a time")                                     \
    X(TL_EXR_PIZ, "piz", 1, "wavelets, 32 rows at a time")                                    \
    X(TL_EXR_PXR24, "pxr24", 1, "deflate; floats are rounded to 24 bits, 2^-16 of the value") \
    X(TL_EXR_B44, "b44", 1,                                                                   \
      "blocks of 4 x 4 halves in 14 bytes, whatever they hold, rounded; floats stay as they " \
      "are")                                                                                  \
    X(TL_EXR_B44A, "b44a", 1, "as b44, and blocks of one value in 3 bytes")                   \
    X(TL_EXR_DWAA, "dwaa", 0, "cosines, 32 rows at a time")                                   \
    X(TL_EXR_DWAB, "dwab", 0, "cosines, 256 rows at a time")

typedef enum tl_exr_compression {
#define TL_EXR_COMPRESSION_NAME(name, word, is_written, what) name,
    TL_EXR_COMPRESSIONS(TL_EXR_COMPRESSION_NAME)
#undef TL_EXR_COMPRESSION_NAME
        TL_EXR_COMPRESSION_COUNT
} tl_exr_compression;

/* How numbers stand in an EXR. All zero is usual. */
typedef struct tl_exr_form {
    int half; /* else float */
    tl_exr_compression compression;
    const char *record; /* what it was made from, for tl_image_record; NULL: nothing is said */
} tl_exr_form;

/* A picture in codes, and how it stands in a PNG. */
typedef struct tl_png_picture {
    const void *codes;      /* [height][width][3] of uint8_t or uint16_t */
    uint32_t width, height; /* px */
    unsigned depth;         /* bits a channel, 8 or 16 */
    tl_curve curve;         /* by which the codes are */
    const char *record;     /* as above */
} tl_png_picture;

/* The longest record, with its NUL; none is empty. */
#define TL_IMAGE_RECORD_SIZE 64

/* A picture that is written beside another, under a name: UTF-8, of at most 127 bytes. */
typedef struct tl_image_layer {
    char name[128];
    const float *planes; /* [3][rows][pitch] of the picture that it stands beside */
} tl_image_layer;

/* Atomic writers, as tl_gbuffer_write; "-" is standard output, for all but OpenEXR, whose writer goes back
 * in the file. Fail with TL_ERR_WRITE or TL_ERR_MEMORY.
 *
 * OpenEXR: channels R, G, B, linear. In halves what is above 65504, the largest, is that. Usual are zip for
 * halves, at a low level, and none for floats: zip takes some 80 times the processor time for 43 % fewer
 * bytes. A compression that is not written fails with TL_ERR_UNSUPPORTED.
 * Layers, which a picture may have beside it, are channels NAME.R, NAME.G, NAME.B, as compositors read them.
 * PFM: linear floats bit for bit, little-endian, the bottom row first.
 * PNG: 8 or 16 bits a channel; it says by which curve its codes are. */
tl_status tl_image_write_exr(const char *path,
                             const tl_image *image,
                             tl_exr_form form,
                             tl_error *err);
tl_status tl_image_write_layers(const char *path,
                                const tl_image *image,
                                const tl_image_layer *layers,
                                size_t count,
                                tl_exr_form form,
                                tl_error *err);
tl_status tl_image_write_pfm(const char *path, const tl_image *image, tl_error *err);
tl_status tl_png_write(const char *path,
                       const uint8_t *rgb,
                       uint32_t width,
                       uint32_t height,
                       tl_curve curve,
                       tl_error *err);
tl_status tl_png_write_deep(const char *path,
                            const uint16_t *rgb,
                            uint32_t width,
                            uint32_t height,
                            tl_curve curve,
                            tl_error *err);
tl_status tl_png_write_picture(const char *path, const tl_png_picture *picture, tl_error *err);

/* What an OpenEXR or PNG file says that it was made from: the string attribute or the text chunk
 * "tilelight:record". False, and "", for one that says nothing, is cut short, or cannot be read. Reads no
 * pixels. */
int tl_image_record(const char *path, char out[TL_IMAGE_RECORD_SIZE]);

/* Reads a picture for comparison: the R, G, B of an OpenEXR file, a PFM, or an 8- or 16-bit PNG as values
 * in [0, 1] without decoding sRGB (*is_png says whether it is that; may be NULL). Sizes are checked first.
 * Fails with TL_ERR_READ, TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or TL_ERR_MEMORY. */
tl_status tl_image_read(const char *path, tl_image **out, int *is_png, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
