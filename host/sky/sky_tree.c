#include "sky_tree.h"

#include "normal_code.h"
#include "parallel.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

void tl_sky_cell_direction(double x, double y, double size, double out[3])
{
    const vec3 d = direction_of_octahedron((vec2){2.0 * x / size - 1.0, 2.0 * y / size - 1.0});
    const double length = sqrt(dot3(d, d));
    out[0] = d.x / length;
    out[1] = d.z / length;
    out[2] = d.y / length;
}

static double chord(const float a[3], const double b[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++)
        square += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(square);
}

/* The bits of a number with a 0 before each: those of x and y in turns keep the four cells of a parent
 * together. */
static size_t spread(uint32_t number)
{
    size_t bits = number;
    bits = (bits | bits << 8) & 0x00ff00ffu;
    bits = (bits | bits << 4) & 0x0f0f0f0fu;
    bits = (bits | bits << 2) & 0x33333333u;
    return (bits | bits << 1) & 0x55555555u;
}

static size_t interleaved(uint32_t x, uint32_t y)
{
    return spread(x) | spread(y) << 1;
}

/* Of a piece, before it is divided: over what lies in it. `toward` is weighed by light and a little by solid
 * angle, so that what is black has a direction too. */
typedef struct sky_sums {
    double toward[3], solid_angle, light[3];
} sky_sums;

/* Means, and unit directions. */
static void finish(const sky_sums *of, tl_sky_node *node)
{
    double length2 = 0.0;
    for (int i = 0; i < 3; i++)
        length2 += of->toward[i] * of->toward[i];
    const double per_length = length2 > 0.0 ? 1.0 / sqrt(length2) : 0.0;
    const double per_angle = of->solid_angle > 0.0 ? 1.0 / of->solid_angle : 0.0;
    for (int i = 0; i < 3; i++) {
        node->toward[i] = (float)(of->toward[i] * per_length);
        node->radiance[i] = (float)(of->light[i] * per_angle);
    }
    node->solid_angle = (float)of->solid_angle;
}

/* What is added to a texel's light as weight: a thousandth of the mean of all texels' channels, which hides
 * nothing; 1 where there is no light, so that black has a direction too. */
static double weight_floor(const tl_sky_source *source)
{
    double sum = 0.0;
    const size_t count = 3 * (size_t)source->width * source->height;
    for (size_t i = 0; i < count; i++)
        sum += (double)source->pixels[i];
    return sum > 0.0 ? 1e-3 * sum / (double)count : 1.0;
}

/* Texels in parts that are smaller than half of the smallest cell, 2/cells, along both sides: the nearer to a
 * pole, the fewer. Half of the rows each has sums of its own, so that two threads can add to them; how many
 * threads there are shows in no bit. */
enum { HALVES = 2 };
typedef struct half_map {
    const tl_sky_source *source;
    uint32_t cells;
    double floor;     /* weight_floor */
    uint32_t columns; /* parts of a texel along its row */
    double (*longitudes)
        [2]; /* [source width][columns] of sine and cosine; owned, for the widest row */
    sky_sums *leaves; /* [cells^2]; owned */
} half_map;

static uint32_t parts_of(double extent, uint32_t cells)
{
    const double parts = ceil(extent * cells);
    return parts > 1.0 ? (uint32_t)parts : 1;
}

static void set_columns(half_map *j, uint32_t columns)
{
    const uint32_t count = j->source->width * columns;
    if (columns == j->columns)
        return;
    j->columns = columns;
    for (uint32_t x = 0; x < count; x++) {
        const double longitude = 2.0 * pi * ((x + 0.5) / count - 0.5);
        j->longitudes[x][0] = sin(longitude);
        j->longitudes[x][1] = cos(longitude);
    }
}

static uint32_t cell_along(double e, uint32_t cells)
{
    const double at = (e * 0.5 + 0.5) * cells;
    return at < (double)(cells - 1) ? (uint32_t)at : cells - 1;
}

/* Light of one color from direction d, added to its cell. */
static void deposit(const half_map *j,
                    const double d[3],
                    double solid_angle,
                    const double light[3],
                    double weight)
{
    const vec2 e = octahedron_of((vec3){d[0], d[2], d[1]});
    sky_sums *leaf =
        &j->leaves[interleaved(cell_along(e.x, j->cells), cell_along(e.y, j->cells))];
    leaf->solid_angle += solid_angle;
    for (int i = 0; i < 3; i++) {
        leaf->light[i] += light[i];
        leaf->toward[i] += weight * d[i];
    }
}

/* One row of parts of a row of texels: colatitudes `top` to `end`. */
static void deposit_row(half_map *j, const float *row, double top, double end)
{
    const double middle = 0.5 * (top + end), sine = sin(middle), cosine = cos(middle);
    const double width = 2.0 * pi / j->source->width;
    const double widest = top < 0.5 * pi && end > 0.5 * pi ? 1.0 : fmax(sin(top), sin(end));
    set_columns(j, parts_of(width * widest, j->cells));
    const double solid_angle = (cos(top) - cos(end)) * width / j->columns;
    const double(*longitude)[2] = (const double(*)[2])j->longitudes;
    for (uint32_t x = 0; x < j->source->width; x++, row += 3) {
        double light[3], weight = j->floor;
        for (int c = 0; c < 3; c++) {
            light[c] = (double)row[c] * solid_angle;
            weight += (double)row[c];
        }
        for (uint32_t part = 0; part < j->columns; part++, longitude++) {
            const double d[3] = {sine * (*longitude)[0], cosine, sine * (*longitude)[1]};
            deposit(j, d, solid_angle, light, weight * solid_angle);
        }
    }
}

static void deposit_rows(void *context, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++) {
        half_map *const half = (half_map *)context + i;
        const tl_sky_source *source = half->source;
        const double height = pi / source->height;
        const uint32_t rows = parts_of(height, half->cells), all = source->height * rows;
        for (uint32_t y = (uint32_t)i * (all / HALVES);
             y < (i + 1 < HALVES ? all / HALVES : all); y++)
            deposit_row(half, source->pixels + 3 * (size_t)(y / rows) * source->width,
                        height * y / rows, height * (y + 1.0) / rows);
    }
}

static void clear_halves(half_map halves[HALVES])
{
    for (int i = 0; i < HALVES; i++) {
        free(halves[i].longitudes);
        free(halves[i].leaves);
    }
}

/* To be cleared, whatever comes of it. */
static tl_status deposit_all(const tl_sky_source *source,
                             uint32_t cells,
                             half_map halves[HALVES],
                             tl_error *err)
{
    const size_t most = (size_t)source->width * parts_of(2.0 * pi / source->width, cells);
    const double floor = weight_floor(source);
    for (int i = 0; i < HALVES; i++) {
        half_map *half = &halves[i];
        *half = (half_map){.source = source,
                           .cells = cells,
                           .floor = floor,
                           .longitudes = malloc(most * sizeof *half->longitudes),
                           .leaves = calloc((size_t)cells * cells, sizeof *half->leaves)};
    }
    for (int i = 0; i < HALVES; i++)
        if (!halves[i].longitudes || !halves[i].leaves)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky");
    tl_parallel(HALVES, 1, deposit_rows, halves);
    return TL_OK;
}

/* Rounded up: further than rounding moves what it bounds. */
static float radius_of(double radius)
{
    return (float)(radius * (1.0 + 1e-6));
}

/* A leaf lies within the corners of its cell, and parts reach half of a part beyond it: a third more. */
static void bound_leaf(tl_sky_node *leaf, uint32_t x, uint32_t y, uint32_t cells)
{
    double radius = 0.0;
    for (uint32_t corner = 0; corner < 4; corner++) {
        double d[3];
        tl_sky_cell_direction((double)(x + (corner & 1)), (double)(y + (corner >> 1)), cells,
                              d);
        radius = fmax(radius, 4.0 / 3.0 * chord(leaf->toward, d));
    }
    leaf->radius = radius_of(radius);
}

static void join(const tl_sky_node below[4], tl_sky_node *node)
{
    sky_sums sums = {.solid_angle = 0.0};
    double radius = 0.0;
    for (int i = 0; i < 4; i++) {
        const double solid_angle = (double)below[i].solid_angle;
        double light = 0.0;
        sums.solid_angle += solid_angle;
        for (int c = 0; c < 3; c++) {
            sums.light[c] += (double)below[i].radiance[c] * solid_angle;
            light += (double)below[i].radiance[c];
        }
        for (int k = 0; k < 3; k++)
            sums.toward[k] +=
                (light * (1.0 + 1e-3) + 1e-30) * solid_angle * (double)below[i].toward[k];
    }
    finish(&sums, node);
    for (int i = 0; i < 4; i++) {
        const double toward[3] = {(double)below[i].toward[0], (double)below[i].toward[1],
                                  (double)below[i].toward[2]};
        if (below[i].solid_angle > 0.0f)
            radius = fmax(radius, chord(node->toward, toward) + (double)below[i].radius);
    }
    node->radius = radius_of(radius);
}

static sky_sums sum_of(const half_map halves[HALVES], size_t at)
{
    sky_sums sum = halves[0].leaves[at];
    for (int k = 1; k < HALVES; k++) {
        const sky_sums *more = &halves[k].leaves[at];
        sum.solid_angle += more->solid_angle;
        for (int i = 0; i < 3; i++) {
            sum.toward[i] += more->toward[i];
            sum.light[i] += more->light[i];
        }
    }
    return sum;
}

typedef struct leaf_job {
    const half_map *halves;
    tl_sky_node *leaves;
} leaf_job;

static void finish_rows(void *context, size_t begin, size_t end)
{
    const leaf_job *j = context;
    const uint32_t cells = j->halves->cells;
    for (uint32_t y = (uint32_t)begin; y < end; y++)
        for (uint32_t x = 0; x < cells; x++) {
            const size_t at = interleaved(x, y);
            const sky_sums sum = sum_of(j->halves, at);
            finish(&sum, &j->leaves[at]);
            bound_leaf(&j->leaves[at], x, y, cells);
        }
}

tl_status tl_sky_tree_make(const tl_sky_source *source,
                           unsigned depth,
                           tl_sky_tree *out,
                           tl_error *err)
{
    tl_status status = TL_OK;
    const uint32_t cells = 1u << depth;
    tl_sky_tree tree = {.depth = depth, .nodes = calloc(depth + 1, sizeof *tree.nodes)};
    half_map halves[HALVES] = {{.source = NULL}};
    if (!tree.nodes)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky"));
    for (unsigned level = 0; level <= depth; level++) {
        tree.nodes[level] = calloc((size_t)1 << (2 * level), sizeof **tree.nodes);
        if (!tree.nodes[level])
            TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky"));
    }
    TRY(deposit_all(source, cells, halves, err));
    tl_parallel(cells, 1, finish_rows, &(leaf_job){halves, tree.nodes[depth]});
    for (unsigned level = depth; level-- > 0;)
        for (size_t i = 0; i < (size_t)1 << (2 * level); i++)
            join(&tree.nodes[level + 1][4 * i], &tree.nodes[level][i]);
    *out = tree;
    tree = (tl_sky_tree){0};
done:
    clear_halves(halves);
    tl_sky_tree_clear(&tree);
    return status;
}

void tl_sky_tree_clear(tl_sky_tree *tree)
{
    for (unsigned level = 0; tree->nodes && level <= tree->depth; level++)
        free(tree->nodes[level]);
    free(tree->nodes);
    *tree = (tl_sky_tree){0};
}
