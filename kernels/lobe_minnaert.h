/* Minnaert, "The Reciprocity Principle in Lunar Photometry", Astrophysical Journal 93, 1941, times pi and
 * so that light from straight above is reflected whole:
 *
 *   diffuse = (k + 1)/2 (n.l)^k (n.v)^(k - 1)
 *
 * Of light that falls in under n.l, (n.l)^(k - 1) is reflected: all of it, or less, for k >= 1; for k < 1
 * more than all at grazing angles, as a model of moons at full phase has it. k = 1 is Lambert's. Towards
 * the eye's horizon it grows without bound for k < 1: n.v is not taken below 2^-10.
 *
 * As a power of two of k log2(n.l) + (k - 1) log2(n.v), which is 10 at most; not below 2^-54.
 *
 * Off: as n.l and n.v are (light.h), and by 2^d - 1 + 9u of itself, d of that sum s: 9.5u of either
 * logarithm (specular.h), 2u of the second's factor and product, 2u|s| + 10u for sum and shift. The power is
 * off by 7u, (k + 1)/2 and the product by u each. */
#ifndef TL_LOBE_MINNAERT_H
#define TL_LOBE_MINNAERT_H

#include "specular.h"
#include "surface.h"

#define TL_LEAST_COSINE R(0x1p-24)
#define TL_LEAST_EYE_COSINE R(0x1p-10)
#define TL_MOST_K R(10.0)

/* Of a cosine above 0. */
TL_INLINE real log2_of_cosine(real cosine)
{
    return log2_of_cos2(cosine, R(1.0));
}

TL_INLINE reflection minnaert_reflection(finish f, meeting m)
{
    const real away = ABSOLUTE(f.n_dot_v);
    const real eye = pick(away > TL_LEAST_EYE_COSINE, away, TL_LEAST_EYE_COSINE);
    const real light = pick(m.cosine > TL_LEAST_COSINE, m.cosine, TL_LEAST_COSINE);
    const real log2_of = FMA(f.k, log2_of_cosine(light), (f.k - R(1.0)) * log2_of_cosine(eye));
    const real power = exp2_of_negative(log2_of - R(10.0)) * R(0x1p10);
    const reflection r = {m.weight * (FMA(f.k, R(0.5), R(0.5)) * power), R(0.0), R(0.0)};
    return r;
}

#endif
