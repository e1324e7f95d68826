/* Profiles of lights: which share of its largest intensity a light gives in a direction.
 *
 * A grid of shares, 0 to 1, over the angles of photometry of type C (tilelight/photometry.h): columns at even
 * angles C around the nadir, from C0 on, which come round; rows at even angles from the nadir, `first_row`
 * steps from it and on. In between shares are linear along both, as LM-63 has it; beyond the first and the
 * last row there are none. Rows stand at angles, not between them: what a file says of the nadir, the level
 * and the zenith is met exactly, and so is C0 from both sides. */
#ifndef TL_PROFILE_H
#define TL_PROFILE_H

#include "frame.h"
#include "texture.h"

/* The profile at a row of the buffer of lights. */
TL_INLINE tl_view_profile profile_behind(tl_numbers numbers, tl_u32 profile_at)
{
    return *(TL_GLOBAL const tl_view_profile *)(numbers + (size_t)profile_at * 4);
}

/* Of a place on an axis of `count` samples that comes round; at: 0 to count, which is 0 again. */
TL_INLINE texel_pair pair_of_turn(real at, scalar count)
{
    const real last = (real)(count - R(1.0));
    const real above = pick(at > R(0.0), at, R(0.0)); /* what is no number, too */
    const real inside = pick(above < (real)count, above, R(0.0));
    texel_pair pair;
    pair.first = TO_REAL(TO_INTEGER(inside));
    pair.share = inside - pair.first;
    pair.second = pick(pair.first < last, pair.first + R(1.0), R(0.0));
    return pair;
}

/* The share in direction d from the light, of any length. Angles are off as those of map_around are
 * (texture.h): by 2u of a turn and by what d and the profile's directions are off across them; around, the
 * sum with a whole turn adds u of it; down, the difference with the first row u of the rows of half a turn.
 * Then 3u of the largest sample a mixture. What is off by that much at an edge where shares end is in or
 * out. */
TL_INLINE real profile_share(tl_numbers numbers, tl_view_profile p, vec3 d)
{
    const tl_numbers shares = numbers + (size_t)p.shares_at * 4;
    const scalar columns = (scalar)p.columns, rows = (scalar)p.rows;
    const integer width = (integer)p.columns;
    const real c90 = dot3(d, lanes_of(p.c90)), c0 = dot3(d, lanes_of(p.c0)),
               down = dot3(d, lanes_of(p.nadir));
    const real level = SQRT(FMA(c90, c90, c0 * c0));
    const real around = longitude_of(c90, c0) * columns;
    const real row = FMA(longitude_of(level, down), R(2.0) * (scalar)p.rows_of_half_turn,
                         -(scalar)p.first_row);
    const texel_pair x = pair_of_turn(pick(around < R(0.0), around + columns, around), columns);
    const texel_pair y = pair_clamped(row, rows);
    const integer upper = TO_INTEGER(y.first) * width, lower = TO_INTEGER(y.second) * width;
    const integer left = TO_INTEGER(x.first), right = TO_INTEGER(x.second);
    const real of_upper =
        mixed(GATHER(shares, upper + left), GATHER(shares, upper + right), x.share);
    const real of_lower =
        mixed(GATHER(shares, lower + left), GATHER(shares, lower + right), x.share);
    const mask inside = (row >= R(0.0)) & (row <= rows - R(1.0));
    return pick(inside, mixed(of_upper, of_lower, y.share), R(0.0));
}

#endif
