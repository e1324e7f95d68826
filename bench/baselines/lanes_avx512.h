/* Sixteen lanes: AVX-512 F and DQ. Masks are mask registers. */
#include <immintrin.h>

enum { BLOCK_COLUMNS = 4 };
typedef __mmask16 lane_mask;

LANES_INLINE lanes all(float value)
{
    return _mm512_set1_ps(value);
}

LANES_INLINE lanes fused(lanes a, lanes b, lanes c) /* a b + c */
{
    return _mm512_fmadd_ps(a, b, c);
}

LANES_INLINE lanes fused_minus(lanes a, lanes b, lanes c) /* a b - c */
{
    return _mm512_fmsub_ps(a, b, c);
}

LANES_INLINE lanes fused_from(lanes a, lanes b, lanes c) /* c - a b */
{
    return _mm512_fnmadd_ps(a, b, c);
}

LANES_INLINE lanes root(lanes a)
{
    return _mm512_sqrt_ps(a);
}

LANES_INLINE lanes rough_reciprocal_root(lanes a) /* 2^-14 */
{
    return _mm512_rsqrt14_ps(a);
}

LANES_INLINE lanes larger(lanes a, lanes b) /* b where one is not a number */
{
    return _mm512_max_ps(a, b);
}

LANES_INLINE lanes smaller(lanes a, lanes b) /* b where one is not a number */
{
    return _mm512_min_ps(a, b);
}

LANES_INLINE lane_mask below(lanes a, lanes b)
{
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}

LANES_INLINE lane_mask both(lane_mask a, lane_mask b)
{
    return (lane_mask)(a & b);
}

LANES_INLINE unsigned bits_of(lane_mask which)
{
    return which;
}

LANES_INLINE lanes keep(lane_mask which, lanes a) /* 0 elsewhere */
{
    return _mm512_maskz_mov_ps(which, a);
}

LANES_INLINE lanes drop(lane_mask which, lanes a) /* 0 there */
{
    return _mm512_maskz_mov_ps((lane_mask)~which, a);
}

LANES_INLINE lanes choose(lane_mask which, lanes a, lanes b)
{
    return _mm512_mask_blend_ps(which, b, a);
}

/* a where `sign` is not negative, else 0; the sign bit decides. */
LANES_INLINE lanes keep_unless_negative(lanes sign, lanes a)
{
    return keep((lane_mask)~_mm512_movepi32_mask((__m512i)sign), a);
}

LANES_INLINE ints truncated(lanes a)
{
    return (ints)_mm512_cvttps_epi32(a);
}

LANES_INLINE ints nearest(lanes a)
{
    return (ints)_mm512_cvtps_epi32(a);
}

LANES_INLINE lanes as_floats(ints a) /* converts */
{
    return _mm512_cvtepi32_ps((__m512i)a);
}

LANES_INLINE lanes load_block(const float *from, size_t pitch)
{
    const __m256 top = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from)),
                                            _mm_loadu_ps(from + pitch), 1);
    const __m256 bottom =
        _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from + 2 * pitch)),
                             _mm_loadu_ps(from + 3 * pitch), 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(top), bottom, 1);
}

LANES_INLINE void store_block(lanes a, float *to, size_t pitch)
{
    _mm_storeu_ps(to, _mm512_castps512_ps128(a));
    _mm_storeu_ps(to + pitch, _mm512_extractf32x4_ps(a, 1));
    _mm_storeu_ps(to + 2 * pitch, _mm512_extractf32x4_ps(a, 2));
    _mm_storeu_ps(to + 3 * pitch, _mm512_extractf32x4_ps(a, 3));
}

LANES_INLINE lanes load_lanes(const float *from)
{
    return _mm512_loadu_ps(from);
}
