/* Oren and Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, equation 30, the
 * qualitative model, times pi:
 *
 *   diffuse = n.l (A + B max(0, cos(phi)) sin(a) tan(b)),  a the larger of the angles of light and eye to n,
 *   A = 1 - 0.5 sigma^2/(sigma^2 + 0.33),  B = 0.45 sigma^2/(sigma^2 + 0.09)   b the smaller
 *
 * Without angles: sines and cosine of phi multiply to l.v - n.l n.v, and the tangent divides by the larger
 * of n.l and n.v. sigma, the facets' deviation in radians, is the roughness as artists see it, so that
 * sigma^2 is alpha. Where the normal is turned from the eye, n.v counts as 0.
 *
 * Off: A by 2.5u, B by 6u of itself, each constant and step rounding once; l.v by 3u sum |l_i v_i| + 9u l.v +
 * 2u; n.l and n.v as light.h has it, in the product, the quotient and the sum, and u of the difference. The
 * quotient, cut at 1, rounds once, and so do three products and the sum. */
#ifndef TL_LOBE_OREN_NAYAR_H
#define TL_LOBE_OREN_NAYAR_H

#include "halfway.h"

TL_INLINE reflection oren_nayar_reflection(surface s, finish f, meeting m)
{
    const real eye = pick(f.n_dot_v > R(0.0), f.n_dot_v, R(0.0));
    const real together = FMA(-m.cosine, eye, dot3(m.l, s.to_eye) * m.per_length);
    const real ahead = at_most_one(pick(together > R(0.0), together, R(0.0)));
    const real larger = pick(eye > m.cosine, eye, m.cosine);
    const real share = pick(m.cosine > R(0.0), m.cosine / larger, R(0.0)); /* 1 at most */
    const real bent = m.weight * (f.bent * ahead * share);
    const reflection r = {FMA(m.arriving, f.flat, bent), R(0.0), R(0.0)};
    return r;
}

#endif
