/* Edges of surfaces, smoothed: equation 7 of Policarpo and Fonseca, "Deferred Shading Tutorial", 2005,
 * section 3.5.1, over all 8 neighbours of a pixel:
 *
 *     Factor = sum over i of |t_i - t|^2
 *
 * of what changes where an edge is, t: the normal, the depth, or both. A pixel is then looked up again at
 * its 8 neighbours, drawn towards it as the factor is below 1, twice at its own place, and the mean of the
 * ten taken; where the factor is 0 it stays as it is, bit for bit.
 *
 * Normals: |n_i - n|^2 is 4 sin^2(a/2), a the angle between them. Next to a straight edge three neighbours
 * are beyond it, so TL_EDGE_NEIGHBOURS times that of the threshold's angle is the sum at the threshold. To
 * the sky, which has none, the difference is 1.
 *
 * Depth: |t_i - t| of a plane that is seen aslant is not 0, and grows without bound towards the horizon. What
 * is 0 on every plane is the second difference, d_i + d_j - 2 d, of neighbours on opposite sides, d being
 * 1/depth under a perspective camera, which is linear across the picture, and depth under a parallel one. It
 * stands for both, |d_i + d_j - 2d|/d, as a share of the pixel's own depth, at most 1, and 1 where one of
 * the three is sky and another not. The distance from the pixel's tangent plane would be as good were normals
 * those of surfaces; those of normal maps are not. What stored depths are off is taken away from it, so a
 * plane gives exactly 0 in every layout: each of d_i, d_j and twice d by e/depth of itself, e being what
 * tl_place_slack says; d_i + d_j is 2d, so their squares are 4d^2 together at most, and all that comes to
 * 6 e/depth of d (tests/test_post_edges.c). Next to a straight edge three of the four pairs differ, which
 * counts six times.
 *
 * Both, over their thresholds, add up to s; the factor is s - 1 between 0 and 1: no edge below the threshold,
 * in full from twice that on, and continuous, so that rounding cannot show.
 *
 * Looking up at a share f of the way to a neighbour is bilinear in the colours around, so the mean of ten
 * has closed weights: f (3 - 2f)/10 for each of the four beside the pixel, f^2/10 for each of the four
 * corners, and what is left for the pixel. They are given to differences from the pixel, whose halves never
 * leave the range of float: a picture of one colour stays one.
 *
 * Beyond the picture's edges stand the normals and colours that are at the edge; pairs of depths of which one
 * is beyond do not count, for there is no plane to hold it against. */
#ifndef TL_EDGES_H
#define TL_EDGES_H

#include "frame.h"
#include "post.h"

/* What counts as an edge: bits. */
#define TL_EDGE_NORMALS 1u
#define TL_EDGE_DEPTH 2u

/* Beside a straight edge, of 8. */
#define TL_EDGE_NEIGHBOURS 3

/* Planes of what edges are looked for in, [TL_EDGE_PLANE_COUNT][rows][pitch] floats. */
enum tl_edge_plane {
    TL_EDGE_PLACE, /* 1/depth or depth, 1/m or m; +infinity is sky */
    TL_EDGE_NORMAL_X,
    TL_EDGE_NORMAL_Y,
    TL_EDGE_NORMAL_Z,
    TL_EDGE_PLANE_COUNT
};

typedef struct tl_view_edges {
    tl_u32 which;      /* TL_EDGE_NORMALS, TL_EDGE_DEPTH or both */
    float per_normals; /* 1 over the sum of squared differences at the threshold */
    float per_depth;   /* the same */
    tl_u32 orthographic;
    /* m that a place at depth d may be off: slack + d (per_depth + d per_depth2) */
    float slack, slack_per_depth, slack_per_depth2;
    tl_u32 first_row,
        rows; /* of the planes: that of the picture which they begin with, and how many */
    tl_u32 unused[3];
} tl_view_edges;
TL_STATIC_ASSERT(sizeof(tl_view_edges) == 48, view_edges_is_three_rows);

typedef struct tl_view_edge_stage {
    tl_view_picture picture;
    tl_view_edges edges;
} tl_view_edge_stage;

/* What planes of edges are gathered from: frame.buffer_row is where their first row stands in the word
 * planes, which have frame.rows. */
typedef struct tl_view_gather {
    tl_frame frame;
    tl_view_edges edges;
} tl_view_gather;

/* What TL_EDGE_PLACE has. */
TL_INLINE real edge_place(tl_u32 orthographic, real depth)
{
    return pick(depth < (real)INFINITY, orthographic ? depth : R(1.0) / depth, (real)INFINITY);
}

TL_INLINE tl_numbers edge_row(const tl_view_edge_stage *s,
                              tl_numbers planes,
                              enum tl_edge_plane plane,
                              int row)
{
    const size_t at = clamped_row(row, s->picture.height) - s->edges.first_row;
    return planes + ((size_t)plane * s->edges.rows + at) * s->picture.pitch;
}

TL_INLINE real edge_value(const tl_view_edge_stage *s,
                          tl_numbers planes,
                          enum tl_edge_plane plane,
                          int row,
                          int column)
{
    return clamped_column(edge_row(s, planes, plane, row), column, (int)s->picture.width);
}

TL_INLINE vec3 edge_normal(const tl_view_edge_stage *s, tl_numbers planes, int row, int column)
{
    const vec3 n = {edge_value(s, planes, TL_EDGE_NORMAL_X, row, column),
                    edge_value(s, planes, TL_EDGE_NORMAL_Y, row, column),
                    edge_value(s, planes, TL_EDGE_NORMAL_Z, row, column)};
    return n;
}

/* Neighbours, of which no two are on opposite sides; the other four are the negatives. */
TL_INLINE int edge_right(int pair)
{
    return pair == 1 ? 0 : 1;
}

TL_INLINE int edge_down(int pair)
{
    return pair == 0 ? 0 : pair == 3 ? -1 : 1;
}

TL_INLINE real squared_difference(vec3 a, vec3 b)
{
    const vec3 d = {a.x - b.x, a.y - b.y, a.z - b.z};
    return dot3(d, d);
}

TL_INLINE real sum_of_normals(const tl_view_edge_stage *s,
                              tl_numbers planes,
                              int row,
                              int column)
{
    const vec3 own = edge_normal(s, planes, row, column);
    real sum = R(0.0);
    for (int pair = 0; pair < 4; pair++) {
        const int right = edge_right(pair), down = edge_down(pair);
        sum = sum + squared_difference(edge_normal(s, planes, row + down, column + right), own);
        sum = sum + squared_difference(edge_normal(s, planes, row - down, column - right), own);
    }
    return sum;
}

/* 6 e/depth: what of a second difference, as a share of `own`, stored depths may have made. */
TL_INLINE real edge_allowance(const tl_view_edges *e, real own)
{
    const real depth = e->orthographic ? own : R(1.0) / own;
    const real off =
        FMA(FMA((real)e->slack_per_depth2, depth, e->slack_per_depth), depth, e->slack);
    return R(6.0) * (off / depth);
}

TL_INLINE real second_difference(real one, real own, real other, real allowance)
{
    const mask is_surface = own < (real)INFINITY;
    const mask one_is = one < (real)INFINITY, other_is = other < (real)INFINITY;
    const mask all_are = is_surface & one_is & other_is;
    const mask none_is = !(is_surface | one_is | other_is);
    const real share = ABSOLUTE((one - own) + (other - own)) / own - allowance;
    const real kept = pick(share > R(0.0), pick(share > R(1.0), R(1.0), share), R(0.0));
    return pick(all_are, kept, pick(none_is, R(0.0), R(1.0)));
}

TL_INLINE real sum_of_depths(const tl_view_edge_stage *s,
                             tl_numbers planes,
                             int row,
                             int column)
{
    const real own = edge_value(s, planes, TL_EDGE_PLACE, row, column);
    const real allowance = edge_allowance(&s->edges, own);
    real sum = R(0.0);
    for (int pair = 0; pair < 4; pair++) {
        const int right = edge_right(pair), down = edge_down(pair);
        const real one = edge_value(s, planes, TL_EDGE_PLACE, row + down, column + right);
        const real other = edge_value(s, planes, TL_EDGE_PLACE, row - down, column - right);
        const real d = second_difference(one, own, other, allowance);
        const mask are_there = is_in_row(column + right, s->picture.width) &
                               is_in_row(column - right, s->picture.width);
        const real more = FMA(R(2.0) * d, d, sum);
        if (down == 0 || (row > 0 && row + 1 < (int)s->picture.height))
            sum = pick(are_there, more, sum);
    }
    return sum;
}

/* 0 to 1. */
TL_INLINE real edge_factor(const tl_view_edge_stage *s, tl_numbers planes, int row, int column)
{
    real over = -R(1.0);
    if (s->edges.which & TL_EDGE_NORMALS)
        over = FMA(sum_of_normals(s, planes, row, column), s->edges.per_normals, over);
    if (s->edges.which & TL_EDGE_DEPTH)
        over = FMA(sum_of_depths(s, planes, row, column), s->edges.per_depth, over);
    return pick(over > R(0.0), pick(over > R(1.0), R(1.0), over), R(0.0));
}

TL_INLINE real half_beyond(real other, real own)
{
    return R(0.5) * other - R(0.5) * own;
}

/* Twice the weight, for what is added are halves. */
TL_INLINE vec3 add_beyond(vec3 sum, real weight, vec3 other, vec3 own)
{
    const vec3 d = {half_beyond(other.x, own.x), half_beyond(other.y, own.y),
                    half_beyond(other.z, own.z)};
    return fma3(d, weight + weight, sum);
}

/* The pixel as it is seen then. from: the picture. */
TL_INLINE vec3
smoothed_edge(const tl_view_edge_stage *s, tl_numbers from, real factor, int row, int column)
{
    const vec3 own = clamped_color(&s->picture, from, row, column);
    const real beside = factor * FMA(-R(2.0), factor, R(3.0)) * R(0.1);
    const real corner = factor * factor * R(0.1);
    vec3 sum = {R(0.0), R(0.0), R(0.0)};
    for (int pair = 0; pair < 4; pair++) {
        const int right = edge_right(pair), down = edge_down(pair);
        const real weight = right != 0 && down != 0 ? corner : beside;
        sum = add_beyond(sum, weight,
                         clamped_color(&s->picture, from, row + down, column + right), own);
        sum = add_beyond(sum, weight,
                         clamped_color(&s->picture, from, row - down, column - right), own);
    }
    const vec3 mean = {within_float(own.x + sum.x), within_float(own.y + sum.y),
                       within_float(own.z + sum.z)};
    return pick3(factor > R(0.0), mean, own);
}

#endif
