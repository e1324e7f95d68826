/* Integrals over a map of latitude and longitude by the words of docs/sky-light.md, in double: sums over fine
 * parts of every texel. Nothing is shared with host/sky/ and kernels/sky_light.h. Directions are right, up,
 * ahead. */
#ifndef TL_ORACLE_SKY_H
#define TL_ORACLE_SKY_H

/* A map of one channel: values [height][width], one radiance all over a texel; each is cut in parts x
 * parts. */
typedef struct tl_oracle_sky {
    int width, height, parts;
    const float *values;
} tl_oracle_sky;

/* Integral of L max(0, n.d) over pi. */
double tl_oracle_sky_irradiance(const tl_oracle_sky *sky, const double n[3]);

/* The part of that in the bands 0 to 2 of spherical harmonics, by the harmonics themselves and the clamped
 * cosine's coefficients (Ramamoorthi and Hanrahan 2001, equation 8), before it is cut at 0; *energy becomes
 * the sum of the squares of all that is in other bands. */
double tl_oracle_sky_nine(const tl_oracle_sky *sky, const double n[3], double *energy);

/* Mean of L by the weight D(h) n.l, D of Trowbridge and Reitz, where n, the eye and the mirrored direction
 * are one. */
double tl_oracle_sky_mirrored(const tl_oracle_sky *sky, const double n[3], double alpha);

/* What the metal-rough lobe reflects, glTF 2.0, appendix B, with Heitz's masking, where the sky is seen by n
 * and the eye in direction v. */
double tl_oracle_sky_reflected(const tl_oracle_sky *sky,
                               const double n[3],
                               const double v[3],
                               double alpha,
                               double f0,
                               double f90);

/* Of light that is 1 all around: what the lobe reflects with F0 = F90 = 1, and that times (1 - v.h)^5. By
 * adaptive cells of l, which are halved where D is steep. cosine: n.v, above 0. */
void tl_oracle_sky_shares(
    double cosine, double alpha, double *base, double *grazing, double *lost);

#endif
