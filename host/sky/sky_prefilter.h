/* A sky as surfaces of each roughness mirror it. */
#ifndef TL_SKY_PREFILTER_H
#define TL_SKY_PREFILTER_H

#include "sky_tree.h"

/* Side of a level's octahedral map, texels, borders left out. most: of the finest, a power of 2. */
uint32_t tl_sky_level_size(unsigned level, uint32_t most);

/* alpha of a level. */
double tl_sky_level_alpha(unsigned level);

/* Texels of all levels, borders included, and where level `level` begins. */
size_t tl_sky_level_start(unsigned level, uint32_t most);

/* A level is, in every direction, the mean radiance of the sky about it, weighed by
 *
 *     K(c) = max(0, c) / (1 - c + alpha^2 (1 + c))^2,   c the cosine of the angle from it,
 *
 * which is D n.l of metal-rough with n = v = the direction, up to a constant: Karis, "Real Shading in Unreal
 * Engine 4", SIGGRAPH 2013, his sum over samples as the integral it stands for.
 *
 * All levels: [tl_sky_level_start(TL_SKY_LEVELS)][4], R, G, B, 0, as kernels/sky_light.h reads them. On all
 * threads; the bits do not depend on how many. */
void tl_sky_prefilter(const tl_sky_tree *tree, uint32_t most, float (*texels)[4]);

#endif
