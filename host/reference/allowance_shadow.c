/* A texel leaves a place lit where a bound on depths holds, so the share of light grows with the depth that
 * is compared, and with the part of a texel that places may be off (kernels/shadow.h). What a kernel may
 * find is therefore between what the text gives for the least and for the greatest of both; and beside that
 * areas move with the place, by 1/filter per texel each way. u and the manner are those of allowance.c.
 *
 * Where rounding may send a place to another side of a cube, beyond what the map sees, or a surface over the
 * edge of the light, both are possible. */
#include "allowance_shadow.h"

/* How far a place may be off. */
typedef struct displaced {
    double x, y;             /* texels */
    double depth;            /* of what is stored */
    double slope_x, slope_y; /* per texel */
} displaced;

static double length_of(vec3 v)
{
    return sqrt(dot3(v, v));
}

static double row_length(const float row[3])
{
    const vec3 v = {row[0], row[1], row[2]};
    return length_of(v);
}

/* Of the point that is looked up, m: position and way move, the offset along the normal with it; three
 * sums of the point, and three of its products with a row. */
static double point_moved(const rough_surface *s, const way *w, vec3 point, int is_parallel)
{
    const double place = is_parallel ? hypot(s->moved_x, s->moved_y) : w->l_moved;
    return place + (8.0 * U + s->normal_moved * 0x1p-10) * length_of(point);
}

/* seen: the point in the view, off by `moved` m; slope_off: of slopes, as a share of themselves. */
static displaced displacement(
    tl_view_shadow map, shadow_place at, vec3 seen, double moved, double slope_off)
{
    displaced d = {.slope_x = fabs(at.slope_x) * slope_off,
                   .slope_y = fabs(at.slope_y) * slope_off};
    const double places =
        4.0 * U * ((double)map.size + fabs((double)map.right_at) + fabs((double)map.down_at));
    if (map.kind == TL_SHADOW_PARALLEL) {
        d.x = row_length(map.right) * moved + places;
        d.y = row_length(map.down) * moved + places;
        d.depth = row_length(map.ahead) * moved + 2.0 * U * (1.0 + fabs((double)map.ahead_at));
        return d;
    }
    const double share = moved / seen.z;
    const double scale = (double)map.scale;
    d.x = scale * (share + fabs(seen.x / seen.z) * (share + (division + 3.0) * U)) + places;
    d.y = scale * (share + fabs(seen.y / seen.z) * (share + (division + 3.0) * U)) + places;
    d.depth = at.depth * (share + (division + 3.0) * U);
    return d;
}

static interval either(interval a, interval b)
{
    return (interval){fmin(a.low, b.low), fmax(a.high, b.high)};
}

/* The share between the ends of what may be, with slopes of the texels around (x, y). */
static interval share_around(
    tl_numbers numbers, tl_view_shadow map, shadow_place place, displaced d, double x, double y)
{
    const shadow_place at = with_slopes_around(numbers, map, place, x, y);
    const double filter = (double)map.filter, half = 0.5 * (filter + 1.0);
    const double unit = shadow_unit(map, at.depth);
    const double off = fmax(d.x, d.y) + 16.0 * U * half;
    double slope_x = fabs(at.slope_x), slope_y = fabs(at.slope_y);
    for (int k = 0; k < 4; k++) {
        slope_x = fmax(slope_x, fabs(at.around_x[k]));
        slope_y = fmax(slope_y, fabs(at.around_y[k]));
    }
    const double depth = d.depth + 8.0 * U * (unit + at.depth) +
                         (1.0 + 0x1p-7) * ((d.slope_x + slope_x * 16.0 * U) * half +
                                           (d.slope_y + slope_y * 16.0 * U) * half +
                                           slope_x * d.x + slope_y * d.y);
    const double areas = (d.x + d.y) / filter + ((filter + 1.0) * (filter + 1.0) + 8.0) * U;
    shadow_place darker = at, lighter = at;
    darker.depth = at.depth - depth;
    lighter.depth = at.depth + depth;
    const interval share = {share_at(numbers, map, darker, -off),
                            share_at(numbers, map, lighter, off)};
    return (interval){clamp_low(share.low - areas), fmin(share.high + areas, 1.0)};
}

/* That, with the texels around each place that may be meant. */
static interval share_within(tl_numbers numbers,
                             tl_view_shadow map,
                             shadow_place at,
                             displaced d)
{
    const double xs[2] = {at.x - d.x, at.x + d.x}, ys[2] = {at.y - d.y, at.y + d.y};
    interval share = {1.0, 0.0};
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            const int is_same_column = i == 1 && floor(xs[1] - 0.5) == floor(xs[0] - 0.5);
            const int is_same_row = j == 1 && floor(ys[1] - 0.5) == floor(ys[0] - 0.5);
            if (!is_same_column && !is_same_row)
                share = either(share, share_around(numbers, map, at, d, xs[i], ys[j]));
        }
    return share;
}

/* Whether it is so near to the end of what the map sees that kernels may find it beyond. */
static int may_be_outside(tl_view_shadow map, shadow_place at, displaced d)
{
    const double margin = 0.5 * (double)map.filter + 1.0, end = (double)map.size - margin;
    return !at.inside || at.x - d.x < margin || at.x + d.x > end || at.y - d.y < margin ||
           at.y + d.y > end || !(at.depth > d.depth);
}

/* In one view, with one cosine. */
static interval share_in_view(tl_numbers numbers,
                              tl_view_shadow map,
                              vec3 seen,
                              vec3 n,
                              double facing,
                              double view,
                              double moved,
                              double slope_off)
{
    static const interval all = {1.0, 1.0};
    const shadow_place at = place_in_view(map, seen, n, facing, view);
    const displaced d = displacement(map, at, seen, moved, slope_off);
    const interval inside = share_within(numbers, map, at, d);
    return may_be_outside(map, at, d) ? either(inside, all) : inside;
}

/* In each view that the place may be found in. */
static interval share_in_views(tl_numbers numbers,
                               tl_view_shadow map,
                               vec3 point,
                               vec3 normal,
                               double facing,
                               double moved,
                               double slope_off)
{
    const vec3 along = along_rows(map, point), n = along_rows(map, normal);
    if (map.kind != TL_SHADOW_CUBE)
        return share_in_view(numbers, map, along, n, facing, 0.0, moved, slope_off);
    const double parts[3] = {along.x, along.y, along.z};
    const double most = fmax(fabs(along.x), fmax(fabs(along.y), fabs(along.z)));
    interval out = {1.0, 0.0};
    for (int axis = 0; axis < 3; axis++) {
        if (fabs(parts[axis]) + 2.0 * moved < most)
            continue;
        const cube_side side = cube_side_of(axis == 0, axis == 1, parts[axis] < 0.0);
        out = either(out, share_in_view(numbers, map, seen_from_side(side, along),
                                        seen_from_side(side, n), facing, side.view, moved,
                                        slope_off));
    }
    return out;
}

interval tl_shadow_allowance(const tl_prepared *prepared,
                             const tl_view_shape *shape,
                             const rough_surface *s,
                             const way *w,
                             const incidence *n_dot_l)
{
    static const interval all = {1.0, 1.0};
    if (!shape || shape->shadow_at == 0 || !(prepared->needs.shapes & TL_SHAPE_SHADOW))
        return all;
    const tl_numbers numbers = (tl_numbers)prepared->lights;
    const tl_view_shadow map = shadow_behind(numbers, shape->shadow_at);
    const int is_parallel = map.kind == TL_SHADOW_PARALLEL;
    const vec3 point = shadowed_point(map, s->exact, w->l);
    const double moved = point_moved(s, w, point, is_parallel);
    const double cosine = n_dot_l->exact, grazing = (double)TL_SHADOW_GRAZING;
    const double cosine_off = fmax(cosine - n_dot_l->cosine.low, n_dot_l->cosine.high - cosine);
    const double cut = fmax(cosine, grazing);
    /* Of a slope, as a share of itself: the normal's direction, beside the cosine and six roundings. */
    const double slope_off = (cosine_off + s->normal_moved) / cut + (division + 6.0) * U;
    const double facing = cosine > 0.0 ? cut * w->exact : 0.0;
    const interval share =
        share_in_views(numbers, map, point, s->exact.normal, facing, moved, slope_off);
    if (fabs(cosine) > cosine_off)
        return share;
    return either(share,
                  share_in_views(numbers, map, point, s->exact.normal,
                                 cosine > 0.0 ? 0.0 : grazing * w->exact, moved, slope_off));
}
