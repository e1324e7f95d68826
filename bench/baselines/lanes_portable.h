/* Four lanes for any processor. Where it has no fused multiply-add the library's takes its place:
 * the same bits, slowly. */
#include <math.h>
#include <string.h>

enum { BLOCK_COLUMNS = 4 };
typedef ints lane_mask;

LANES_INLINE lanes all(float value)
{
    const lanes out = {value, value, value, value};
    return out;
}

LANES_INLINE lanes fused(lanes a, lanes b, lanes c) /* a b + c */
{
    const lanes out = {fmaf(a[0], b[0], c[0]), fmaf(a[1], b[1], c[1]), fmaf(a[2], b[2], c[2]),
                       fmaf(a[3], b[3], c[3])};
    return out;
}

LANES_INLINE lanes fused_minus(lanes a, lanes b, lanes c) /* a b - c */
{
    return fused(a, b, -c);
}

LANES_INLINE lanes fused_from(lanes a, lanes b, lanes c) /* c - a b */
{
    return fused(-a, b, c);
}

LANES_INLINE lanes root(lanes a)
{
    const lanes out = {sqrtf(a[0]), sqrtf(a[1]), sqrtf(a[2]), sqrtf(a[3])};
    return out;
}

LANES_INLINE lanes rough_reciprocal_root(lanes a)
{
    return 1.0f / root(a);
}

LANES_INLINE lanes keep(lane_mask which, lanes a) /* 0 elsewhere */
{
    return (lanes)(which & (ints)a);
}

LANES_INLINE lanes drop(lane_mask which, lanes a) /* 0 there */
{
    return (lanes)(~which & (ints)a);
}

LANES_INLINE lanes choose(lane_mask which, lanes a, lanes b)
{
    return (lanes)((which & (ints)a) | (~which & (ints)b));
}

LANES_INLINE lanes larger(lanes a, lanes b) /* b where one is not a number */
{
    return choose(a > b, a, b);
}

LANES_INLINE lanes smaller(lanes a, lanes b) /* b where one is not a number */
{
    return choose(a < b, a, b);
}

LANES_INLINE lane_mask below(lanes a, lanes b)
{
    return a < b;
}

LANES_INLINE lane_mask both(lane_mask a, lane_mask b)
{
    return a & b;
}

LANES_INLINE unsigned bits_of(lane_mask which)
{
    return (unsigned)((which[0] & 1) | (which[1] & 2) | (which[2] & 4) | (which[3] & 8));
}

/* a where `sign` is not negative, else 0; the sign bit decides. */
LANES_INLINE lanes keep_unless_negative(lanes sign, lanes a)
{
    return drop((ints)sign >> 31, a);
}

LANES_INLINE ints truncated(lanes a)
{
    return __builtin_convertvector(a, ints);
}

LANES_INLINE ints nearest(lanes a) /* ties away from 0, of magnitudes below 2^22 */
{
    return truncated(a + choose(a < 0.0f, all(-0.5f), all(0.5f)));
}

LANES_INLINE lanes as_floats(ints a) /* converts */
{
    return __builtin_convertvector(a, lanes);
}

LANES_INLINE lanes load_lanes(const float *from)
{
    lanes out;
    memcpy(&out, from, sizeof out);
    return out;
}

LANES_INLINE lanes load_block(const float *from, size_t pitch)
{
    (void)pitch;
    return load_lanes(from);
}

LANES_INLINE void store_block(lanes a, float *to, size_t pitch)
{
    (void)pitch;
    memcpy(to, &a, sizeof a);
}
