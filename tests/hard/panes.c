#define _GNU_SOURCE
/* Surfaces that blend, and cut each other. */
#include "hard_case.h"

#include "pane_scenes.h"

/* Nearest first, by the centre. */
static int by_center(const void *a, const void *b)
{
    const double x = ((const hit *)a)->at->center[2], y = ((const hit *)b)->at->center[2];
    return (x < y) - (x > y);
}

static int is_near(const double a[3], const double b[3])
{
    int near = 1;
    for (int c = 0; c < 3; c++)
        near &= fabs(a[c] - b[c]) <= pane_tolerance;
    return near;
}

/* hits: nearest first, up to what hides all behind it, which stays the last. */
static void blend_by_centers(hit *hits, size_t count, double out[3])
{
    const size_t panes = count - (count > 0 && !hits[count - 1].at->blends);
    qsort(hits, panes, sizeof *hits, by_center);
    blend(hits, count, out);
}

void hard_pane_order(hard_bench *bench)
{
    char *path = panes_path();
    edited_gltf file;
    assert_true(read_gltf(path, &file));
    const scene s = scene_of(&file);
    tl_gbuffer *gbuffer = captured(path, 0);
    tl_image *image = lit(gbuffer);
    for (uint32_t y = 0; y < PANES_HEIGHT; y++)
        for (uint32_t x = 0; x < PANES_WIDTH; x++) {
            hit hits[MOST_SHEETS];
            double want[3], usual[3], got[3];
            size_t count;
            if (!look(&s, &gbuffer->camera, x, y, hits, &count))
                continue;
            blend(hits, count, want);
            blend_by_centers(hits, count, usual);
            for (unsigned c = 0; c < 3; c++)
                got[c] = (double)tl_image_plane(image, c)[(size_t)y * image->pitch + x];
            hard_count(bench, is_near(got, want), is_near(usual, want));
        }
    tl_image_destroy(image);
    tl_gbuffer_destroy(gbuffer);
    release_gltf(&file);
    free(path);
}
