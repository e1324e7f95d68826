#include "tilelight/image.h"

#include "aligned.h"
#include "plane_shape.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

tl_status tl_image_create(uint32_t width, uint32_t height, tl_image **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *made = NULL;

    if (width < 1 || width > TL_MAX_EXTENT || height < 1 || height > TL_MAX_EXTENT)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "a picture of %u x %u pixels: 1 to %d per side",
                    width, height, TL_MAX_EXTENT));
    made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture"));
    *made = (tl_image){width, height, tl_plane_pitch(width), tl_plane_rows(height), NULL};

    const size_t size = 3 * (size_t)made->pitch * made->rows * sizeof(float);
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

void tl_image_destroy(tl_image *image)
{
    if (!image)
        return;
    free(image->planes);
    free(image);
}

float *tl_image_plane(const tl_image *image, unsigned channel)
{
    return image->planes + channel * (size_t)image->pitch * image->rows;
}
