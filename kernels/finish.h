/* What models take of a surface beside its colours, once for all lights. */
#ifndef TL_FINISH_H
#define TL_FINISH_H

#include "lobe_metal_rough.h"
#include "substance.h"
#include "surface.h"

/* F90: lobe_metal_rough.h. */
TL_INLINE real grazing_reflectance(vec3 specular)
{
    return at_most_one(R(50.0) * largest(specular));
}

/* The axis along which Ward's lobe is narrow, times sqrt(1/sharp^2 - 1/wide^2); 0 where the lobe is round,
 * or its direction that of the normal. */
TL_INLINE vec3 sharp_axis(surface s, substance m)
{
    const real off = dot3(s.normal, m.along);
    const vec3 tangent = unit3(fma3(s.normal, -off, m.along));
    const vec3 n = s.normal;
    const vec3 across = {FMA(n.y, tangent.z, -(n.z * tangent.y)),
                         FMA(n.z, tangent.x, -(n.x * tangent.z)),
                         FMA(n.x, tangent.y, -(n.y * tangent.x))};
    const real steep = R(1.0) / m.alpha2 - R(1.0) / m.across2;
    const vec3 axis = pick3(steep > R(0.0), tangent, across);
    const real by = SQRT(ABSOLUTE(steep));
    const vec3 sharp = {axis.x * by, axis.y * by, axis.z * by};
    return sharp;
}

TL_INLINE finish finish_of(tl_needs needs, surface s, substance m)
{
    finish f;
    f.at = 0; /* the caller's to say */
    f.model = m.model;
    f.n_dot_v = a_cosine(dot3(s.normal, s.to_eye));
    f.alpha2 = m.alpha2;
    f.half_alpha2 = R(0.5) * m.alpha2;
    f.masking = smith_root(m.alpha2, f.n_dot_v);
    f.f90 = grazing_reflectance(m.specular);
    const real sigma2 = SQRT(m.alpha2);
    f.flat = R(1.0) - R(0.5) * sigma2 / (sigma2 + R(0.33));
    f.bent = R(0.45) * sigma2 / (sigma2 + R(0.09));
    f.k = m.k;
    f.per_wide2 = R(1.0) / m.alpha2;
    f.per_area = R(0.25) * f.per_wide2;
    f.sharp.x = f.sharp.y = f.sharp.z = R(0.0);
    if (some_lobe_has(needs, TL_LOBE_TANGENT)) {
        const mask is = lane_has(needs, m.model, TL_LOBE_TANGENT);
        const vec3 sharp = sharp_axis(s, m);
        const real wide2 = pick(m.alpha2 > m.across2, m.alpha2, m.across2);
        f.sharp = pick3(is, sharp, f.sharp);
        f.per_wide2 = pick(is, R(1.0) / wide2, f.per_wide2);
        f.per_area = pick(is, R(0.25) / SQRT(m.alpha2 * m.across2), f.per_area);
    }
    return f;
}

#endif
