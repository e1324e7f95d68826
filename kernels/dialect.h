/* One text, two compilers, every precision and width.
 *
 * A .h in kernels/ is read by the host's C compiler and by OpenCL C, a .cl by OpenCL C only. A
 * formula is written once, over the names below, and is scalar code or SIMD code as it is built.
 *
 *   real      one quantity per lane: floatN or doubleN, N = TL_WIDTH; on the host N is 1
 *   scalar    the element of real, for what is the same in every lane
 *   integer   lanes of integers as wide as real;  mask: what comparing two reals gives
 *   word32    lanes of 32 bits, whatever real is: what a packed pixel is read as
 *   R(x)      a literal of type scalar
 *
 * Rules that make every width and the host give the same bits, and why:
 *
 * - a * b + c is never contracted; where one rounding is meant, FMA says so. Off here and with
 *   -ffp-contract=off on the host. Measured on PoCL 3.1, a chain as in light.h: 0 of
 *   1,048,576 results differ between the host and widths 1, 8, 16; with contraction left on, a
 *   plain a * b + c differs in 300,481.
 * - + - * / SQRT FMA and conversions only: IEEE 754 fixes their results. pow, exp, rsqrt and
 *   native_* differ from library to library; specular.h has its own power. OpenCL lets a device
 *   round float / and sqrt less well; those of PoCL on x86 do not, others lose only this test.
 * - No double by accident: SQRT, not sqrt; R(0.5), not 0.5.
 * - pick, not `if`, min or fmax: their NaN rules differ, and a lane cannot branch.
 * - No libm, no pointers (OpenCL's have address spaces), no float3 (it is 16 bytes), no bool. */
#ifndef TL_DIALECT_H
#define TL_DIALECT_H

/* A call between kernel functions would pass vectors through memory: all are inlined, whatever the
 * compiler thinks of their size (x 2 on PoCL). */
#ifdef __OPENCL_C_VERSION__
#    define TL_INLINE static inline __attribute__((always_inline))
#else
#    define TL_INLINE static inline
#endif

/* TL_STRUCT(name) { ... }; is a type called `name`, in GLSL too (raster/shaders/dialect.glsl). */
#define TL_STRUCT(name)       \
    typedef struct name name; \
    struct name

/* C11 has _Static_assert, OpenCL C 1.2 has not; a negative array length stops both. */
#define TL_STATIC_ASSERT(condition, name) typedef char tl_assert_##name[(condition) ? 1 : -1]

#ifdef __OPENCL_C_VERSION__
#    pragma OPENCL FP_CONTRACT OFF
#    include "options.h"

#    define TL_PASTE_(a, b) a##b
#    define TL_PASTE(a, b) TL_PASTE_(a, b)
#    if TL_WIDTH == 1
#        define TL_LANES(type) type
#    else
#        define TL_LANES(type) TL_PASTE(type, TL_WIDTH)
#    endif

#    if TL_REAL_DOUBLE
#        define TL_SCALAR double
#        define TL_INTEGER long
#        define R(x) x
#    else
#        define TL_SCALAR float
#        define TL_INTEGER int
#        define R(x) x##f
#    endif

typedef uint tl_u32;
typedef TL_SCALAR scalar;
typedef TL_LANES(TL_SCALAR) real;
typedef TL_LANES(TL_INTEGER) integer;
#    define TO_REAL(i) TL_PASTE(convert_, TL_LANES(TL_SCALAR))(i)
#    define AS_REAL(i) TL_PASTE(as_, TL_LANES(TL_SCALAR))(i)
#    define TO_INTEGER(x) TL_PASTE(convert_, TL_LANES(TL_INTEGER))(x)
#    define AS_INTEGER(x) TL_PASTE(as_, TL_LANES(TL_INTEGER))(x)
/* To the precision of float, whatever real is. */
#    define NARROW(x) TO_REAL(TL_PASTE(convert_, TL_LANES(float))(x))

/* Of words: as signed numbers; the float with these bits; the whole number, below 2^31. */
typedef TL_LANES(uint) word32;
#    define WORD_AS_INT(w) TL_PASTE(as_, TL_LANES(int))(w)
#    define INT_AS_WORD(i) TL_PASTE(as_, TL_LANES(uint))(i)
#    define WORD_AS_REAL(w) TO_REAL(TL_PASTE(as_, TL_LANES(float))(w))
#    define WORD_TO_REAL(w) TO_REAL(WORD_AS_INT(w))

/* FOLD(HALVES, v) combines the lanes of v to one, as a tree; HALVES(v) joins v.lo and v.hi.
 * EACH_LANE(F, a, i) is F(a, lane) for each lane of i, with commas between. */
#    if TL_WIDTH == 16
#        define FOLD(HALVES, v) HALVES(HALVES(HALVES(HALVES(v))))
#        define LANE_INDEX ((real)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#        define FIRST_LANE(i) ((i).s0)
#        define EACH_LANE(F, a, i)                                                    \
            F(a, (i).s0), F(a, (i).s1), F(a, (i).s2), F(a, (i).s3), F(a, (i).s4),     \
                F(a, (i).s5), F(a, (i).s6), F(a, (i).s7), F(a, (i).s8), F(a, (i).s9), \
                F(a, (i).sa), F(a, (i).sb), F(a, (i).sc), F(a, (i).sd), F(a, (i).se), \
                F(a, (i).sf)
typedef integer mask;
#    elif TL_WIDTH == 8
#        define FOLD(HALVES, v) HALVES(HALVES(HALVES(v)))
#        define LANE_INDEX ((real)(0, 1, 2, 3, 4, 5, 6, 7))
#        define FIRST_LANE(i) ((i).s0)
#        define EACH_LANE(F, a, i)                                                \
            F(a, (i).s0), F(a, (i).s1), F(a, (i).s2), F(a, (i).s3), F(a, (i).s4), \
                F(a, (i).s5), F(a, (i).s6), F(a, (i).s7)
typedef integer mask;
#    elif TL_WIDTH == 4
#        define FOLD(HALVES, v) HALVES(HALVES(v))
#        define LANE_INDEX ((real)(0, 1, 2, 3))
#        define FIRST_LANE(i) ((i).s0)
#        define EACH_LANE(F, a, i) F(a, (i).s0), F(a, (i).s1), F(a, (i).s2), F(a, (i).s3)
typedef integer mask;
#    else
#        define FOLD(HALVES, v) (v)
#        define LANE_INDEX ((real)0)
#        define FIRST_LANE(i) (i)
#        define EACH_LANE(F, a, i) F(a, i)
typedef int mask;
#    endif

#    define FMA(a, b, c) fma((real)(a), (real)(b), (real)(c))
#    define SQRT(v) sqrt(v)
#    define pick(which, a, b) ((which) ? (real)(a) : (real)(b))

/* Not any(): that of a scalar looks at the sign bit, which a true scalar comparison leaves 0,
 * and that of an int16 is slower on PoCL than this tree. Clang's own, where it has one, is a test of
 * a mask register on AVX-512, one instruction in place of six. */
#    define ADD_HALVES(v) ((v).lo + (v).hi)
#    define SUM_LANES(v) FOLD(ADD_HALVES, v)
#    define TL_LANE_COUNT TL_WIDTH
#    define OR_HALVES(v) ((v).lo | (v).hi)
#    if TL_WIDTH > 1 && defined(__has_builtin)
#        if __has_builtin(__builtin_reduce_or)
#            define OR_LANES(v) __builtin_reduce_or(v)
#        endif
#    endif
#    ifndef OR_LANES
#        define OR_LANES(v) FOLD(OR_HALVES, v)
#    endif
TL_INLINE int any_lane(mask which)
{
    return OR_LANES(which) != 0;
}

/* Numbers in memory that are looked up: from[at], lane by lane. */
#    define TL_GLOBAL __global
typedef TL_GLOBAL const float *tl_numbers;
#    define NUMBER_AT(from, i) (from)[i]
#    define GATHER(from, i) TO_REAL((TL_LANES(float))(EACH_LANE(NUMBER_AT, from, i)))
#    define WORD_AT(from, i) ((TL_GLOBAL const uint *)(from))[i]
#    define GATHER_WORDS(from, i) ((word32)(EACH_LANE(WORD_AT, from, i)))

/* From and to memory of any alignment: vloadN asks for none, a cast pointer would. LOAD widens
 * floats where real is double. */
#    if TL_WIDTH == 1
#        define LOAD(from, at) ((real)(from)[at])
#        define STORE_FLOAT(v, to, at) ((to)[at] = (float)(v))
#        define STORE_MASK(which, to) ((to)[0] = (which))
#    else
#        define LOAD(from, at) TO_REAL(TL_LANES(vload)(0, (from) + (at)))
#        define STORE_FLOAT(v, to, at) \
            TL_LANES(vstore)(TL_LANES(convert_float)(v), 0, (to) + (at))
#        define STORE_MASK(which, to) TL_LANES(vstore)(TL_LANES(convert_int)(which), 0, to)
#    endif

#else /* the host: one lane; float unless the file that includes this says otherwise */
#    include <math.h>
#    include <stdint.h>
#    include <string.h>

#    ifndef TL_REAL_DOUBLE
#        define TL_REAL_DOUBLE 0
#    endif
#    ifndef TL_PRECISE_POWER
#        define TL_PRECISE_POWER 0
#    endif
#    ifndef TL_POWER
#        define TL_POWER 0
#        define TL_FORM 0
#        define TL_ROOT 0
#    endif
#    include "knobs.h"

typedef uint32_t tl_u32;
#    if TL_REAL_DOUBLE
typedef double real, scalar;
typedef int64_t integer;
#        define R(x) x
#        define FMA(a, b, c) fma(a, b, c)
#        define SQRT(x) sqrt(x)
#        define FLOOR(x) floor(x)
#        define LIBRARY_LOG2(x) log2(x)
#    else
typedef float real, scalar;
typedef int32_t integer;
#        define R(x) x##f
#        define FMA(a, b, c) fmaf(a, b, c)
#        define SQRT(x) sqrtf(x)
#        define FLOOR(x) floorf(x)
#        define LIBRARY_LOG2(x) log2f(x)
#    endif
typedef int mask;

#    define TO_REAL(i) ((real)(i))
#    define TO_INTEGER(x) ((integer)(x))
#    define NARROW(x) ((real)(float)(x))
#    define pick(which, a, b) ((which) ? (a) : (b))

TL_INLINE int any_lane(mask which)
{
    return which;
}

typedef uint32_t word32;
#    define WORD_AS_INT(w) ((int32_t)(w))
#    define INT_AS_WORD(i) ((word32)(i))
#    define WORD_TO_REAL(w) ((real)WORD_AS_INT(w))

TL_INLINE real WORD_AS_REAL(word32 w)
{
    float x;
    memcpy(&x, &w, sizeof x);
    return (real)x;
}

/* The bits of x as a float; of a whole number as a word, negative ones as two's complement. */
TL_INLINE word32 REAL_AS_WORD(real x)
{
    const float rounded = (float)x;
    word32 w;
    memcpy(&w, &rounded, sizeof w);
    return w;
}
#    define WHOLE_TO_WORD(x) ((word32)(int32_t)(x))

#    define TL_GLOBAL
typedef TL_GLOBAL const float *tl_numbers;
#    define GATHER(from, i) ((real)(from)[i])
#    define LOAD(from, at) ((real)(from)[at])
#    define LANE_INDEX R(0.0)
#    define TL_LANE_COUNT 1
TL_INLINE word32 GATHER_WORDS(tl_numbers from, integer i)
{
    word32 w;
    memcpy(&w, from + i, sizeof w);
    return w;
}
#    define FIRST_LANE(i) (i)
#    define EACH_LANE(F, a, i) F(a, i)

TL_INLINE integer AS_INTEGER(real x)
{
    integer i;
    memcpy(&i, &x, sizeof i);
    return i;
}

TL_INLINE real AS_REAL(integer i)
{
    real x;
    memcpy(&x, &i, sizeof x);
    return x;
}
#endif

/* TL_BEGIN_LOOSE and TL_END_LOOSE enclose functions whose arithmetic the compiler may loosen, where a build
 * asks for it. Flags of the build would loosen positions and what decides on a light too; then a tile could
 * leave out a light that a pixel counts, and tiles would show. Pragmas do not reach beyond what they enclose,
 * so culling stays exact; clang has them. The host is strict. */
#if defined(__OPENCL_C_VERSION__) && TL_ARITHMETIC != 0
#    ifndef __clang__
#        error "--math contract and relaxed need an OpenCL compiler of clang's kind"
#    endif
#    if TL_ARITHMETIC == 1
#        define TL_BEGIN_LOOSE _Pragma("clang fp contract(fast)")
#        define TL_END_LOOSE _Pragma("clang fp contract(off)")
#    else
#        define TL_BEGIN_LOOSE _Pragma("float_control(precise, off, push)")
#        define TL_END_LOOSE _Pragma("float_control(pop)")
#    endif
#else
#    define TL_BEGIN_LOOSE
#    define TL_END_LOOSE
#endif

#define NO_LANE ((mask)0)
#define EVERY_LANE ((mask)0 == (mask)0)

#endif
