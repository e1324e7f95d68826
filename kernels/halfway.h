/* Light, eye and the vector halfway between them, as microfacet models take them.
 *
 * What h is off by, beside light.h's l, v and n; u = 2^-24, and t the tangent of the angle between v and h:
 *
 *   turn     (4t + 2/|h| + 2) u, its angle to n: l and v are off in length by 3.5u and 4.5u, of which half
 *            the difference, at most, is across h, and counts t times; their turns count 1/|h| each; its own
 *            sum, and n, u each. Where v and l are so nearly opposite that this is no small angle, nothing
 *            is known of h.
 *   stretch  (5 + t) u of |h|: half of what the lengths are off together, turns, sum
 *   cos^2    that of an angle off by turn; n.h by 3u|h| for its sum; 15u of itself: lengths of n and h 9u and
 *            4u, square, product
 *   sin^2    the same; 10u of itself + 146u^2 (specular.h)
 *   v.h      stretch + 2.5u of itself; so (1 - v.h)^5 is that of a sum that is off so much, and 9u of it */
#ifndef TL_HALFWAY_H
#define TL_HALFWAY_H

#include "specular.h"
#include "surface.h"

/* h is the sum of the unit vectors. Squares of cosine and sine of the angle between n and h are those of
 * specular.h; both stay finite where h vanishes, where `above` says that there is no lobe. */
typedef struct halfway {
    vec3 across; /* the part of h across n */
    real n_dot_h;
    real length2; /* |h|^2: four times the square of v.h, of unit vectors */
    mask above; /* h is above the surface, in lanes that are lit: in others h may be infinite */
} halfway;

TL_INLINE real at_most_one(real v)
{
    return pick(v < R(1.0), v, R(1.0)); /* of NaN too */
}

/* What is no number comes of a point too near to the eye to have a direction to it. */
TL_INLINE real a_cosine(real v)
{
    const real most = at_most_one(v);
    return pick(most > R(-1.0), most, R(-1.0));
}

TL_INLINE halfway halfway_of(surface s, meeting m)
{
    const vec3 h = fma3(m.l, m.per_length, s.to_eye);
    halfway a;
    a.length2 = dot3(h, h);
    a.n_dot_h = dot3(s.normal, h);
    a.across = fma3(s.normal, -a.n_dot_h, h);
    a.above = (a.n_dot_h > R(0.0)) & (m.weight > R(0.0));
    return a;
}

/* Between n and h: 0 to 1. */
TL_INLINE real cos2_of(halfway a, real per_length2)
{
    return at_most_one(a.n_dot_h * a.n_dot_h * per_length2);
}

TL_INLINE real sin2_of(halfway a, real per_length2)
{
    return at_most_one(dot3(a.across, a.across) * per_length2);
}

/* The square of v.h, of unit vectors. */
TL_INLINE real eye2_of(halfway a)
{
    return at_most_one(R(0.25) * a.length2);
}

/* (1 - v.h)^5: Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Computer Graphics Forum
 * 13(3), 1994, equation 15. */
TL_INLINE real schlick_weight(halfway a)
{
    const real away = R(1.0) - SQRT(eye2_of(a));
    const real away2 = away * away;
    return away2 * away2 * away;
}

/* exp(-x) by specular.h's power of two; 0 beyond 2^-64, so that what it is divided by is bounded where it
 * counts. Off by 7u of itself and 1.5u x: the product rounds, and the constant. */
TL_INLINE real exp_of_negative(real x)
{
    const real log2_of = x * R(-1.4426950408889634);
    return pick(log2_of > R(-64.0), exp2_of_negative(log2_of), R(0.0));
}

/* exp(-tan^2/alpha^2) / cos^4, tan the tangent between n and h: what Beckmann's and Ward's distributions
 * have in common. slope2: tan^2/alpha^2 times cos^2. cos^2 is above 1/45 where the power is not 0, alpha
 * being 1 at most; it is kept above 0 elsewhere. Off by what both are, by 2.5u of the exponent for quotient
 * and power, and by 9u of itself: power, square, quotient. Beyond 2^-64 of the exponential: 0. */
TL_INLINE real gaussian_slopes(real cos2, real slope2)
{
    const real bounded = pick(cos2 > R(0x1p-20), cos2, R(0x1p-20));
    return exp_of_negative(slope2 / bounded) / (bounded * bounded);
}

#endif
