#include "shadow_size.h"

#include "visible_points.h"

#include <math.h>
#include <stdlib.h>

/* Texels each way, at most: larger ones take a whole budget for one light. */
static const uint32_t most_size[TL_SHADOW_KIND_COUNT] = {
    [TL_SHADOW_SPOT] = 4096,
    [TL_SHADOW_PARALLEL] = 4096,
    [TL_SHADOW_CUBE] = 2048,
};

/* Of the points in reach, that get texels as fine as their pixels. The rest, nearest to the camera, would
 * quadruple maps again and again. */
static const double share_served = 0.9;

enum { POINTS_ACROSS = 128 }; /* of the picture, each way, at most */

static void note_point(void *context, const double at[3], double width)
{
    tl_seen_points *const points = context;
    struct tl_seen_point *const to = &points->of[points->count++];
    for (int i = 0; i < 3; i++)
        to->at[i] = at[i];
    to->width = width;
}

tl_status tl_seen_points_of(const tl_gbuffer *gbuffer, tl_seen_points *out, tl_error *err)
{
    static const double axes_of_world[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const uint32_t width = gbuffer->camera.width, height = gbuffer->camera.height;
    const uint32_t longer = width > height ? width : height;
    const uint32_t step = (longer + POINTS_ACROSS - 1) / POINTS_ACROSS;
    const size_t most = ((size_t)width / step + 1) * ((size_t)height / step + 1);
    *out = (tl_seen_points){.of = malloc(most * sizeof *out->of)};
    if (!out->of)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu points that are seen", most);
    tl_visit_visible_points(gbuffer, axes_of_world, step, note_point, out);
    return TL_OK;
}

void tl_seen_points_clear(tl_seen_points *points)
{
    free(points->of);
    *points = (tl_seen_points){0};
}

/* From the light, m; below 0: its light does not get there, whatever is between. */
static double distance_lit(const tl_light *light, const struct tl_seen_point *point)
{
    double distance2 = 0.0, along = 0.0;
    for (int i = 0; i < 3; i++) {
        const double way = point->at[i] - (double)light->position[i];
        distance2 += way * way;
        along += way * (double)light->direction[i];
    }
    const double distance = sqrt(distance2);
    if (distance >= (double)light->range)
        return -1.0;
    return light->type == TL_LIGHT_SPOT && along < cos((double)light->outer_cone) * distance
               ? -1.0
               : distance;
}

/* Texels each way with which one is as wide as the point's pixel; 0 where no light gets. */
static double texels_for(const tl_light *light,
                         const struct tl_seen_point *point,
                         double tangent,
                         double span)
{
    if (light->type == TL_LIGHT_DIRECTIONAL)
        return span / point->width;
    const double distance = distance_lit(light, point);
    return distance < 0.0 ? 0.0 : 2.0 * tangent * distance / point->width;
}

/* Sizes from the least one on, an eighth of an octave between; the last is beyond every limit. */
enum { LEVELS_PER_OCTAVE = 8, LEVELS = 8 * LEVELS_PER_OCTAVE };

static int level_for(double texels)
{
    const double level = LEVELS_PER_OCTAVE * log2(texels / TL_LEAST_SHADOW_SIZE);
    return level > 0.0 ? (int)fmin(ceil(level), LEVELS - 1) : 0;
}

static double size_at(int level)
{
    return TL_LEAST_SHADOW_SIZE * exp2((double)level / LEVELS_PER_OCTAVE);
}

void tl_shadow_need_of(const tl_seen_points *points,
                       const tl_light *light,
                       uint32_t kind,
                       double tangent,
                       double span,
                       tl_shadow_need *need)
{
    size_t reached = 0, served = 0, of_level[LEVELS] = {0};
    int level = 0;
    for (size_t i = 0; i < points->count; i++) {
        const double texels = texels_for(light, &points->of[i], tangent, span);
        if (!(texels > 0.0))
            continue;
        of_level[level_for(texels)]++;
        reached++;
    }
    for (served = of_level[0]; (double)served < share_served * (double)reached;)
        served += of_level[++level];
    need->size = (uint32_t)ceil(fmin(size_at(level), (double)most_size[kind]));
    need->pixels = (double)reached;
}
