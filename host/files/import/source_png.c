/* PNG files as sources: colours of 8 or 16 bits, 0 to 1. */
#include "image_png.h"
#include "source.h"
#include "try.h"

#include <string.h>

static bool recognises(const unsigned char *bytes, size_t size)
{
    static const unsigned char magic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return size >= sizeof magic && memcmp(bytes, magic, sizeof magic) == 0;
}

static tl_status open_png(tl_source *source, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *image = NULL;
    TRY(tl_image_read_png(source->path, &image, err));
    source->pixels = image;
    source->needs_srgb = true;
    TRY(tl_source_add_picture(source, image->width, image->height, 3, "8 or 16 bits", err));
done:
    return status;
}

static tl_status read_png(tl_source *source,
                          const uint32_t *indices,
                          float *const *planes,
                          size_t count,
                          size_t pitch,
                          tl_error *err)
{
    const tl_image *image = source->pixels;
    (void)err;
    for (size_t i = 0; i < count; i++)
        for (size_t y = 0; y < image->height; y++)
            memcpy(planes[i] + y * pitch, tl_image_plane(image, indices[i]) + y * image->pitch,
                   image->width * sizeof(float));
    return TL_OK;
}

static void close_png(tl_source *source)
{
    tl_image_destroy(source->pixels);
}

const tl_source_format tl_source_png = {"PNG", recognises, open_png, read_png, close_png};
