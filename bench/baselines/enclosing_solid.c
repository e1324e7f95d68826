#include "enclosing_solid.h"

#include <math.h>

enum { ICOSAHEDRON_CORNERS = 12, ICOSAHEDRON_FACES = 20 };

/* By so much the faces stay clear of the sphere: float corners err by 1e-7, and depths that are
 * interpolated between them by as much of the distance from the eye. */
static const double clearance = 1e-3;

/* (0, 1, phi) and its like, phi the golden ratio. */
#define PHI 1.618033988749895
static const double icosahedron[ICOSAHEDRON_CORNERS][3] = {
    {-1, PHI, 0},  {1, PHI, 0},  {-1, -PHI, 0}, {1, -PHI, 0}, {0, -1, PHI},  {0, 1, PHI},
    {0, -1, -PHI}, {0, 1, -PHI}, {PHI, 0, -1},  {PHI, 0, 1},  {-PHI, 0, -1}, {-PHI, 0, 1},
};
static const uint32_t icosahedron_faces[ICOSAHEDRON_FACES][3] = {
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1},
};

typedef struct building {
    double corners[SOLID_CORNER_COUNT][3]; /* unit */
    uint32_t parents[SOLID_CORNER_COUNT][2];
    uint32_t count;
} building;

static void make_unit(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* The corner between two, made where it is first asked for. */
static uint32_t between(building *b, uint32_t first, uint32_t second)
{
    const uint32_t low = first < second ? first : second;
    const uint32_t high = first < second ? second : first;
    for (uint32_t i = ICOSAHEDRON_CORNERS; i < b->count; i++)
        if (b->parents[i][0] == low && b->parents[i][1] == high)
            return i;
    b->parents[b->count][0] = low;
    b->parents[b->count][1] = high;
    for (int i = 0; i < 3; i++)
        b->corners[b->count][i] = b->corners[low][i] + b->corners[high][i];
    make_unit(b->corners[b->count]);
    return b->count++;
}

static double plane_distance(const double a[3], const double b[3], const double c[3])
{
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
    }
    double normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0]};
    make_unit(normal);
    return normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2];
}

static void part_faces(building *b, uint32_t faces[SOLID_FACE_COUNT][3])
{
    for (uint32_t f = 0; f < ICOSAHEDRON_FACES; f++) {
        const uint32_t *corner = icosahedron_faces[f];
        const uint32_t middle[3] = {between(b, corner[0], corner[1]),
                                    between(b, corner[1], corner[2]),
                                    between(b, corner[2], corner[0])};
        const uint32_t parts[4][3] = {{corner[0], middle[0], middle[2]},
                                      {middle[0], corner[1], middle[1]},
                                      {middle[2], middle[1], corner[2]},
                                      {middle[0], middle[1], middle[2]}};
        for (int i = 0; i < 12; i++)
            faces[4 * f + (uint32_t)i / 3][i % 3] = parts[i / 3][i % 3];
    }
}

void tl_enclosing_solid(enclosing_solid *out)
{
    building b = {.count = ICOSAHEDRON_CORNERS};
    double nearest = 1.0;
    for (uint32_t i = 0; i < ICOSAHEDRON_CORNERS; i++) {
        for (int k = 0; k < 3; k++)
            b.corners[i][k] = icosahedron[i][k];
        make_unit(b.corners[i]);
    }
    part_faces(&b, out->faces);
    for (int f = 0; f < SOLID_FACE_COUNT; f++)
        nearest = fmin(nearest,
                       plane_distance(b.corners[out->faces[f][0]], b.corners[out->faces[f][1]],
                                      b.corners[out->faces[f][2]]));
    for (uint32_t i = 0; i < SOLID_CORNER_COUNT; i++)
        for (int k = 0; k < 3; k++)
            out->corners[i][k] = (float)(b.corners[i][k] * (1.0 + clearance) / nearest);
}
