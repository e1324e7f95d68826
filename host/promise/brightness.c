#include "brightness.h"

#include "parallel.h"

#include "tilelight/camera.h"

double tl_brightness(const tl_image *image, uint32_t x, uint32_t y)
{
    const size_t plane = (size_t)image->pitch * image->rows;
    const float *p = image->planes + (size_t)y * image->pitch + x;
    return ((double)p[0] + (double)p[plane] + (double)p[2 * plane]) / 3.0;
}

typedef struct job {
    const tl_image *image;
    uint32_t tile;
    double *to;
} job;

static void add_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t y = begin; y < end; y++) {
        j->to[y] = 0.0;
        for (uint32_t x = 0; x < j->image->width; x++)
            j->to[y] += tl_brightness(j->image, x, (uint32_t)y);
    }
}

/* Rows are added in order: the result does not depend on how many threads there are. */
double tl_mean_brightness(const tl_image *image)
{
    enum { ROWS_A_THREAD_TAKES = 16 };
    double rows[TL_MAX_EXTENT], sum = 0.0;
    job j = {.image = image, .to = rows};
    tl_parallel(image->height, ROWS_A_THREAD_TAKES, add_rows, &j);
    for (uint32_t y = 0; y < image->height; y++)
        sum += rows[y];
    return sum / ((double)image->width * image->height);
}

static void look_at_tiles(void *context, size_t begin, size_t end)
{
    const job *j = context;
    const tl_image *image = j->image;
    const uint32_t tile = j->tile;
    const size_t tiles_x = (image->width + tile - 1) / tile;
    for (size_t i = begin * tiles_x; i < end * tiles_x; i++)
        j->to[i] = 0.0;
    for (size_t y = begin * tile; y < end * tile && y < image->height; y++)
        for (uint32_t x = 0; x < image->width; x++) {
            const double value = tl_brightness(image, x, (uint32_t)y);
            double *most = &j->to[y / tile * tiles_x + x / tile];
            *most = value > *most ? value : *most;
        }
}

void tl_brightest_of_tiles(const tl_image *image, uint32_t tile, double *most)
{
    job j = {image, tile, most};
    tl_parallel((image->height + tile - 1) / tile, 1, look_at_tiles, &j);
}
