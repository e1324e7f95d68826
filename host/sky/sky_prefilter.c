#include "sky_prefilter.h"

#include "parallel.h"
#include "sky_light.h"

#include <math.h>

/* Texels along alpha: below two, a lobe falls between texels and mixtures of them show. */
static const double texels_per_alpha = 2.0;
enum { LEAST_SIZE = 32 };

double tl_sky_level_alpha(unsigned level)
{
    const double r = TL_SKY_LEAST_ROUGHNESS +
                     (1.0 - TL_SKY_LEAST_ROUGHNESS) * level / (TL_SKY_LEVELS - 1);
    return r * r;
}

/* 4 pi over size^2 is a texel's solid angle. */
uint32_t tl_sky_level_size(unsigned level, uint32_t most)
{
    const double wanted = texels_per_alpha * sqrt(16.0 * atan(1.0)) / tl_sky_level_alpha(level);
    uint32_t size = LEAST_SIZE;
    while (size < most && (double)size < 0.95 * wanted)
        size *= 2;
    return size;
}

size_t tl_sky_level_start(unsigned level, uint32_t most)
{
    size_t start = 0;
    for (unsigned i = 0; i < level; i++) {
        const size_t pitch = tl_sky_level_size(i, most) + 2;
        start += pitch * pitch;
    }
    return start;
}

static double cosine_of(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void tl_sky_mirrored(const tl_sky_tree *tree, const double toward[3], double alpha, double out[3])
{
    enum { MOST_WAITING = 4 * 32 };
    const double alpha2 = alpha * alpha;
    struct {
        unsigned level;
        size_t at;
    } waiting[MOST_WAITING] = {{0, 0}};
    double sum[3] = {0.0, 0.0, 0.0}, weights = 0.0;
    for (int count = 1; count > 0;) {
        const unsigned level = waiting[--count].level;
        const size_t at = waiting[count].at;
        const tl_sky_node *node = &tree->nodes[level][at];
        if (!(node->solid_angle > 0.0))
            continue;
        const double c = cosine_of(toward, node->toward), apart2 = 2.0 - 2.0 * c;
        const double near2 = TL_SKY_NEAR * TL_SKY_NEAR * (apart2 + 4.0 * alpha2);
        if (node->radius * node->radius > near2 && level < tree->depth) {
            for (size_t i = 4; i-- > 0;) {
                waiting[count].level = level + 1;
                waiting[count++].at = 4 * at + i;
            }
            continue;
        }
        if (!(c > 0.0))
            continue;
        const double wide = 1.0 - c + alpha2 * (1.0 + c);
        const double weight = c / (wide * wide) * node->solid_angle;
        for (int i = 0; i < 3; i++)
            sum[i] += weight * node->radiance[i];
        weights += weight;
    }
    for (int i = 0; i < 3; i++)
        out[i] = weights > 0.0 ? sum[i] / weights : 0.0;
}

/* Rows of all levels, one after another. */
typedef struct job {
    const tl_sky_tree *tree;
    uint32_t most;
    float (*texels)[4];
} job;

static void filter_row(const job *j, unsigned level, uint32_t y)
{
    const uint32_t size = tl_sky_level_size(level, j->most);
    float(*row)[4] = j->texels + tl_sky_level_start(level, j->most) + (y + 1) * (size + 2) + 1;
    for (uint32_t x = 0; x < size; x++) {
        double d[3], seen[3];
        tl_sky_cell_direction(x + 0.5, y + 0.5, size, d);
        tl_sky_mirrored(j->tree, d, tl_sky_level_alpha(level), seen);
        for (int c = 0; c < 3; c++)
            row[x][c] = (float)seen[c];
        row[x][3] = 0.0f;
    }
}

static void filter_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t row = begin; row < end; row++) {
        size_t y = row;
        unsigned level = 0;
        while (y >= tl_sky_level_size(level, j->most))
            y -= tl_sky_level_size(level++, j->most);
        filter_row(j, level, (uint32_t)y);
    }
}

/* Where the texel beside an edge lies: across it the map goes on in the mirror image along it. */
static uint32_t mirrored_along(uint32_t at, uint32_t size)
{
    return size + 1 - at;
}

static void copy_texel(float (*texels)[4], uint32_t pitch, uint32_t to_x, uint32_t to_y,
                       uint32_t x, uint32_t y)
{
    for (int c = 0; c < 4; c++)
        texels[to_y * pitch + to_x][c] = texels[y * pitch + x][c];
}

static void add_border(float (*texels)[4], uint32_t size)
{
    const uint32_t pitch = size + 2, last = size + 1;
    for (uint32_t i = 1; i <= size; i++) {
        const uint32_t from = mirrored_along(i, size);
        copy_texel(texels, pitch, i, 0, from, 1);
        copy_texel(texels, pitch, i, last, from, size);
        copy_texel(texels, pitch, 0, i, 1, from);
        copy_texel(texels, pitch, last, i, size, from);
    }
    copy_texel(texels, pitch, 0, 0, size, size);
    copy_texel(texels, pitch, last, last, 1, 1);
    copy_texel(texels, pitch, 0, last, size, 1);
    copy_texel(texels, pitch, last, 0, 1, size);
}

void tl_sky_prefilter(const tl_sky_tree *tree, uint32_t most, float (*texels)[4])
{
    job j = {tree, most, texels};
    size_t rows = 0;
    for (unsigned level = 0; level < TL_SKY_LEVELS; level++)
        rows += tl_sky_level_size(level, most);
    tl_parallel(rows, 1, filter_rows, &j);
    for (unsigned level = 0; level < TL_SKY_LEVELS; level++)
        add_border(texels + tl_sky_level_start(level, most), tl_sky_level_size(level, most));
}
