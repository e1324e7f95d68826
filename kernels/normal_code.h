/* Unit vectors in two or three numbers.
 *
 *   xyz         the three components, each off by half a step: sqrt(3) of that in rad at most. Numbers of
 *               few bits cannot say 0, so what is shorter than 1/2 reads as no normal; a float of any
 *               length is a direction.
 *   octahedron  the octahedron |x| + |y| + |z| = 1, its lower half folded over its upper one: Meyer,
 *               Suessmuth, Sussner, Stamminger, Greiner, "On Floating-Point Normal Vectors", EGSR 2010,
 *               section 3. Of the four numbers around, the nearest is written: sqrt(2) steps in rad at
 *               most, in the middle of a face. No normal: the first number is its format's "none".
 *   spheremap   Lambert's azimuthal equal-area map, (e - 1/2) 4 = (x, y) sqrt(2 / (1 + z)), z towards
 *               the eye; of the ISPC project's deferred shading example. A step s of (x, y) is s/cos(t/2)
 *               rad, t the angle from the axis: 1.4 s across the view, 2 sqrt(s) at -z, the edge of its
 *               disk, where half floats are 4 degrees off. No normal: e = (0, 0), far outside of the disk.
 *
 * host/gbuffer/error_bounds.c derives these. Reading gives a direction of length 1/2 or more (of floats,
 * any), or 0: whoever reads makes it unit. All of it is in the common subset of C and GLSL, for the
 * geometry pass (encode.h). */
#ifndef TL_NORMAL_CODE_H
#define TL_NORMAL_CODE_H

#include "vec3.h"

#ifndef TL_GLSL
enum tl_normal_code {
    TL_NORMAL_NOT_STORED,
    TL_NORMAL_XYZ,
    TL_NORMAL_OCTAHEDRON,
    TL_NORMAL_SPHEREMAP,
    TL_NORMAL_CODE_COUNT
};
#endif

/* v: a unit vector. Both of e within [-1, 1]. */
TL_INLINE vec2 octahedron_of(vec3 v)
{
    const real k = R(1.0) / (ABSOLUTE(v.x) + ABSOLUTE(v.y) + ABSOLUTE(v.z));
    const real x = v.x * k, y = v.y * k;
    const real folded_x = (R(1.0) - ABSOLUTE(y)) * pick(x < R(0.0), R(-1.0), R(1.0));
    const real folded_y = (R(1.0) - ABSOLUTE(x)) * pick(y < R(0.0), R(-1.0), R(1.0));
    const vec2 e = {pick(v.z < R(0.0), folded_x, x), pick(v.z < R(0.0), folded_y, y)};
    return e;
}

TL_INLINE vec3 direction_of_octahedron(vec2 e)
{
    const real z = R(1.0) - ABSOLUTE(e.x) - ABSOLUTE(e.y);
    const real fold = pick(z < R(0.0), z, R(0.0));
    const vec3 v = {e.x + pick(e.x < R(0.0), -fold, fold),
                    e.y + pick(e.y < R(0.0), -fold, fold), z};
    return v;
}

/* v: a unit vector, z towards the eye. Both of e within [0, 1]. For z < 0, 1 + z is taken from x and
 * y, which keep their digits there. */
TL_INLINE vec2 spheremap_of(vec3 v)
{
    const real across2 = FMA(v.x, v.x, v.y * v.y);
    const real above = pick(v.z < R(0.0), across2 / (R(1.0) - v.z), R(1.0) + v.z);
    const real k = SQRT(R(0.125) / pick(above > R(0.0), above, R(1.0)));
    const vec2 e = {pick(above > R(0.0), FMA(v.x, k, R(0.5)), R(1.0)), FMA(v.y, k, R(0.5))};
    return e;
}

TL_INLINE vec3 direction_of_spheremap(vec2 e)
{
    const real x = FMA(e.x, R(4.0), R(-2.0)), y = FMA(e.y, R(4.0), R(-2.0));
    const real across2 = FMA(x, x, y * y);
    const real inside = FMA(across2, R(-0.25), R(1.0));
    const real k = SQRT(pick(inside > R(0.0), inside, R(0.0)));
    const mask is_one = across2 < R(6.0);
    const vec3 v = {x * k, y * k, pick(is_one, FMA(across2, R(-0.5), R(1.0)), R(0.0))};
    return v;
}

#endif
