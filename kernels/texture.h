/* Pictures that are looked up by a direction: what spots project, what lamps shine through, the sky.
 *
 * A picture of width x height pixels, looked up between the centres of its pixels (bilinear), whose places
 * count from 0 at the centre of the first. Two ways from direction to place:
 *
 *   projected  a pinhole at the light, straight ahead the middle of the picture:
 *              x = (width - 1)/2 + d.right/d.ahead, y = (height - 1)/2 - d.up/d.ahead, right and up scaled
 *              to pixels; beyond the middle of the outermost pixels those go on.
 *   around     a map of longitude and latitude, the whole of space: longitude 0 ahead in the middle, growing
 *              to the right, which comes round at the seam; the first row at the top:
 *              x = width (1/2 + atan2(d.right, d.ahead)/2 pi) - 1/2,
 *              y = height atan2(|d across up|, d.up)/pi - 1/2; beyond the middle of the first and the
 *              last row those go on, up to the poles. */
#ifndef TL_TEXTURE_H
#define TL_TEXTURE_H

#include "frame.h"
#include "vec3.h"

/* Longitude of (x, y), in turns, -1/2 to 1/2: atan2(y, x)/2 pi; 0 where both are 0.
 *
 * With t the smaller over the larger magnitude, atan(t)/2 pi = t P(t^2), |P - that/t| <= 2.9e-9
 * (tests/tools/fit_powers.py): 0.4u of it, u = 2^-24. t is off by 5u at most (division), so is what hangs
 * on it; P by 3u in Horner's order; the product by u: 10u of 1/8, and what it is subtracted from rounds by
 * u/4 and u/2: 2u of a turn for exact x and y. Of those, an error by e of their length is one of e/2 pi of
 * a turn. In double the polynomial's 2.9e-9 remains. */
#if TL_PRECISE_POWER
#    if !defined(__OPENCL_C_VERSION__) && !TL_REAL_DOUBLE
#        define LIBRARY_ATAN2(y, x) atan2f(y, x)
#    else
#        define LIBRARY_ATAN2(y, x) atan2(y, x)
#    endif
TL_INLINE real longitude_of(real y, real x)
{
    const mask somewhere = (y < R(0.0)) | (y > R(0.0)) | (x < R(0.0)) | (x > R(0.0));
    return pick(somewhere, LIBRARY_ATAN2(y, x), R(0.0)) * R(0.15915494309189535);
}
#else
TL_INLINE real longitude_of(real y, real x)
{
    const real ay = ABSOLUTE(y), ax = ABSOLUTE(x);
    const mask steep = ay > ax;
    const real large = pick(steep, ay, ax), small = pick(steep, ax, ay);
    const real t = pick(large > R(0.0), small / large, R(0.0));
    const real z = t * t;
    real p = R(0.0004402676933);
    p = FMA(p, z, R(-0.002503706059));
    p = FMA(p, z, R(0.006706411084));
    p = FMA(p, z, R(-0.01186795305));
    p = FMA(p, z, R(0.01689966174));
    p = FMA(p, z, R(-0.022596497));
    p = FMA(p, z, R(0.03181805255));
    p = FMA(p, z, R(-0.05305117561));
    p = FMA(p, z, R(0.1591549402));
    const real eighth = t * p;
    const real quarter = pick(steep, R(0.25) - eighth, eighth);
    const real half_turn = pick(x < R(0.0), R(0.5) - quarter, quarter);
    return pick(y < R(0.0), -half_turn, half_turn);
}
#endif

/* Where something stands between two pixels of a row or a column. */
typedef struct texel_pair {
    real first, second; /* whole, 0 to count - 1 */
    real share;         /* of the second, below 1 */
} texel_pair;

/* Of a place on an axis of `count` pixels that goes on at its ends. */
TL_INLINE texel_pair pair_clamped(real at, scalar count)
{
    const real last = (real)(count - R(1.0));
    const real above = pick(at > R(0.0), at, R(0.0)); /* what is no number, too */
    const real inside = pick(above < last, above, last);
    texel_pair pair;
    pair.first = TO_REAL(TO_INTEGER(inside));
    pair.share = inside - pair.first;
    pair.second = pick(pair.first < last, pair.first + R(1.0), last);
    return pair;
}

/* Of one that comes round; at: -1/2 to count - 1/2. */
TL_INLINE texel_pair pair_around(real at, scalar count)
{
    const real last = (real)(count - R(1.0));
    const real above = pick(at > R(-0.5), at, R(-0.5));
    const real inside = pick(above < last + R(0.5), above, last + R(0.5));
    const mask before = inside < R(0.0); /* the first: between the last pixel and it */
    const real whole = TO_REAL(TO_INTEGER(inside));
    texel_pair pair;
    pair.first = pick(before, last, whole);
    pair.share = inside - pick(before, R(-1.0), whole);
    pair.second = pick(pair.first < last, pair.first + R(1.0), R(0.0));
    return pair;
}

/* f in [0, 1). Off by 3u of the larger; 0 or above where both are. */
TL_INLINE real mixed(real a, real b, real f)
{
    return FMA(f, b - a, a);
}

/* What a picture shows between four pixels. numbers: the buffer of lights. */
TL_INLINE vec3 texel_mix(tl_numbers numbers, tl_view_map map, texel_pair x, texel_pair y)
{
    const tl_numbers pixels = numbers + (size_t)map.pixels_at * 4;
    const integer width = (integer)map.width;
    const integer left = TO_INTEGER(x.first), right = TO_INTEGER(x.second);
    const integer upper = TO_INTEGER(y.first) * width, lower = TO_INTEGER(y.second) * width;
    real of[3];
    for (int c = 0; c < 3; c++)
        of[c] = mixed(mixed(GATHER(pixels, (upper + left) * 4 + c),
                            GATHER(pixels, (upper + right) * 4 + c), x.share),
                      mixed(GATHER(pixels, (lower + left) * 4 + c),
                            GATHER(pixels, (lower + right) * 4 + c), x.share),
                      y.share);
    const vec3 color = {of[0], of[1], of[2]};
    return color;
}

TL_INLINE vec3 lanes_of(const float v[3])
{
    const vec3 lanes = {(real)v[0], (real)v[1], (real)v[2]};
    return lanes;
}

/* What is projected in direction d, of any length, or against it: the same. Its place: each sum is off by
 * 4u |d| times the length of its direction, 3u its own and u the direction's rounding; the quotient of the
 * two by 2u of itself beside, the sum with the middle by u of both. Then 3u of the largest sample a mixture.
 * Asserted by tests/test_map_accuracy.c, as is what is around. */
TL_INLINE vec3 map_projected(tl_numbers numbers, tl_view_map map, vec3 d)
{
    const scalar width = (scalar)map.width, height = (scalar)map.height;
    const real per_ahead = R(1.0) / dot3(d, lanes_of(map.ahead));
    const real x = FMA(dot3(d, lanes_of(map.right)), per_ahead, R(0.5) * (width - R(1.0)));
    const real y = FMA(-dot3(d, lanes_of(map.up)), per_ahead, R(0.5) * (height - R(1.0)));
    return texel_mix(numbers, map, pair_clamped(x, width), pair_clamped(y, height));
}

/* What is around in direction d, of any length. Its place: sums off as above turn longitude by sqrt(2) 4u |d|
 * over the level's length, colatitude by sqrt(3) 4u and 2.5u for the level; longitude_of adds 2u of the width
 * or 4u of the height, product and sum u each. */
TL_INLINE vec3 map_around(tl_numbers numbers, tl_view_map map, vec3 d)
{
    const scalar width = (scalar)map.width, height = (scalar)map.height;
    const real right = dot3(d, lanes_of(map.right)), up = dot3(d, lanes_of(map.up)),
               ahead = dot3(d, lanes_of(map.ahead));
    const real level = SQRT(FMA(right, right, ahead * ahead));
    const real x = FMA(longitude_of(right, ahead), width, R(0.5) * (width - R(1.0)));
    const real y = FMA(longitude_of(level, up), R(2.0) * height, R(-0.5));
    return texel_mix(numbers, map, pair_around(x, width), pair_clamped(y, height));
}

#endif
