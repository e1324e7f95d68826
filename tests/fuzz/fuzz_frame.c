#include "fuzz_frame.h"

#include "fuzz.h"
#include "reference.h"

#include "tilelight/layouts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is repaired stays as it is. Normals of no length count again: they are what others are made. */
static void must_be_repaired(tl_gbuffer *gbuffer, const char *what)
{
    const size_t size = (size_t)tl_gbuffer_pixel_size(gbuffer) * gbuffer->rows * gbuffer->pitch;
    unsigned char *const before = malloc(size);
    tl_error err = {.status = TL_OK};
    tl_repairs found;
    fuzz_must(before != NULL, "out of memory for %zu bytes", size);
    memcpy(before, gbuffer->planes, size);
    fuzz_must(tl_gbuffer_repair(gbuffer, what, false, &found, &err) == TL_OK, "%s",
              err.message);
    fuzz_must(found.depth == 0 && found.value == 0, "%s: %llu depths, %llu values repaired",
              what, (unsigned long long)found.depth, (unsigned long long)found.value);
    fuzz_must(memcmp(before, gbuffer->planes, size) == 0, "%s: a second repair changes it",
              what);
    free(before);
}

void fuzz_repair(tl_gbuffer *gbuffer)
{
    tl_error err = {.status = TL_OK};
    tl_gbuffer *unpacked = NULL;
    fuzz_must(tl_camera_check(&gbuffer->camera, &err) == TL_OK, "%s", err.message);
    fuzz_must(tl_gbuffer_repair(gbuffer, "frame", false, NULL, &err) == TL_OK, "%s",
              err.message);
    must_be_repaired(gbuffer, "a repaired frame");
    if (gbuffer->layout == TL_LAYOUT_FLOAT)
        return;
    fuzz_must(tl_gbuffer_unpack(gbuffer, &unpacked, &err) == TL_OK, "%s", err.message);
    must_be_repaired(unpacked, "an unpacked frame");
    tl_gbuffer_destroy(unpacked);
}

static void must_be_finite(const tl_image *image, const char *what)
{
    for (unsigned c = 0; c < 3; c++)
        for (uint32_t y = 0; y < image->height; y++)
            for (uint32_t x = 0; x < image->width; x++) {
                const float value = tl_image_plane(image, c)[(size_t)y * image->pitch + x];
                fuzz_must(isfinite(value), "%s: pixel (%u, %u), channel %u is %g", what, x, y,
                          c, (double)value);
            }
}

void fuzz_light(const tl_gbuffer *gbuffer, const tl_light_set *lights)
{
    static const uint64_t most_pairs = 1 << 18; /* of pixels and lights */
    tl_error err = {.status = TL_OK};
    tl_prepared prepared = {.capacity = 0};
    tl_image *image = NULL;
    if ((uint64_t)gbuffer->rows * gbuffer->pitch * (lights->count + 1) > most_pairs)
        return;
    const tl_status status =
        tl_prepare(gbuffer, lights, &(tl_prepare_options){.tile_size = 16, .box_count = 2},
                   NULL, &prepared, &err);
    /* Rows of materials may lead nowhere in this frame. */
    fuzz_must(status == TL_OK || status == TL_ERR_FORMAT, "%s", err.message);
    if (status == TL_OK) {
        fuzz_must(tl_image_create(gbuffer->camera.width, gbuffer->camera.height, &image,
                                  &err) == TL_OK,
                  "%s", err.message);
        tl_reference_light(&prepared, gbuffer, TL_TWIN_FLOAT, image);
        must_be_finite(image, "float twin");
        tl_reference_light(&prepared, gbuffer, TL_TWIN_REFERENCE, image);
        must_be_finite(image, "reference");
    }
    tl_image_destroy(image);
    tl_prepared_clear(&prepared);
}
