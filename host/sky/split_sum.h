/* What of light that comes from everywhere alike a metal-rough surface reflects: the second half of Karis's
 * split sum ("Real Shading in Unreal Engine 4", SIGGRAPH 2013), for the lobes of
 * kernels/lobe_metal_rough.h. */
#ifndef TL_SPLIT_SUM_H
#define TL_SPLIT_SUM_H

/* Integrals over the hemisphere, n.v above 0. */
typedef struct tl_split_sum {
    double base, grazing; /* the specular lobe reflects F0 base + (F90 - F0) grazing of it */
    double lost;          /* of diffuse light, F90 times this does not get below the surface */
} tl_split_sum;

/* By quadrature in double; off by 3e-4 at most (tests/test_sky_light.c). */
tl_split_sum tl_split_sum_at(double n_dot_v, double alpha);

/* [TL_SKY_TABLE][TL_SKY_TABLE] rows of roughness, columns of n.v, as kernels/sky_light.h reads them: base,
 * grazing, lost, 0. Computed once in a process, on all threads. */
const float (*tl_split_sum_table(void))[4];

#endif
