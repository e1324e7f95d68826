/* By deviation.c the reference lies between a - peak (a + mean) and a + peak (a + mean) in every pixel
 * outside the sample, and codes rise with radiance; so codes of these two pictures enclose those of the
 * reference. In the sample they are its own. Means of pixels lie between means of both. */
#include "codes.h"

#include "brightness.h"
#include "parallel.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOW, GOT, HIGH, PICTURES };

typedef struct job {
    const tl_image *image;
    tl_image *const *around; /* [PICTURES] */
    double peak, mean;
} job;

static void widen_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < j->image->width; x++) {
            const size_t at = y * j->image->pitch + x;
            const double by = j->peak * (tl_brightness(j->image, x, (uint32_t)y) + j->mean);
            for (unsigned c = 0; c < 3; c++) {
                const double got = (double)tl_image_plane(j->image, c)[at];
                tl_image_plane(j->around[LOW], c)[at] = (float)(got - by);
                tl_image_plane(j->around[GOT], c)[at] = (float)got;
                tl_image_plane(j->around[HIGH], c)[at] = (float)(got + by);
            }
        }
}

/* What was looked at is known. */
static void settle(const tl_sample *sample, tl_image *const around[PICTURES])
{
    for (size_t i = 0; i < sample->count; i++)
        for (unsigned c = 0; c < 3; c++) {
            const size_t at = (size_t)sample->at[i].y * around[LOW]->pitch + sample->at[i].x;
            tl_image_plane(around[LOW], c)[at] = sample->reference[i][c];
            tl_image_plane(around[HIGH], c)[at] = sample->reference[i][c];
        }
}

static tl_status resolve(tl_image **image, uint32_t side, tl_error *err)
{
    tl_image *pixels = NULL;
    if (side == 1)
        return TL_OK;
    const tl_status status = tl_image_resolve(*image, side, &pixels, err);
    if (status != TL_OK)
        return status;
    tl_image_destroy(*image);
    *image = pixels;
    return TL_OK;
}

static int apart(const uint8_t *a, const uint8_t *b, size_t at)
{
    int most = 0;
    for (size_t c = 3 * at; c < 3 * at + 3; c++)
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    return most;
}

static tl_estimate most_apart(const tl_sample *sample,
                              uint8_t *const codes[PICTURES],
                              size_t pixels,
                              uint32_t side)
{
    int seen = 0, bound = 0;
    for (size_t at = 0; at < pixels; at++) {
        const int below = apart(codes[GOT], codes[LOW], at),
                  above = apart(codes[GOT], codes[HIGH], at);
        bound = below > bound ? below : bound;
        bound = above > bound ? above : bound;
    }
    for (size_t i = 0; side == 1 && i < sample->count; i++) {
        const size_t at = (size_t)sample->at[i].y * sample->width + sample->at[i].x;
        const int off = apart(codes[GOT], codes[LOW], at);
        seen = off > seen ? off : seen;
    }
    return (tl_estimate){tl_sample_is_whole(sample) ? bound : seen, bound};
}

tl_status tl_codes_off(const tl_goal *goal,
                       const tl_sample *sample,
                       const tl_deviation *deviation,
                       const tl_image *image,
                       uint32_t side,
                       tl_estimate *out,
                       tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *around[PICTURES] = {NULL};
    uint8_t *codes[PICTURES] = {NULL};
    const double peak = fmin(deviation->peak, 1.0); /* beyond, nothing is said at all */
    job j = {image, around, peak, deviation->mean};
    for (int i = 0; i < PICTURES; i++)
        TRY(tl_image_create(image->width, image->height, &around[i], err));
    tl_parallel(image->height, TL_RIM_TILE, widen_rows, &j);
    settle(sample, around);
    for (int i = 0; i < PICTURES; i++)
        TRY(resolve(&around[i], side, err));
    const float exposure = tl_goal_exposure(goal, around[GOT]);
    const size_t pixels = (size_t)around[GOT]->width * around[GOT]->height;
    for (int i = 0; i < PICTURES; i++) {
        codes[i] = malloc(3 * pixels);
        if (!codes[i])
            TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the codes of %zu pixels",
                        pixels));
        tl_image_to_rgb8(around[i], exposure, goal->look, codes[i]);
    }
    *out = most_apart(sample, codes, pixels, side);
    if (deviation->peak >= 1.0)
        out->bound = 255.0;
done:
    for (int i = 0; i < PICTURES; i++) {
        free(codes[i]);
        tl_image_destroy(around[i]);
    }
    return status;
}
