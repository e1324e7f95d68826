/* Numbers that look random, the same for the same seed. */
#ifndef TL_PROMISE_RANDOM_H
#define TL_PROMISE_RANDOM_H

#include <stdint.h>

/* The next of 2^64 numbers. G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators",
 * OOPSLA 2014, figure 2: SplitMix64. */
static inline uint64_t tl_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* In [0, count), each as likely as the others but for a part in 2^32; count is below 2^32 and not 0. */
static inline uint32_t tl_random_below(uint64_t *state, uint32_t count)
{
    return (uint32_t)(((tl_random(state) >> 32) * count) >> 32);
}

#endif
