/* Vectors of floats of the processor at hand: what the hand-written baselines are written over.
 *
 * One of three sets, chosen by the build (HAND_SET_...): the same text becomes AVX-512, AVX2, or
 * whatever GCC makes of 16-byte vectors. Arithmetic operators are the vector extension's; the
 * functions here are what it lacks. A block is LANES pixels, BLOCK_COLUMNS wide: the squarer it
 * is, the fewer blocks a light touches. */
#ifndef TL_LANES_H
#define TL_LANES_H

#if defined(HAND_SET_AVX512)
enum { LANES = 16 };
#elif defined(HAND_SET_AVX2)
enum { LANES = 8 };
#else
enum { LANES = 4 };
#endif

typedef float lanes __attribute__((vector_size(LANES * 4)));
typedef int ints __attribute__((vector_size(LANES * 4)));

#define LANES_INLINE static inline __attribute__((always_inline))

#if defined(HAND_SET_AVX512)
#    include "lanes_avx512.h"
#elif defined(HAND_SET_AVX2)
#    include "lanes_avx2.h"
#else
#    include "lanes_portable.h"
#endif

enum { BLOCK_ROWS = LANES / BLOCK_COLUMNS };

typedef struct lanes3 {
    lanes x, y, z;
} lanes3;

LANES_INLINE lanes dot(lanes3 a, lanes3 b)
{
    return fused(a.x, b.x, fused(a.y, b.y, a.z * b.z));
}

/* color k + sum */
LANES_INLINE lanes3 add_scaled(const float color[3], lanes k, lanes3 sum)
{
    const lanes3 out = {fused(all(color[0]), k, sum.x), fused(all(color[1]), k, sum.y),
                        fused(all(color[2]), k, sum.z)};
    return out;
}

/* 0, 1, 2 ... within a row of the block, and the row */
LANES_INLINE lanes column_in_block(void)
{
    lanes columns;
    for (int i = 0; i < LANES; i++)
        columns[i] = (float)(i % BLOCK_COLUMNS);
    return columns;
}

LANES_INLINE lanes row_in_block(void)
{
    lanes rows;
    for (int i = 0; i < LANES; i++)
        rows[i] = (float)(i / BLOCK_COLUMNS);
    return rows;
}

#endif
