/* The plain models: diffuse light is n.l (Lambert), a specular lobe is Blinn's power of n.h
 * (specular.h), under n.l where the model says so. In frames that have one of them alone, light.h does
 * the same by shorter code, to the same bits.
 *
 * Diffuse light is off as n.l is (light.h), under n.l: off l and u of itself. The lobe: specular.h's power,
 * of h turned to n by (3.5t + 2/|h| + 2) u, t the tangent between v and h, |h| of unit vectors: |l| v is off
 * by 2.5u + 4.5u in length, half of which is across h at most; turns of l and v, its sum, n. */
#ifndef TL_LOBE_PLAIN_H
#define TL_LOBE_PLAIN_H

#include "specular.h"
#include "surface.h"

/* The half vector is taken |l| times as long as usual, l + |l| v, so that it does not wait for the
 * division. */
TL_INLINE half_angle highlight_angle(surface s, vec3 l, real length)
{
    return angle_of(s.normal, fma3(s.to_eye, length, l));
}

/* under_cosine: lanes whose lobe is multiplied by n.l. */
TL_INLINE reflection
plain_reflection(tl_needs needs, surface s, meeting m, mask has_specular, mask under_cosine)
{
    reflection r = {m.arriving, R(0.0), R(0.0)};
    if (needs.specular && any_lane(has_specular)) {
        const half_angle a = highlight_angle(s, m.l, m.length);
        const real seen = pick(under_cosine, m.arriving, m.weight);
        const real shine = pick(a.above & has_specular, seen, R(0.0));
        r.specular = shine * power_of_log2(log2_of_power(a.cos2, a.sin2, s.shininess));
    }
    return r;
}

#endif
