/* How light fades with distance and off the axis of a cone, by the words of docs/conventions.md ("Units",
 * "Textures of lights, and skies"). Nothing is shared with kernels/falloff.h and spot.h.
 *
 * Off by 8v of the terms they add, v = 2^-113; by 10v beside for the cone's angle, whose cosine is taken. */
#ifndef TL_ORACLE_FALLOFFS_H
#define TL_ORACLE_FALLOFFS_H

#include "oracle/vectors.h"

/* Distances and ranges in m; 0 at the range and beyond. begin: 0 and above, not above the range; where it is
 * the range, 1 before it. */
wide tl_oracle_linear(wide distance, wide begin, wide range);

/* 1/m^2. An infinite range fades nothing. */
wide tl_oracle_inverse_square(wide distance, wide range);

/* values: [count], evenly spaced from distance 0 to the range. */
wide tl_oracle_table(wide distance, wide range, const float *values, size_t count);

/* Of a spot that shines along `axis`, seen from it in direction `way`; both of any length but 0. Half-angles
 * are those of lights (tl_oracle_half_angle). *below_square becomes the share before it is squared. */
wide tl_oracle_cone(wide3 axis, wide3 way, float inner, float outer, wide *below_square);

/* Of the largest share of a cosine: 1 over what the edge is wide. */
wide tl_oracle_cone_steepness(float inner, float outer);

/* Turns from ahead, towards what is right, -1/2 to 1/2, of a direction with these parts. */
wide tl_oracle_longitude(wide right, wide ahead);

#endif
