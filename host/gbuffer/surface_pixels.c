#include "surface_pixels.h"

#include "packing.h"
#include "parallel.h"
#include "plane_values.h"

typedef struct job {
    const tl_gbuffer *gbuffer;
    tl_word_planes planes;
    tl_words sky; /* repaired pixels that show no surface are these words and no others */
    uint32_t tile_size, tiles_x;
    uint32_t *counts;
} job;

static void count_row(const job *j, uint32_t row)
{
    uint32_t *counts = j->counts + (size_t)(row / j->tile_size) * j->tiles_x;
    for (uint32_t column = 0; column < j->gbuffer->camera.width; column++) {
        const tl_words words =
            tl_words_at(&j->planes, (size_t)row * j->gbuffer->pitch + column);
        counts[column / j->tile_size] += memcmp(&words, &j->sky, sizeof words) != 0;
    }
}

static void count_tiles(void *context, size_t begin, size_t end)
{
    const job *j = context;
    const size_t height = j->gbuffer->camera.height;
    memset(j->counts + begin * j->tiles_x, 0, (end - begin) * j->tiles_x * sizeof *j->counts);
    for (size_t row = begin * j->tile_size; row < end * j->tile_size && row < height; row++)
        count_row(j, (uint32_t)row);
}

void tl_surface_pixels(const tl_gbuffer *gbuffer, uint32_t tile_size, uint32_t *counts)
{
    const tl_camera *camera = &gbuffer->camera;
    job j = {.gbuffer = gbuffer,
             .planes = tl_word_planes_of(gbuffer),
             .sky = tl_sky_words(camera, gbuffer->layout, gbuffer->present),
             .tile_size = tile_size,
             .tiles_x = (camera->width + tile_size - 1) / tile_size,
             .counts = counts};
    tl_parallel((camera->height + tile_size - 1) / tile_size, 1, count_tiles, &j);
}

/* Where planes say something. */
typedef struct plane_job {
    const tl_gbuffer *gbuffer;
    uint32_t tile_size, tiles_x;
    uint32_t *planes;
} plane_job;

static void note_row(const plane_job *j, enum tl_plane plane, uint32_t row)
{
    const float *values = tl_gbuffer_plane(j->gbuffer, plane) + (size_t)row * j->gbuffer->pitch;
    uint32_t *planes = j->planes + (size_t)(row / j->tile_size) * j->tiles_x;
    for (uint32_t column = 0; column < j->gbuffer->camera.width; column++)
        planes[column / j->tile_size] |= tl_says_more_than_absence(plane, values[column])
                                         << plane;
}

static void note_tiles(void *context, size_t begin, size_t end)
{
    const plane_job *j = context;
    const size_t height = j->gbuffer->camera.height;
    memset(j->planes + begin * j->tiles_x, 0, (end - begin) * j->tiles_x * sizeof *j->planes);
    for (size_t row = begin * j->tile_size; row < end * j->tile_size && row < height; row++)
        for (int p = 0; p < TL_PLANE_COUNT; p++)
            if (j->gbuffer->present >> p & 1u)
                note_row(j, (enum tl_plane)p, (uint32_t)row);
}

void tl_surface_planes(const tl_gbuffer *gbuffer, uint32_t tile_size, uint32_t *planes)
{
    const tl_camera *camera = &gbuffer->camera;
    plane_job j = {.gbuffer = gbuffer,
                   .tile_size = tile_size,
                   .tiles_x = (camera->width + tile_size - 1) / tile_size,
                   .planes = planes};
    tl_parallel((camera->height + tile_size - 1) / tile_size, 1, note_tiles, &j);
}
