/* A. Lauritzen, "Deferred Rendering for Current and Future Rendering Pipelines", SIGGRAPH 2010: tile
 * based culling, as the ISPC project's deferred shading example does it too. */
#include "classic_pairs.h"

#include "parallel.h"

#include <math.h>
#include <stdatomic.h>

enum { TILE = 16 }; /* px */

typedef struct counting {
    const tl_gbuffer *gbuffer;
    const tl_light_set *lights;
    uint32_t tiles_x;
    atomic_ullong pairs;
} counting;

/* A plane through the eye: inside is where x nx + depth nd >= 0 (or y). Unit. */
typedef struct side {
    int axis;
    double normal, depth;
} side;

typedef struct tile {
    side sides[4];
    double near, far; /* m; near > far where all is sky */
    uint32_t pixels;
} tile;

/* Through the edge at this x/depth (y/depth); `sign`: 1 where inside is towards larger ones. */
static side side_at(int axis, double edge, double sign)
{
    const double length = sqrt(1.0 + edge * edge);
    return (side){axis, sign / length, -sign * edge / length};
}

static void bound_depths(const tl_gbuffer *g, uint32_t x0, uint32_t y0, tile *to)
{
    const tl_camera *c = &g->camera;
    const float *depths = tl_gbuffer_plane(g, TL_DEPTH);
    to->near = (double)INFINITY;
    to->far = (double)-INFINITY;
    to->pixels = 0;
    for (uint32_t y = y0; y < y0 + TILE && y < c->height; y++)
        for (uint32_t x = x0; x < x0 + TILE && x < c->width; x++) {
            const double depth = (double)depths[(size_t)y * g->pitch + x];
            to->pixels++;
            if (isinf(depth))
                continue;
            to->near = fmin(to->near, depth);
            to->far = fmax(to->far, depth);
        }
}

static tile tile_at(const tl_gbuffer *g, uint32_t column, uint32_t row)
{
    const tl_camera *c = &g->camera;
    const double wide = ((double)c->right - (double)c->left) / c->width;
    const double tall = ((double)c->top - (double)c->bottom) / c->height;
    const double left = (double)c->left + wide * TILE * column;
    const double top = (double)c->top - tall * TILE * row;
    tile t = {.sides = {side_at(0, left, 1.0), side_at(0, left + wide * TILE, -1.0),
                        side_at(1, top, -1.0), side_at(1, top - tall * TILE, 1.0)}};
    bound_depths(g, column * TILE, row * TILE, &t);
    return t;
}

static int meets(const tile *t, const double center[3], double range)
{
    const double depth = -center[2];
    if (t->near > t->far || depth + range < t->near || depth - range > t->far)
        return 0;
    for (int i = 0; i < 4; i++)
        if (center[t->sides[i].axis] * t->sides[i].normal + depth * t->sides[i].depth < -range)
            return 0;
    return 1;
}

static void count_tiles(void *context, size_t begin, size_t end)
{
    counting *c = context;
    for (size_t i = begin; i < end; i++) {
        const tile t = tile_at(c->gbuffer, (uint32_t)i % c->tiles_x, (uint32_t)i / c->tiles_x);
        unsigned long long count = 0;
        for (size_t l = 0; l < c->lights->count; l++) {
            const tl_light *light = &c->lights->lights[l];
            double world[3], center[3];
            for (int axis = 0; axis < 3; axis++)
                world[axis] = (double)light->position[axis];
            tl_camera_view_point(&c->gbuffer->camera, world, center);
            count += (unsigned)meets(&t, center, (double)light->range);
        }
        atomic_fetch_add(&c->pairs, count * t.pixels);
    }
}

uint64_t tl_classic_pairs(const tl_gbuffer *gbuffer, const tl_light_set *lights)
{
    counting c = {.gbuffer = gbuffer,
                  .lights = lights,
                  .tiles_x = (gbuffer->camera.width + TILE - 1) / TILE};
    const uint32_t tiles_y = (gbuffer->camera.height + TILE - 1) / TILE;
    atomic_init(&c.pairs, 0);
    tl_parallel((size_t)c.tiles_x * tiles_y, 16, count_tiles, &c);
    return atomic_load(&c.pairs);
}
