// The names of kernels/dialect.h in GLSL, in float: formulas of kernels/*.h compile here as they stand.
#define TL_GLSL
#define TL_INLINE
#define TL_STRUCT(name) struct name
#define real float
#define scalar float
#define mask bool
#define word32 uint
#define tl_u32 uint
#define R(x) x
#define FMA(a, b, c) fma(a, b, c)
#define SQRT(x) sqrt(x)
#define FLOOR(x) floor(x)
#define LIBRARY_LOG2(x) log2(x)
#define TO_REAL(i) float(i)
#define WHOLE_TO_WORD(x) uint(int(x))
#define WORD_AS_REAL(w) uintBitsToFloat(w)
#define REAL_AS_WORD(x) floatBitsToUint(x)
#define pick(which, a, b) ((which) ? (a) : (b))
