#include "oracle/encodings.h"

wide tl_oracle_binary(uint32_t bits, int has_sign, int exponent_bits, int mantissa_bits)
{
    const uint32_t ones = (1u << exponent_bits) - 1u;
    const uint32_t mantissa = bits & ((1u << mantissa_bits) - 1u),
                   exponent = bits >> mantissa_bits & ones;
    const int bias = (int)(ones >> 1);
    const wide sign = has_sign && bits >> (mantissa_bits + exponent_bits) & 1u ? -1 : 1;
    if (exponent == ones)
        return mantissa ? nanq("") : sign * HUGE_VALQ;
    if (exponent == 0)
        return sign * scalbnq(mantissa, 1 - bias - mantissa_bits);
    return sign * scalbnq((wide)(1u << mantissa_bits) + mantissa,
                          (int)exponent - bias - mantissa_bits);
}

wide tl_oracle_unorm(uint32_t bits, int count)
{
    return (wide)bits / ((1u << count) - 1u);
}

wide tl_oracle_snorm(uint32_t bits, int count)
{
    const wide half = 1u << (count - 1);
    return (bits < half ? (wide)bits : bits - 2 * half) / (half - 1);
}

wide3 tl_oracle_octahedron(wide x, wide y)
{
    const wide z = 1 - fabsq(x) - fabsq(y);
    if (z >= 0)
        return (wide3){x, y, z};
    return (wide3){copysignq(1 - fabsq(y), x), copysignq(1 - fabsq(x), y), z};
}

wide3 tl_oracle_spheremap(wide ex, wide ey)
{
    const wide x = 4 * ex - 2, y = 4 * ey - 2, r = sqrtq(x * x + y * y);
    const wide t = 2 * asinq(fminq(r / 2, 1));
    if (!(r > 0))
        return (wide3){0, 0, 1};
    return (wide3){sinq(t) * x / r, sinq(t) * y / r, cosq(t)};
}

wide tl_oracle_exponent(wide stored)
{
    return expm1q(stored * logq(10001));
}

wide3 tl_oracle_shared(uint32_t bits)
{
    const int exponent = (int)(bits >> 27) - 15 - 9;
    return (wide3){scalbnq(bits & 511u, exponent), scalbnq(bits >> 9 & 511u, exponent),
                   scalbnq(bits >> 18 & 511u, exponent)};
}
