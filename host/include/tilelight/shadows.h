/* Shadow maps: what the lights of a scene see of it. Capture makes them, a G-buffer owns them, files hold
 * them, lighting looks them up. kernels/shadow_code.h says what texels are, kernels/shadow.h what they are
 * for.
 *
 * A view is a camera of the light's (camera.h): square in texels, its rows from the top left. Of a spot it
 * looks along the axis, of a directional light along the rays; of a light that stands apart from all that
 * the camera sees, towards that; of other point lights, and of spots whose cone is too wide for one view,
 * there are six, along the axes of the world. */
#ifndef TL_SHADOWS_H
#define TL_SHADOWS_H

#include "camera.h"
#include "lights.h"
#include "shadow_code.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* X(name, word in files, views) */
#define TL_SHADOW_KINDS(X)                  \
    X(TL_SHADOW_SPOT, "spot", 1)            \
    X(TL_SHADOW_PARALLEL, "directional", 1) \
    X(TL_SHADOW_CUBE, "cube", TL_SHADOW_VIEWS)

enum {
    TL_SHADOW_VIEWS = 6, /* at most */
    TL_SHADOW_KIND_COUNT = 3,
    TL_LEAST_SHADOW_SIZE = 64, /* texels each way */
    TL_MOST_SHADOW_SIZE = 4096
};

extern const char *const tl_shadow_kind_words[TL_SHADOW_KIND_COUNT];
extern const uint32_t tl_shadow_view_counts[TL_SHADOW_KIND_COUNT];

typedef struct tl_shadow_map {
    uint32_t kind; /* TL_SHADOW_SPOT and its like */
    uint32_t size; /* texels each way, of each view */
    /* Whose it is: the light that has these, bit for bit; 0 where its type has none. */
    float position[3], direction[3];
    /* 1: of a spot's or a point light's, that its view is of what the camera sees, whatever its cone */
    uint32_t is_fitted;
    float slack; /* m: how far surfaces in it may lie off their places, by what drew them */
    tl_camera views[TL_SHADOW_VIEWS]; /* those that the kind has */
    /* [views][size][size][2], owned: depth as the bits of a float, then slopes */
    uint32_t *texels;
} tl_shadow_map;

/* All zero is none. */
typedef struct tl_shadow_maps {
    uint32_t count;
    tl_shadow_map *of; /* [count], owned */
} tl_shadow_maps;

uint32_t tl_shadow_view_count(const tl_shadow_map *map);

/* Bytes of all its texels. */
size_t tl_shadow_map_size(const tl_shadow_map *map);

/* Makes the views of a spot's or a cube's map, of its size, from its position: a spot's is up to half_angle
 * from the axis, of unit length, rad, at most TL_WIDEST_SHADOW_CONE; a cube asks for neither. The nearest
 * surfaces that it sees are `near` m away. */
void tl_shadow_views_from(tl_shadow_map *map,
                          const float axis[3],
                          double half_angle,
                          double near);

#define TL_DEFAULT_SHADOW_FILTER 2 /* texels: TL_MOST_SHADOW_FILTER at most */

#define TL_WIDEST_SHADOW_CONE 1.1f /* rad: beyond, six views cost fewer texels than one */

/* Makes the view of a parallel map, of its size, along its direction. It sees all that is in the box
 * receivers[2][3] and what casts shadows on it in the box casters[2][3]; both as least and largest
 * coordinates along the axes of tl_shadow_axes, m. */
void tl_shadow_view_along(tl_shadow_map *map,
                          const double receivers[2][3],
                          const double casters[2][3]);

/* Right, up and back of a view along a direction of unit length: rows of a rotation from world space. */
void tl_shadow_axes(const float direction[3], double rows[3][3]);

/* Appends one like `like`, with texels of its own that show nothing. Fails with TL_ERR_MEMORY. */
tl_status tl_shadow_maps_add(tl_shadow_maps *maps, const tl_shadow_map *like, tl_error *err);

/* *to, which has none, becomes a copy. Fails with TL_ERR_MEMORY. */
tl_status tl_shadow_maps_copy(const tl_shadow_maps *from, tl_shadow_maps *to, tl_error *err);

/* Leaves none. */
void tl_shadow_maps_clear(tl_shadow_maps *maps);

/* The map of this light, NULL where there is none. */
const tl_shadow_map *tl_shadow_map_of(const tl_shadow_maps *maps, const tl_light *light);

/* Fails with TL_ERR_ARGUMENT, saying which field: an unknown kind, a size beyond the limits above, views that
 * are no cameras of that size, depths outside [0, 1] or slopes that are no numbers. */
tl_status tl_shadow_map_check(const tl_shadow_map *map, tl_error *err);

/* The share of its texels that show something. */
double tl_shadow_coverage(const tl_shadow_map *map);

/* m, of a texel's width at `distance` m from the light along its view; the wider of both ways. */
double tl_shadow_texel_width(const tl_shadow_map *map, double distance);

#ifdef __cplusplus
}
#endif

#endif
