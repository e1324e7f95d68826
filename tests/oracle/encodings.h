/* What numbers of packed pixels mean: the definitions of their formats, in 128-bit floats. Nothing is shared
 * with kernels/number.h, normal_code.h and color_code.h. Exact but for quotients, v = 2^-113, and for angles
 * and powers, 10v. */
#ifndef TL_ORACLE_ENCODINGS_H
#define TL_ORACLE_ENCODINGS_H

#include "oracle/vectors.h"

#include <stdint.h>

/* IEEE 754: a sign, if there is one, an exponent and a mantissa, from the highest bit down. */
wide tl_oracle_binary(uint32_t bits, int has_sign, int exponent_bits, int mantissa_bits);

/* OpenGL 4.6, 2.3.5: a whole number over the largest. The least signed one is below -1 here. */
wide tl_oracle_unorm(uint32_t bits, int count);
wide tl_oracle_snorm(uint32_t bits, int count);

/* Meyer et al. 2010: the octahedron |x| + |y| + |z| = 1 over the square; of length 1/sqrt(3) or more. */
wide3 tl_oracle_octahedron(wide x, wide y);

/* Lambert's equal-area map, e = 1/2 + (x, y)/4, sqrt(x^2 + y^2) = 2 sin(t/2), t from +z. Beyond the disk -z's
 * direction. Unit. */
wide3 tl_oracle_spheremap(wide ex, wide ey);

/* Exponents by their logarithm: (1 + 10000)^stored - 1. */
wide tl_oracle_exponent(wide stored);

/* OpenGL 4.6, 8.5.2: RGB9E5. */
wide3 tl_oracle_shared(uint32_t bits);

#endif
