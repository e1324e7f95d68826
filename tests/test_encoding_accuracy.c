/* Is what kernels read of packed numbers what their formats say, to within what kernels/number.h,
 * normal_code.h and color_code.h derive for float and for double?
 *
 * Expected is tests/oracle/encodings.h. What storing rounds is tests/test_layout_round_trip.c's. */
#include "formula_cases.h"
#include "oracle/encodings.h"

#include "number.h"

static void exact(const formulas *by, const char *what, uint32_t bits, double got, wide want)
{
    if (!((wide)got == want))
        fail_msg("%s, %s: %08x is read as %a, want %a", what, by->name, bits, got,
                 (double)want);
}

/* Denormal and largest numbers among them; what is not finite is test_number_formats.c's. */
static void floats_are_exact(void **state)
{
    uint64_t seed = 754;
    (void)state;
    for (int i = 0; i < scaled_count(20000); i++) {
        const uint32_t word = i % 3 ? bits_of(&seed) : bits_of(&seed) & 0x83ff83ffu;
        const uint32_t half = word & 0xffffu, short_float = word >> 8;
        for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
            if ((half & 0x7c00u) != 0x7c00u)
                exact(arithmetics[k], "half", half,
                      arithmetics[k]->number(TL_NUMBER_HALF, word, 0, 16),
                      tl_oracle_binary(half, 1, 5, 10));
            if (short_float < 0xff0000u)
                exact(arithmetics[k], "float24", short_float,
                      arithmetics[k]->number(TL_NUMBER_FLOAT24, word, 8, 24),
                      tl_oracle_binary(short_float, 0, 8, 16));
        }
    }
}

static void whole_numbers_are_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const formulas *by = arithmetics[k];
        figure plain = figure_of("encodings", "unorm of 2 to 24 bits", "kernels/number.h",
                                 "value, of itself", by, "step rounded, product"),
               sign = figure_of("encodings", "snorm of 2 to 24 bits", "kernels/number.h",
                                "value, of itself", by, "step rounded, product");
        uint64_t seed = 255;
        for (int i = 0; i < scaled_count(20000); i++) {
            const int bits = 2 + i % 23;
            const uint32_t most = (1u << bits) - 1u, field = 1u + bits_of(&seed) % most;
            const uint32_t shift = (uint32_t)(32 - bits) / 2,
                           word = field << shift | (bits_of(&seed) & ~(most << shift));
            const wide whole = tl_oracle_unorm(field, bits),
                       with_sign = tl_oracle_snorm(field, bits);
            const wide read = by->number(TL_NUMBER_UNORM, word, shift, (uint32_t)bits),
                       signed_read = by->number(TL_NUMBER_SNORM, word, shift, (uint32_t)bits);
            figure_sees(&plain, (double)(fabsq(read - whole) / whole), 2 * by->u,
                        "%u of %d bits", field, bits);
            if (field == most / 2 + 1)
                assert_true(signed_read < -1);
            else
                figure_sees(&sign, (double)(fabsq(signed_read - with_sign) / fabsq(with_sign)),
                            2 * by->u, "%u of %d bits", field, bits);
        }
        figure_report(&plain);
        figure_report(&sign);
    }
}

static void bytes_are_in_order(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const double got = arithmetics[k]->number(TL_NUMBER_BYTES24, 0x99563412u, 0, 24);
        const wide want = tl_oracle_unorm(0x123456u, 24);
        assert_true(fabsq(got - want) <= 2 * (wide)arithmetics[k]->u * want);
    }
}

static double turned(const double got[3], wide3 want)
{
    return (double)wide3_angle((wide3){got[0], got[1], got[2]}, want);
}

static void octahedra_are_within(void **state)
{
    static const uint32_t counts[] = {12, 16};
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const formulas *by = arithmetics[k];
        figure f =
            figure_of("encodings", "octahedron of 12 and 16 bits", "kernels/normal_code.h",
                      "rad", by, "numbers 1.5 each, two differences, the fold");
        uint64_t seed = 8;
        for (int i = 0; i < scaled_count(20000); i++) {
            const uint32_t bits = counts[i % 2], most = (1u << bits) - 1u;
            uint32_t field[2] = {bits_of(&seed) & most, bits_of(&seed) & most};
            if (i % 16 < 4) /* corners, edges and folds */
                field[i / 16 % 2] = i % 4 < 2 ? 0u : i % 8 < 4 ? most / 2 : most / 2 + 2;
            if (field[0] == most / 2 + 1 || field[1] == most / 2 + 1) /* none */
                continue;
            double e[2], got[3];
            for (int j = 0; j < 2; j++)
                e[j] = by->number(TL_NUMBER_SNORM, field[j], 0, bits);
            by->octahedron(e, got);
            const wide3 want = tl_oracle_octahedron(tl_oracle_snorm(field[0], (int)bits),
                                                    tl_oracle_snorm(field[1], (int)bits));
            figure_sees(&f, turned(got, want), 16.3 * by->u * (1 + 0x1p-20),
                        "(%u, %u) of %u bits", field[0], field[1], bits);
        }
        figure_report(&f);
    }
}

/* r is off by 2u, which turns by that over cos(t/2), and at the rim by what is left to it; steps after it by
 * 3u. */
static double spheremap_bound(wide ex, wide ey, wide u)
{
    const wide x = 4 * ex - 2, y = 4 * ey - 2, r = sqrtq(x * x + y * y);
    const wide inner = 2 * asinq(fmaxq(0, r - 2 * u) / 2), t = 2 * asinq(r / 2),
               outer = 2 * asinq(fminq(2, r + 2 * u) / 2);
    return (double)((fmaxq(outer - t, t - inner) + 3 * u) * (1 + 0x1p-20Q));
}

/* Halves of the disk, as renderers store them; beyond it nothing is stored. */
static void spheremaps_are_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const formulas *by = arithmetics[k];
        figure f = figure_of("encodings", "spheremap of halves", "kernels/normal_code.h", "rad",
                             by, "radius 2, steep at the rim; root, products");
        uint64_t seed = 1772;
        for (int i = 0; i < scaled_count(20000); i++) {
            const uint32_t a = bits_of(&seed) % 0x3c01u, b = bits_of(&seed) % 0x3c01u;
            const uint32_t first = i % 3 ? 0x3400u + a % 0x0801u : a,
                           second = i % 5 ? 0x3400u + b % 0x0801u : b;
            const wide ex = tl_oracle_binary(first, 1, 5, 10),
                       ey = tl_oracle_binary(second, 1, 5, 10);
            const wide x = 4 * ex - 2, y = 4 * ey - 2;
            if (x * x + y * y > 4)
                continue;
            const double e[2] = {by->number(TL_NUMBER_HALF, first, 0, 16),
                                 by->number(TL_NUMBER_HALF, second, 0, 16)};
            double got[3];
            by->spheremap(e, got);
            figure_sees(&f, turned(got, tl_oracle_spheremap(ex, ey)),
                        spheremap_bound(ex, ey, by->u), "(%a, %a)", e[0], e[1]);
        }
        figure_report(&f);
    }
}

/* stored: what reading the number gave. */
static void exponents_are_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const formulas *by = arithmetics[k];
        figure f =
            figure_of("encodings", "logarithm of an exponent", "kernels/color_code.h",
                      "of 1 + e", by, "difference, product with log2 10001; power 14; product");
        for (uint32_t field = 1; field < 256; field++) {
            const double stored = by->number(TL_NUMBER_UNORM, field, 0, 8);
            const wide want = tl_oracle_exponent(stored);
            figure_sees(&f, (double)(fabsq(by->exponent(stored) - want) / (1 + want)),
                        38.1 * by->u * (1 + 0x1p-20), "%u of 255", field);
        }
        assert_true(by->exponent(0.0) == 0.0);
        figure_report(&f);
    }
}

static void shared_exponents_are_exact(void **state)
{
    uint64_t seed = 995;
    (void)state;
    for (int i = 0; i < scaled_count(5000); i++) {
        const uint32_t word = bits_of(&seed);
        const wide3 want = tl_oracle_shared(word);
        for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
            double got[3];
            arithmetics[k]->shared(word, got);
            exact(arithmetics[k], "RGB9E5, red", word, got[0], want.x);
            exact(arithmetics[k], "RGB9E5, green", word, got[1], want.y);
            exact(arithmetics[k], "RGB9E5, blue", word, got[2], want.z);
        }
    }
}

/* kernels/vec3.h: what every normal goes through. Lengths from 1e-15 to 1e18. */
static void unit_vectors_are_within(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(arithmetics); k++) {
        const formulas *by = arithmetics[k];
        figure length = figure_of("encodings", "unit vector", "kernels/vec3.h", "length", by,
                                  "squares and sums, halved 1.5; root, quotient, products"),
               turn = figure_of("encodings", "unit vector", "kernels/vec3.h", "rad", by,
                                "products");
        uint64_t seed = 3;
        for (int i = 0; i < scaled_count(40000); i++) {
            const double scale = pow(10, bits_of(&seed) * 0x1p-32 * 33 - 15);
            const double flat = i % 4 == 3 ? 1e-4 : 1;
            float v[3];
            double got[3];
            for (int j = 0; j < 3; j++)
                v[j] = (float)((bits_of(&seed) * 0x1p-31 - 1) * scale * (j ? flat : 1));
            by->unit(v, got);
            const wide3 want = wide3_of(v), read = {got[0], got[1], got[2]};
            figure_sees(&length, (double)fabsq(wide3_length(read) - 1),
                        4.5 * by->u * (1 + 0x1p-20), "(%a, %a, %a)", (double)v[0], (double)v[1],
                        (double)v[2]);
            figure_sees(&turn, turned(got, want), by->u * (1 + 0x1p-20), "(%a, %a, %a)", v[0],
                        v[1], v[2]);
        }
        figure_report(&length);
        figure_report(&turn);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_exact),
        cmocka_unit_test(whole_numbers_are_within),
        cmocka_unit_test(bytes_are_in_order),
        cmocka_unit_test(octahedra_are_within),
        cmocka_unit_test(spheremaps_are_within),
        cmocka_unit_test(exponents_are_within),
        cmocka_unit_test(shared_exponents_are_exact),
        cmocka_unit_test(unit_vectors_are_within),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
