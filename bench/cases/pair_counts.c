#include "pair_counts.h"

#include "parallel.h"
#include "tilelight/bounds.h"
#include "try.h"

#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { TILE = 16 }; /* px: pixels that are tested against a light together */

typedef struct sphere {
    double center[3], range2; /* view space, m */
    tl_pixel_rect rect;
} sphere;

typedef struct counting {
    const tl_gbuffer *gbuffer;
    const tl_light_set *lights;
    sphere *spheres; /* [lights->count] */
    atomic_ullong in_range, lit;
    atomic_int out_of_memory;
} counting;

/* What pixels show, tile after tile of a row of tiles. */
typedef struct tile {
    double position[TILE * TILE][3], normal[TILE * TILE][3]; /* view space */
    double low[3], high[3]; /* of the positions; low > high where all is sky */
    uint32_t count;         /* of pixels that something was hit in */
} tile;

static void place_lights(void *context, size_t begin, size_t end)
{
    const counting *c = context;
    for (size_t i = begin; i < end; i++) {
        const tl_light *light = &c->lights->lights[i];
        sphere *s = &c->spheres[i];
        double world[3];
        float center[3];
        assert(light->type == TL_LIGHT_POINT && isfinite(light->range));
        for (int axis = 0; axis < 3; axis++)
            world[axis] = (double)light->position[axis];
        tl_camera_view_point(&c->gbuffer->camera, world, s->center);
        for (int axis = 0; axis < 3; axis++)
            center[axis] = (float)s->center[axis];
        s->range2 = (double)light->range * (double)light->range;
        /* A little wider, so that the centre's rounding loses no pixel. */
        tl_sphere_bounds(&c->gbuffer->camera, center, light->range * 1.001f, &s->rect);
    }
}

static void add_pixel(const tl_gbuffer *g, uint32_t column, uint32_t row, tile *to)
{
    const tl_camera *c = &g->camera;
    const size_t at = (size_t)row * g->pitch + column;
    const double depth = (double)tl_gbuffer_plane(g, TL_DEPTH)[at];
    if (isinf(depth))
        return;
    const double x = ((double)column + 0.5) / c->width, y = ((double)row + 0.5) / c->height;
    const double spread = c->projection == TL_PERSPECTIVE ? depth : 1.0;
    double *p = to->position[to->count], normal[3];
    p[0] = ((double)c->left + ((double)c->right - (double)c->left) * x) * spread;
    p[1] = ((double)c->top + ((double)c->bottom - (double)c->top) * y) * spread;
    p[2] = -depth;
    for (int axis = 0; axis < 3; axis++) {
        normal[axis] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + axis))[at];
        to->low[axis] = fmin(to->low[axis], p[axis]);
        to->high[axis] = fmax(to->high[axis], p[axis]);
    }
    tl_camera_view_direction(c, normal, to->normal[to->count++]);
}

static void load_tile(const tl_gbuffer *g, uint32_t column0, uint32_t row0, tile *to)
{
    to->count = 0;
    for (int axis = 0; axis < 3; axis++) {
        to->low[axis] = INFINITY;
        to->high[axis] = -INFINITY;
    }
    for (uint32_t row = row0; row < row0 + TILE && row < g->camera.height; row++)
        for (uint32_t column = column0; column < column0 + TILE && column < g->camera.width;
             column++)
            add_pixel(g, column, row, to);
}

static int reaches_tile(const sphere *s, const tile *of)
{
    double distance2 = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double off =
            fmax(fmax(of->low[axis] - s->center[axis], s->center[axis] - of->high[axis]), 0.0);
        distance2 += off * off;
    }
    return distance2 < s->range2;
}

static void count_tile(const sphere *s, const tile *of, tl_pair_counts *sum)
{
    for (uint32_t i = 0; i < of->count; i++) {
        double distance2 = 0.0, along = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            const double away = s->center[axis] - of->position[i][axis];
            distance2 += away * away;
            along += away * of->normal[i][axis];
        }
        sum->in_range += distance2 < s->range2;
        sum->lit += (distance2 < s->range2) & (along > 0.0);
    }
}

static void count_row(
    const counting *c, uint32_t tile_row, tile *tiles, uint32_t tiles_x, tl_pair_counts *sum)
{
    const uint32_t row0 = tile_row * TILE;
    for (uint32_t x = 0; x < tiles_x; x++)
        load_tile(c->gbuffer, x * TILE, row0, &tiles[x]);
    for (size_t i = 0; i < c->lights->count; i++) {
        const sphere *s = &c->spheres[i];
        if (s->rect.y0 >= row0 + TILE || s->rect.y1 <= row0)
            continue;
        for (uint32_t x = s->rect.x0 / TILE; x < tiles_x && x * TILE < s->rect.x1; x++)
            if (reaches_tile(s, &tiles[x]))
                count_tile(s, &tiles[x], sum);
    }
}

static void count_rows(void *context, size_t begin, size_t end)
{
    counting *c = context;
    const uint32_t tiles_x = (c->gbuffer->camera.width + TILE - 1) / TILE;
    tl_pair_counts sum = {0};
    tile *tiles = malloc(tiles_x * sizeof *tiles);
    if (!tiles) {
        atomic_store(&c->out_of_memory, 1);
        return;
    }
    for (size_t row = begin; row < end; row++)
        count_row(c, (uint32_t)row, tiles, tiles_x, &sum);
    atomic_fetch_add(&c->in_range, sum.in_range);
    atomic_fetch_add(&c->lit, sum.lit);
    free(tiles);
}

tl_status tl_pair_counts_take(const tl_gbuffer *gbuffer,
                              const tl_light_set *lights,
                              tl_pair_counts *out,
                              tl_error *err)
{
    counting c = {.gbuffer = gbuffer, .lights = lights};
    tl_status status = TL_OK;
    c.spheres = calloc(lights->count + 1, sizeof *c.spheres);
    if (!c.spheres)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for counting pairs"));
    tl_parallel(lights->count, 64, place_lights, &c);
    tl_parallel((gbuffer->camera.height + TILE - 1) / TILE, 1, count_rows, &c);
    if (atomic_load(&c.out_of_memory))
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for counting pairs"));
    *out = (tl_pair_counts){.in_range = atomic_load(&c.in_range), .lit = atomic_load(&c.lit)};
done:
    free(c.spheres);
    return status;
}
