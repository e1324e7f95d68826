#include "tilelight/image.h"

#include "aligned.h"
#include "plane_shape.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

tl_status tl_image_create_parts(
    uint32_t width, uint32_t height, uint32_t part_count, tl_image **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *made = NULL;

    if (width < 1 || width > TL_MAX_EXTENT || height < 1 || height > TL_MAX_EXTENT)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "a picture of %u x %u pixels: 1 to %d per side",
                    width, height, TL_MAX_EXTENT));
    made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture"));
    *made = (tl_image){.width = width,
                       .height = height,
                       .pitch = tl_plane_pitch(width),
                       .rows = tl_plane_rows(height),
                       .part_count = part_count};

    const size_t size =
        tl_image_plane_count(made) * (size_t)made->pitch * made->rows * sizeof(float);
    made->planes = tl_aligned_alloc(size);
    if (!made->planes)
        TRY(tl_fail(err, TL_ERR_MEMORY,
                    "out of memory for a picture of %u x %u pixels (%zu MB)", width, height,
                    size >> 20));
    memset(made->planes, 0, size);
    *out = made;
    made = NULL;
done:
    tl_image_destroy(made);
    return status;
}

tl_status tl_image_create(uint32_t width, uint32_t height, tl_image **out, tl_error *err)
{
    return tl_image_create_parts(width, height, 0, out, err);
}

void tl_image_destroy(tl_image *image)
{
    if (!image)
        return;
    free(image->planes);
    free(image);
}

uint32_t tl_image_plane_count(const tl_image *image)
{
    return 3 + 3 * image->part_count;
}

float *tl_image_plane(const tl_image *image, unsigned channel)
{
    return image->planes + channel * (size_t)image->pitch * image->rows;
}
