/* Shadow maps: what a light sees of a scene, as kernels take it and as capture makes it.
 *
 * A map has texels of 8 bytes: the depth of the nearest surface at the texel's centre, and how that changes
 * from texel to texel (the surface's slope). Depth is 1 nearest to the light and falls away from it; 0 is
 * nothing at all. A plane's depth is affine over the map, in both kinds:
 *
 *   perspective  near/w, w metres ahead of the light. A float's rounding, u = 2^-24 of it, is u of the
 *                distance w everywhere, whatever near is: so near can be as small as need be. Stored as
 *                1 - near/w, as depth buffers used to be, the same rounding is u w^2/near.
 *   parallel     (far - w)/(far - near). Off by u/2 of the whole depth of the map at most, and as fine as a
 *                float far away. The other way round it would be as coarse where it is read most.
 *
 * Slopes are two halves: right in the lower bits, down in the upper, per texel, times TL_SLOPE_SCALE; in
 * perspective as shares of the texel's own depth, so that none is too small for a half: one of 2^-24 is
 * 2^-34 of the depth. */
#ifndef TL_SHADOW_CODE_H
#define TL_SHADOW_CODE_H

/* What one light's map is: values of tl_view_shadow.kind, and in GLSL. */
#define TL_SHADOW_SPOT 0     /* one perspective view */
#define TL_SHADOW_PARALLEL 1 /* one orthographic view */
#define TL_SHADOW_CUBE 2     /* six perspective views, along the axes of the world */

#define TL_SLOPE_SCALE 1024

/* Texels that a surface is moved towards the light before it is looked up, for what folds within a texel. */
#define TL_SHADOW_OFFSET 1.0

/* Texels at each side of a view beyond what it is for, so that a filter finds all it needs in one view: the
 * widest filter, half, and one texel. */
#define TL_SHADOW_BORDER 8
#define TL_MOST_SHADOW_FILTER 13 /* texels */

#endif
