#include "sky_prefilter.h"

#include "parallel.h"
#include "sky_light.h"
#include "sky_tile.h"

#include <math.h>

/* Texels along alpha: below two, a lobe falls between texels and mixtures of them show. */
static const double texels_per_alpha = 2.0;
enum { LEAST_SIZE = 32 };

/* Of the width of a lobe at a piece of the sky, at most, its radius: there the logarithm of K still changes
 * by less than its fourth power does. */
static const double most_share = 0.4;

double tl_sky_level_alpha(unsigned level)
{
    const double r =
        TL_SKY_LEAST_ROUGHNESS + (1.0 - TL_SKY_LEAST_ROUGHNESS) * level / (TL_SKY_LEVELS - 1);
    return r * r;
}

/* 4 pi over size^2 is a texel's solid angle. */
uint32_t tl_sky_level_size(unsigned level, uint32_t most)
{
    const double wanted = texels_per_alpha * sqrt(16.0 * atan(1.0)) / tl_sky_level_alpha(level);
    uint32_t size = LEAST_SIZE;
    while (size < most && (double)size < 0.9 * wanted)
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

/* A piece of the sky counts as a whole where its radius is a small share of the width of K there,
 * sqrt(apart^2 + 4 alpha^2): smaller where K has most of its light than where it has little, and the mean over
 * K of the share's square is the square of this at most. What is wide is looked at more closely, for there are
 * few texels of it. */
static double level_near(double alpha)
{
    return 0.2 * cbrt(tl_sky_level_alpha(0) / alpha);
}

static float chord2(const float a[3], const float b[3])
{
    float square = 0.0f;
    for (int i = 0; i < 3; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return square;
}

/* The mean of sqrt(apart^2 + 4 alpha^2) over a lobe is this times 2 alpha at most: K falls no slower than
 * its fourth power, down to the horizon, where apart is sqrt(2). */
static double mean_width(double alpha)
{
    const double least = 2.0 * alpha, most = sqrt(2.0 + least * least);
    return 2.0 * most / (most + least);
}

static void cell_direction(double x, double y, uint32_t size, float out[3])
{
    double d[3];
    tl_sky_cell_direction(x, y, size, d);
    for (int k = 0; k < 3; k++)
        out[k] = (float)d[k];
}

static void begin_tile(tl_sky_tile *t, double alpha, uint32_t x, uint32_t y, uint32_t size)
{
    const double near = level_near(alpha);
    const double steepness = near * near / (2.0 * alpha * mean_width(alpha));
    *t = (tl_sky_tile){.alpha2 = (float)(alpha * alpha),
                       .most_share2 = (float)(most_share * most_share),
                       .steepness2 = (float)(steepness * steepness)};
    cell_direction(x + 0.5 * TL_SKY_SIDE, y + 0.5 * TL_SKY_SIDE, size, t->middle);
    for (uint32_t i = 0; i < TL_SKY_TILE; i++) {
        float d[3];
        cell_direction(x + i % TL_SKY_SIDE + 0.5, y + i / TL_SKY_SIDE + 0.5, size, d);
        for (int k = 0; k < 3; k++)
            t->toward[k][i] = d[k];
        t->radius = fmaxf(t->radius, sqrtf(chord2(t->middle, d)));
    }
}

/* For the vectors that the processor has; the bits are the same. */
static tl_sky_add_piece *piece_adder(void)
{
#ifdef TL_HAS_AVX
    if (__builtin_cpu_supports("avx512f"))
        return tl_sky_add_piece_avx512;
    if (__builtin_cpu_supports("avx2"))
        return tl_sky_add_piece_avx2;
#endif
    return tl_sky_add_piece_portable;
}

/* Whether it is small enough for the texel that is nearest to it: with s^2 = apart^2 + 4 alpha^2 the width of
 * K there, its radius is below near s sqrt(s / (2 alpha mean_width)), and below most_share s. */
static int counts_as_a_whole(const tl_sky_tile *t, const tl_sky_node *node, float chord)
{
    const float apart = chord - t->radius, radius2 = node->radius * node->radius;
    const float width2 = (apart > 0.0f ? apart * apart : 0.0f) + 4.0f * t->alpha2;
    return radius2 <= t->most_share2 * width2 &&
           radius2 * radius2 <= t->steepness2 * width2 * width2 * width2;
}

/* Whether all of it is below the horizon of every texel, where K is 0: a cosine of 0 is a chord of
 * sqrt(2). */
static int is_below(const tl_sky_tile *t, const tl_sky_node *node, float chord)
{
    return chord - t->radius - node->radius > 1.41422f;
}

static void filter(const tl_sky_tree *tree, tl_sky_tile *t)
{
    tl_sky_add_piece *const add_piece = piece_adder();
    enum { MOST_WAITING = 4 * 32 };
    struct {
        unsigned level;
        size_t at;
    } waiting[MOST_WAITING] = {{0, 0}};
    for (int count = 1; count > 0;) {
        const unsigned level = waiting[--count].level;
        const size_t at = waiting[count].at;
        const tl_sky_node *node = &tree->nodes[level][at];
        const float chord = sqrtf(chord2(t->middle, node->toward));
        if (!(node->solid_angle > 0.0f) || is_below(t, node, chord))
            continue;
        if (level == tree->depth || counts_as_a_whole(t, node, chord)) {
            add_piece(t, node);
            continue;
        }
        for (size_t i = 4; i-- > 0;) {
            waiting[count].level = level + 1;
            waiting[count++].at = 4 * at + i;
        }
    }
}

/* Tiles of all levels, one after another. */
typedef struct job {
    const tl_sky_tree *tree;
    uint32_t most;
    float (*texels)[4];
} job;

static size_t tiles_of(uint32_t size)
{
    return (size_t)(size / TL_SKY_SIDE) * (size / TL_SKY_SIDE);
}

static void filter_tile(const job *j, unsigned level, size_t index)
{
    const uint32_t size = tl_sky_level_size(level, j->most), across = size / TL_SKY_SIDE;
    const uint32_t x = (uint32_t)(index % across) * TL_SKY_SIDE,
                   y = (uint32_t)(index / across) * TL_SKY_SIDE;
    float(*texels)[4] = j->texels + tl_sky_level_start(level, j->most);
    tl_sky_tile t;
    begin_tile(&t, tl_sky_level_alpha(level), x, y, size);
    filter(j->tree, &t);
    for (uint32_t i = 0; i < TL_SKY_TILE; i++) {
        float *to =
            texels[(size_t)(y + i / TL_SKY_SIDE + 1) * (size + 2) + x + i % TL_SKY_SIDE + 1];
        for (int c = 0; c < 3; c++)
            to[c] = t.weight[i] > 0.0f ? t.sum[c][i] / t.weight[i] : 0.0f;
        to[3] = 0.0f;
    }
}

static void filter_tiles(void *context, size_t begin, size_t end)
{
    const job *j = context;
    for (size_t i = begin; i < end; i++) {
        size_t index = i;
        unsigned level = 0;
        while (index >= tiles_of(tl_sky_level_size(level, j->most)))
            index -= tiles_of(tl_sky_level_size(level++, j->most));
        filter_tile(j, level, index);
    }
}

/* Where the texel beside an edge lies: across it the map goes on in the mirror image along it. */
static uint32_t mirrored_along(uint32_t at, uint32_t size)
{
    return size + 1 - at;
}

static void copy_texel(
    float (*texels)[4], uint32_t pitch, uint32_t to_x, uint32_t to_y, uint32_t x, uint32_t y)
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
    size_t tiles = 0;
    for (unsigned level = 0; level < TL_SKY_LEVELS; level++)
        tiles += tiles_of(tl_sky_level_size(level, most));
    tl_parallel(tiles, 1, filter_tiles, &j);
    for (unsigned level = 0; level < TL_SKY_LEVELS; level++)
        add_border(texels + tl_sky_level_start(level, most), tl_sky_level_size(level, most));
}
