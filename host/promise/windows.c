#include "windows.h"

#include "bound.h"
#include "random.h"
#include "surround.h"
#include "try.h"

#include "tilelight/flip.h"
#include "tilelight/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELL = 32,   /* px; the side of a window */
    AROUND = 12, /* px; at 67 pixels a degree FLIP's filters reach 10 */
    BLOCK = 16   /* px; the side of what is lit together */
};

static const double unseen = 4.0; /* as in deviation.c */

void tl_windows_destroy(tl_windows *windows)
{
    if (!windows)
        return;
    for (uint32_t i = 0; windows->of && i < windows->count; i++)
        tl_image_destroy(windows->of[i].reference);
    free(windows->of);
    free(windows);
}

static uint32_t sooner(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* The part of a picture that a window counts, and room for what is around it. */
static tl_status window_make(
    uint32_t width, uint32_t height, tl_window part, tl_window *out, tl_error *err)
{
    part.around_x = part.x < AROUND ? 0 : part.x - AROUND;
    part.around_y = part.y < AROUND ? 0 : part.y - AROUND;
    *out = part;
    return tl_image_create(sooner(part.x + part.width + AROUND, width) - part.around_x,
                           sooner(part.y + part.height + AROUND, height) - part.around_y,
                           &out->reference, err);
}

/* Cells of the picture in rows, cut into as many runs as there are windows: one of each run. */
static tl_status choose(
    tl_windows *windows, uint32_t width, uint32_t height, uint64_t seed, tl_error *err)
{
    const uint32_t cells_x = (width + CELL - 1) / CELL;
    tl_status status = TL_OK;
    if (windows->count == windows->cell_count) /* one, the whole picture */
        return window_make(width, height, (tl_window){.width = width, .height = height},
                           &windows->of[0], err);
    for (uint32_t i = 0; i < windows->count; i++) {
        const uint32_t begin = (uint32_t)((uint64_t)i * windows->cell_count / windows->count);
        const uint32_t end =
            (uint32_t)((uint64_t)(i + 1) * windows->cell_count / windows->count);
        const uint32_t cell = begin + tl_random_below(&seed, end - begin);
        const uint32_t x = cell % cells_x * CELL, y = cell / cells_x * CELL;
        TRY(window_make(width, height,
                        (tl_window){.x = x,
                                    .y = y,
                                    .width = sooner(CELL, width - x),
                                    .height = sooner(CELL, height - y)},
                        &windows->of[i], err));
    }
done:
    return status;
}

/* Samples of a rectangle, px of the G-buffer, in blocks. */
typedef struct blocks {
    tl_pixel_at *at;
    size_t *begins, count;
    float (*radiance)[3];
} blocks;

static void blocks_clear(blocks *b)
{
    free(b->at);
    free(b->begins);
    free(b->radiance);
}

static void put_block(blocks *b, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1)
{
    size_t at = b->begins[b->count++];
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = x0; x < x1; x++)
            b->at[at++] = (tl_pixel_at){x, y};
    b->begins[b->count] = at;
}

static tl_status blocks_make(
    uint32_t x0, uint32_t y0, const tl_image *image, blocks *b, tl_error *err)
{
    const size_t pixels = (size_t)image->width * image->height;
    const size_t most =
        ((size_t)image->width / BLOCK + 1) * ((size_t)image->height / BLOCK + 1);
    b->at = malloc(pixels * sizeof *b->at);
    b->radiance = malloc(pixels * sizeof *b->radiance);
    b->begins = calloc(most + 1, sizeof *b->begins);
    if (!b->at || !b->radiance || !b->begins)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a window of %zu pixels", pixels);
    for (uint32_t y = 0; y < image->height; y += BLOCK)
        for (uint32_t x = 0; x < image->width; x += BLOCK)
            put_block(b, x0 + x, y0 + y, x0 + sooner(x + BLOCK, image->width),
                      y0 + sooner(y + BLOCK, image->height));
    return TL_OK;
}

static void put_radiance(const blocks *b, uint32_t x0, uint32_t y0, tl_image *image)
{
    for (size_t i = 0; i < b->begins[b->count]; i++)
        for (unsigned c = 0; c < 3; c++)
            tl_image_plane(image,
                           c)[(size_t)(b->at[i].y - y0) * image->pitch + b->at[i].x - x0] =
                b->radiance[i][c];
}

/* *to becomes the means of what *from, which is released, has. */
static tl_status resolve_into(tl_image *from, uint32_t side, tl_image **to, tl_error *err)
{
    tl_image *pixels = NULL;
    tl_status status = TL_OK;
    TRY(tl_image_resolve(from, side, &pixels, err));
    tl_image_destroy(*to);
    *to = pixels;
done:
    tl_image_destroy(from);
    return status;
}

static tl_status light_window(const tl_prepared *prepared,
                              const tl_gbuffer *gbuffer,
                              uint32_t side,
                              tl_window *window,
                              tl_error *err)
{
    const uint32_t x0 = window->around_x * side, y0 = window->around_y * side;
    tl_status status = TL_OK;
    tl_image *samples = NULL;
    blocks b = {0};
    TRY(tl_image_create(window->reference->width * side, window->reference->height * side,
                        &samples, err));
    TRY(blocks_make(x0, y0, samples, &b, err));
    tl_reference_some(prepared, gbuffer, &(tl_pixel_groups){b.at, b.begins, b.count},
                      b.radiance);
    put_radiance(&b, x0, y0, samples);
    status = resolve_into(samples, side, &window->reference, err);
    samples = NULL;
done:
    blocks_clear(&b);
    tl_image_destroy(samples);
    return status;
}

static tl_status light_windows(const tl_gbuffer *gbuffer,
                               const tl_light_set *lights,
                               tl_windows *windows,
                               tl_error *err)
{
    tl_status status = TL_OK;
    tl_prepared prepared = {0};
    TRY(tl_prepare(gbuffer, lights, &(tl_prepare_options){.tile_size = BLOCK}, NULL, &prepared,
                   err));
    tl_reference_surround(&prepared, gbuffer, TL_TWIN_REFERENCE);
    for (uint32_t i = 0; i < windows->count; i++)
        TRY(light_window(&prepared, gbuffer, windows->side, &windows->of[i], err));
done:
    tl_prepared_clear(&prepared);
    return status;
}

tl_status tl_windows_draw(const tl_gbuffer *gbuffer,
                          const tl_light_set *lights,
                          double pixels,
                          uint64_t seed,
                          tl_windows **out,
                          tl_error *err)
{
    const uint32_t side = tl_samples_side(gbuffer->samples);
    const uint32_t width = gbuffer->camera.width / side, height = gbuffer->camera.height / side;
    const double window = (double)(CELL + 2 * AROUND) * (CELL + 2 * AROUND) * side * side;
    const uint32_t cells = (width + CELL - 1) / CELL * ((height + CELL - 1) / CELL);
    const double start = tl_seconds(), wanted = ceil(pixels / window);
    const int is_whole = wanted * window >= (double)width * height * side * side;
    tl_status status = TL_OK;
    tl_windows *made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for windows"));
    made->side = side;
    made->cell_count = is_whole ? 1 : cells;
    made->count = is_whole ? 1 : wanted < 1.0 ? 1 : (uint32_t)wanted;
    made->of = calloc(made->count, sizeof *made->of);
    if (!made->of)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %u windows", made->count));
    TRY(choose(made, width, height, seed, err));
    TRY(light_windows(gbuffer, lights, made, err));
    made->seconds = tl_seconds() - start;
    *out = made;
    made = NULL;
done:
    tl_windows_destroy(made);
    return status;
}

/* A window of a picture, as a screen shows it: codes over 255. */
static tl_status shown(const tl_image *image,
                       const tl_window *window,
                       const tl_goal *goal,
                       float exposure,
                       tl_image **out,
                       tl_error *err)
{
    const tl_image *like = window->reference;
    tl_status status = TL_OK;
    tl_image *part = NULL;
    uint8_t *rgb = malloc(3 * (size_t)like->width * like->height);
    if (!rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a window"));
    TRY(tl_image_create(like->width, like->height, &part, err));
    const uint32_t x0 = image == like ? 0 : window->around_x,
                   y0 = image == like ? 0 : window->around_y;
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < like->height; y++)
            memcpy(tl_image_plane(part, c) + (size_t)y * part->pitch,
                   tl_image_plane(image, c) + (size_t)(y0 + y) * image->pitch + x0,
                   like->width * sizeof(float));
    tl_image_to_rgb8(part, exposure, goal->look, rgb);
    for (unsigned c = 0; c < 3; c++)
        for (size_t i = 0; i < (size_t)like->width * like->height; i++)
            tl_image_plane(part, c)[i / like->width * part->pitch + i % like->width] =
                (float)rgb[3 * i + c] / 255.0f;
    *out = part;
    part = NULL;
done:
    tl_image_destroy(part);
    free(rgb);
    return status;
}

tl_status tl_window_flip(const tl_window *window,
                         const tl_goal *goal,
                         const tl_image *image,
                         float exposure,
                         double *sum,
                         tl_error *err)
{
    const tl_image *like = window->reference;
    tl_status status = TL_OK;
    tl_image *pictures[2] = {NULL, NULL};
    tl_flip flip;
    float *map = malloc((size_t)like->width * like->height * sizeof *map);
    *sum = 0.0;
    if (!map)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a window's FLIP"));
    TRY(shown(image, window, goal, exposure, &pictures[0], err));
    TRY(shown(like, window, goal, exposure, &pictures[1], err));
    TRY(tl_flip_compare(pictures[0], pictures[1], TL_FLIP_SCREEN, TL_FLIP_PIXELS_PER_DEGREE,
                        map, &flip, err));
    for (uint32_t y = 0; y < window->height; y++)
        for (uint32_t x = 0; x < window->width; x++)
            *sum += (double)map[(size_t)(window->y - window->around_y + y) * like->width +
                                window->x - window->around_x + x];
done:
    tl_image_destroy(pictures[0]);
    tl_image_destroy(pictures[1]);
    free(map);
    return status;
}

/* Cells at the ends of rows and columns are smaller, and count as if the rest of them were equal. */
static tl_estimate estimate_of(const tl_windows *windows,
                               uint32_t width,
                               uint32_t height,
                               double sum,
                               double most,
                               double doubt)
{
    const double weight = (double)windows->cell_count / windows->count;
    const double pixels = (double)width * height;
    if (windows->count == windows->cell_count)
        return (tl_estimate){sum / pixels, sum / pixels};
    const double bound = tl_sum_bound(weight * sum, weight * unseen * most, doubt) / pixels;
    return (tl_estimate){weight * sum / pixels, fmin(bound, 1.0)};
}

tl_status tl_windows_flip(const tl_windows *windows,
                          const tl_goal *goal,
                          const tl_image *image,
                          double doubt,
                          tl_estimate *out,
                          tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *pixels = NULL;
    double sum = 0.0, most = 0.0;
    TRY(tl_image_resolve(image, windows->side, &pixels, err));
    const float exposure = tl_goal_exposure(goal, pixels);
    for (uint32_t i = 0; i < windows->count; i++) {
        double of = 0.0;
        TRY(tl_window_flip(&windows->of[i], goal, pixels, exposure, &of, err));
        sum += of;
        most = fmax(most, of);
    }
    *out = estimate_of(windows, pixels->width, pixels->height, sum, most, doubt);
done:
    tl_image_destroy(pixels);
    return status;
}
