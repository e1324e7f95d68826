/* stb_image, in a file of its own so that its warnings stay its own. */
#include "decode.h"

#include "load_limits.h"

#include <limits.h>
#include <stdlib.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS TL_MAX_IMAGE_EXTENT
#include <stb_image.h>

int tl_decode_size(const uint8_t *data, size_t size, uint32_t *width, uint32_t *height)
{
    int w = 0, h = 0, channels = 0;
    if (size > INT_MAX || !stbi_info_from_memory(data, (int)size, &w, &h, &channels) || w < 1 ||
        h < 1)
        return 0;
    *width = (uint32_t)w;
    *height = (uint32_t)h;
    return 1;
}

uint8_t *tl_decode_rgba8(const uint8_t *data, size_t size, uint32_t width, uint32_t height)
{
    int w = 0, h = 0, channels = 0;
    uint8_t *const texels = stbi_load_from_memory(data, (int)size, &w, &h, &channels, 4);
    if (texels && (uint32_t)w == width && (uint32_t)h == height)
        return texels;
    free(texels);
    return NULL;
}
