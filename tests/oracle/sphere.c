#define _GNU_SOURCE /* sincosl */
#include "oracle/sphere.h"

#include <float.h>
#include <math.h>

_Static_assert(LDBL_MANT_DIG >= 64, "TL_QUICK_SPAN_ERROR is that of 64 bits");

TL_ACCURATE_SUM(quick_sum, long double)

#define number wide
#define SUM wide_sum
#define SPAN tl_span
#define NAME(name) wide_##name##_of_sphere
#define CALL(name) name##q
#include "oracle/sphere_text.h"
#undef number
#undef SUM
#undef SPAN
#undef NAME
#undef CALL

#define number long double
#define SUM quick_sum
#define SPAN tl_quick_span
#define NAME(name) quick_##name##_of_sphere
#define CALL(name) name##l
#include "oracle/sphere_text.h"

tl_span tl_oracle_sphere_span(wide c, wide depth, wide r, wide near, wide far, int orthographic)
{
    return wide_span_of_sphere(c, depth, r, near, far, orthographic);
}

tl_quick_span tl_oracle_sphere_quick_span(long double c,
                                          long double depth,
                                          long double r,
                                          long double near,
                                          long double far,
                                          int orthographic)
{
    return quick_span_of_sphere(c, depth, r, near, far, orthographic);
}
