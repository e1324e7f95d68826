/* Textures of glTF scenes, PNG or JPEG: does any file do more than be refused? */
#include "decode.h"
#include "fuzz.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const uint32_t most_pixels = 1 << 20; /* of pictures that are worth the time */
    uint32_t width = 0, height = 0;
    if (!tl_decode_size(data, size, &width, &height))
        return 0;
    fuzz_must(width > 0 && height > 0, "a picture of %u x %u pixels", width, height);
    if ((uint64_t)width * height > most_pixels)
        return 0;
    uint16_t *const pixels = malloc((size_t)4 * width * height * sizeof *pixels);
    fuzz_must(pixels != NULL, "out of memory for %u x %u pixels", width, height);
    tl_decode_rgba16(data, size, width, height, size % 2, pixels);
    free(pixels);
    return 0;
}
