/* stb_image, in a file of its own so that its warnings stay its own. */
#include "decode.h"

#include "load_limits.h"
#include "picture_parts.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS /* one of them is static memory that threads would write at once */
/* Tables that a JPEG uses and does not bring are empty, not what memory held before. */
#define STBI_MALLOC(size) calloc(1, size)
#define STBI_REALLOC(memory, size) realloc(memory, size)
#define STBI_FREE(memory) free(memory)
#define STBI_MAX_DIMENSIONS TL_MAX_IMAGE_EXTENT
#include <stb_image.h>

int tl_decode_size(const uint8_t *data, size_t size, uint32_t *width, uint32_t *height)
{
    int w = 0, h = 0, channels = 0;
    if (size > INT_MAX || !tl_picture_is_sound(data, size) ||
        !stbi_info_from_memory(data, (int)size, &w, &h, &channels) || w < 1 || h < 1)
        return 0;
    *width = (uint32_t)w;
    *height = (uint32_t)h;
    return 1;
}

static void fill_curve(uint16_t curve[256], int srgb)
{
    for (int i = 0; i < 256; i++) {
        const double v = i / 255.0;
        const double linear = !srgb          ? v
                              : v <= 0.04045 ? v / 12.92
                                             : pow((v + 0.055) / 1.055, 2.4);
        curve[i] = (uint16_t)(65535.0 * linear + 0.5);
    }
}

static void widen(const uint8_t *from, size_t pixel_count, int srgb, uint16_t *to)
{
    uint16_t color[256], alpha[256];
    fill_curve(color, srgb);
    fill_curve(alpha, 0);
    for (size_t i = 0; i < 4 * pixel_count; i += 4) {
        to[i] = color[from[i]];
        to[i + 1] = color[from[i + 1]];
        to[i + 2] = color[from[i + 2]];
        to[i + 3] = alpha[from[i + 3]];
    }
}

/* Data with 16 bits stays as it is; colours, which OpenGL has not in 16 bits of sRGB, come as
 * 8 bits. */
int tl_decode_rgba16(
    const uint8_t *data, size_t size, uint32_t width, uint32_t height, int srgb, uint16_t *out)
{
    const size_t pixel_count = (size_t)width * height;
    int w = 0, h = 0, channels = 0;
    uint8_t *bytes = NULL;
    uint16_t *words = NULL;
    if (!srgb && stbi_is_16_bit_from_memory(data, (int)size))
        words = stbi_load_16_from_memory(data, (int)size, &w, &h, &channels, 4);
    else
        bytes = stbi_load_from_memory(data, (int)size, &w, &h, &channels, 4);
    const int done = (words || bytes) && (uint32_t)w == width && (uint32_t)h == height;
    if (done && words)
        memcpy(out, words, pixel_count * 4 * sizeof *out);
    else if (done)
        widen(bytes, pixel_count, srgb, out);
    free(words);
    free(bytes);
    return done;
}
