#include "sky_tree.h"

#include "normal_code.h"
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

static double chord(const double a[3], const double b[3])
{
    double square = 0.0;
    for (int i = 0; i < 3; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
}

/* Bits of x and y in turns, so that the four cells of a parent stand together. */
static size_t interleaved(uint32_t x, uint32_t y)
{
    size_t at = 0;
    for (unsigned bit = 0; bit < 16; bit++)
        at |= (size_t)(x >> bit & 1u) << (2 * bit) | (size_t)(y >> bit & 1u) << (2 * bit + 1);
    return at;
}

static uint32_t cell_along(double e, uint32_t cells)
{
    const double at = (e * 0.5 + 0.5) * cells;
    return at < (double)(cells - 1) ? (uint32_t)at : cells - 1;
}

/* Light that comes from a direction, added to its cell; `toward` is summed here, weighed by light and a
 * little by solid angle, so that what is black has a direction too. */
static void deposit(tl_sky_node *leaves,
                    uint32_t cells,
                    const double d[3],
                    double solid_angle,
                    const float color[3],
                    double floor)
{
    const vec2 e = octahedron_of((vec3){d[0], d[2], d[1]});
    tl_sky_node *leaf = &leaves[interleaved(cell_along(e.x, cells), cell_along(e.y, cells))];
    double weight = floor;
    for (int c = 0; c < 3; c++) {
        leaf->radiance[c] += (double)color[c] * solid_angle;
        weight += (double)color[c];
    }
    leaf->solid_angle += solid_angle;
    for (int i = 0; i < 3; i++)
        leaf->toward[i] += weight * solid_angle * d[i];
}

/* Of sums: means, and unit directions. */
static void finish(tl_sky_node *node)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    const double length = chord(node->toward, origin);
    for (int i = 0; i < 3; i++) {
        if (node->solid_angle > 0.0)
            node->radiance[i] /= node->solid_angle;
        if (length > 0.0)
            node->toward[i] /= length;
    }
}

/* What is added to a texel's light as weight: a thousandth of the brightest row's mean would hide nothing,
 * and it is never 0 where there is light at all. */
static double weight_floor(const tl_sky_source *source)
{
    double sum = 0.0;
    const size_t count = 3 * (size_t)source->width * source->height;
    for (size_t i = 0; i < count; i++)
        sum += (double)source->pixels[i];
    return sum > 0.0 ? 1e-3 * sum / (double)count : 1.0;
}

/* Parts along a side of `extent` (rad) that are smaller than half of the smallest cell, 2/cells. */
static uint32_t parts_of(double extent, uint32_t cells)
{
    return (uint32_t)ceil(extent * cells);
}

static void deposit_all(const tl_sky_source *source, uint32_t cells, tl_sky_node *leaves)
{
    const double floor = weight_floor(source);
    const double height = pi / source->height, width = 2.0 * pi / source->width;
    const uint32_t rows = parts_of(height, cells), columns = parts_of(width, cells);
    for (uint32_t y = 0; y < source->height * rows; y++) {
        const double at_y = (double)y / rows, top = height * at_y,
                     end = height * (y + 1.0) / rows;
        const double solid_angle = (cos(top) - cos(end)) * width / columns;
        const float *row = source->pixels + 3 * (size_t)(y / rows) * source->width;
        for (uint32_t x = 0; x < source->width * columns; x++) {
            double d[3];
            tl_sky_direction(source, (x + 0.5) / columns, at_y + 0.5 / rows, d);
            deposit(leaves, cells, d, solid_angle, row + 3 * (size_t)(x / columns), floor);
        }
    }
}

/* A leaf lies within the corners of its cell, and parts reach half of a part beyond it: a third more. */
static void bound_leaf(tl_sky_node *leaf, uint32_t x, uint32_t y, uint32_t cells)
{
    for (uint32_t corner = 0; corner < 4; corner++) {
        double d[3];
        tl_sky_cell_direction((double)(x + (corner & 1)), (double)(y + (corner >> 1)), cells,
                              d);
        leaf->radius = fmax(leaf->radius, 4.0 / 3.0 * chord(leaf->toward, d));
    }
}

static void join(const tl_sky_node below[4], tl_sky_node *node)
{
    *node = (tl_sky_node){.radius = 0.0};
    for (int i = 0; i < 4; i++) {
        double light = 0.0;
        node->solid_angle += below[i].solid_angle;
        for (int c = 0; c < 3; c++) {
            node->radiance[c] += below[i].radiance[c] * below[i].solid_angle;
            light += below[i].radiance[c];
        }
        for (int k = 0; k < 3; k++)
            node->toward[k] +=
                (light * (1.0 + 1e-3) + 1e-30) * below[i].solid_angle * below[i].toward[k];
    }
    finish(node);
    for (int i = 0; i < 4; i++)
        if (below[i].solid_angle > 0.0)
            node->radius =
                fmax(node->radius, chord(node->toward, below[i].toward) + below[i].radius);
}

tl_status tl_sky_tree_make(const tl_sky_source *source,
                           unsigned depth,
                           tl_sky_tree *out,
                           tl_error *err)
{
    tl_status status = TL_OK;
    const uint32_t cells = 1u << depth;
    tl_sky_tree tree = {.depth = depth, .nodes = calloc(depth + 1, sizeof *tree.nodes)};
    if (!tree.nodes)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky"));
    for (unsigned level = 0; level <= depth; level++) {
        tree.nodes[level] = calloc((size_t)1 << (2 * level), sizeof **tree.nodes);
        if (!tree.nodes[level])
            TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky"));
    }
    deposit_all(source, cells, tree.nodes[depth]);
    for (uint32_t y = 0; y < cells; y++)
        for (uint32_t x = 0; x < cells; x++) {
            tl_sky_node *leaf = &tree.nodes[depth][interleaved(x, y)];
            finish(leaf);
            bound_leaf(leaf, x, y, cells);
        }
    for (unsigned level = depth; level-- > 0;)
        for (size_t i = 0; i < (size_t)1 << (2 * level); i++)
            join(&tree.nodes[level + 1][4 * i], &tree.nodes[level][i]);
    *out = tree;
    tree = (tl_sky_tree){0};
done:
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
