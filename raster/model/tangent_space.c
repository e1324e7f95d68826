#include "tangent_space.h"

#include "try.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { NONE = UINT32_MAX };

typedef struct vec {
    float x, y, z;
} vec;

/* A triangle, and what it says of the directions in which u and v grow. */
typedef struct triangle {
    /* welded: the first corner that has the same position, normal and uv */
    uint32_t corners[3];
    uint32_t neighbours[3]; /* across the edge from corner i to the next; NONE */
    uint32_t groups[3];     /* of corner i; NONE */
    vec along_u, along_v;   /* unit, or 0 */
    bool is_degenerate;     /* two corners in one place: takes part in nothing */
    bool follows_any;       /* says nothing itself: may join any group */
    bool keeps_orientation; /* u, v turn as the triangle does */
} triangle;

/* Triangles around one welded corner, joined by edges and alike in orientation. */
typedef struct group {
    uint32_t corner, first, count; /* members [first, first + count) */
    bool keeps_orientation;
} group;

typedef struct space {
    const tl_corners *of;
    triangle *triangles; /* [triangle_count] */
    group *groups;       /* [3 triangle_count] at most */
    uint32_t *members;   /* [3 triangle_count] at most, group after group */
    uint32_t *waiting;   /* [9 triangle_count]: triangles still to be asked */
    uint32_t *joining; /* [3 triangle_count]: those of one group that one tangent is made of */
    uint32_t group_count, member_count;
} space;

/* --- vectors ----------------------------------------------------------------------------------- */

static vec vec_of(const float v[3])
{
    return (vec){v[0], v[1], v[2]};
}

static vec minus(vec a, vec b)
{
    return (vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static vec times(float k, vec a)
{
    return (vec){k * a.x, k * a.y, k * a.z};
}

static vec plus(vec a, vec b)
{
    return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static float dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static bool is_zero(float x)
{
    return !(fabsf(x) > FLT_MIN);
}

static vec unit_or_same(vec a)
{
    const bool vanishes = is_zero(a.x) && is_zero(a.y) && is_zero(a.z);
    return vanishes ? a : times(1.0f / sqrtf(dot(a, a)), a);
}

/* What of a lies across n, as a direction. */
static vec across(vec n, vec a)
{
    return unit_or_same(minus(a, times(dot(n, a), n)));
}

/* --- welding ------------------------------------------------------------------------------------ */

typedef struct welded_key {
    float values[8]; /* position, normal, uv */
    uint32_t corner;
} welded_key;

static int by_values(const void *left, const void *right)
{
    const welded_key *a = left, *b = right;
    for (int i = 0; i < 8; i++)
        if (a->values[i] != b->values[i])
            return a->values[i] < b->values[i] ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

static bool same_values(const welded_key *a, const welded_key *b)
{
    for (int i = 0; i < 8; i++)
        if (a->values[i] != b->values[i])
            return false;
    return true;
}

static tl_status weld(space *s, tl_error *err)
{
    const size_t count = 3 * s->of->triangle_count;
    welded_key *keys = malloc(count * sizeof *keys);
    if (!keys)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
    for (uint32_t i = 0; i < count; i++) {
        memcpy(keys[i].values, s->of->position[i], 3 * sizeof(float));
        memcpy(keys[i].values + 3, s->of->normal[i], 3 * sizeof(float));
        memcpy(keys[i].values + 6, s->of->uv[i], 2 * sizeof(float));
        keys[i].corner = i;
    }
    qsort(keys, count, sizeof *keys, by_values);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (!same_values(&keys[i], &keys[first]))
            first = i;
        const uint32_t corner = keys[i].corner;
        s->triangles[corner / 3].corners[corner % 3] = keys[first].corner;
    }
    free(keys);
    return TL_OK;
}

/* --- triangles ---------------------------------------------------------------------------------- */

static vec position_of(const space *s, uint32_t corner)
{
    return vec_of(s->of->position[corner]);
}

static bool same_place(vec a, vec b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Mikkelsen, section 3.1: the first-order derivatives of position by u and v, their directions only. */
static void derive(const space *s, triangle *t)
{
    const float *const uv0 = s->of->uv[t->corners[0]];
    const float *const uv1 = s->of->uv[t->corners[1]];
    const float *const uv2 = s->of->uv[t->corners[2]];
    const vec p0 = position_of(s, t->corners[0]), p1 = position_of(s, t->corners[1]),
              p2 = position_of(s, t->corners[2]);
    const float u1 = uv1[0] - uv0[0], v1 = uv1[1] - uv0[1];
    const float u2 = uv2[0] - uv0[0], v2 = uv2[1] - uv0[1];
    const vec d1 = minus(p1, p0), d2 = minus(p2, p0);
    const float area = u1 * v2 - v1 * u2;
    const vec along_u = minus(times(v2, d1), times(v1, d2));
    const vec along_v = plus(times(-u2, d1), times(u1, d2));
    const float length_u = sqrtf(dot(along_u, along_u)),
                length_v = sqrtf(dot(along_v, along_v));

    t->is_degenerate = same_place(p0, p1) || same_place(p0, p2) || same_place(p1, p2);
    t->keeps_orientation = area > 0.0f;
    t->follows_any = true;
    if (is_zero(area))
        return;
    const float sign = t->keeps_orientation ? 1.0f : -1.0f, size = fabsf(area);
    if (!is_zero(length_u))
        t->along_u = times(sign / length_u, along_u);
    if (!is_zero(length_v))
        t->along_v = times(sign / length_v, along_v);
    t->follows_any = is_zero(length_u / size) || is_zero(length_v / size);
}

/* --- neighbours --------------------------------------------------------------------------------- */

typedef struct edge {
    uint32_t low, high; /* welded corners */
    uint32_t triangle, number;
} edge;

static int by_corners(const void *left, const void *right)
{
    const edge *a = left, *b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static uint32_t start_of(const space *s, const edge *e)
{
    return s->triangles[e->triangle].corners[e->number];
}

static uint32_t *neighbour_at(space *s, const edge *e)
{
    return &s->triangles[e->triangle].neighbours[e->number];
}

/* Two triangles are neighbours where one has an edge forwards and the other has it backwards. */
static void join_edges(space *s, const edge *edges, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count && *neighbour_at(s, &edges[i]) == NONE &&
                               edges[k].low == edges[i].low && edges[k].high == edges[i].high;
             k++)
            if (*neighbour_at(s, &edges[k]) == NONE &&
                start_of(s, &edges[k]) != start_of(s, &edges[i])) {
                *neighbour_at(s, &edges[i]) = edges[k].triangle;
                *neighbour_at(s, &edges[k]) = edges[i].triangle;
            }
}

static tl_status find_neighbours(space *s, tl_error *err)
{
    size_t count = 0;
    edge *edges = malloc(3 * s->of->triangle_count * sizeof *edges);
    if (!edges)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
    for (uint32_t t = 0; t < s->of->triangle_count; t++)
        for (uint32_t i = 0; i < 3 && !s->triangles[t].is_degenerate; i++) {
            const uint32_t a = s->triangles[t].corners[i];
            const uint32_t b = s->triangles[t].corners[(i + 1) % 3];
            edges[count++] = (edge){a < b ? a : b, a < b ? b : a, t, i};
        }
    qsort(edges, count, sizeof *edges, by_corners);
    join_edges(s, edges, count);
    free(edges);
    return TL_OK;
}

/* --- groups ------------------------------------------------------------------------------------- */

static uint32_t number_of_corner(const triangle *t, uint32_t corner)
{
    return t->corners[0] == corner ? 0 : t->corners[1] == corner ? 1 : 2;
}

/* A triangle that says nothing takes the orientation of the first group that reaches it. */
static bool may_join(triangle *t, const group *g, uint32_t number)
{
    if (t->groups[number] != NONE)
        return false;
    if (t->follows_any && t->groups[0] == NONE && t->groups[1] == NONE && t->groups[2] == NONE)
        t->keeps_orientation = g->keeps_orientation;
    return t->keeps_orientation == g->keeps_orientation;
}

/* Walks around the corner both ways; the way over the edge that leaves the corner is walked first. */
static void fill_group(space *s, uint32_t index, uint32_t first_triangle)
{
    group *g = &s->groups[index];
    size_t waiting_count = 0;
    s->waiting[waiting_count++] = first_triangle;
    while (waiting_count > 0) {
        const uint32_t at = s->waiting[--waiting_count];
        triangle *t = &s->triangles[at];
        const uint32_t number = number_of_corner(t, g->corner);
        if (at != first_triangle && !may_join(t, g, number))
            continue;
        if (t->groups[number] != NONE)
            continue;
        t->groups[number] = index;
        s->members[g->first + g->count++] = at;
        const uint32_t before = t->neighbours[(number + 2) % 3], after = t->neighbours[number];
        if (before != NONE)
            s->waiting[waiting_count++] = before;
        if (after != NONE)
            s->waiting[waiting_count++] = after;
    }
}

static void find_groups(space *s)
{
    for (uint32_t i = 0; i < s->of->triangle_count; i++) {
        const triangle *t = &s->triangles[i];
        for (uint32_t number = 0; number < 3; number++) {
            if (t->is_degenerate || t->follows_any || t->groups[number] != NONE)
                continue;
            s->groups[s->group_count] = (group){.corner = t->corners[number],
                                                .first = s->member_count,
                                                .keeps_orientation = t->keeps_orientation};
            fill_group(s, s->group_count, i);
            s->member_count += s->groups[s->group_count].count;
            s->group_count++;
        }
    }
}

/* --- tangents ----------------------------------------------------------------------------------- */

/* The angle of a triangle at one of its corners, seen along the normal. */
static float angle_at(const space *s, const triangle *t, uint32_t number, vec normal)
{
    const vec here = position_of(s, t->corners[number]);
    const vec back = across(normal, minus(position_of(s, t->corners[(number + 2) % 3]), here));
    const vec forth = across(normal, minus(position_of(s, t->corners[(number + 1) % 3]), here));
    const float cosine = dot(back, forth);
    return acosf(cosine > 1.0f ? 1.0f : cosine < -1.0f ? -1.0f : cosine);
}

/* Section 4.2: the directions of u, turned into the plane of the normal, weighted by angles. */
static vec weighted_tangent(const space *s, const group *g, uint32_t count)
{
    const vec normal = vec_of(s->of->normal[g->corner]);
    vec sum = {0.0f, 0.0f, 0.0f};
    for (uint32_t i = 0; i < count; i++) {
        const triangle *t = &s->triangles[s->joining[i]];
        if (t->follows_any)
            continue;
        const float angle = angle_at(s, t, number_of_corner(t, g->corner), normal);
        sum = plus(sum, times(angle, across(normal, t->along_u)));
    }
    return unit_or_same(sum);
}

/* At a threshold of 180 degrees only what is turned to the exact opposite stays out. */
static uint32_t choose_joining(space *s, const group *g, uint32_t of)
{
    const vec normal = vec_of(s->of->normal[g->corner]);
    const triangle *t = &s->triangles[of];
    const vec u = across(normal, t->along_u), v = across(normal, t->along_v);
    uint32_t count = 0;
    for (uint32_t i = 0; i < g->count; i++) {
        const uint32_t other = s->members[g->first + i];
        const triangle *o = &s->triangles[other];
        if (t->follows_any || o->follows_any ||
            (dot(u, across(normal, o->along_u)) > -1.0f &&
             dot(v, across(normal, o->along_v)) > -1.0f))
            s->joining[count++] = other;
    }
    return count;
}

/* Whether all directions lie on one side of the first: then none is opposite to another. */
static bool all_join(const space *s, const group *g)
{
    const vec normal = vec_of(s->of->normal[g->corner]);
    const triangle *first = &s->triangles[s->members[g->first]];
    const vec u = across(normal, first->along_u), v = across(normal, first->along_v);
    for (uint32_t i = 1; i < g->count; i++) {
        const triangle *t = &s->triangles[s->members[g->first + i]];
        if (!t->follows_any && !(dot(u, across(normal, t->along_u)) > 0.001f &&
                                 dot(v, across(normal, t->along_v)) > 0.001f))
            return false;
    }
    return true;
}

static int by_number(const void *left, const void *right)
{
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

static void put_tangent(float out[4], vec tangent, bool keeps_orientation)
{
    out[0] = tangent.x;
    out[1] = tangent.y;
    out[2] = tangent.z;
    out[3] = keeps_orientation ? -1.0f : 1.0f; /* glTF's bitangent goes against v */
}

static void make_tangents(space *s, const group *g, float (*tangents)[4])
{
    const bool are_one = all_join(s, g);
    vec tangent = {0.0f, 0.0f, 0.0f};
    for (uint32_t i = 0; i < g->count; i++) {
        const uint32_t at = s->members[g->first + i];
        if (i == 0 || !are_one) {
            const uint32_t count = choose_joining(s, g, at);
            qsort(s->joining, count, sizeof *s->joining, by_number);
            tangent = weighted_tangent(s, g, count);
        }
        const uint32_t number = number_of_corner(&s->triangles[at], g->corner);
        put_tangent(tangents[3 * (size_t)at + number], tangent, g->keeps_orientation);
    }
}

/* A triangle without area has its corners' tangents from triangles that share them. */
static tl_status lend_tangents(const space *s, float (*tangents)[4], tl_error *err)
{
    const size_t count = 3 * s->of->triangle_count;
    uint32_t *lenders = malloc(count * sizeof *lenders); /* by welded corner */
    if (!lenders)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
    for (size_t i = 0; i < count; i++)
        lenders[i] = NONE;
    for (uint32_t i = 0; i < count; i++) {
        const triangle *t = &s->triangles[i / 3];
        if (!t->is_degenerate && lenders[t->corners[i % 3]] == NONE)
            lenders[t->corners[i % 3]] = i;
    }
    for (uint32_t i = 0; i < count; i++) {
        const triangle *t = &s->triangles[i / 3];
        if (t->is_degenerate && lenders[t->corners[i % 3]] != NONE)
            memcpy(tangents[i], tangents[lenders[t->corners[i % 3]]], sizeof tangents[i]);
    }
    free(lenders);
    return TL_OK;
}

static tl_status allocate(space *s, tl_error *err)
{
    const size_t count = s->of->triangle_count;
    s->triangles = calloc(count + 1, sizeof *s->triangles);
    s->groups = malloc((3 * count + 1) * sizeof *s->groups);
    s->members = malloc((3 * count + 1) * sizeof *s->members);
    s->waiting = malloc((9 * count + 1) * sizeof *s->waiting);
    s->joining = malloc((3 * count + 1) * sizeof *s->joining);
    if (!s->triangles || !s->groups || !s->members || !s->waiting || !s->joining)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for tangents");
    return TL_OK;
}

tl_status tl_tangent_space(const tl_corners *corners, float (*tangents)[4], tl_error *err)
{
    const vec default_tangent = {1.0f, 0.0f, 0.0f};
    tl_status status = TL_OK;
    space s = {.of = corners};

    for (size_t i = 0; i < 3 * corners->triangle_count; i++)
        put_tangent(tangents[i], default_tangent, false);
    TRY(allocate(&s, err));
    TRY(weld(&s, err));
    for (size_t i = 0; i < corners->triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            s.triangles[i].neighbours[k] = s.triangles[i].groups[k] = NONE;
        derive(&s, &s.triangles[i]);
    }
    TRY(find_neighbours(&s, err));
    find_groups(&s);
    for (uint32_t i = 0; i < s.group_count; i++)
        make_tangents(&s, &s.groups[i], tangents);
    TRY(lend_tangents(&s, tangents, err));
done:
    free(s.triangles);
    free(s.groups);
    free(s.members);
    free(s.waiting);
    free(s.joining);
    return status;
}
