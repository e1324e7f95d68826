#include "bounds/tile_families.h"

#include "bounds/cone_verdict.h"
#include "bounds/sphere_families.h"

#include "position.h"
#include "tile_rect.h"
#include "view.h"

/* A light, and a pixel whose position it reaches by one ulp. */
typedef struct reached_pixel {
    tl_frame frame;
    tl_needs needs;
    tl_view_light light;
    double direction[3]; /* of a spot's cone, with the position at its edge */
    vec3 position;       /* as kernels compute it */
    int column, row;
} reached_pixel;

/* First or last of a tile, or any. */
static int draw_cell(tl_draws *d, int count, int size)
{
    const int any = draw_index(d, count), edge = any / size * size - draw_index(d, 2);
    return draw_chance(d, 0.6) && edge >= 0 ? edge : any;
}

static double product(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A unit vector at right angles to another one. */
static void draw_across(tl_draws *d, const double from[3], double out[3])
{
    double length2 = 0.0;
    while (!(length2 > 1e-3)) {
        double other[3];
        for (int i = 0; i < 3; i++)
            other[i] = draw(d, -1.0, 1.0);
        const double along = product(other, from);
        for (int i = 0; i < 3; i++)
            out[i] = other[i] - along * from[i];
        length2 = product(out, out);
    }
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(length2);
}

/* The unit normal of the plane through the eye and the pixel's column, or its row. What touches that plane at
 * the position is bounded by the pixel's ray. */
static void draw_side(tl_draws *d, const reached_pixel *p, double out[3])
{
    const int axis = draw_index(d, 2);
    const tl_rays r = p->frame.rays;
    const double slope =
        axis ? (double)r.y0 + p->row * (double)r.dy : (double)r.x0 + p->column * (double)r.dx;
    const double sign = draw_chance(d, 0.5) ? 1.0 : -1.0;
    const double turned = p->needs.orthographic ? 0.0 : slope;
    out[axis] = sign / hypot(1.0, turned);
    out[1 - axis] = 0.0;
    out[2] = sign * turned / hypot(1.0, turned);
}

/* The way from the light to the position, and the direction of a cone of this half-angle, so that the least
 * sphere around the cone, or around the light where it is wide, touches the plane of the side n at the
 * position: from the sphere's centre, that is in the direction of n. Up to 45 degrees the sphere holds the
 * light too, so the angle between n and the direction is twice the half-angle; up to 90 degrees it is a right
 * angle. */
static void draw_way(
    tl_draws *d, const double n[3], double half_angle, double direction[3], double way[3])
{
    const double angle = half_angle < 0.7853981 ? 2.0 * half_angle : 1.5707963;
    double across[3], rim[3];
    draw_across(d, n, across);
    for (int i = 0; i < 3; i++) {
        direction[i] = cos(angle) * n[i] + sin(angle) * across[i];
        rim[i] = (n[i] - cos(angle) * direction[i]) / sin(angle);
        way[i] = cos(half_angle) * direction[i] + sin(half_angle) * rim[i];
    }
}

/* half_angle: below 0 of a point light. */
static void place_light(tl_draws *d, reached_pixel *p, double half_angle)
{
    const double at[3] = {(double)p->position.x, (double)p->position.y, (double)p->position.z};
    const double range = fabs(at[2]) * draw_magnitude(d, 1e-4, 1e2);
    double side[3], way[3];
    draw_side(d, p, side);
    for (int i = 0; i < 3; i++)
        way[i] = side[i];
    if (half_angle > 0.0)
        draw_way(d, side, half_angle, p->direction, way);
    for (int i = 0; i < 3; i++)
        p->light.position[i] = (float)(at[i] - range * way[i]);
}

/* half_angle: of a spot, at the edge of whose cone the position is; below 0 of a point light. */
static int reach_pixel(tl_draws *d, reached_pixel *p, double half_angle)
{
    static const tl_u32 sizes[] = {8, 16, 32, 64};
    const tl_sphere_case s = tl_sphere_families[draw_index(d, TL_SPHERE_FAMILIES)].draw(d);
    *p = (reached_pixel){.needs = {.orthographic = s.camera.projection == TL_ORTHOGRAPHIC}};
    p->frame.tile_size = sizes[draw_index(d, 4)];
    p->frame.tiles_x = (s.camera.width + p->frame.tile_size - 1) / p->frame.tile_size;
    p->frame.tiles_y = (s.camera.height + p->frame.tile_size - 1) / p->frame.tile_size;
    tl_view_set(&s.camera, TL_LAYOUT_FLOAT, &p->frame);
    p->column = draw_cell(d, (int)s.camera.width, (int)p->frame.tile_size);
    p->row = draw_cell(d, (int)s.camera.height, (int)p->frame.tile_size);
    const float depth = fabsf(s.center[2]) * (float)draw_magnitude(d, 1e-2, 1e2);
    p->position =
        view_position(p->frame.rays, p->needs, (float)p->column, (float)p->row, depth);
    place_light(d, p, half_angle);
    const vec3 l = vector_to_light(p->position, p->light);
    p->light.range2 = nextafterf(dot3(l, l), INFINITY);
    return isfinite(p->light.range2) && depth > 0.0f;
}

static int holds(tl_tile_rect rect, const reached_pixel *p)
{
    const int x = p->column / (int)p->frame.tile_size, y = p->row / (int)p->frame.tile_size;
    return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
}

static tl_view_window window_of(const reached_pixel *p, int knows_depth)
{
    const int parallel = (int)p->needs.orthographic;
    const double depth = -(double)p->position.z;
    return knows_depth
               ? view_window(&p->frame, depth, nextafter(depth, HUGE_VAL), parallel)
               : view_window(&p->frame, TL_LEAST_DEPTH(parallel), TL_GREATEST_DEPTH, parallel);
}

static void count(tl_tally *tally, int is_hit, int is_kept)
{
    tally->cases++;
    tally->hits += (uint64_t)is_hit;
    tally->lost += is_hit && !is_kept;
}

static void try_point(tl_draws *d, tl_tally *tally)
{
    reached_pixel p;
    const int is_hit = reach_pixel(d, &p, -1.0);
    count(tally, is_hit,
          !is_hit || holds(tile_rect_of(window_of(&p, 0), &p.frame, p.light), &p));
}

/* All pixels are at the depth of this one. */
static void try_point_at_depth(tl_draws *d, tl_tally *tally)
{
    reached_pixel p;
    const int is_hit = reach_pixel(d, &p, -1.0);
    count(tally, is_hit,
          !is_hit || holds(tile_rect_of(window_of(&p, 1), &p.frame, p.light), &p));
}

/* The position is inside of the edge by 1e-8 of the half-angle, or more. */
static void try_spot_of(tl_draws *d, tl_tally *tally, float outer)
{
    reached_pixel p;
    const double inside = draw_magnitude(d, 1e-8, 1e-3);
    const int is_reached = reach_pixel(d, &p, (double)outer * (1.0 - inside));
    const vec3 l = vector_to_light(p.position, p.light);
    const tl_view_spot spot = tl_test_spot(p.direction, outer);
    const int is_hit = is_reached && in_cone(spot, l, dot3(l, l));
    count(tally, is_hit,
          !is_hit || holds(tile_rect_of_spot(window_of(&p, 0), &p.frame, p.light, spot), &p));
}

static void try_spot(tl_draws *d, tl_tally *tally)
{
    try_spot_of(d, tally, (float)draw_magnitude(d, 1e-3, 3.14));
}

/* Where the sphere around a cone changes its form: 45 and 90 degrees. */
static void try_spot_at_turn(tl_draws *d, tl_tally *tally)
{
    const double turn = draw_chance(d, 0.5) ? 0.785398163 : 1.570796327;
    try_spot_of(d, tally, draw_beside(d, turn, 3));
}

const tl_tile_family tl_tile_families[TL_TILE_FAMILIES] = {
    {"point lights, before cameras of every family", try_point},
    {"the same, with all pixels at one depth", try_point_at_depth},
    {"spots, before cameras of every family", try_spot},
    {"spots of 45 and 90 degrees, 3 ulps about", try_spot_at_turn},
};
