#include "tilelight/image.h"

#include "parallel.h"

#include <stdatomic.h>

typedef struct job {
    const tl_image *image;
    float most;
    atomic_ullong count;
} job;

static void count_rows(void *context, size_t begin, size_t end)
{
    job *j = context;
    const tl_image *image = j->image;
    unsigned long long count = 0;
    for (size_t y = begin; y < end; y++) {
        const float *r = tl_image_plane(image, 0) + y * image->pitch;
        const float *g = tl_image_plane(image, 1) + y * image->pitch;
        const float *b = tl_image_plane(image, 2) + y * image->pitch;
        for (size_t x = 0; x < image->width; x++)
            count += r[x] > j->most || g[x] > j->most || b[x] > j->most;
    }
    atomic_fetch_add(&j->count, count);
}

uint64_t tl_image_count_above(const tl_image *image, float most)
{
    job j = {.image = image, .most = most};
    atomic_init(&j.count, 0);
    tl_parallel(image->height, 16, count_rows, &j);
    return atomic_load(&j.count);
}
