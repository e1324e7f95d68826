/* Random numbers of one case: they depend on the seed, the family and the case's index alone, so cases may
 * be tried in any order, on any number of processors. No expression draws twice where C leaves open in which
 * order. */
#ifndef TL_TEST_DRAWS_H
#define TL_TEST_DRAWS_H

#include <math.h>
#include <stdint.h>

typedef struct tl_draws {
    uint64_t state;
} tl_draws;

/* Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom Number Generators", splitmix64. */
static inline uint64_t draw_bits(tl_draws *d)
{
    uint64_t z = d->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

static inline tl_draws draws_of(uint64_t seed, uint64_t family, uint64_t index)
{
    tl_draws d = {seed};
    d.state = draw_bits(&d) ^ family;
    d.state = draw_bits(&d) ^ index;
    d.state = draw_bits(&d);
    return d;
}

static inline double draw(tl_draws *d, double low, double high)
{
    return low + (high - low) * (double)(draw_bits(d) >> 11) * 0x1p-53;
}

static inline int draw_chance(tl_draws *d, double share)
{
    return draw(d, 0.0, 1.0) < share;
}

/* 0 to count - 1 */
static inline int draw_index(tl_draws *d, int count)
{
    return (int)(draw_bits(d) % (uint64_t)count);
}

/* Every order of magnitude alike. */
static inline double draw_magnitude(tl_draws *d, double low, double high)
{
    return exp2(draw(d, log2(low), log2(high)));
}

static inline float draw_signed(tl_draws *d, double low, double high)
{
    const float m = (float)draw_magnitude(d, low, high);
    return draw_bits(d) & 1 ? -m : m;
}

/* v, or one of the floats up to `most` places beside it. */
static inline float draw_beside(tl_draws *d, double v, int most)
{
    const int places = draw_index(d, 2 * most + 1) - most;
    float f = (float)v;
    for (int i = 0; i < (places < 0 ? -places : places); i++)
        f = nextafterf(f, places < 0 ? -INFINITY : INFINITY);
    return f;
}

#endif
