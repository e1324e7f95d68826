/* Bloom: what is bright scatters over what is around (Policarpo and Fonseca, "Deferred Shading Tutorial",
 * 2005, section 3.5.2), in colour.
 *
 * Bright pass. x is the largest of a pixel's three numbers, T the threshold, K half the width of its knee.
 * What is over the threshold,
 *
 *     q(x) = 0 below T - K;   (x - T + K)^2 / 4K up to T + K;   x - T beyond,
 *
 * has no step and no kink. The pixel gives its colour times q/x: its hue stays.
 *
 * Size. A pixel of the small picture is the mean of side x side pixels, 2 x 2 or 4 x 4. It is blurred by
 * seven taps across and seven down, as often as the width asks for, looked up bilinearly at the pixels'
 * centres, and added times the strength.
 *
 * Width. Variances of blurs add up. Down and up again bring side^2/4 px^2 together: (side^2 - 1)/12 of the
 * mean, (2 side^2 + 1)/12 of bilinear weights at pixels' centres. The passes have what is left of the
 * width's square, each at most TL_BLOOM_MOST_VARIANCE, for which seven taps have 2 % of a Gaussian at their
 * ends. So the same width looks nearly the same in either size, and a quarter takes a quarter of the time.
 *
 * Energy. Taps add up to 1, bilinear weights of a small pixel to side^2, so what is added adds up to the
 * strength times what is over the threshold, by colour. Beyond the picture's edges there is no light, and
 * nothing comes back that went there: the small picture has a margin as wide as blurs reach, so a glow looks
 * the same wherever it is, cut at the edge.
 *
 * Rounding, in u = 2^-24 of what is added, for all is sums and products of numbers that are not negative: 6
 * in the bright pass, side^2 in the mean, 5 in each of the taps' sums, 5 in looking up and adding, and 1 of
 * the pixel (tests/test_post_bloom.c). What a pixel gives is cut at 2^125, so that no sum of taps leaves the
 * range of float. */
#ifndef TL_BLOOM_H
#define TL_BLOOM_H

#include "post.h"

#define TL_BLOOM_MOST_GIVEN R(0x1p125)
#define TL_BLOOM_TAPS 7
#define TL_BLOOM_REACH 3 /* to either side */
#define TL_BLOOM_MOST_VARIANCE 1.5

/* Planes of the small picture are [3][rows][pitch]; its pixel (column, row) stands at column + guard, row -
 * first_row. There is room for what blurs reach beyond its edges: rows and columns below 0 are there. */
typedef struct tl_view_bloom {
    float strength;
    float lower, threshold, upper; /* T - K, T, T + K */
    float per_4knee;               /* 1/4K; 0 where K is */
    float per_mean;                /* 1/side^2 */
    tl_u32 side;
    tl_u32 unused;
    float taps[4]; /* in the middle, and 1, 2, 3 away */
    tl_u32 pitch, rows;
    tl_u32 guard; /* a multiple of 16 */
    int first_row;
    int from_row, to_row; /* rows that a step writes: from_row to to_row - 1 */
    tl_u32 unused_too[2];
} tl_view_bloom;
TL_STATIC_ASSERT(sizeof(tl_view_bloom) == 80, view_bloom_is_five_rows);

typedef struct tl_view_bloom_stage {
    tl_view_picture picture;
    tl_view_bloom bloom;
} tl_view_bloom_stage;

/* Columns at both ends of the small planes' rows that only the bright pass writes: zeroes, for taps. */
#define TL_BLOOM_ENDS 16

TL_INLINE size_t bloom_at(const tl_view_bloom *b, tl_u32 color, int row, tl_u32 at)
{
    return ((size_t)color * b->rows + (size_t)(row - b->first_row)) * b->pitch + at;
}

/* What a pixel gives, as a share of its colour. */
TL_INLINE real bright_share(const tl_view_bloom *b, vec3 c)
{
    const real most = pick(c.x > c.y, c.x, c.y), x = pick(most > c.z, most, c.z);
    const real above = x - b->lower;
    const real knee = above * above * b->per_4knee;
    const real over =
        pick(x < (real)b->upper, pick(x > (real)b->lower, knee, R(0.0)), x - b->threshold);
    return pick((x > R(0.0)) & (over > R(0.0)), over / x, R(0.0));
}

TL_INLINE real given(real color, real share)
{
    const real v = color * share;
    return pick(v > (real)TL_BLOOM_MOST_GIVEN, TL_BLOOM_MOST_GIVEN, v);
}

/* Column sums of a row of small pixels, times per_mean: from `column` of the picture on, whose rows begin at
 * `row`; 0 of what is beyond the edges. */
TL_INLINE vec3 bright_columns(const tl_view_bloom_stage *s,
                              tl_numbers from,
                              int row,
                              int column)
{
    const tl_view_bloom *b = &s->bloom;
    vec3 sum = {R(0.0), R(0.0), R(0.0)};
    if (column < 0 || column >= (int)s->picture.width)
        return sum;
    const mask is_there = is_in_row(column, s->picture.width);
    for (int y = 0; y < (int)b->side; y++) {
        if (row + y < 0 || row + y >= (int)s->picture.height)
            continue;
        const vec3 c = post_color(&s->picture, from, (tl_u32)(row + y), (tl_u32)column);
        const real own = bright_share(b, c);
        const real share = pick(is_there, own, R(0.0));
        const vec3 gives = {given(c.x, share), given(c.y, share), given(c.z, share)};
        sum = pick3(is_there, fma3(gives, (real)b->per_mean, sum), sum);
    }
    return sum;
}

TL_INLINE real seven_taps(const tl_view_bloom *b, tl_numbers at, long apart)
{
    const real own = LOAD(at, 0), one = LOAD(at, -apart) + LOAD(at, apart),
               two = LOAD(at, -2 * apart) + LOAD(at, 2 * apart),
               three = LOAD(at, -3 * apart) + LOAD(at, 3 * apart);
    return FMA(b->taps[3], three,
               FMA(b->taps[2], two, FMA(b->taps[1], one, (real)b->taps[0] * own)));
}

/* The small pixel left of or above a pixel's centre, and the share of the one beyond: side is 2 or 4. */
TL_INLINE int bloom_before(tl_u32 at, tl_u32 side)
{
    return (int)((2 * at + 1 + side) / (2 * side)) - 1;
}

TL_INLINE scalar bloom_beyond(tl_u32 at, tl_u32 side)
{
    return (scalar)((2 * at + 1 + side) % (2 * side)) * (side == 4 ? R(0.125) : R(0.25));
}

TL_INLINE real between(real share, real before, real beyond)
{
    return FMA(share, beyond, (R(1.0) - share) * before);
}

TL_INLINE real with_glow(const tl_view_bloom *b, real own, real glow)
{
    return within_float(FMA(b->strength, glow, own));
}

#endif
