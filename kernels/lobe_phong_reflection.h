/* Phong, "Illumination for Computer Generated Pictures", Communications of the ACM 18(6), 1975:
 *
 *   specular = (R.v)^e,  R = 2 (n.l) n - l the mirrored light,  diffuse = n.l
 *
 * 0 where R.v <= 0 or n.l <= 0. The power is specular.h's, of the angle between R, which is as long as l,
 * and v; both its forms are there, so an exponent of 10000 costs no digits.
 *
 * R is turned to v by (6 sum |n_i l_i| + 18 n.l + 5) u at most: twice the sum of n.l; twice n's length in
 * n.l and in the product, 4.5u each; the turn of n twice, those of l and v, and the rounding of its parts. A
 * turn by d is at most sqrt(e) d of the power (specular.h), so 29 sqrt(e) u, and 40u. */
#ifndef TL_LOBE_PHONG_REFLECTION_H
#define TL_LOBE_PHONG_REFLECTION_H

#include "specular.h"
#include "surface.h"

TL_INLINE reflection phong_reflection(tl_needs needs, surface s, meeting m)
{
    reflection r = {m.arriving, R(0.0), R(0.0)};
    if (needs.specular) {
        const real twice = R(2.0) * dot3(s.normal, m.l);
        const vec3 mirrored = {FMA(s.normal.x, twice, -m.l.x), FMA(s.normal.y, twice, -m.l.y),
                               FMA(s.normal.z, twice, -m.l.z)};
        const half_angle a = angle_of(s.to_eye, mirrored);
        r.specular = pick(a.above, m.weight, R(0.0)) *
                     power_of_log2(log2_of_power(a.cos2, a.sin2, s.shininess));
    }
    return r;
}

#endif
