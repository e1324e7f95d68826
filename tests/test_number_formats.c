/* Are numbers read as exactly as kernels/number.h says, every one of them? */
#include "testing.h"

#include "number.h"

/* From the definition of binary16; what is not finite is 65536 or more. */
static double half_by_definition(uint32_t bits)
{
    const int exponent = (int)(bits >> 10 & 31u), mantissa = (int)(bits & 1023u);
    const double magnitude =
        exponent ? ldexp(1024.0 + mantissa, exponent - 25) : ldexp((double)mantissa, -24);
    return bits >> 15 ? -magnitude : magnitude;
}

static void every_half_is_exact(void **state)
{
    (void)state;
    for (uint32_t shift = 0; shift <= 16; shift += 16)
        for (uint32_t bits = 0; bits < 65536; bits++) {
            /* Whatever else is in the word. */
            const uint32_t word = bits << shift | 0xa5a5u << (16 - shift);
            const double got = (double)number_value(TL_NUMBER_HALF, word, shift, 16);
            if (got != half_by_definition(bits))
                fail_msg("half %04x is %a, want %a", bits, got, half_by_definition(bits));
        }
}

static void every_float24_is_exact(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < 0xff0000u; bits += 37) {
        const int exponent = (int)(bits >> 16);
        const double mantissa = (double)(bits & 65535u);
        const double want = exponent ? ldexp(65536.0 + mantissa, exponent - 127 - 16)
                                     : ldexp(mantissa, -126 - 16);
        const double got = (double)number_value(TL_NUMBER_FLOAT24, bits << 8 | 0xa5u, 8, 24);
        if (got != want)
            fail_msg("float24 %06x is %a, want %a", bits, got, want);
    }
    assert_true(isinf(number_value(TL_NUMBER_FLOAT24, 0xff0000u << 8, 8, 24)));
}

/* Within 2u of the value and 1.5u; 0 and `most` exactly. */
static void check_whole(const char *what, uint32_t bits, float got, double whole, double most)
{
    const double want = whole / most, bound = fmin(2.0 * fabs(want), 1.5) * 0x1p-24;
    const int is_end = whole == 0.0 || fabs(whole) == most;
    if (!(fabs((double)got - want) <= bound) || (is_end && (double)got != want))
        fail_msg("%s of %u bits: %g is read as %a, want %a", what, bits, whole, (double)got,
                 want);
}

static void whole_numbers_are_within_their_bound(void **state)
{
    (void)state;
    for (uint32_t bits = 2; bits <= 24; bits++) {
        const uint32_t most = (1u << bits) - 1u, stride = bits > 16 ? 251 : 1;
        const uint32_t shift = 32u - bits, half = 1u << (bits - 1u);
        for (uint32_t i = 0; i <= most + stride - 1; i += stride) {
            const uint32_t whole = i < most ? i : most;
            const uint32_t word = whole << shift | 0x5u;
            const double is_signed = whole >= half ? (double)whole - 2.0 * half : (double)whole;
            check_whole("unorm", bits, number_value(TL_NUMBER_UNORM, word, shift, bits),
                        (double)whole, (double)most);
            if (whole == half)
                assert_true(number_value(TL_NUMBER_SNORM, word, shift, bits) < -1.0f);
            else
                check_whole("snorm", bits, number_value(TL_NUMBER_SNORM, word, shift, bits),
                            is_signed, (double)(half - 1u));
        }
    }
}

static void bytes_have_the_highest_first(void **state)
{
    (void)state;
    check_whole("bytes24", 24, number_value(TL_NUMBER_BYTES24, 0x00563412u, 0, 24),
                (double)0x123456, 16777215.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_is_exact),
        cmocka_unit_test(every_float24_is_exact),
        cmocka_unit_test(whole_numbers_are_within_their_bound),
        cmocka_unit_test(bytes_have_the_highest_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
