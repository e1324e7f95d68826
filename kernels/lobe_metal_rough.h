/* Metal-rough: glTF 2.0 specification, appendix B, times pi.
 *
 *   D = alpha^2 / ((n.h)^2 (alpha^2 - 1) + 1)^2 / pi         Trowbridge and Reitz; "GGX" of Walter et al.,
 *                                                            EGSR 2007, equation 33
 *   V = 1/2 / (n.l sqrt(alpha^2 + (1 - alpha^2)(n.v)^2) + n.v sqrt(alpha^2 + (1 - alpha^2)(n.l)^2))
 *   F = F0 + (F90 - F0)(1 - v.h)^5                           Schlick 1994
 *
 *   specular = pi F D V n.l,  diffuse = n.l (1 - F90 (1 - v.h)^5)
 *
 * V is Smith's with masking and shadowing correlated by height: Heitz, "Understanding the Masking-Shadowing
 * Function in Microfacet-Based BRDFs", JCGT 3(2), 2014, equation 99 over 4 n.l n.v. The appendix writes the
 * product of the two apart, and leaves the choice; this one is nearer to the surface that the distribution
 * describes, and costs the same.
 *
 * In D the denominator is taken as alpha^2 cos^2 + sin^2 (specular.h): a sum, so that it is as accurate at
 * the peak of a mirror, where the form above cancels, and both are left times |h|^2, so that D and V take one
 * quotient.
 *
 * Off, by the letters of halfway.h: w = alpha^2 cos^2 + sin^2 is that of an angle off by turn, and for exact
 * h by alpha^2 (6 cos + 10 cos^2) u + 5u sin^2 + 146u^2 + uw, which is 17u + 146u^2/alpha^2 of itself; it
 * counts twice. n.l over V's denominator grows with n.l and falls with n.v: of cosines as light.h has it, and
 * 4.5u of itself: roots 2.5u each, product, sum. Beside that 12u: |h|^2 twice, 3u each; five products and a
 * quotient. Diffuse light: n.l, F90 by u, and 2u.
 *
 * F90 is 1 from F0 = 0.02 on and falls to 0 with F0, for no substance reflects less, but a material may
 * (Lagarde and de Rousiers, "Moving Frostbite to PBR", SIGGRAPH 2014, section 3.1.3): so a surface without a
 * specular colour has no highlights at grazing angles either, and an unlit one reflects nothing. */
#ifndef TL_LOBE_METAL_ROUGH_H
#define TL_LOBE_METAL_ROUGH_H

#include "halfway.h"

#define TL_LEAST_MASKED R(1e-12)
#define TL_LEAST_SPREAD \
    R(0x1p-33) /* |h| is less than 2^-10 there: v and l 0.06 degrees from opposite */

/* sqrt(alpha^2 + (1 - alpha^2) cos^2) */
TL_INLINE real smith_root(real alpha2, real cosine)
{
    return SQRT(FMA(R(1.0) - alpha2, cosine * cosine, alpha2));
}

TL_INLINE reflection metal_rough_reflection(tl_needs needs, surface s, finish f, meeting m)
{
    const halfway a = halfway_of(s, m);
    const real graze = schlick_weight(a);
    reflection r = {m.arriving * FMA(-graze, f.f90, R(1.0)), R(0.0), R(0.0)};
    if (needs.specular) {
        const real eye = ABSOLUTE(f.n_dot_v);
        const real spread = FMA(f.alpha2, a.n_dot_h * a.n_dot_h, dot3(a.across, a.across));
        const real wide = pick(spread > TL_LEAST_SPREAD, spread, TL_LEAST_SPREAD);
        const real masked = FMA(m.cosine, f.masking, eye * smith_root(f.alpha2, m.cosine));
        const real bounded = pick(masked > TL_LEAST_MASKED, masked, TL_LEAST_MASKED);
        const real lobe = f.half_alpha2 * (a.length2 * a.length2) / (wide * wide * bounded);
        r.specular = pick(a.above, m.arriving * lobe, R(0.0));
        r.grazing = r.specular * graze;
    }
    return r;
}

#endif
