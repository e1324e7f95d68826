#include "tilelight/shadows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const tl_shadow_kind_words[TL_SHADOW_KIND_COUNT] = {
#define WORD(name, word, views) [name] = word,
    TL_SHADOW_KINDS(WORD)
#undef WORD
};

const uint32_t tl_shadow_view_counts[TL_SHADOW_KIND_COUNT] = {
#define VIEWS(name, word, views) [name] = views,
    TL_SHADOW_KINDS(VIEWS)
#undef VIEWS
};

uint32_t tl_shadow_view_count(const tl_shadow_map *map)
{
    return tl_shadow_view_counts[map->kind];
}

static size_t texel_count(const tl_shadow_map *map)
{
    return (size_t)tl_shadow_view_count(map) * map->size * map->size;
}

size_t tl_shadow_map_size(const tl_shadow_map *map)
{
    return texel_count(map) * 2 * sizeof *map->texels;
}

/* --- views ----------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void scale_to_one(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* Up is that of the world, or where the direction is vertical, -z. */
void tl_shadow_axes(const float direction[3], double rows[3][3])
{
    static const double least_sine = 1e-4;
    static const double world_up[3] = {0.0, 1.0, 0.0}, forward[3] = {0.0, 0.0, -1.0};
    for (int i = 0; i < 3; i++)
        rows[2][i] = -(double)direction[i];
    scale_to_one(rows[2]);
    cross(world_up, rows[2], rows[0]);
    if (dot(rows[0], rows[0]) < least_sine * least_sine)
        cross(forward, rows[2], rows[0]);
    scale_to_one(rows[0]);
    cross(rows[2], rows[0], rows[1]);
}

/* Right, up and back of view `index` of a cube: seen_from_side of kernels/shadow.h, whose down is up here. */
static void cube_axes(uint32_t index, double rows[3][3])
{
    const unsigned axis = index / 2;
    const double sign = index % 2 == 0 ? 1.0 : -1.0;
    memset(rows, 0, 9 * sizeof rows[0][0]);
    rows[0][(axis + 1) % 3] = 1.0;
    rows[1][(axis + 2) % 3] = -sign;
    rows[2][axis] = -sign;
}

/* The camera whose rotation these rows are, and which stands at `eye`. */
static void stand_at(const double rows[3][3], const double eye[3], tl_camera *camera)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            camera->view_from_world[i][j] = (float)rows[i][j];
        camera->view_from_world[i][3] = (float)-dot(rows[i], eye);
    }
}

/* Texels of a view that are not its border, as a share of all. */
static double inner_share(uint32_t size)
{
    return 1.0 - 2.0 * TL_SHADOW_BORDER / (double)size;
}

void tl_shadow_views_from(tl_shadow_map *map,
                          const float axis[3],
                          double half_angle,
                          double near)
{
    const double half_view = map->kind == TL_SHADOW_CUBE ? 1.0 : tan(half_angle);
    const double edge = half_view / inner_share(map->size);
    const double eye[3] = {(double)map->position[0], (double)map->position[1],
                           (double)map->position[2]};
    for (uint32_t i = 0; i < tl_shadow_view_count(map); i++) {
        double rows[3][3];
        tl_camera *view = &map->views[i];
        *view = (tl_camera){.projection = TL_PERSPECTIVE,
                            .width = map->size,
                            .height = map->size,
                            .near = (float)near,
                            .far = INFINITY};
        tl_camera_center(view, edge, edge);
        if (map->kind == TL_SHADOW_CUBE)
            cube_axes(i, rows);
        else
            tl_shadow_axes(axis, rows);
        stand_at((const double(*)[3])rows, eye, view);
    }
}

void tl_shadow_view_along(tl_shadow_map *map,
                          const double receivers[2][3],
                          const double casters[2][3])
{
    tl_camera *view = &map->views[0];
    double rows[3][3], eye[3] = {0.0, 0.0, 0.0}, half[2];
    tl_shadow_axes(map->direction, rows);
    for (int i = 0; i < 3; i++) /* in the middle, where coordinates are small */
        for (int j = 0; j < 3; j++)
            eye[j] += 0.5 * (receivers[0][i] + receivers[1][i]) * rows[i][j];
    const double middle = 0.5 * (receivers[0][2] + receivers[1][2]);
    const double depth = receivers[1][2] - receivers[0][2];
    const double nearest = fmax(casters[1][2], receivers[1][2]) - middle;
    const double whole = nearest + 0.5 * depth;
    const double room = 1e-3 * whole + 1e-6; /* so that nothing is on the planes themselves */
    for (int i = 0; i < 2; i++)
        half[i] = fmax(0.5 * (receivers[1][i] - receivers[0][i]), 1e-3 * whole + 1e-6) /
                  inner_share(map->size);
    *view = (tl_camera){.projection = TL_ORTHOGRAPHIC,
                        .width = map->size,
                        .height = map->size,
                        .near = (float)(-nearest - room),
                        .far = (float)(0.5 * depth + room)};
    tl_camera_center(view, half[0], half[1]);
    stand_at((const double(*)[3])rows, eye, view);
}

double tl_shadow_texel_width(const tl_shadow_map *map, double distance)
{
    const tl_camera *view = &map->views[0];
    const double across = (double)view->right - (double)view->left,
                 down = (double)view->top - (double)view->bottom;
    const double width = fmax(across, down) / map->size;
    return view->projection == TL_PERSPECTIVE ? width * distance : width;
}

double tl_shadow_coverage(const tl_shadow_map *map)
{
    size_t shown = 0;
    for (size_t i = 0; i < texel_count(map); i++)
        shown += map->texels[2 * i] != 0;
    return (double)shown / (double)texel_count(map);
}

/* --- lists of maps --------------------------------------------------------------------------------- */

tl_status tl_shadow_maps_add(tl_shadow_maps *maps, const tl_shadow_map *like, tl_error *err)
{
    uint32_t *texels = calloc(texel_count(like), 2 * sizeof *texels);
    tl_shadow_map *grown = texels ? realloc(maps->of, (maps->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(texels);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a shadow map of %u x %u texels",
                       like->size, like->size);
    }
    maps->of = grown;
    grown[maps->count] = *like;
    grown[maps->count++].texels = texels;
    return TL_OK;
}

tl_status tl_shadow_maps_copy(const tl_shadow_maps *from, tl_shadow_maps *to, tl_error *err)
{
    for (uint32_t i = 0; i < from->count; i++) {
        const tl_shadow_map *map = &from->of[i];
        const tl_status status = tl_shadow_maps_add(to, map, err);
        if (status != TL_OK)
            return status;
        memcpy(to->of[i].texels, map->texels, tl_shadow_map_size(map));
    }
    return TL_OK;
}

void tl_shadow_maps_clear(tl_shadow_maps *maps)
{
    for (uint32_t i = 0; i < maps->count; i++)
        free(maps->of[i].texels);
    free(maps->of);
    *maps = (tl_shadow_maps){0};
}

/* Of each type of light: the kinds that its maps may be, and what of a light they are known by. */
static const struct {
    uint32_t kinds; /* bits 1 << kind */
    bool has_position, has_direction;
} traits[TL_LIGHT_TYPE_COUNT] = {
    [TL_LIGHT_POINT] = {1u << TL_SHADOW_SPOT | 1u << TL_SHADOW_CUBE, true, false},
    [TL_LIGHT_DIRECTIONAL] = {1u << TL_SHADOW_PARALLEL, false, true},
    [TL_LIGHT_SPOT] = {1u << TL_SHADOW_SPOT | 1u << TL_SHADOW_CUBE, true, true},
};

static bool is_seen_by(const tl_shadow_map *map, const tl_light *light)
{
    if (!(traits[light->type].kinds >> map->kind & 1u))
        return false;
    if (traits[light->type].has_position &&
        memcmp(map->position, light->position, sizeof map->position) != 0)
        return false;
    /* All around, where it looks is of no matter. */
    if (map->kind == TL_SHADOW_CUBE || !traits[light->type].has_direction)
        return map->kind != TL_SHADOW_SPOT || map->is_fitted;
    if (memcmp(map->direction, light->direction, sizeof map->direction) != 0)
        return false;
    /* A cone may have become wider than what was drawn, unless that is all that the camera sees. */
    return map->kind != TL_SHADOW_SPOT || map->is_fitted ||
           (light->outer_cone <= TL_WIDEST_SHADOW_CONE &&
            tan((double)light->outer_cone) <=
                (double)map->views[0].right * inner_share(map->size) * (1.0 + 1e-6));
}

const tl_shadow_map *tl_shadow_map_of(const tl_shadow_maps *maps, const tl_light *light)
{
    for (uint32_t i = 0; i < maps->count; i++)
        if (is_seen_by(&maps->of[i], light))
            return &maps->of[i];
    return NULL;
}

/* --- checking -------------------------------------------------------------------------------------- */

/* Of a half: all bits of its exponent are set. */
static bool is_no_number(uint32_t half)
{
    return (half & 0x7c00u) == 0x7c00u;
}

static tl_status check_texels(const tl_shadow_map *map, tl_error *err)
{
    for (size_t i = 0; i < texel_count(map); i++) {
        const uint32_t slopes = map->texels[2 * i + 1];
        float depth;
        memcpy(&depth, &map->texels[2 * i], sizeof depth);
        if (!(depth >= 0.0f && depth <= 1.0f))
            return tl_fail(err, TL_ERR_ARGUMENT,
                           "texel %zu has the depth %g, which is not from 0 to 1", i,
                           (double)depth);
        if (is_no_number(slopes) || is_no_number(slopes >> 16))
            return tl_fail(err, TL_ERR_ARGUMENT, "texel %zu has a slope that is no number", i);
    }
    return TL_OK;
}

static tl_status check_view(const tl_shadow_map *map, uint32_t index, tl_error *err)
{
    const tl_camera *view = &map->views[index];
    const bool is_parallel = map->kind == TL_SHADOW_PARALLEL;
    const tl_status status = tl_camera_check(view, err);
    if (status != TL_OK)
        return status;
    if (view->width != map->size || view->height != map->size)
        return tl_fail(err, TL_ERR_ARGUMENT, "view %u is %u x %u texels, and not %u x %u",
                       index, view->width, view->height, map->size, map->size);
    if ((view->projection == TL_ORTHOGRAPHIC) != is_parallel || isinf(view->far) == is_parallel)
        return tl_fail(err, TL_ERR_ARGUMENT, "view %u has a projection that %s maps have not",
                       index, tl_shadow_kind_words[map->kind]);
    return TL_OK;
}

tl_status tl_shadow_map_check(const tl_shadow_map *map, tl_error *err)
{
    if (map->kind >= TL_SHADOW_KIND_COUNT)
        return tl_fail(err, TL_ERR_ARGUMENT, "%u is no kind of shadow map", map->kind);
    if (map->size < TL_LEAST_SHADOW_SIZE || map->size > TL_MOST_SHADOW_SIZE)
        return tl_fail(err, TL_ERR_ARGUMENT, "%u texels each way: %d to %d are possible",
                       map->size, TL_LEAST_SHADOW_SIZE, TL_MOST_SHADOW_SIZE);
    if (!(map->slack >= 0.0f && map->slack <= 1e18f))
        return tl_fail(err, TL_ERR_ARGUMENT, "its slack is %g m, which is not from 0 to 1e18",
                       (double)map->slack);
    for (uint32_t i = 0; i < tl_shadow_view_count(map); i++) {
        const tl_status status = check_view(map, i, err);
        if (status != TL_OK)
            return status;
    }
    return check_texels(map, err);
}
