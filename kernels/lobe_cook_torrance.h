/* Cook and Torrance, "A Reflectance Model for Computer Graphics", ACM Transactions on Graphics 1(1), 1982,
 * times pi:
 *
 *   specular = F D G / (4 n.v),  diffuse = n.l
 *
 *   D = exp(-tan^2 / m^2) / (m^2 cos^4)               Beckmann's distribution, there on page 13; m = alpha
 *   G = min(1, 2 n.h n.v / v.h, 2 n.h n.l / v.h)      page 12
 *
 * The paper divides by pi n.l n.v, which reflects more than arrives; with 4 in place of pi D is a
 * distribution of facets (Walter et al., EGSR 2007, equations 20 and 25). F is Schlick's, with F90 as
 * lobe_metal_rough.h has it, for the paper's needs an index of refraction, of which a material has only the
 * reflectance at normal incidence.
 *
 * With h the sum of the unit vectors, 2 n.h / v.h = 4 n.h / |h|^2.
 *
 * Off, by the letters of halfway.h: D cos^4 as gaussian_slopes is, its exponent by u more for alpha^2; G,
 * where it is below 1, by n.h's turn, 3u of 1 for its sum, and stretch + 10.5u of itself: length of n 4.5u,
 * |h|^2 3u, quotient and two products; n.l and n.v as light.h has it; and 4u of itself for the products and
 * the quotient of all. */
#ifndef TL_LOBE_COOK_TORRANCE_H
#define TL_LOBE_COOK_TORRANCE_H

#include "halfway.h"

#define TL_LEAST_FACING R(0x1p-20)

TL_INLINE real lesser(real a, real b)
{
    return pick(a < b, a, b);
}

TL_INLINE reflection cook_torrance_reflection(surface s, finish f, meeting m)
{
    const halfway a = halfway_of(s, m);
    const real away = ABSOLUTE(f.n_dot_v);
    const real eye = pick(away > TL_LEAST_FACING, away, TL_LEAST_FACING);
    const real per_length2 = R(1.0) / a.length2;
    const real cos2 = cos2_of(a, per_length2), sin2 = sin2_of(a, per_length2);
    const real valley = R(4.0) * a.n_dot_h * per_length2;
    const real masked = at_most_one(valley * lesser(eye, m.cosine));
    const real facets = gaussian_slopes(cos2, sin2 / f.alpha2) / (f.alpha2 * (R(4.0) * eye));
    reflection r = {m.arriving, pick(a.above, m.weight * (facets * masked), R(0.0)), R(0.0)};
    r.grazing = r.specular * schlick_weight(a);
    return r;
}

#endif
