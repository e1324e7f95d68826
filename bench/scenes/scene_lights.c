#include "scene_lights.h"

#include "parallel.h"
#include "tilelight/bounds.h"
#include "tilelight/scatter.h"
#include "try.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { TILE = 16, MOST_SAMPLED_TILES = 1024, MOST_TESTS = 1 << 24, MOST_STEPS = 30 };

/* Some tiles of a frame. A tile lists a light whose rectangle meets it and that reaches the box of
 * its surfaces: what culling does without looking for gaps in the depth of a tile. */
typedef struct sampled_tile {
    uint32_t x, y; /* px, its top left */
    double box[6]; /* view space, low then high, m; low > high where all is sky */
} sampled_tile;

/* Lights stand off their feet in proportion to their range: `at_1` and `at_2` are those of 1 m and
 * 2 m. */
typedef struct sample {
    const tl_gbuffer *gbuffer;
    tl_light_set at_1, at_2;
    double range;        /* m; what is being tried */
    size_t count;        /* of tiles, those of sky included */
    sampled_tile *tiles; /* [count] */
    atomic_ullong listed;
} sample;

static void box_of_tile(const tl_gbuffer *gbuffer,
                        uint32_t column0,
                        uint32_t row0,
                        double box[6])
{
    const tl_camera *c = &gbuffer->camera;
    const float *depths = tl_gbuffer_plane(gbuffer, TL_DEPTH);
    for (int i = 0; i < 6; i++)
        box[i] = i < 3 ? INFINITY : -INFINITY;
    for (uint32_t row = row0; row < row0 + TILE && row < c->height; row++)
        for (uint32_t column = column0; column < column0 + TILE && column < c->width;
             column++) {
            const double depth = (double)depths[(size_t)row * gbuffer->pitch + column];
            if (isinf(depth))
                continue;
            const double x = ((double)column + 0.5) / c->width,
                         y = ((double)row + 0.5) / c->height;
            const double p[3] = {
                ((double)c->left + ((double)c->right - (double)c->left) * x) * depth,
                ((double)c->top + ((double)c->bottom - (double)c->top) * y) * depth, -depth};
            for (int i = 0; i < 3; i++) {
                box[i] = fmin(box[i], p[i]);
                box[3 + i] = fmax(box[3 + i], p[i]);
            }
        }
}

static tl_status sample_tiles(const tl_gbuffer *gbuffer,
                              uint32_t light_count,
                              sample *s,
                              tl_error *err)
{
    const size_t tiles_x = (gbuffer->camera.width + TILE - 1) / TILE;
    const size_t tiles_y = (gbuffer->camera.height + TILE - 1) / TILE;
    const size_t tiles = tiles_x * tiles_y;
    const size_t affordable = MOST_TESTS / light_count + 1;
    const size_t wanted = affordable < MOST_SAMPLED_TILES ? affordable : MOST_SAMPLED_TILES;
    s->gbuffer = gbuffer;
    s->count = tiles < wanted ? tiles : wanted;
    s->tiles = malloc(s->count * sizeof *s->tiles);
    if (!s->tiles)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the lights of a bench scene");
    for (size_t i = 0; i < s->count; i++) {
        const size_t tile = (size_t)((double)i * (double)tiles / (double)s->count);
        s->tiles[i].x = (uint32_t)(tile % tiles_x) * TILE;
        s->tiles[i].y = (uint32_t)(tile / tiles_x) * TILE;
        box_of_tile(gbuffer, s->tiles[i].x, s->tiles[i].y, s->tiles[i].box);
    }
    return TL_OK;
}

static double distance2_to_box(const double at[3], const double box[6])
{
    double distance2 = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double off = fmax(fmax(box[axis] - at[axis], at[axis] - box[3 + axis]), 0.0);
        distance2 += off * off;
    }
    return distance2;
}

static void light_in_view(const sample *s, size_t i, double at[3])
{
    double world[3];
    for (int axis = 0; axis < 3; axis++) {
        const double one = (double)s->at_1.lights[i].position[axis];
        const double two = (double)s->at_2.lights[i].position[axis];
        world[axis] = one + (two - one) * (s->range - 1.0);
    }
    tl_camera_view_point(&s->gbuffer->camera, world, at);
}

static void count_listed(void *context, size_t begin, size_t end)
{
    sample *s = context;
    unsigned long long listed = 0;
    for (size_t i = begin; i < end; i++) {
        double at[3];
        tl_pixel_rect rect;
        light_in_view(s, i, at);
        const float center[3] = {(float)at[0], (float)at[1], (float)at[2]};
        tl_sphere_bounds(&s->gbuffer->camera, center, (float)s->range, &rect);
        for (size_t k = 0; k < s->count; k++) {
            const sampled_tile *tile = &s->tiles[k];
            listed += tile->x < rect.x1 && tile->x + TILE > rect.x0 && tile->y < rect.y1 &&
                      tile->y + TILE > rect.y0 &&
                      distance2_to_box(at, tile->box) < s->range * s->range;
        }
    }
    atomic_fetch_add(&s->listed, listed);
}

static tl_status scatter(const tl_gbuffer *gbuffer,
                         const tl_bench_scene_options *options,
                         double range,
                         tl_light_set *lights,
                         tl_error *err)
{
    tl_scatter_options scattered = tl_scatter_options_default();
    scattered.count = options->light_count;
    scattered.seed = options->seed;
    scattered.range = (float)range;
    return tl_scatter(gbuffer, &scattered, lights, err);
}

/* Bisects the logarithm of the range until as many lights are listed as wanted, to 0.5 %. */
static double range_that_lists(sample *s, double lights_per_tile)
{
    double low = 1e-3, high = 1e3;
    for (int step = 0; step < MOST_STEPS; step++) {
        s->range = sqrt(low * high);
        atomic_store(&s->listed, 0);
        tl_parallel(s->at_1.count, 1, count_listed, s);
        const double per_tile = (double)atomic_load(&s->listed) / (double)s->count;
        if (fabs(per_tile - lights_per_tile) < 0.005 * lights_per_tile)
            break;
        if (per_tile < lights_per_tile)
            low = s->range;
        else
            high = s->range;
    }
    return s->range;
}

tl_status tl_scene_lights(const tl_gbuffer *gbuffer,
                          const tl_bench_scene_options *options,
                          tl_light_set *lights,
                          tl_error *err)
{
    tl_status status = TL_OK;
    sample s = {0};
    double range = options->range;
    if (options->light_count == 0)
        goto done;
    if (!(range > 0.0)) {
        TRY(sample_tiles(gbuffer, options->light_count, &s, err));
        TRY(scatter(gbuffer, options, 1.0, &s.at_1, err));
        TRY(scatter(gbuffer, options, 2.0, &s.at_2, err));
        range = range_that_lists(&s, options->lights_per_tile);
    }
    TRY(scatter(gbuffer, options, range, lights, err));
done:
    tl_light_set_clear(&s.at_1);
    tl_light_set_clear(&s.at_2);
    free(s.tiles);
    return status;
}
