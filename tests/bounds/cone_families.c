#include "bounds/cone_families.h"

#include "directions.h"

/* Of length 1, as good as. */
static void draw_direction(tl_draws *d, double out[3])
{
    double length2;
    do {
        length2 = 0.0;
        for (int i = 0; i < 3; i++) {
            out[i] = draw(d, -1.0, 1.0);
            length2 += out[i] * out[i];
        }
    } while (length2 > 1.0 || length2 < 0.01);
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(length2);
}

static float any_half_angle(tl_draws *d)
{
    const int is_even = draw_chance(d, 0.5);
    return (float)(is_even ? draw(d, 0.0, 3.14159274) : draw_magnitude(d, 1e-4, 3.1415));
}

/* A position at the edge of the cone as a rule, but for 1e-8 to 1 radians, `away` from the light, which is up
 * to `place` from the origin. Its box is the position alone. */
static tl_cone_case at_edge(tl_draws *d, float half_angle, double away, double place)
{
    tl_cone_case c = {.half_angle = half_angle};
    const double share = draw_chance(d, 0.8) ? 1.0 : draw(d, 0.0, 1.0);
    const double slip = (double)draw_signed(d, 1e-8, 1.0);
    double direction[3], other[3], way[3];
    draw_direction(d, direction);
    if (draw_chance(d, 0.1)) /* along an axis of space */
        for (int i = 0; i < 3; i++)
            direction[i] = i == 1 ? -1.0 : 0.0;
    draw_direction(d, other);
    turn_towards(direction, other, fabs((double)half_angle * share + slip), way);
    for (int i = 0; i < 3; i++) {
        c.light[i] = (float)draw(d, -place, place);
        c.direction[i] = (float)direction[i];
        c.position[i] = (float)((double)c.light[i] + away * way[i]);
        c.low[i] = c.high[i] = c.position[i];
    }
    return c;
}

/* Makes the box larger around its position, to each side as it comes: by nothing, by a share of `away`. */
static void grow_box(tl_draws *d, tl_cone_case *c, double away, double least, double most)
{
    for (int i = 0; i < 3; i++) {
        const double below = draw_chance(d, 0.2) ? 0.0 : away * draw_magnitude(d, least, most);
        const double above = draw_chance(d, 0.2) ? 0.0 : away * draw_magnitude(d, least, most);
        c->low[i] = fminf((float)((double)c->position[i] - below), c->position[i]);
        c->high[i] = fmaxf((float)((double)c->position[i] + above), c->position[i]);
    }
}

static tl_cone_case draw_case(tl_draws *d, float half_angle)
{
    const double away = draw_magnitude(d, 1e-3, 1e3);
    const double place = draw_chance(d, 0.3) ? 0.0 : away * draw_magnitude(d, 1e-3, 1e3);
    tl_cone_case c = at_edge(d, half_angle, away, place);
    grow_box(d, &c, away, 1e-7, 10.0);
    return c;
}

static tl_cone_case any_angle(tl_draws *d)
{
    return draw_case(d, any_half_angle(d));
}

static tl_cone_case position_alone(tl_draws *d)
{
    const double away = draw_magnitude(d, 1e-3, 1e3);
    const double place = draw_chance(d, 0.5) ? 0.0 : away;
    const float half_angle = any_half_angle(d);
    return at_edge(d, half_angle, away, place);
}

static tl_cone_case all_distances(tl_draws *d)
{
    const double away = draw_magnitude(d, 1e-30, 1e30);
    const double place = draw_chance(d, 0.5) ? 0.0 : away * draw_magnitude(d, 1e-3, 1e3);
    tl_cone_case c = at_edge(d, any_half_angle(d), away, place);
    grow_box(d, &c, away, 1e-7, 10.0);
    return c;
}

/* The box holds what is next to the light and what is 1e30 times as far. */
static tl_cone_case endless_boxes(tl_draws *d)
{
    const double away = draw_magnitude(d, 1e-10, 1e15);
    const double place = draw_chance(d, 0.5) ? 0.0 : away;
    tl_cone_case c = at_edge(d, any_half_angle(d), away, place);
    grow_box(d, &c, away, 1.0, 1e22);
    return c;
}

static tl_cone_case apex_in_box(tl_draws *d)
{
    tl_cone_case c = any_angle(d);
    for (int i = 0; i < 3; i++) {
        c.low[i] = fminf(c.low[i], c.light[i]);
        c.high[i] = fmaxf(c.high[i], c.light[i]);
    }
    return c;
}

/* A corner, an edge or a face of the box holds the light. */
static tl_cone_case apex_on_box(tl_draws *d)
{
    tl_cone_case c = any_angle(d);
    for (int i = 0; i < 3; i++) {
        const int side = draw_index(d, 3);
        if (side == 0)
            c.low[i] = c.position[i] = c.light[i];
        if (side == 1)
            c.high[i] = c.position[i] = c.light[i];
        c.low[i] = fminf(c.low[i], c.position[i]);
        c.high[i] = fmaxf(c.high[i], c.position[i]);
    }
    return c;
}

static tl_cone_case narrowest(tl_draws *d)
{
    static const float angles[] = {0.0f,           1e-6f, 1e-4f,   2.4e-4f,
                                   2.44140625e-4f, 3e-4f, 3.5e-4f, 1e-3f};
    return draw_case(d, angles[draw_index(d, 8)]);
}

static tl_cone_case quarter_turn(tl_draws *d)
{
    return draw_case(d, draw_beside(d, 1.57079637, 4));
}

static tl_cone_case half_turn(tl_draws *d)
{
    static const float angles[] = {3.14159274f, 3.14159250f, 3.1415925f, 3.1415f, 3.14f, 3.1f};
    return draw_case(d, angles[draw_index(d, 6)]);
}

/* Tiles that are seen at a grazing angle, or hold an edge: long along an axis, thin along the others. */
static tl_cone_case long_boxes(tl_draws *d)
{
    const double away = draw_magnitude(d, 1e-2, 1e2);
    tl_cone_case c = at_edge(d, any_half_angle(d), away, 10.0 * away);
    const int axis = draw_index(d, 3);
    grow_box(d, &c, away, 1e-7, 1e-2);
    c.low[axis] -= (float)(away * draw_magnitude(d, 1.0, 1e4));
    c.high[axis] += (float)(away * draw_magnitude(d, 1.0, 1e4));
    return c;
}

/* The position is a corner of the box, and deeper in the cone than all else of it: the box lies to that side
 * of it where (p.d - cos |p|), p from the light, d the direction, becomes less. */
static tl_cone_case touched_at_corner(tl_draws *d)
{
    tl_cone_case c = any_angle(d);
    const double way[3] = {(double)c.position[0] - (double)c.light[0],
                           (double)c.position[1] - (double)c.light[1],
                           (double)c.position[2] - (double)c.light[2]};
    const double length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    for (int i = 0; i < 3; i++) {
        if ((double)c.direction[i] * length > cos((double)c.half_angle) * way[i])
            c.high[i] = c.position[i];
        else
            c.low[i] = c.position[i];
    }
    return c;
}

/* A light so far from the origin that ways to it are a few ulps. */
static tl_cone_case coarse_places(tl_draws *d)
{
    const double away = draw_magnitude(d, 1e-3, 1e3);
    const double place = away * draw_magnitude(d, 1e4, 3e7);
    tl_cone_case c = at_edge(d, any_half_angle(d), away, place);
    grow_box(d, &c, away, 1e-3, 1.0);
    return c;
}

const tl_cone_family tl_cone_families[TL_CONE_FAMILIES] = {
    {"any half-angle, boxes of every size", any_angle},
    {"boxes of a position alone", position_alone},
    {"distances of 1e-30 to 1e30 m", all_distances},
    {"boxes 1e22 times as long as the way", endless_boxes},
    {"light in the box", apex_in_box},
    {"light on a face or a corner of the box", apex_on_box},
    {"half-angles of 0 to 1e-3", narrowest},
    {"a quarter turn, 4 ulps about", quarter_turn},
    {"half a turn, and next to it", half_turn},
    {"long boxes", long_boxes},
    {"boxes that the cone touches at a corner", touched_at_corner},
    {"coarse places, far from the origin", coarse_places},
};
