/* Eight lanes: AVX2 with FMA. Masks are vectors, all ones where true. */
#include <immintrin.h>

enum { BLOCK_COLUMNS = 4 };
typedef ints lane_mask;

LANES_INLINE lanes all(float value)
{
    return _mm256_set1_ps(value);
}

LANES_INLINE lanes fused(lanes a, lanes b, lanes c) /* a b + c */
{
    return _mm256_fmadd_ps(a, b, c);
}

LANES_INLINE lanes fused_minus(lanes a, lanes b, lanes c) /* a b - c */
{
    return _mm256_fmsub_ps(a, b, c);
}

LANES_INLINE lanes fused_from(lanes a, lanes b, lanes c) /* c - a b */
{
    return _mm256_fnmadd_ps(a, b, c);
}

LANES_INLINE lanes root(lanes a)
{
    return _mm256_sqrt_ps(a);
}

LANES_INLINE lanes rough_reciprocal_root(lanes a) /* 1.5 2^-12 */
{
    return _mm256_rsqrt_ps(a);
}

LANES_INLINE lanes larger(lanes a, lanes b) /* b where one is not a number */
{
    return _mm256_max_ps(a, b);
}

LANES_INLINE lanes smaller(lanes a, lanes b) /* b where one is not a number */
{
    return _mm256_min_ps(a, b);
}

LANES_INLINE lane_mask below(lanes a, lanes b)
{
    return (lane_mask)_mm256_cmp_ps(a, b, _CMP_LT_OQ);
}

LANES_INLINE lane_mask both(lane_mask a, lane_mask b)
{
    return a & b;
}

LANES_INLINE unsigned bits_of(lane_mask which)
{
    return (unsigned)_mm256_movemask_ps((lanes)which);
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
    return _mm256_blendv_ps(b, a, (lanes)which);
}

/* a where `sign` is not negative, else 0; the sign bit decides. */
LANES_INLINE lanes keep_unless_negative(lanes sign, lanes a)
{
    return _mm256_blendv_ps(a, _mm256_setzero_ps(), sign);
}

LANES_INLINE ints truncated(lanes a)
{
    return (ints)_mm256_cvttps_epi32(a);
}

LANES_INLINE ints nearest(lanes a)
{
    return (ints)_mm256_cvtps_epi32(a);
}

LANES_INLINE lanes as_floats(ints a) /* converts */
{
    return _mm256_cvtepi32_ps((__m256i)a);
}

LANES_INLINE lanes load_block(const float *from, size_t pitch)
{
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from)),
                                _mm_loadu_ps(from + pitch), 1);
}

LANES_INLINE void store_block(lanes a, float *to, size_t pitch)
{
    _mm_storeu_ps(to, _mm256_castps256_ps128(a));
    _mm_storeu_ps(to + pitch, _mm256_extractf128_ps(a, 1));
}

LANES_INLINE lanes load_lanes(const float *from)
{
    return _mm256_loadu_ps(from);
}
