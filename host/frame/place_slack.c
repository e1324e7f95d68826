#include "place_slack.h"

#include "layout.h"

#include "tilelight/error_bounds.h"

#include <math.h>
#include <stdbool.h>

/* With which power of depth what a convention stores is off, at most; under a perspective camera. */
static int power_of(tl_u32 code)
{
    if (TL_IS_NEARNESS(code))
        return 2;
    return code == TL_DEPTH_FRACTION ? 0 : 1;
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double farther_edge(float a, float b)
{
    return fmax(fabs((double)a), fabs((double)b));
}

/* Of a surface in the corner of the picture at this depth, m. */
static double stored_error(const tl_gbuffer *gbuffer, double depth)
{
    const tl_camera *camera = &gbuffer->camera;
    const double scale = camera->projection == TL_PERSPECTIVE ? depth : 1.0;
    const double view[3] = {farther_edge(camera->left, camera->right) * scale,
                            farther_edge(camera->bottom, camera->top) * scale, -depth};
    double bound[3];
    tl_position_bound(camera, gbuffer->layout, view, bound);
    return length_of(bound);
}

/* The least factor of depth^power that is no less than what is stored may be off, from near to far. */
static double stored_factor(const tl_gbuffer *gbuffer, int power)
{
    enum { STEPS = 64 };
    const tl_camera *camera = &gbuffer->camera;
    const double near = (double)camera->near;
    const double far =
        isinf(camera->far) ? fmax(near, 1.0) * TL_FAR_OF_NONE : (double)camera->far;
    double most = 0.0;
    for (int i = 0; i <= STEPS; i++) {
        const double depth = power == 0 ? near + (far - near) * i / STEPS
                                        : near * pow(far / near, (double)i / STEPS);
        most = fmax(most, stored_error(gbuffer, depth) / pow(depth, power));
    }
    return most;
}

void tl_place_slack(const tl_gbuffer *gbuffer, double beside, float out[3])
{
    const tl_camera *camera = &gbuffer->camera;
    const bool is_parallel = camera->projection == TL_ORTHOGRAPHIC;
    const int power = is_parallel ? 0 : power_of(tl_layouts[gbuffer->layout].depth.code);
    const double edge =
        farther_edge(camera->left, camera->right) + farther_edge(camera->bottom, camera->top);
    double factors[3] = {beside, TL_PLACE_MISREAD * (1.0 + (is_parallel ? 0.0 : edge)), 0.0};
    if (is_parallel)
        factors[0] += TL_PLACE_MISREAD * edge;
    factors[power] += stored_factor(gbuffer, power);
    for (int i = 0; i < 3; i++)
        out[i] = (float)factors[i];
}
