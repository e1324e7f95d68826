#include "spot_cone.h"

#include "spot.h"

/* The floats of a quarter and of half a turn: angles of files are floats, and mean these. */
static const float quarter_turn = 1.57079637f, half_turn = 3.14159274f;

/* KHR_lights_punctual has it at least that, so that an edge is never infinitely steep. */
static const double least_fall = 0.001;

/* What rounding may take from a cosine, and more: kernels/spot.h. */
static const double widened_by = 0x1p-20;

static double cosine(float half_angle)
{
    return half_angle == quarter_turn ? 0.0 : cos((double)half_angle);
}

void tl_against_rays(const tl_camera *camera, const tl_light *light, float view[3])
{
    double towards[3], turned[3], length2 = 0.0;
    for (int i = 0; i < 3; i++)
        towards[i] = -(double)light->direction[i];
    tl_camera_view_direction(camera, towards, turned);
    for (int i = 0; i < 3; i++)
        length2 += turned[i] * turned[i];
    for (int i = 0; i < 3; i++)
        view[i] = (float)(turned[i] / sqrt(length2));
}

int tl_spot_has_edge(const tl_light *light)
{
    return light->type == TL_LIGHT_SPOT && light->inner_cone < half_turn;
}

int tl_spot_is_empty(const tl_light *light)
{
    return tl_spot_has_edge(light) && (float)cosine(light->outer_cone) == 1.0f;
}

tl_view_spot tl_spot_cone(const tl_camera *camera, const tl_light *light)
{
    if (!tl_spot_has_edge(light))
        return whole_space();
    const double outer = tl_spot_is_empty(light) ? 2.0 : cosine(light->outer_cone);
    const double fall = cosine(light->inner_cone) - cosine(light->outer_cone);
    const double widened = fmax(fmin(outer, 1.0) - widened_by, -1.0);
    tl_view_spot spot = {.least_cos = (float)outer,
                         .least_cos2 = (float)(outer * fabs(outer)),
                         .scale = (float)(1.0 / fmax(least_fall, fall)),
                         .cull_cos = (float)widened,
                         .cull_sin = (float)sqrt(1.0 - widened * widened)};
    tl_against_rays(camera, light, spot.axis);
    return spot;
}
