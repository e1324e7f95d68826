#include "maps.h"

#include "ramp.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

/* px of a square that becomes one. */
static uint32_t square_of(uint32_t width, uint32_t height)
{
    const uint32_t longer = width > height ? width : height;
    return (longer + TL_STUDY_MAP_EXTENT - 1) / TL_STUDY_MAP_EXTENT;
}

static uint8_t *allocate(uint32_t width, uint32_t height)
{
    return calloc(3 * (size_t)width * height, 1);
}

static void paint(double error, uint8_t rgb[3])
{
    static const double low = TL_STUDY_MAP_LOW, high = TL_STUDY_MAP_HIGH;
    const double at = log(error / low) / log(high / low);
    if (error > 0.0)
        tl_ramp(fmax(0.0, fmin(1.0, at)), rgb);
}

tl_status tl_study_map_write(
    const char *path, const float *errors, uint32_t width, uint32_t height, tl_error *err)
{
    const uint32_t square = square_of(width, height);
    const uint32_t columns = (width + square - 1) / square,
                   rows = (height + square - 1) / square;
    tl_status status = TL_OK;
    uint8_t *rgb = allocate(columns, rows);
    if (!rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %s", path));
    for (uint32_t i = 0; i < columns * rows; i++) {
        const uint32_t x0 = i % columns * square, y0 = i / columns * square;
        double most = 0.0;
        for (uint32_t y = y0; y < y0 + square && y < height; y++)
            for (uint32_t x = x0; x < x0 + square && x < width; x++)
                most = fmax(most, (double)errors[(size_t)y * width + x]);
        paint(most, rgb + 3 * (size_t)i);
    }
    TRY(tl_png_write(path, rgb, columns, rows, TL_CURVE_SRGB, err));
done:
    free(rgb);
    return status;
}

/* What is left at the right and at the bottom makes no square. */
static tl_status shrink(const tl_image *from, uint32_t square, tl_image **out, tl_error *err)
{
    tl_image *made = NULL;
    const tl_status status =
        tl_image_create(from->width / square, from->height / square, &made, err);
    if (status != TL_OK)
        return status;
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t i = 0; i < made->width * made->height; i++) {
            const uint32_t x = i % made->width, y = i / made->width;
            double sum = 0.0;
            for (uint32_t k = 0; k < square * square; k++)
                sum += (double)tl_image_plane(
                    from, c)[(size_t)(y * square + k / square) * from->pitch + x * square +
                             k % square];
            tl_image_plane(made, c)[(size_t)y * made->pitch + x] =
                (float)(sum / (square * square));
        }
    *out = made;
    return TL_OK;
}

tl_status tl_study_picture_write(const char *path,
                                 const tl_image *image,
                                 float exposure,
                                 tl_error *err)
{
    const uint32_t longer = square_of(image->width, image->height);
    const uint32_t shorter_side = image->width < image->height ? image->width : image->height;
    const uint32_t square = longer < shorter_side ? longer : shorter_side;
    tl_status status = TL_OK;
    tl_image *small = NULL;
    uint8_t *rgb = NULL;
    TRY(shrink(image, square, &small, err));
    rgb = allocate(small->width, small->height);
    if (!rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %s", path));
    tl_image_to_rgb8(small, exposure, (tl_look){0}, rgb);
    TRY(tl_png_write(path, rgb, small->width, small->height, TL_CURVE_SRGB, err));
done:
    free(rgb);
    tl_image_destroy(small);
    return status;
}
