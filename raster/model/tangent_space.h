/* Tangent space as normal maps are baked for it: M. S. Mikkelsen, "Simulation of Wrinkled Surfaces
 * Revisited" (2008), chapter 4, known as MikkTSpace, for triangles and an angular threshold of 180
 * degrees. glTF 2.0, section 3.7.2.1, asks for it where a mesh has none.
 *
 * A map that was baked with it is undone exactly only by the same tangents, so what decides is kept as
 * the thesis's own program has it: arithmetic in float, comparisons by value, groups in the order of
 * triangles. */
#ifndef TL_TANGENT_SPACE_H
#define TL_TANGENT_SPACE_H

#include "tilelight/error.h"

#include <stddef.h>

/* Triangles without sharing: corner c of triangle t is number 3 t + c. */
typedef struct tl_corners {
    size_t triangle_count;      /* at most 2^30 */
    const float (*position)[3]; /* [3 triangle_count] */
    const float (*normal)[3];   /* [3 triangle_count], unit */
    const float (*uv)[2];       /* [3 triangle_count], as glTF has them: v downwards */
} tl_corners;

/* tangents: [3 triangle_count], x, y, z unit, and w, 1 or -1: the bitangent is w cross(normal, tangent),
 * and goes against v (glTF 2.0, section 3.7.2.1). (1, 0, 0, 1) where neither a corner's triangle nor any
 * around it says anything. Fails with TL_ERR_MEMORY. */
tl_status tl_tangent_space(const tl_corners *corners, float (*tangents)[4], tl_error *err);

#endif
