#include "bounds/cone_verdict.h"

#include "oracle/cone.h"

#include "spot_cone.h"

static const wide doubt = 16 * 0x1p-24Q;

tl_view_spot tl_test_spot(const double direction[3], float half_angle)
{
    static const tl_camera camera = {
        .view_from_world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    tl_light light = tl_light_default();
    light.type = TL_LIGHT_SPOT;
    light.outer_cone = half_angle;
    for (int i = 0; i < 3; i++)
        light.direction[i] = (float)direction[i];
    return tl_spot_cone(&camera, &light);
}

/* A cone as kernels take it, and as it is meant. */
typedef struct cone {
    tl_view_light light;
    tl_view_spot spot;
    wide axis[3], half_angle;
} cone;

static cone cone_of(const tl_cone_case *of)
{
    const double direction[3] = {(double)of->direction[0], (double)of->direction[1],
                                 (double)of->direction[2]};
    cone c = {.light = {.range2 = INFINITY},
              .spot = tl_test_spot(direction, of->half_angle),
              .half_angle = tl_oracle_half_angle(of->half_angle)};
    for (int i = 0; i < 3; i++) {
        c.light.position[i] = of->light[i];
        c.axis[i] = -(wide)of->direction[i];
    }
    return c;
}

/* Whether float has the squares that in_cone takes, with all their digits. */
static int is_regular(float distance2)
{
    return distance2 > 1e-24f && distance2 < 1e36f;
}

/* tl_oracle_above_edge in double, which is off by less than 1e-14, and in 128-bit floats only where that does
 * not tell on which side of a doubt it is. */
static wide above_edge(const cone *c, vec3 l)
{
    const wide way[3] = {l.x, l.y, l.z};
    const double x = (double)c->axis[0], y = (double)c->axis[1], z = (double)c->axis[2];
    const double lx = (double)l.x, ly = (double)l.y, lz = (double)l.z;
    const double cosine = (x * lx + y * ly + z * lz) /
                          sqrt((x * x + y * y + z * z) * (lx * lx + ly * ly + lz * lz));
    const double above = cosine - cos((double)c->half_angle);
    if (fabs(fabs(above) - (double)doubt) > 1e-12)
        return above;
    return tl_oracle_above_edge(c->axis, c->half_angle, way);
}

typedef struct opinion {
    int lit, surely_in, surely_out;
} opinion;

static opinion opinion_of(const cone *c, const float position[3])
{
    const vec3 at = {position[0], position[1], position[2]};
    const vec3 l = vector_to_light(at, c->light);
    const float distance2 = dot3(l, l);
    opinion o = {.lit = reaches(c->light, distance2) && in_cone(c->spot, l, distance2)};
    if (!is_regular(distance2))
        return o;
    const wide above = above_edge(c, l);
    o.surely_in = above > doubt;
    o.surely_out = above < -doubt;
    return o;
}

/* The float in the box that is nearest to the deepest way. */
static void deepest_position(const tl_cone_case *of, const cone *c, float out[3])
{
    double axis[3], low[3], high[3], way[3];
    for (int i = 0; i < 3; i++) {
        axis[i] = (double)c->spot.axis[i];
        low[i] = (double)of->light[i] - (double)of->high[i];
        high[i] = (double)of->light[i] - (double)of->low[i];
    }
    tl_oracle_deepest_way(axis, (double)c->spot.least_cos, low, high, 9, way);
    for (int i = 0; i < 3; i++)
        out[i] = fminf(fmaxf((float)((double)of->light[i] - way[i]), of->low[i]), of->high[i]);
}

void tl_try_cone(const tl_cone_case *of, tl_tally *tally)
{
    const cone c = cone_of(of);
    const box around = {{of->low[0], of->low[1], of->low[2]},
                        {of->high[0], of->high[1], of->high[2]}};
    float deepest[3];
    deepest_position(of, &c, deepest);
    const opinion at = opinion_of(&c, of->position), deep = opinion_of(&c, deepest);
    const int met = cone_meets_box(c.spot, c.light, around);
    tally->cases++;
    tally->hits += (uint64_t)at.lit;
    tally->lost += !met && (at.lit || deep.lit || at.surely_in || deep.surely_in);
    tally->falsely_kept += (at.lit && at.surely_out) || (deep.lit && deep.surely_out);
    tally->falsely_empty += (!at.lit && at.surely_in) || (!deep.lit && deep.surely_in);
    tally->undecided += !at.surely_in && !at.surely_out;
}
